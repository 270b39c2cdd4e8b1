"""The outcome of a mission in numbers: how far, how many dives, what it cost, how wrong the vehicle believed itself."""

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from stommel.control.dive_cycle import DESCENT, NOTHING, TARGET_REACHED
from stommel.simulation.flight import Flown
from stommel.simulation.log import REASONS
from stommel.simulation.plant.parameters import CONSUMERS

if TYPE_CHECKING:
    from pyproj import Geod

Array = NDArray[np.float64]

_WATT_HOUR = 3600.0
_DAY = 86400.0


def summary(flown: Flown) -> dict[str, Any]:
    """Sum up a mission; the names say the units. None stands for what the mission or the vehicle file does not tell."""
    plan, record = flown.mission.scenario, flown.record
    days = float(record["time"][-1] + plan.output_every_s) / _DAY if len(record) else 0.0
    return {
        "name": plan.name,
        "vehicle": flown.mission.vehicle.name,
        "ocean": flown.mission.ocean.name,
        "outcome": flown.outcome,
        "seed": plan.seed,
        "days": days,
        "dives": _dives(flown),
        "surfacings": len(flown.surfacings),
        "deepest_m": float(record["depth"].max()) if len(record) else 0.0,
        **_distances(flown),
        **_energy(flown, days),
        **_navigation(flown.surfacings),
        "ctd_samples": len(flown.samples),
        "events": _events(flown),
    }


def _dives(flown: Flown) -> int:
    """Dives begun: every change into descent."""
    return int(np.sum(flown.events["phase"] == DESCENT))


def _distances(flown: Flown) -> dict[str, float]:
    """Way over ground and through the water, and what was made good from start to end [km]."""
    from pyproj import Geod  # noqa: PLC0415 - start-up counts

    ellipsoid = Geod(ellps="WGS84")
    latitude, longitude = (np.degrees(flown.record[name]) for name in ("latitude", "longitude"))
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
    spent = dict(zip(CONSUMERS, flown.record["energy"][-1].tolist(), strict=True))
    total, stored = sum(spent.values()), flown.plant.battery.energy
    if not np.isfinite(stored) or total <= 0.0:
        unknown = ("energy_wh", "mean_power_w", "battery_wh", "battery_left_wh", "battery_left_share", "days_left",
                   "battery_end_v", "battery_least_v")  # fmt: skip
        return dict.fromkeys(unknown)
    lost = flown.plant.battery.self_discharge * days * _DAY
    left = max(0.0, stored - total - lost)
    power = (total + lost) / (days * _DAY)
    voltage = flown.record["voltage"]
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


def _navigation(surfacings: NDArray[np.void]) -> dict[str, Any]:
    """Errors of dead reckoning and of the depth-averaged current against the truth; none before the first surfacing."""
    if not len(surfacings):
        return {"reckoning_error_m": None, "current_error_m_s": None}
    error = surfacings["reckoning_error"]
    miss = np.hypot(*(surfacings[f"current_{way}"] - surfacings[f"true_current_{way}"] for way in ("north", "east")))
    return {
        "reckoning_error_m": {"mean": float(error.mean()), "greatest": float(error.max())},
        "current_error_m_s": {"mean": float(miss.mean()), "greatest": float(miss.max())},
    }


def _events(flown: Flown) -> dict[str, int]:
    """How often what ended a dive or the mission, without the ordinary turns at the target depth."""
    reasons = flown.events["reason"].astype(int)
    kinds, counts = np.unique(reasons, return_counts=True)
    found = zip(kinds.tolist(), counts.tolist(), strict=True)
    return {REASONS[kind]: count for kind, count in found if kind not in (NOTHING, TARGET_REACHED)}
