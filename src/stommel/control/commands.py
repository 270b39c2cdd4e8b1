"""What the vehicle's software tells the machinery: actuators, loads, sampling, radio."""

from typing import NamedTuple

LOAD_UNDERWATER, LOAD_DIVE, LOAD_CLIMB, LOAD_SURFACE, LOAD_DRIFT = 1, 2, 4, 8, 16
"""Groups of consumers that are switched together, as bits of `Commands.loads`; a consumer's `on` in the vehicle file
names its group. What is always on needs no command."""

GOING_ON, COMPLETE, ABORTED = range(3)
"""Whether the software has anything left to do."""


class Commands(NamedTuple):
    """What the software wants, SI units and radians."""

    r_px: float
    """Moving-mass position [m]."""
    V_b: float
    """Ballast volume [m3]."""
    steering: float
    """Angle of the rudder, or of the rolling mass [rad]."""
    hold_mass: float
    """Distance from the commanded position below which the mass's drive stays off [m]."""
    loads: int
    """Groups of consumers that are on, bits of `LOAD_UNDERWATER` to `LOAD_DRIFT`."""
    sampling: bool
    """Whether the payload measures."""
    radio: bool
    """Whether GPS listens and the radio calls."""
    ended: int
    """`GOING_ON`, or why the mission is over: `COMPLETE`, `ABORTED`."""
