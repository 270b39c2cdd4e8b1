"""What the vehicle's software is told by its sensors: never the truth, always what a sensor says."""

import math
from typing import NamedTuple

from stommel.compilation import inlined


class Readings(NamedTuple):
    """What the sensors say at one decision; SI units and radians."""

    down_b2: float
    """Direction down as the accelerometers feel it, along b2 to starboard."""
    down_b3: float
    """The same along b3, through the keel."""
    theta: float
    """Pitch [rad]."""
    psi: float
    """Heading by the compass [rad]."""
    depth: float
    """By the pressure sensor [m]."""
    altitude: float
    """Height above the bottom [m]; infinite where none is heard."""
    r_px: float
    """Moving-mass position [m]."""
    V_b: float
    """Ballast volume by the displacement of the oil [m3]."""
    steering: float
    """Angle of the rudder, or of the rolling mass [rad]."""
    leak: bool
    """Whether a leak detector is wet."""
    internal_pressure: float
    """Of the air in the hull, absolute [Pa]."""
    voltage: float
    """Of the battery [V], the mean since the last decision."""
    current: float
    """Out of the battery [A], the mean since the last decision."""
    fixed: bool
    """Whether GPS has told a position since the last decision."""
    fix_time: float
    """When it held [s]."""
    fix_latitude: float
    """[rad]"""
    fix_longitude: float
    """[rad]"""

    @property
    def phi(self) -> float:
        """Roll [rad]; compiled code calls `roll`."""
        return roll(self)


@inlined
def roll(readings: Readings) -> float:
    """Roll [rad], starboard down; worked out when it is asked for, since the vehicle's own laws do not."""
    return math.atan2(readings.down_b2, readings.down_b3)
