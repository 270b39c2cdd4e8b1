"""What a pilot should know of a mission before it is flown, though it can be flown."""

from collections.abc import Iterator

from stommel.design.named_warning import NamedWarning
from stommel.geometry.geodesics import leg
from stommel.simulation.scenario.mission import Mission


def remarks(mission: Mission) -> list[NamedWarning]:
    """Warn of waypoints so near the place before them that they count as reached before they are flown to."""
    return [NamedWarning("waypoint_within_radius", text) for text in _within_radius(mission)]


def _within_radius(mission: Mission) -> Iterator[str]:
    plan = mission.scenario
    radius, name = plan.guidance.acceptance_radius_m, "the start"
    before = plan.start
    around = [*plan.waypoints, *(plan.waypoints[:1] if plan.guidance.repeat and len(plan.waypoints) > 1 else ())]
    for k, place in enumerate(around):
        number = k % len(plan.waypoints) + 1
        way = leg(before.latitude_deg, before.longitude_deg, place.latitude_deg, place.longitude_deg).distance_m
        if way <= radius:
            when = "before the first dive" if name == "the start" else f"together with {name}"
            yield (
                f"waypoint {number} lies {way:.0f} m from {name}, within guidance.acceptance_radius_m = {radius:g}: "
                f"it may count as reached {when}"
            )
        before, name = place, f"waypoint {number}"
