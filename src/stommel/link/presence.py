"""Who is there: heartbeats of this end, and when each peer was heard."""

from collections.abc import Callable
from dataclasses import dataclass, field

from stommel.link.outbox import Outbox, Priority
from stommel.link.service import Peer, Received
from stommel.messages.mavlink import Fields, FieldValue

SHORE_HEARTBEAT: Fields = {"type": 6, "autopilot": 8, "base_mode": 0, "system_status": 4, "mavlink_version": 3}
"""Of a shore station: MAV_TYPE_GCS, MAV_AUTOPILOT_INVALID, MAV_STATE_ACTIVE."""
SHORTEST_SILENCE, LONGEST_SILENCE = 5.0, 60.0
"""Between these a peer is lost that is not heard for four of its intervals [s]."""
_INTERVALS = 4.0
_WEIGHT = 0.25
"""Of a new interval in the mean."""
_MOST_PEERS = 32
_BACK_MS, _ROUND_MS = 10_000, 1 << 32
"""How far a peer's time since boot goes back at least when it has restarted, and when it comes round [ms]."""


@dataclass
class PeerPresence:
    """What is known of a peer; times are ours [s]."""

    heard: float
    """When it was heard last."""
    since: float
    """Since when it is heard without a pause."""
    restarts: int = 0
    """How often its time since boot went back."""
    heartbeat: Fields = field(default_factory=dict)
    """Its last heartbeat; empty before the first."""
    interval: float = 1.0
    """Mean time between its heartbeats, as they arrive [s]."""
    _beat: float | None = None
    _boot_ms: int | None = None

    @property
    def longest_silence(self) -> float:
        """After which it is lost [s]."""
        return min(max(_INTERVALS * self.interval, SHORTEST_SILENCE), LONGEST_SILENCE)

    def is_heard(self, t: float) -> bool:
        """Whether it is there at a time [s]."""
        return t - self.heard <= self.longest_silence

    def hear(self, received: Received, t: float) -> None:
        """Take note of a message of it at a time [s]."""
        if not self.is_heard(t):
            self.since = t
        self.heard = t
        if received.name == "HEARTBEAT":
            if self._beat is not None and 0.0 < t - self._beat <= LONGEST_SILENCE:
                self.interval += _WEIGHT * (t - self._beat - self.interval)
            self._beat, self.heartbeat = t, received.values
        self._look_at_boot(received.values.get("time_boot_ms"))

    def _look_at_boot(self, boot_ms: FieldValue | None) -> None:
        if not isinstance(boot_ms, int):
            return
        if self._boot_ms is not None:
            back = (self._boot_ms - boot_ms) % _ROUND_MS
            if back < _BACK_MS:  # one that came late
                return
            self.restarts += back < _ROUND_MS // 2
        self._boot_ms = boot_ms


class Presence:
    """A service that says heartbeats and notes who is heard.

    A peer that was silent for a day is heard with its first message: nothing has to be enabled again.

    Parameters
    ----------
    heartbeat
        Fields of ours, asked for before each; None where another service says it.
    period
        Between two of ours [s].
    """

    def __init__(self, heartbeat: Callable[[], Fields] | None = None, period: float = 1.0) -> None:
        self._heartbeat, self._period = heartbeat, period
        self._due = float("-inf")
        self.peers: dict[Peer, PeerPresence] = {}

    def take(self, received: Received, t: float) -> None:
        """Note that somebody is there."""
        peer = received.system, received.component
        if peer not in self.peers:
            if len(self.peers) >= _MOST_PEERS:
                del self.peers[min(self.peers, key=lambda known: self.peers[known].heard)]
            self.peers[peer] = PeerPresence(t, t)
        self.peers[peer].hear(received, t)

    def poll(self, t: float, outbox: Outbox) -> None:
        """Say the heartbeat when it is due."""
        if self._heartbeat is not None and t >= self._due:
            outbox.put(Priority.STATE, "HEARTBEAT", self._heartbeat())
            self._due = t + self._period

    def is_heard(self, t: float, system: int | None = None, component: int | None = None) -> bool:
        """Whether anybody is there at a time [s], of a system and component if they are given."""
        return any(
            known.is_heard(t)
            for peer, known in self.peers.items()
            if system in (None, peer[0]) and component in (None, peer[1])
        )
