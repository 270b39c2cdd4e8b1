"""Flying at a multiple of real time, by a clock that is handed in."""

import time
from collections.abc import Callable
from dataclasses import dataclass, field

PATIENCE = 1.0
"""Delay that is made up for [s]; what is beyond it is given up, and counted as lost."""


@dataclass
class Pace:
    """Lets the time of the mission pass as fast as that of a clock, or a multiple.

    A loop that cannot keep up does not race afterwards: the delay stays, and `lost` tells it.
    """

    speed: float
    """Times real time."""
    clock: Callable[[], float] = time.monotonic
    """Says the time [s]; it never runs backwards."""
    sleep: Callable[[float], None] = time.sleep
    lost: float = 0.0
    """Time by which the mission fell behind the clock for good [s]."""
    _began: float | None = field(default=None, repr=False)

    def wait(self, t: float) -> None:
        """Return when it is time for a time of the mission [s]; the first call says which time is now."""
        now = self.clock()
        if self._began is None:
            self._began = now - t / self.speed
        ahead = self._began + t / self.speed - now
        if ahead > 0.0:
            self.sleep(ahead)
        elif -ahead > PATIENCE:
            self._began -= ahead
            self.lost -= ahead
