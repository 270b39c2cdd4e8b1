"""What the vehicle knows of the clock ashore, by which commands expire."""

from stommel.link.service import SHORE_COMPONENT, SHORE_SYSTEM
from stommel.link.time_sync import TimeSync

SHORE = (SHORE_SYSTEM, SHORE_COMPONENT)


class ShoreClock:
    """The shore's clock, by the questions and answers of TIMESYNC; our own need not be right for it."""

    def __init__(self, time_sync: TimeSync) -> None:
        self._time_sync = time_sync

    def latest(self, t: float) -> float | None:
        """The latest that the shore's clock can show at a time [s] of ours [s]; None before they were compared."""
        return self._time_sync.latest(SHORE, t)
