"""The bottom of the plan's water along its way."""

from collections.abc import Iterator
from math import ceil

from stommel.errors import StommelError
from stommel.geometry.geodesics import leg, travel
from stommel.ocean.errors import LandError, OutsideOceanError
from stommel.ocean.ocean import Ocean
from stommel.plans.plan import StationPlan
from stommel.plans.problems import PlanProblem
from stommel.plans.way import PlannedLeg, legs_of

_STEP = 2000.0
"""Between two looks along a leg [m]."""
_MOST_LOOKS = 2000
"""Along all of the way; on a longer one they are farther apart."""


def bottom_problems(plan: StationPlan, ocean: Ocean) -> list[PlanProblem]:
    """Legs that lead over land or out of the ocean; their ends are in the water."""
    found = []
    for each, depths in _soundings(plan, ocean):
        wrong = next((depth for depth in depths if isinstance(depth, StommelError)), None)
        if wrong is not None:
            where = "over land" if isinstance(wrong, LandError) else "out of the ocean"
            reason = f"{each.key}: the way there leads {where}: must stay in the water ({wrong})"
            found.append(PlanProblem(each.key, "", reason, "a way in the water"))
    return found


def bottom_remarks(plan: StationPlan, ocean: Ocean) -> list[str]:
    """Legs on which the bottom lies above the depth of the dives and what the vehicle keeps away from it."""
    wanted = plan.dives.depth_m + plan.dives.least_altitude_m
    found = []
    for each, depths in _soundings(plan, ocean):
        least = min((depth for depth in depths if not isinstance(depth, StommelError)), default=wanted)
        if least < wanted:
            turn = max(0.0, least - plan.dives.least_altitude_m)
            found.append(
                f"{each.key}: on the way there the bottom rises to {least:.0f} m; dives turn there at {turn:.0f} m, by "
                f"dives.least_altitude_m = {plan.dives.least_altitude_m:g}, if the altimeter hears the bottom"
            )
    return found


def _soundings(plan: StationPlan, ocean: Ocean) -> Iterator[tuple[PlannedLeg, list[float | StommelError]]]:
    """Depth of the bottom along each leg [m], or why there is none."""
    legs = legs_of(plan)
    whole = sum(each.length_m for each in legs)
    step = max(_STEP, whole / _MOST_LOOKS)
    for each in legs:
        looks = max(1, ceil(each.length_m / step))
        yield each, [_depth(ocean, each, share / looks) for share in range(1, looks)]


def _depth(ocean: Ocean, each: PlannedLeg, share: float) -> float | StommelError:
    way = leg(*each.begin, *each.end)
    try:
        return ocean.bottom_depth(*travel(*each.begin, way.bearing_deg, share * way.distance_m))
    except (LandError, OutsideOceanError) as error:
        return error
