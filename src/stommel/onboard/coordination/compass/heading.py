"""Attitude and heading from what accelerometers and magnetometers feel, compensated for tilt."""

import math

Vector = tuple[float, float, float]

STRAIGHT: tuple[Vector, Vector, Vector] = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))
"""No soft iron."""


def attitude_of(acceleration: Vector) -> tuple[float, float]:
    """Pitch and roll [rad] from the acceleration, which a compass at rest and level feels as (0, 0, 1) g."""
    x, y, z = acceleration
    return math.atan2(-x, math.sqrt(y * y + z * z)), math.atan2(y, z)


def heading_of(acceleration: Vector, field: Vector) -> float:
    """Magnetic heading [rad] in (-pi, pi]: east is down cross field, north is east cross down.

    Parameters
    ----------
    acceleration
        Direction down in the body frame; its length does not matter.
    field
        Magnetic field in the body frame, calibrated; its length does not matter.
    """
    x, y, z = acceleration
    b1, b2, b3 = field
    east = (y * b3 - z * b2, z * b1 - x * b3, x * b2 - y * b1)
    north = east[1] * z - east[2] * y
    return math.atan2(east[0] * math.sqrt(x * x + y * y + z * z), north)


def inclination_of(acceleration: Vector, field: Vector) -> float:
    """Angle by which the field points below the horizon [rad]."""
    across = math.hypot(*acceleration) * math.hypot(*field)
    along = sum(a * b for a, b in zip(acceleration, field, strict=True))
    return math.asin(max(-1.0, min(1.0, along / across))) if across > 0.0 else 0.0
