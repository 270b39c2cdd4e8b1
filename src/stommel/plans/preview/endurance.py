"""How far the battery and the time of a plan reach, from a short flight of its own dives."""

from dataclasses import replace
from math import sqrt

import numpy as np

from stommel.errors import StommelError
from stommel.files.units import counted
from stommel.plans.plan import StationPlan
from stommel.plans.way import legs_of
from stommel.simulation.flight import Flown, fly_mission
from stommel.simulation.results.summary import summary
from stommel.simulation.scenario.mission import Mission

_TRIAL_DAYS = 0.25
"""Flown to see what the dives cost; a few of them."""


def endurance_remarks(plan: StationPlan, mission: Mission) -> list[str]:
    """Warn of a way that is longer than the battery or the time of the plan lasts, currents aside."""
    days = min(_TRIAL_DAYS, plan.duration_days)
    trial = replace(mission, scenario=mission.scenario.model_copy(update={"duration_days": days}))
    try:
        flown = fly_mission(trial)
    except StommelError:
        return []  # it is told where the whole mission is flown
    left = summary(flown)["days_left"]
    way, forward = sum(each.length_m for each in legs_of(plan)), _forward(flown) / days
    if plan.guidance.repeat or not way or not forward:
        return _battery(left, plan.duration_days)
    needed = way / forward
    return [
        *_too_far("the battery lasts", left, needed, way),
        *_too_far("duration_days is", plan.duration_days, needed, way),
    ]


def _forward(flown: Flown) -> float:
    """Way through the water less what of it led down and up [m]."""
    vertical = float(np.abs(np.diff(flown.record["depth"])).sum())
    return sqrt(max(0.0, flown.distance_through_water**2 - vertical**2))


def _battery(days_left: float | None, wanted: float) -> list[str]:
    if days_left is None or days_left >= wanted:
        return []
    return [f"the battery lasts about {counted(f'{days_left:.3g}', 'day')}, less than duration_days = {wanted:g}"]


def _too_far(what: str, days: float | None, needed: float, way: float) -> list[str]:
    if days is None or days >= needed:
        return []
    return [
        f"waypoints: the way of {way / 1e3:.0f} km takes about {counted(f'{needed:.3g}', 'day')} in still water; "
        f"{what} {counted(f'{days:.3g}', 'day')}"
    ]
