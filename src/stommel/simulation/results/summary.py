"""The outcome of a mission in numbers: how far, how many dives, what it cost, how wrong the vehicle believed itself."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from stommel.geometry.geodesics import line_length
from stommel.simulation.flight import Flown
from stommel.simulation.results.energy import energy_of
from stommel.simulation.results.events import counts_of, dives_begun, events_of
from stommel.simulation.results.speed import flown_speed
from stommel.simulation.results.verdict import verdict
from stommel.simulation.results.waypoints import Waypoints, as_rows, waypoints_of

Array = NDArray[np.float64]

_WATT_HOUR = 3600.0
_DAY = 86400.0


def summary(flown: Flown) -> dict[str, Any]:
    """Sum up a mission; the names say the units. None stands for what the mission or the vehicle file does not tell."""
    plan, record = flown.mission.scenario, flown.record
    days = float(record["time"][-1] + plan.output_every_s) / _DAY if len(record) else 0.0
    waypoints = waypoints_of(flown)
    return {
        "verdict": verdict(waypoints, plan.start_seconds, flown.outcome),
        "name": plan.name,
        "vehicle": flown.mission.vehicle.name,
        "ocean": flown.mission.ocean.name,
        "outcome": flown.outcome,
        "seed": plan.seed,
        "days": days,
        **_waypoints(waypoints, plan.start_seconds),
        "dives": int(dives_begun(flown.events["phase"], flown.events["reason"]).sum()),
        "surfacings": len(flown.surfacings),
        "deepest_m": float(record["depth"].max()) if len(record) else 0.0,
        "flown_speed_m_s": flown_speed(record),
        "asked_speed_m_s": plan.dives.speed_m_s,
        **_distances(flown),
        **_energy(flown, days),
        **_navigation(flown.surfacings),
        "ctd_samples": len(flown.samples),
        "events": counts_of(events_of(flown, waypoints)),
    }


def _waypoints(waypoints: Waypoints, start: float) -> dict[str, Any]:
    """How many waypoints were reached, and how it stands with the one that was sought at the end."""
    goal = waypoints.next
    return {
        "waypoints_planned": waypoints.planned,
        "waypoints_reached": waypoints.reached,
        "waypoint_distance_m": None if goal is None else goal.to_go_m,
        "waypoint_missed_by_m": None if goal is None else waypoints.missed_by(goal),
        "swept_away": waypoints.swept_away,
        "acceptance_radius_m": waypoints.radius_m,
        "waypoints": as_rows(waypoints, start),
    }


def _distances(flown: Flown) -> dict[str, float]:
    """Way over ground and through the water, and what was made good from start to end [km]."""
    latitude, longitude = (np.degrees(flown.record[name]) for name in ("latitude", "longitude"))
    made_good = line_length(latitude[[0, -1]], longitude[[0, -1]]) if len(latitude) else 0.0
    return {
        "distance_over_ground_km": line_length(latitude, longitude) / 1e3,
        "distance_made_good_km": made_good / 1e3,
        "distance_through_water_km": flown.distance_through_water / 1e3,
    }


def _energy(flown: Flown, days: float) -> dict[str, Any]:
    """Energy by what took it, and what the battery still gives at the mean power so far."""
    spent = {name: float(curve[-1]) for name, curve in energy_of(flown).items()}
    total, stored = sum(spent.values()), flown.plant.battery.energy
    if not np.isfinite(stored) or total <= 0.0:
        unknown = ("energy_wh", "mean_power_w", "battery_wh", "battery_left_wh", "battery_left_share", "days_left",
                   "battery_end_v", "battery_least_v")  # fmt: skip
        return dict.fromkeys(unknown)
    left = max(0.0, stored - total)
    power = total / (days * _DAY)
    voltage = flown.record["voltage"]
    return {
        "energy_wh": {name: joules / _WATT_HOUR for name, joules in spent.items()},
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
