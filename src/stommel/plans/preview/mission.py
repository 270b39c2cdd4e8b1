"""From a plan to a mission that the simulator can fly."""

from dataclasses import replace
from datetime import UTC, datetime
from functools import lru_cache
from pathlib import Path
from typing import Any

from stommel.mission.plan import Plan
from stommel.ocean.ocean import Ocean
from stommel.plans.plan import StationPlan, Water
from stommel.plans.problems import ORIGIN, PlanError, problem
from stommel.simulation.scenario.loading import mission_from
from stommel.simulation.scenario.mission import Mission
from stommel.vehicle import Vehicle, load_vehicle

_SAMPLES_EVERY = 600.0
"""[s]"""
_ROWS = 100_000
"""Of a preview's record, about; a longer mission is written down less often."""


def mission_of(plan: StationPlan) -> Mission:
    """Return the mission of a plan, its vehicle trimmed and its water as the plan expects it.

    Raises
    ------
    PlanError
        The current is one that only the station knows.
    FileError, StommelError
        The vehicle cannot be used, or the plan is impossible in this water; with the key and what is allowed.
    """
    mission = mission_from(_scenario(plan), ORIGIN, Path(), _vehicle(plan.vehicle), _ocean(plan.water))
    if plan.neutral_density_kg_m3 is None:
        return mission
    return replace(mission, vehicle=mission.vehicle.trimmed_for(plan.neutral_density_kg_m3))


def _scenario(plan: StationPlan) -> dict[str, Any]:
    """Values of a mission file; what does not matter to a preview, as the errors of sensors, is left as it is."""
    told = plan.model_dump(include=set(Plan.model_fields), exclude_none=True)
    start = datetime.now(UTC) if plan.start_time is None else plan.start_time
    # how often the CTD measures is the acquisition node's affair, and would only fill the memory here
    told["sampling"] = told["sampling"] | {"every_s": _SAMPLES_EVERY}
    return told | {
        "vehicle": plan.vehicle,
        "start": plan.start.model_dump(),
        "start_time": start,
        "duration_days": plan.duration_days,
        "output_every_s": 10.0 * max(1, round(plan.duration_days * 8640.0 / _ROWS)),
        "ocean": {"name": plan.water.ocean},
    }


@lru_cache(maxsize=8)
def _vehicle(name: str) -> Vehicle:
    return load_vehicle(name)


@lru_cache(maxsize=8)
def _ocean(water: Water) -> Ocean:
    if water.current == "last_dive":
        raise PlanError([problem("water.current", "water.current = 'last_dive': is known at the station only")])
    ocean = Ocean.analytic(water.ocean)
    if water.current == "ocean":
        return ocean
    return ocean.with_current(water.east_m_s, water.north_m_s)
