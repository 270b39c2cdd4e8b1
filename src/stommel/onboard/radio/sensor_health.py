"""Which sensors and drives are sound, by the bits of SYS_STATUS, from start checks and alarms."""

from functools import cache
from typing import NamedTuple

from stommel.messages.mavlink import Fields, enumeration
from stommel.onboard.coordination.failsafes import Reaction
from stommel.onboard.coordination.safety import SafetyState


class SensorRow(NamedTuple):
    """What one or more bits stand for."""

    bits: tuple[str, ...]
    """MAV_SYS_STATUS_SENSOR, without its beginning."""
    checks: tuple[str, ...]
    """Start checks that must have passed."""
    alarms: tuple[str, ...]
    """Alarms that must not stand."""


SENSORS = (
    SensorRow(("SENSOR_3D_ACCEL", "SENSOR_3D_MAG", "AHRS"), ("compass",), ("silent compass",)),
    SensorRow(
        ("SENSOR_ABSOLUTE_PRESSURE",), ("pressure sensor",),
        ("silent pressure sensor", "pressure sensor stuck", "blind, last resort"),
    ),
    SensorRow(("SENSOR_GPS",), ("GPS",), ("silent GPS",)),
    SensorRow(
        ("SENSOR_MOTOR_OUTPUTS",), ("pump", "moving mass", "steering"),
        (
            "pump stuck", "valve stuck", "moving mass stuck", "steering stuck", "over-current of a motor",
            "limit switch", "silent displacement sensor", "silent mass position", "silent steering angle",
        ),
    ),
    SensorRow(("LOGGING",), ("log",), ("log not written",)),
    SensorRow(
        ("SENSOR_BATTERY",), ("battery",),
        ("low battery", "low voltage", "voltage nearly gone", "over-current of the battery", "silent battery gauge"),
    ),
)  # fmt: skip
"""PREARM_CHECK stands beside these for all start checks and for alarms that forbid a dive."""
_KEYS = tuple(f"onboard_control_sensors_{word}" for word in ("present", "enabled", "health"))


def sensor_health(safety: SafetyState) -> Fields:
    """Fields of SYS_STATUS: what is there, what is used, and of that what is sound."""
    alarms, ready = {alarm.name for alarm in safety.active}, not safety.unproven and safety.worst < Reaction.NO_DIVE
    present, health = _bits(("PREARM_CHECK",)), _bits(("PREARM_CHECK",)) * ready
    for row in SENSORS:
        present |= _bits(row.bits)
        if not alarms.intersection(row.alarms) and not set(safety.unproven).intersection(row.checks):
            health |= _bits(row.bits)
    return dict(zip(_KEYS, (present, present, health), strict=True))


@cache
def _bits(names: tuple[str, ...]) -> int:
    entries = enumeration("MAV_SYS_STATUS_SENSOR")
    return sum(entries[f"MAV_SYS_STATUS_{name}"] for name in names)
