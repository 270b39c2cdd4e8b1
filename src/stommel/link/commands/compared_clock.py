"""The clock by which commands expire, as TIMESYNC has bounded it."""

from stommel.link.service import Peer
from stommel.link.time_sync import TimeSync


class ComparedClock:
    """What is known of the clock of one peer."""

    def __init__(self, sync: TimeSync, peer: Peer) -> None:
        self._sync, self._peer = sync, peer

    def latest(self, t: float) -> float | None:
        """The latest that its clock can show at a time [s] of ours [s]; None before they were compared."""
        return self._sync.latest(self._peer, t)
