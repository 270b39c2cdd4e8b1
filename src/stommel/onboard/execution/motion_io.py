"""What the motion-control board's pins say and do."""

from typing import NamedTuple


class MotionReadings(NamedTuple):
    """Readings of the board's own sensors; SI units and radians, not a number where a sensor does not answer."""

    V_b: float
    """Ballast volume by the displacement of the oil cylinder's piston [m3]."""
    r_px: float
    """Position of the moving mass [m]."""
    steering: float
    """Angle of the rudder, or of the rolling mass [rad]."""
    limit_fore: bool
    """Forward limit switch of the moving mass."""
    limit_aft: bool
    """Aft limit switch."""
    pump_current: float
    """[A]"""
    mass_current: float
    """[A]"""
    steering_current: float
    """[A]"""


class DriveOutputs(NamedTuple):
    """What the board's power stages do until the next step of the node.

    Motors run for a share of that time, by a timer of the board: it stops them even if the software does not.
    """

    pump: float
    """Share of the time that the pump runs, 0 to 1."""
    valve: float
    """Share of the time that the valve is open, 0 to 1."""
    mass: float
    """Share of the time that the moving mass is driven, forward positive, -1 to 1."""
    steering: float
    """Share of the time that the steering is driven, -1 to 1."""
    brake: bool
    """Whether the brake of the rudder is on: it is without current."""
    drop_weight: bool
    """Whether the release of the drop weight has current."""


AT_REST = DriveOutputs(0.0, 0.0, 0.0, 0.0, True, False)
"""Nothing moves, the brake holds."""
