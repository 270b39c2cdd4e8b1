"""What a vehicle has told of itself, as people and scripts read it; what it has not told is None."""

import math
from collections.abc import Callable
from typing import Any, NamedTuple

from stommel.link.shore.heard import Heard
from stommel.messages.mavlink import FieldValue, entry_words

_ARMED = 128
_DEGREES = math.degrees(1.0)


class Cell(NamedTuple):
    """One value of the status."""

    key: str
    """In JSON; its ending is the unit."""
    words: str
    """In a table."""
    message: str
    value: Callable[[dict[str, Any]], Any]
    shown: Callable[[Any], str] = str


def _of(field: str, scale: float = 1.0) -> Callable[[dict[str, Any]], float | None]:
    def value(fields: dict[str, Any]) -> float | None:
        found: FieldValue = fields[field]
        assert isinstance(found, int | float)
        return found * scale if math.isfinite(found) else None

    return value


def _unless(field: str, unknown: int, scale: float = 1.0) -> Callable[[dict[str, Any]], float | None]:
    return lambda fields: None if fields[field] == unknown else fields[field] * scale


def _heading(fields: dict[str, Any]) -> float | None:
    return math.degrees(fields["yaw"]) % 360.0 if math.isfinite(fields["yaw"]) else None


def _unit(form: str, unit: str) -> Callable[[Any], str]:
    return lambda value: f"{value:{form}} {unit}"


def _state(fields: dict[str, Any]) -> str:
    state = entry_words("GLIDER_EXECUTIVE").get(fields["executive"], f"state {fields['executive']}")
    phase = entry_words("GLIDER_PHASE").get(fields["phase"], f"phase {fields['phase']}")
    return f"{state}: {phase}" if state == "mission" else state


def _alarms(fields: dict[str, Any]) -> list[str]:
    return [words for bit, words in entry_words("GLIDER_ALARM").items() if fields["alarms"] & bit]


def _alarm_words(alarms: list[str]) -> str:
    return ", ".join(alarms) or "none"


_STATE, _PLACE, _WAY, _POWER = "GLIDER_STATE", "GLOBAL_POSITION_INT", "NAVIGATION_ESTIMATE", "ENERGY_STATE"

CELLS = (
    Cell("state", "state", _STATE, _state),
    Cell("mission_started", "mission started", "HEARTBEAT", lambda f: bool(f["base_mode"] & _ARMED),
         lambda started: "yes" if started else "no"),
    Cell("alarms", "alarms", _STATE, _alarms, _alarm_words),
    Cell("mission", "mission", _STATE, lambda f: f["mission"], lambda n: f"number {n}" if n else "none"),
    Cell("dive", "dive", _STATE, lambda f: f["dive"]),
    Cell("waypoint", "waypoint", _STATE, lambda f: f["waypoint"] + 1, lambda n: f"number {n}"),
    Cell("surface_time_left_s", "until the next dive", _STATE, _of("surface_time_left"), _unit(".0f", "s")),
    Cell("depth_m", "depth", _STATE, _of("depth"), _unit(".1f", "m")),
    Cell("altitude_m", "above the sea floor", _STATE, _of("altitude"), _unit(".1f", "m")),
    Cell("latitude_deg", "latitude", _PLACE, _of("lat", 1e-7), _unit(".5f", "deg")),
    Cell("longitude_deg", "longitude", _PLACE, _of("lon", 1e-7), _unit(".5f", "deg")),
    Cell("position_sigma_m", "position may be wrong by", _WAY, _of("sigma"), _unit(".0f", "m")),
    Cell("fix_age_s", "last position by GPS", _WAY, _of("fix_age"), _unit(".0f", "s ago")),
    Cell("waypoint_distance_m", "to the waypoint", _WAY, _of("waypoint_distance"), lambda m: f"{m / 1e3:.2f} km"),
    Cell("current_north_m_s", "current to the north", _WAY, _of("current_north"), _unit(".2f", "m/s")),
    Cell("current_east_m_s", "current to the east", _WAY, _of("current_east"), _unit(".2f", "m/s")),
    Cell("heading_deg", "heading", "ATTITUDE", _heading, _unit(".0f", "deg")),
    Cell("pitch_deg", "pitch", "ATTITUDE", _of("pitch", _DEGREES), _unit(".1f", "deg")),
    Cell("roll_deg", "roll", "ATTITUDE", _of("roll", _DEGREES), _unit(".1f", "deg")),
    Cell("ballast_ml", "ballast volume", "BUOYANCY_ENGINE_STATE", _of("ballast", 1e6), _unit(".0f", "ml")),
    Cell("moving_mass_mm", "moving mass", "MOVING_MASS_STATE", _of("position", 1e3), _unit(".1f", "mm")),
    Cell("voltage_v", "battery", _POWER, _of("voltage"), _unit(".2f", "V")),
    Cell("battery_left_share", "battery left", "SYS_STATUS", _unless("battery_remaining", -1, 0.01),
         lambda share: f"{share:.0%}"),
)  # fmt: skip
"""The status of a vehicle, in the order in which people want it."""


def status_of(heard: Heard) -> dict[str, Any]:
    """Return the status by the keys of `CELLS`; None where the vehicle has not told."""
    return {cell.key: _value(heard, cell) for cell in CELLS}


def status_words(status: dict[str, Any]) -> dict[str, str]:
    """Return what is known of a status, as a table shows it."""
    return {cell.words: cell.shown(status[cell.key]) for cell in CELLS if status.get(cell.key) is not None}


def _value(heard: Heard, cell: Cell) -> Any:
    said = heard.last.get(cell.message)
    return None if said is None else cell.value(said.values)
