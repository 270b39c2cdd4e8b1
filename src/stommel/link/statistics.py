"""How the link is, seen from this end: for whoever looks here, and told to the peers."""

import math
from collections.abc import Callable
from typing import NamedTuple, Protocol

from stommel.link.outbox import Outbox, Priority
from stommel.link.sequence import SequenceCounts
from stommel.link.service import Peer, Received
from stommel.link.session import Session
from stommel.link.time_sync import TimeSync
from stommel.link.traffic import Traffic
from stommel.link.values import boot_ms
from stommel.messages.mavlink import Fields

NAME = "LINK_STATISTICS"
_MOST = 0xFFFFFFFF
_MOST_PEERS = 4
"""Peers whose figures are told in one period."""


class RefusalCounts(Protocol):
    """Frames that a guard did not believe, since the start."""

    @property
    def unsigned(self) -> int:
        """Without a signature."""

    @property
    def wrongly_signed(self) -> int:
        """With one that does not hold."""

    @property
    def replayed(self) -> int:
        """With one whose time stamp is old, or too far ahead."""

    @property
    def out_of_step(self) -> int:
        """With one of an end that had not heard this one yet, or while the own stamps were lost."""


class Refusals(NamedTuple):
    """These counts at one time."""

    unsigned: int = 0
    wrongly_signed: int = 0
    replayed: int = 0
    out_of_step: int = 0
    """Not told over the link: it is no sign of anybody else."""


NOTHING_REFUSED = Refusals()


class LinkStatistics(NamedTuple):
    """The link to one peer; counts since the start, times in seconds."""

    good: int
    """Frames that were accepted."""
    bad: int
    """Frames with a wrong checksum and stretches of garbage, from whomever."""
    duplicate: int
    """Frames that came again."""
    lost: int
    """Frames missing between those that came."""
    refusals: Refusals
    """From whomever."""
    round_trip_time: float
    """Smoothed; not a number before it was measured."""
    time_out: float
    """After which is asked again; not a number before."""
    goodput: float
    """New payload of files [B/s]."""
    retransmit_ratio: float
    """Bytes sent again to bytes sent."""
    bytes_waiting: int
    """To be sent."""
    surface_time_left: float
    """Until the next dive; not a number if unknown."""
    is_signing: bool
    """Whether every frame is signed and checked."""

    @property
    def loss(self) -> float:
        """Share of the peer's frames that did not come."""
        sent = self.good + self.lost
        return self.lost / sent if sent else 0.0


class Statistics:
    """A service that tells the figures of each peer, and keeps what peers tell of theirs.

    Parameters
    ----------
    session
        It counts the frames. Add this service to it afterwards.
    time_sync
        Measures the round trip.
    traffic
        Of files.
    surface_time_left
        Until the next dive [s]; not a number if unknown.
    refusals
        Of the guard.
    period
        Between two messages [s].
    """

    def __init__(
        self,
        session: Session,
        time_sync: TimeSync | None = None,
        traffic: Traffic | None = None,
        surface_time_left: Callable[[], float] = lambda: math.nan,
        refusals: RefusalCounts = NOTHING_REFUSED,
        period: float = 10.0,
    ) -> None:
        self._session, self._time_sync = session, time_sync
        self.traffic = Traffic() if traffic is None else traffic
        self._surface_time_left, self._refusals = surface_time_left, refusals
        self._period, self._due = period, float("-inf")
        self.told: dict[Peer, tuple[float, Fields]] = {}
        """The last figures that each peer told of its side, and when [s]."""

    def take(self, received: Received, t: float) -> None:
        """Keep what a peer tells."""
        if received.name == NAME:
            self.told[received.system, received.component] = t, received.values
            self.told = {peer: told for peer, told in self.told.items() if peer in self._session.peers()}

    def poll(self, t: float, outbox: Outbox) -> None:
        """Tell the figures when they are due."""
        if t < self._due:
            return
        self._due = t + self._period
        for peer in list(self._session.peers())[-_MOST_PEERS:]:
            outbox.put(Priority.STATE, NAME, _fields(peer, self.of(peer, t), t))

    def of(self, peer: Peer, t: float) -> LinkStatistics:
        """Return the figures of a peer at a time [s]; zeros if it was never heard."""
        session = self._session
        counts = session.peers().get(peer, SequenceCounts())
        refused = self._refusals
        timer = None if self._time_sync is None else self._time_sync.timer(peer)
        round_trip = None if timer is None else timer.round_trip
        return LinkStatistics(
            good=counts.good,
            bad=session.bad,
            duplicate=counts.duplicate,
            lost=counts.lost,
            refusals=Refusals(refused.unsigned, refused.wrongly_signed, refused.replayed, refused.out_of_step),
            round_trip_time=math.nan if round_trip is None else round_trip,
            time_out=math.nan if timer is None else timer.time_out,
            goodput=self.traffic.goodput(t),
            retransmit_ratio=self.traffic.retransmit_ratio,
            bytes_waiting=session.outbox.waiting,
            surface_time_left=self._surface_time_left(),
            is_signing=session.guard is not None and session.guard.signs,
        )


def _fields(peer: Peer, seen: LinkStatistics, t: float) -> Fields:
    """Fields of the message."""
    return {
        "time_boot_ms": boot_ms(t),
        "peer_system": peer[0],
        "peer_component": peer[1],
        "good": min(seen.good, _MOST),
        "bad": min(seen.bad, _MOST),
        "duplicate": min(seen.duplicate, _MOST),
        "lost": min(max(seen.lost, 0), _MOST),
        "unsigned_refused": min(seen.refusals.unsigned, _MOST),
        "wrongly_signed_refused": min(seen.refusals.wrongly_signed, _MOST),
        "replayed_refused": min(seen.refusals.replayed, _MOST),
        "round_trip_time": seen.round_trip_time,
        "time_out": seen.time_out,
        "goodput": seen.goodput,
        "retransmit_ratio": seen.retransmit_ratio,
        "bytes_waiting": min(seen.bytes_waiting, _MOST),
        "surface_time_left": seen.surface_time_left,
        "is_signing": seen.is_signing,
    }
