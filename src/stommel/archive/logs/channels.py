"""Which channels the records of a log tell, in the units of the channels; a log describes its fields by name."""

import math
from collections.abc import Callable, Mapping
from typing import Any

Fields = Mapping[str, Any]
Value = Callable[[Fields], float | None]
"""Of the fields of a record; None where they do not tell."""

_DEGREES, _ML, _MM = math.degrees(1.0), 1e6, 1e3
_SIGMA = 1.0 / math.sqrt(2.0)
"""The radio tells the uncertainty along one direction, the log that of the place."""


def _finite(value: object) -> float | None:
    return float(value) if isinstance(value, int | float) and math.isfinite(value) else None


def _of(field: str, scale: float = 1.0, more: float = 0.0) -> Value:
    def value(fields: Fields) -> float | None:
        found = _finite(fields.get(field))
        return None if found is None else found * scale + more

    return value


def _heading(fields: Fields) -> float | None:
    psi = _finite(fields.get("psi"))
    return None if psi is None else math.degrees(psi) % 360.0


def _roll(fields: Fields) -> float | None:
    side, keel = _finite(fields.get("down_b2")), _finite(fields.get("down_b3"))
    return None if side is None or keel is None else math.degrees(math.atan2(side, keel))


def _fix_age(fields: Fields) -> float | None:
    t, fix = _finite(fields.get("t")), _finite(fields.get("fix_time"))
    return t - fix if t is not None and fix is not None and 0.0 <= fix <= t else None


CHANNELS: Mapping[str, tuple[tuple[str, Value], ...]] = {
    "readings": (
        ("depth_m", _of("depth")), ("altitude_m", _of("altitude")), ("pitch_deg", _of("theta", _DEGREES)),
        ("roll_deg", _roll), ("heading_deg", _heading), ("fix_age_s", _fix_age),
    ),
    "commands": (
        ("ballast_setpoint_ml", _of("V_b", _ML)), ("moving_mass_setpoint_mm", _of("r_px", _MM)),
        ("steering_setpoint_deg", _of("steering", _DEGREES)),
    ),
    "decision": (("phase", _of("phase")), ("dive", _of("dives")), ("waypoint", _of("waypoint", more=1.0))),
    "navigation": (
        ("latitude_deg", _of("latitude", _DEGREES)), ("longitude_deg", _of("longitude", _DEGREES)),
        ("position_sigma_m", _of("sigma", _SIGMA)), ("current_north_m_s", _of("current_north")),
        ("current_east_m_s", _of("current_east")),
    ),
    "actuators": (
        ("ballast_ml", _of("V_b", _ML)), ("moving_mass_mm", _of("r_px", _MM)),
        ("steering_deg", _of("steering", _DEGREES)), ("pump_current_a", _of("pump_current")),
        ("mass_current_a", _of("mass_current")),
    ),
    "battery": (
        ("voltage_v", _of("voltage")), ("battery_current_a", _of("current")),
        ("battery_temperature_degc", _of("temperature")), ("energy_used_kj", _of("energy_used", 1e-3)),
    ),
    "ctd": (
        ("pressure_dbar", _of("pressure")), ("temperature_degc", _of("temperature")),
        ("conductivity_s_m", _of("conductivity")),
    ),
    "event": (),
}  # fmt: skip
"""By kind of record that says something here: key of the channel and its value."""
