"""From orders back to a plan that makes them again: what the vehicle flies, opened for changes.

Orders hold ballast volumes where a plan may hold a speed; the plan that is opened has `dives.ballast_ml`, by the water
that it expects. Numbers are rounded to nine digits, so that plan and orders that were opened once stay as they are.
"""

from dataclasses import dataclass
from math import degrees, inf, isfinite, isnan
from typing import Any

import numpy as np

from stommel.control.dive_cycle import PHASES
from stommel.control.orders import Orders
from stommel.control.orders_file import OrdersHeader, parse_orders
from stommel.errors import StommelError
from stommel.mission.plan import Sampling, Surfacing
from stommel.planning.ballasting import afloat_volume, mass_position_at_rest, neutral_ballast, surplus_afloat, water_of
from stommel.planning.deployment import Deployment
from stommel.plans.preview.mission import mission_of
from stommel.plans.problems import plan_from
from stommel.simulation.planned_orders import planned_orders
from stommel.simulation.plant.building import plant_of
from stommel.simulation.scenario.mission import Mission
from stommel.vehicle import load_vehicle
from stommel.vehicle.fingerprint import untrimmed_fingerprint

ORIGIN = "orders"
_ALIKE = 1e-6
"""Share by which two numbers may differ that mean the same."""
_SOME_BALLAST, _LEAST_BALLAST = 100.0, 0.1
"""Of dives whose ballast is still to be found; and the least that a plan may have [ml]."""
_NOTABLE_ML = 2.0
"""Difference of ballast volumes that is told of."""
_STEPS = 60
"""Halvings in the search of a pitch."""


@dataclass(frozen=True)
class Opened:
    """A plan, and what of the orders it cannot hold."""

    plan: dict[str, Any]
    remarks: tuple[str, ...]

    def as_row(self) -> dict[str, Any]:
        """The same as JSON has it."""
        return {"plan": self.plan, "remarks": list(self.remarks)}


def opened(text: str, around: dict[str, Any], origin: str = ORIGIN) -> Opened:
    """Return the plan of orders.

    Parameters
    ----------
    text
        Of the orders file.
    around
        What orders do not hold: `vehicle`, `start`, and if known `start_time` and `water`, as a plan has them.
    origin
        Names the orders in messages.

    Raises
    ------
    FileError
        The text is no orders file, or is one for another vehicle.
    StommelError
        The vehicle or the water cannot be used.
    """
    vehicle = load_vehicle(around["vehicle"])
    orders, header = parse_orders(text, origin, untrimmed_fingerprint(vehicle))
    told = around | _told(orders, header)
    mission = mission_of(plan_from(told))
    ballast, remarks = _ballast(orders, mission.deployment)
    told["dives"]["ballast_ml"] = ballast
    told["surface"] = _surface(orders, mission.deployment)
    told["abort"] = _abort(orders, _usable_energy(mission), told["abort"])
    _leave_out_the_usual_gain(told, orders)
    plan = plan_from(told).model_dump(mode="json", exclude_unset=True)
    return Opened(plan, tuple(remarks))


def _told(orders: Orders, header: OrdersHeader) -> dict[str, Any]:
    """What follows from the orders alone; the ballast is only some."""
    dives, laws = orders.dives, orders.laws
    places, repeat = _waypoints(orders)
    return {
        "name": header.mission,
        "duration_days": _neat((header.expires_hours or 480.0) / 24.0),
        "neutral_density_kg_m3": header.density_kg_m3,
        "waypoints": [{"latitude_deg": lat, "longitude_deg": lon} for lat, lon in places],
        "guidance": {
            "acceptance_radius_m": _neat(orders.radius),
            "lookahead_m": _neat(orders.lookahead),
            "repeat": repeat,
        },
        "dives": {
            "depth_m": _neat(dives.depth),
            "pitch_deg": _neat(degrees(dives.theta)),
            "ballast_ml": _SOME_BALLAST,
            "per_surfacing": int(dives.dives_per_surfacing),
            "turn_depth_m": _neat(dives.turn_depth),
            "least_altitude_m": _neat(dives.least_altitude),
            "drift_hours": _neat(dives.drift_time / 3600.0),
        },
        "surface": {},
        "abort": {
            "dive_hours": _neat(dives.abort_time / 3600.0),
            "leak": bool(orders.alarms.leak),
            "depth_m": None if _alike(dives.abort_depth, 1.1 * dives.depth) else _neat(dives.abort_depth),
        },
        "heading_control": {
            "response_s": _neat(laws.heading.response),
            "dead_band_deg": _neat(degrees(laws.heading.dead_band)),
            "limit_deg": _neat(degrees(laws.heading.limit)),
        },
        "pitch_control": {
            "gain_mm_per_deg": _neat(1e3 * np.radians(laws.pitch.gain)),
            "dead_band_deg": _neat(degrees(laws.pitch.dead_band)),
            "period_s": _neat(laws.pitch.period),
            "tolerance_mm": _neat(1e3 * laws.pitch.tolerance),
        },
        "drift_control": {
            "gain_ml_s_m": _neat(1e6 * laws.drift.gain),
            "return_minutes": _neat(laws.drift.return_time / 60.0),
            "fastest_m_s": _neat(laws.drift.fastest),
            "dead_band_m": _neat(laws.drift.dead_band),
            "period_s": _neat(laws.drift.period),
        },
        "sampling": {"phases": _phases(orders)}
        | ({} if header.sample_every_s is None else {"every_s": header.sample_every_s}),
    }


