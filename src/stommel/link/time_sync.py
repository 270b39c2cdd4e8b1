"""How far a peer's clock is from ours, and how long a word takes to it and back: MAVLink's TIMESYNC, both ways."""

import math
from collections.abc import Callable
from typing import NamedTuple

from stommel.link.outbox import Outbox, Priority
from stommel.link.service import Peer, Received
from stommel.link.timing import RetransmissionTimer

DRIFT = 100e-6
"""By which two clocks differ in pace at most."""
_FIRST_PERIOD, _FIRST_ANSWERS = 1.0, 3
"""Between questions [s] until so many were answered."""
_MOST_PENDING, _MOST_ANSWERS, _MOST_PEERS = 16, 8, 32
_PATIENCE = 120.0
"""How long an answer is waited for, and how long a silent line is asked on [s]."""
_NANO = 1e-9
_LATEST = 9.2e9
"""What 63 bits of nanoseconds hold [s]."""


class Offset(NamedTuple):
    """Bounds of a peer's clock minus ours [s]: whatever the way there and the way back take, it lies between."""

    low: float
    high: float


class PeerClock:
    """What the answers of a peer have told."""

    def __init__(self) -> None:
        self.timer = RetransmissionTimer()
        """Of the round trip."""
        self.answers = 0
        self.jumps = 0
        """How often an answer contradicted those before: its clock was set."""
        self._bounds: tuple[float, float] | None = None
        self._at = 0.0

    def answered(self, sent: float, clock: float, t: float) -> None:
        """Take the peer's clock [s], read between our times of question and answer [s]."""
        self.answers += 1
        self.timer.measure(t - sent)
        wider = DRIFT * (t - sent)
        low, high = clock - t - wider, clock - sent + wider
        if self._bounds is not None:
            old = self.bounds(t)
            if max(low, old[0]) <= min(high, old[1]):
                low, high = max(low, old[0]), min(high, old[1])
            else:
                self.jumps += 1
        self._bounds, self._at = (low, high), t

    def bounds(self, t: float) -> tuple[float, float]:
        """Bounds of the peer's clock minus our time, at a time [s]; wider the older they are."""
        if self._bounds is None:
            return -math.inf, math.inf
        wider = DRIFT * max(t - self._at, 0.0)
        return self._bounds[0] - wider, self._bounds[1] + wider


class TimeSync:
    """A service that asks every peer for its clock, and answers those who ask.

    Parameters
    ----------
    clock
        Our clock [s] at a time [s]: UTC where it is known. Bounds are kept against the time itself, so that this clock
        may be set meanwhile.
    period
        Between two questions [s].
    """

    def __init__(self, clock: Callable[[float], float] = lambda t: t, period: float = 10.0) -> None:
        self._clock, self._period = clock, period
        self._due = self._heard = float("-inf")
        self._pending: dict[int, float] = {}
        self._to_answer: list[int] = []
        self._peers: dict[Peer, PeerClock] = {}

    def take(self, received: Received, t: float) -> None:
        """Take a question or an answer."""
        self._heard = t
        if received.name != "TIMESYNC":
            return
        clock, asked = received.values["tc1"], received.values["ts1"]
        if not isinstance(clock, int) or not isinstance(asked, int):
            return
        if clock == 0:
            self._to_answer = [*self._to_answer, asked][-_MOST_ANSWERS:]
            return
        sent = self._pending.get(asked)
        if sent is not None and t - sent <= _PATIENCE:
            self._peer((received.system, received.component)).answered(sent, clock * _NANO, t)

    def poll(self, t: float, outbox: Outbox) -> None:
        """Answer, and ask when it is due and somebody was heard."""
        now = self._clock(t)
        for asked in self._to_answer if math.isfinite(now) else ():
            outbox.put(Priority.COMMAND, "TIMESYNC", {"tc1": _nanoseconds(now), "ts1": asked})
        self._to_answer = []
        if t < self._due or t - self._heard > _PATIENCE:
            return
        number = _nanoseconds(t)
        while number in self._pending:
            number += 1
        self._pending[number] = t
        while len(self._pending) > _MOST_PENDING:
            del self._pending[next(iter(self._pending))]
        outbox.put(Priority.COMMAND, "TIMESYNC", {"ts1": number})
        settled = any(peer.answers >= _FIRST_ANSWERS for peer in self._peers.values())
        self._due = t + (self._period if settled else min(_FIRST_PERIOD, self._period))

    def offset(self, peer: Peer, t: float) -> Offset | None:
        """Bounds of a peer's clock minus ours at a time [s]; None before its first answer."""
        known = self._peers.get(peer)
        if known is None:
            return None
        ours = self._clock(t) - t
        low, high = known.bounds(t)
        return Offset(low - ours, high - ours)

    def latest(self, peer: Peer, t: float) -> float | None:
        """The latest that a peer's clock can show at a time [s]; None before its first answer."""
        known = self._peers.get(peer)
        return None if known is None else t + known.bounds(t)[1]

    def timer(self, peer: Peer) -> RetransmissionTimer | None:
        """Round trip to a peer and back; None before its first answer."""
        return self._peers[peer].timer if peer in self._peers else None

    def jumps(self, peer: Peer) -> int:
        """How often a peer's clock was set."""
        return self._peers[peer].jumps if peer in self._peers else 0

    def _peer(self, peer: Peer) -> PeerClock:
        if peer not in self._peers:
            if len(self._peers) >= _MOST_PEERS:
                del self._peers[next(iter(self._peers))]
            self._peers[peer] = PeerClock()
        return self._peers[peer]


def _nanoseconds(seconds: float) -> int:
    """A time as TIMESYNC says it; never 0, which is a question."""
    return max(round(min(max(seconds, 0.0), _LATEST) / _NANO), 1)
