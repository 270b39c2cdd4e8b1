"""What the vehicle knows of the clock ashore, by which commands expire."""

from collections.abc import Callable

from stommel.link.service import SHORE_COMPONENT, SHORE_SYSTEM
from stommel.link.time_sync import TimeSync

SHORE = (SHORE_SYSTEM, SHORE_COMPONENT)


class ShoreClock:
    """The shore's clock, by the questions and answers of TIMESYNC.

    Parameters
    ----------
    time_sync
        Has asked.
    clock
        Our own, that it tells [s].
    """

    def __init__(self, time_sync: TimeSync, clock: Callable[[float], float]) -> None:
        self._time_sync, self._clock = time_sync, clock

    def latest(self, t: float) -> float | None:
        """The latest that the shore's clock can show at a time [s] of ours [s]; None before they were compared."""
        offset = self._time_sync.offset(SHORE, t)
        return None if offset is None else self._clock(t) + offset.high
