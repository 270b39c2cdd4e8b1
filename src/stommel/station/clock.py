"""Time of a vehicle's world: UTC for a real one; for a simulated one what its own clock shows, and as fast."""

import math
import time
from collections.abc import Callable
from dataclasses import dataclass

from stommel.files.storage import Storage
from stommel.link.keeping import DamagedError, keep, kept

FILE = "clock"
_WEIGHT = 0.25
"""Of a small difference, that is made up for at once."""
_STEP = 2.0
"""A greater difference [s at the vehicle's speed] is made up for at once."""
LEAST_SPEED, MOST_SPEED = 0.1, 1000.0
FIRST, LAST = 946_684_800.0, 4_102_444_800.0
"""Times that a vehicle can show: 2000 to 2100 [s since 1970]."""


@dataclass(frozen=True)
class Anchor:
    """Where the evenly running time of the link lies on UTC."""

    utc: float
    link: float
    speed: float
    offset: float | None
    """Of the vehicle's clock to it [s]; None before a simulated vehicle has told its clock."""


class VehicleClock:
    """Two times that go `speed` times as fast as this machine's.

    The time of the link goes on evenly, also over a restart of the station, since commands expire by it. The time of
    the vehicle is what people see and what is kept: for a real vehicle both are UTC; for a simulated one the
    vehicle's SYSTEM_TIME sets it, when it is first heard and whenever the simulation is slower than asked for.

    Parameters
    ----------
    speed
        Of the vehicle's world, times real time.
    simulated
        Whether the vehicle has a clock of its own world; a vehicle at another speed than 1 always has.
    utc, monotonic
        Clocks of this machine [s].
    """

    def __init__(
        self,
        speed: float = 1.0,
        *,
        simulated: bool | None = None,
        utc: Callable[[], float] = time.time,
        monotonic: Callable[[], float] = time.monotonic,
    ) -> None:
        self.speed = speed
        self.simulated = speed != 1.0 if simulated is None else simulated or speed != 1.0
        self._monotonic, self._began, self._utc = monotonic, monotonic(), utc()
        self._link = self._utc
        self._offset: float | None = None if self.simulated else 0.0

    @property
    def is_set(self) -> bool:
        """Whether the vehicle's time is known."""
        return self._offset is not None

    def link_now(self) -> float:
        """Time of the link [s]; goes on evenly."""
        return self._link + self.speed * (self._monotonic() - self._began)

    def now(self) -> float:
        """UTC of the vehicle's world [s since 1970]."""
        return self.of_link(self.link_now())

    def of_link(self, t: float) -> float:
        """Time of the vehicle at a time of the link [s]; a clock that runs out of what can be shown stands still."""
        return min(t + (self._offset or 0.0), LAST)

    def hear(self, utc: float, t: float) -> bool:
        """Take what the vehicle's clock showed at a time of the link [s]; whether the clock was set anew by it."""
        if not self.simulated or not FIRST <= utc <= LAST:
            return False
        wrong = math.inf if self._offset is None else utc - t - self._offset
        if abs(wrong) > _STEP * max(self.speed, 1.0):
            self._offset = utc - t
            return True
        self._offset = (self._offset or 0.0) + _WEIGHT * wrong
        return False

    def keep(self, storage: Storage) -> None:
        """Keep where the times lie, so that they go on evenly after a restart.

        Raises
        ------
        OSError
            The disk does not keep it.
        """
        if self.simulated:
            elapsed = self._monotonic() - self._began
            keep(storage, FILE, {
                "utc": self._utc + elapsed, "link": self.link_now(), "offset": self._offset
            })  # fmt: skip

    def restore(self, storage: Storage) -> None:
        """Go on from what was kept, as if the station had run meanwhile; damage is passed over: it costs a restart."""
        if not self.simulated:
            return
        try:
            told = kept(storage, FILE)
            if told is None:
                return
            since = max(0.0, self._utc - float(told["utc"]))
            link = float(told["link"]) + self.speed * since
            offset = told["offset"]
            if math.isfinite(link) and 0.0 <= link < 1e11:
                self._link = link
                self._offset = None if offset is None else float(offset)
        except (DamagedError, OSError, ValueError, KeyError, TypeError):
            return
