"""The outcome of a mission in numbers: how far, how many dives, what it cost, how wrong the vehicle believed itself."""

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from stommel.control.dive_cycle import DESCENT, EVENTS, NOTHING, TARGET_REACHED
from stommel.simulation.flight import Flown
from stommel.simulation.memory import EVENT_COLUMNS, STATE_COLUMNS, SURFACING_COLUMNS
from stommel.simulation.plant.parameters import CONSUMERS

if TYPE_CHECKING:
    from pyproj import Geod

Array = NDArray[np.float64]

_WATT_HOUR = 3600.0
_DAY = 86400.0


def summary(flown: Flown) -> dict[str, Any]:
    """Sum up a mission; the names say the units. None stands for what the mission or the vehicle file does not tell."""
    plan, record = flown.mission.plan, flown.record
    days = float(_column(record, "time")[-1] + plan.output_every_s) / _DAY if len(record) else 0.0
    return {
        "name": plan.name,
        "vehicle": flown.mission.vehicle.name,
        "ocean": flown.mission.ocean.name,
        "outcome": flown.outcome,
        "seed": plan.seed,
        "days": days,
        "dives": _dives(flown),
        "surfacings": len(flown.surfacings),
        "deepest_m": float(_column(record, "depth").max()) if len(record) else 0.0,
        **_distances(flown),
        **_energy(flown, days),
        **_navigation(flown.surfacings),
        "ctd_samples": len(flown.samples),
        "events": _events(flown),
    }


def _column(record: Array, name: str) -> Array:
    return record[:, STATE_COLUMNS.index(name)]


def _dives(flown: Flown) -> int:
    """Dives begun: every change into descent."""
    return int(np.sum(flown.events[:, EVENT_COLUMNS.index("phase")] == DESCENT))


def _distances(flown: Flown) -> dict[str, float]:
    """Way over ground and through the water, and what was made good from start to end [km]."""
    from pyproj import Geod  # noqa: PLC0415 - start-up counts

    ellipsoid = Geod(ellps="WGS84")
    latitude, longitude = (np.degrees(_column(flown.record, name)) for name in ("latitude", "longitude"))
    made_good = _between(ellipsoid, latitude[[0, -1]], longitude[[0, -1]]) if len(latitude) else 0.0
    return {
        "distance_over_ground_km": _between(ellipsoid, latitude, longitude) / 1e3,
        "distance_made_good_km": made_good / 1e3,
        "distance_through_water_km": flown.distance_through_water / 1e3,
    }


def _between(ellipsoid: "Geod", latitude: Array, longitude: Array) -> float:
    return float(ellipsoid.line_length(longitude, latitude))


def _energy(flown: Flown, days: float) -> dict[str, Any]:
    """Energy by consumer, and what the battery still gives at the mean power so far."""
    names = [f"energy_{consumer}" for consumer in CONSUMERS]
    spent = {c: float(_column(flown.record, n)[-1]) for c, n in zip(CONSUMERS, names, strict=True)}
    total, stored = sum(spent.values()), flown.plant.battery_energy
    if not np.isfinite(stored) or total <= 0.0:
        unknown = ("energy_wh", "mean_power_w", "battery_wh", "battery_left_wh", "battery_left_share", "days_left",
                   "battery_end_v", "battery_least_v")  # fmt: skip
        return dict.fromkeys(unknown)
    lost = flown.plant.self_discharge * days * _DAY
    left = max(0.0, stored - total - lost)
    power = (total + lost) / (days * _DAY)
    voltage = _column(flown.record, "voltage")
    return {
        "energy_wh": {c: joules / _WATT_HOUR for c, joules in spent.items()} | {"self_discharge": lost / _WATT_HOUR},
        "mean_power_w": power,
        "battery_wh": stored / _WATT_HOUR,
        "battery_left_wh": left / _WATT_HOUR,
        "battery_left_share": left / stored,
        "days_left": left / power / _DAY,
        "battery_end_v": float(voltage[-1]),
        "battery_least_v": float(voltage.min()),
    }


def _navigation(surfacings: Array) -> dict[str, Any]:
    """Errors of dead reckoning and of the depth-averaged current against the truth; none before the first surfacing."""
    if not len(surfacings):
        return {"reckoning_error_m": None, "current_error_m_s": None}
    error = surfacings[:, SURFACING_COLUMNS.index("reckoning_error")]
    first = SURFACING_COLUMNS.index("current_north")
    miss = np.hypot(*(surfacings[:, first : first + 2] - surfacings[:, first + 2 : first + 4]).T)
    return {
        "reckoning_error_m": {"mean": float(error.mean()), "greatest": float(error.max())},
        "current_error_m_s": {"mean": float(miss.mean()), "greatest": float(miss.max())},
    }


def _events(flown: Flown) -> dict[str, int]:
    """How often what ended a dive or the mission, without the ordinary turns at the target depth."""
    reasons = flown.events[:, EVENT_COLUMNS.index("reason")].astype(int)
    kinds, counts = np.unique(reasons, return_counts=True)
    found = zip(kinds.tolist(), counts.tolist(), strict=True)
    return {EVENTS[kind]: count for kind, count in found if kind not in (NOTHING, TARGET_REACHED)}
