"""From a plan to orders that a vehicle understands, and everything that its vehicle and its water refuse."""

from dataclasses import dataclass, replace
from typing import Any

from stommel.control.orders_file import orders_text
from stommel.control.vehicle_limits import refusals
from stommel.errors import StommelError
from stommel.planning.vehicle_limits import vehicle_limits
from stommel.plans.plan import StationPlan
from stommel.plans.preview.bottom import bottom_problems, bottom_remarks
from stommel.plans.preview.endurance import endurance_remarks
from stommel.plans.preview.mission import mission_of
from stommel.plans.problems import ORIGIN, PlanError, PlanProblem, problem, problems_of
from stommel.plans.way import way_problems
from stommel.simulation.planned_orders import planned_orders
from stommel.simulation.scenario.mission import Mission
from stommel.simulation.scenario.orders_header import orders_header
from stommel.simulation.scenario.remarks import remarks

_PLAN_KEYS = {
    "dives.ballast_dive_m3": "dives",
    "dives.ballast_climb_m3": "dives",
    "dives.ballast_surface_m3": "surface.ballast_ml",
    "dives.ballast_drift_m3": "dives.depth_m",
    "dives.moving_mass_drift_m": "dives.drift_hours",
    "dives.moving_mass_surface_m": "surface.pitch_deg",
    "dives.surfaced_depth_m": "surface.depth_m",
    "dives.abort_depth_m": "abort.depth_m",
    "heading_control.limit": "heading_control.limit_deg",
    "sample_every_s": "sampling.every_s",
    "alarms.energy_j": "abort.battery_share",
    "alarms.internal_pressure_pa": "abort.internal_pressure_kpa",
}
"""Where a person set what the orders hold; keys that are the same in both are left out."""


@dataclass(frozen=True)
class Ordered:
    """A plan as orders, or why not."""

    orders: str | None
    """Text of the orders; None where something is wrong."""
    problems: tuple[PlanProblem, ...]
    """Everything that is wrong."""
    warnings: tuple[str, ...]
    """What a pilot should know, though it can be flown."""

    def as_row(self) -> dict[str, Any]:
        """The same as JSON has it."""
        return {
            "problems": [each.as_row() for each in self.problems],
            "warnings": list(self.warnings),
            "orders": self.orders,
        }


def ordered(plan: StationPlan) -> Ordered:
    """Make the orders of a plan, and name everything at once that is wrong with it."""
    wrong = way_problems(plan)
    try:
        mission = mission_of(plan)
    except StommelError as error:
        return Ordered(None, (*wrong, *problems_of(error)), ())
    wrong += bottom_problems(plan, mission.ocean)
    text, refused = _orders(plan, mission)
    if wrong or refused:
        return Ordered(None, (*wrong, *refused), ())
    return Ordered(text, (), tuple(_warnings(plan, mission)))


def orders_for(plan: StationPlan) -> str:
    """Text of a plan's orders.

    Raises
    ------
    PlanError
        Everything that is wrong with it.
    """
    found = ordered(plan)
    if found.orders is None:
        raise PlanError(found.problems)
    return found.orders


def _orders(plan: StationPlan, mission: Mission) -> tuple[str | None, list[PlanProblem]]:
    header = replace(orders_header(mission), sample_every_s=_sample_every(plan))
    try:
        orders = planned_orders(mission)
        limits = vehicle_limits(mission.vehicle)
        refused = [_in_words_of_the_plan(each.key, each.message) for each in refusals(orders, header, limits, ORIGIN)]
        return (None, refused) if refused else (orders_text(orders, header, ORIGIN), [])
    except StommelError as error:
        return None, problems_of(error)


def _in_words_of_the_plan(key: str, sentence: str) -> PlanProblem:
    found = problem(key, sentence)
    return PlanProblem(_PLAN_KEYS.get(key, key), found.value, found.reason, found.allowed)


def _warnings(plan: StationPlan, mission: Mission) -> list[str]:
    return [
        *(remark.message for remark in remarks(mission)),
        *bottom_remarks(plan, mission.ocean),
        *endurance_remarks(plan, mission),
    ]


def _sample_every(plan: StationPlan) -> float | None:
    """How often the CTD measures [s]; None where the plan leaves it to the vehicle's configuration."""
    return plan.sampling.every_s if "every_s" in plan.sampling.model_fields_set else None