def _phases(orders: Orders) -> list[str]:
    on = [name for name, sampled in zip(PHASES, orders.sampled, strict=True) if sampled]
    return [name for name in Sampling().phases if name in on]


def _waypoints(orders: Orders) -> tuple[list[tuple[float, float]], bool]:
    """Places in degrees, and whether they are sought again and again: then the orders have them many times."""
    places = [(_neat(degrees(lat)), _neat(degrees(lon))) for lat, lon in orders.waypoints.tolist()]
    for count in range(1, len(places) // 2 + 1):
        if len(places) == count * max(1, int(2000 / count)) and places == places[:count] * (len(places) // count):
            return places[:count], True
    return places, False


def _ballast(orders: Orders, deployment: Deployment) -> tuple[float, list[str]]:
    """Ballast volume beyond neutral [ml], and a remark where that of descent and ascent differ."""
    neutral = neutral_ballast(deployment)
    down = 1e6 * (float(neutral.min()) - float(orders.dives.V_b_dive))
    up = 1e6 * (float(orders.dives.V_b_climb) - float(neutral.max()))
    middle = max(_LEAST_BALLAST, _neat(0.5 * (down + up)))
    if abs(down - up) <= _NOTABLE_ML and down > 0.0 and up > 0.0:
        return middle, []
    return middle, [
        f"dives.ballast_ml = {middle:.4g}: the orders have {down:.4g} ml beyond neutral in the descent and {up:.4g} ml "
        "in the ascent, by the water of this plan: a speed, or other water, made them; set dives.speed_m_s for the like"
    ]


def _surface(orders: Orders, deployment: Deployment) -> dict[str, Any]:
    dives = orders.dives
    found: dict[str, Any] = {
        "session_s": _neat(dives.surface_time),
        "longest_s": _neat(dives.longest_surface_time),
        "depth_m": _neat(dives.shallow_depth),
    }
    if isfinite(dives.surfacing_interval):
        found["every_hours"] = _neat(dives.surfacing_interval / 3600.0)
    if not _alike(dives.V_b_surface, deployment.ballast_range[1]):
        found["ballast_ml"] = _neat(1e6 * dives.V_b_surface)
    if not isnan(dives.r_px_surface):
        found |= _surface_pitch(float(dives.r_px_surface), float(dives.V_b_surface), deployment)
    return found


def _surface_pitch(r_px: float, V_b: float, deployment: Deployment) -> dict[str, float]:
    """Pitch at which the vehicle rests at the surface with its moving mass there; nothing where it is the usual."""
    surplus = surplus_afloat(deployment) + V_b - afloat_volume(deployment)

    def beyond(pitch_deg: float) -> float:
        return mass_position_at_rest(deployment, V_b, float(np.radians(pitch_deg)), max(0.0, surplus)) - r_px

    usual = Surfacing().pitch_deg
    if abs(beyond(usual)) <= 1e-7:
        return {}
    low, high = -60.0, 60.0
    sign = 1.0 if beyond(low) > 0.0 else -1.0
    for _ in range(_STEPS):
        middle = 0.5 * (low + high)
        if sign * beyond(middle) > 0.0:
            low = middle
        else:
            high = middle
    return {"pitch_deg": _neat(round(low, 6))}


def _usable_energy(mission: Mission) -> float:
    """Of the charged battery in the water of the plan [J]."""
    return float(plant_of(mission.vehicle, water_of(mission.deployment).mean_temperature_c).battery.energy)


def _abort(orders: Orders, usable: float, told: dict[str, Any]) -> dict[str, Any]:
    """Aborts of the plan; `usable` is the energy of the battery [J]."""
    found = {key: value for key, value in told.items() if value is not None}
    alarms = orders.alarms
    if isfinite(alarms.internal_pressure):
        found["internal_pressure_kpa"] = _neat(alarms.internal_pressure / 1e3)
    if isfinite(alarms.energy) and isfinite(usable):
        found["battery_share"] = float(np.clip(_neat(1.0 - alarms.energy / usable), 0.0, 1.0))
    return found


def _leave_out_the_usual_gain(told: dict[str, Any], orders: Orders) -> None:
    """Let the gain of the pitch follow from the flight table where it did."""
    gain = told["pitch_control"].pop("gain_mm_per_deg")
    try:
        usual = planned_orders(mission_of(plan_from(told))).laws.pitch.gain
    except StommelError:  # impossible in this water, as a check will tell
        usual = inf
    if not _alike(usual, orders.laws.pitch.gain):
        told["pitch_control"]["gain_mm_per_deg"] = gain


def _alike(one: float, other: float) -> bool:
    return abs(one - other) <= _ALIKE * max(abs(one), abs(other))


def _neat(value: float) -> float:
    """A number to nine digits."""
    return float(f"{value:.9g}")
