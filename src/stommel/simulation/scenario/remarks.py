"""What a pilot should know of a mission before it is flown, though it can be flown."""

from collections.abc import Iterator

from stommel.design.named_warning import NamedWarning
from stommel.geometry.geodesics import leg
from stommel.planning.ballasting import ballast_volumes, neutral_ballast
from stommel.simulation.scenario.mission import Mission

NOTABLY = 1.02
"""Times the speed that was asked for, from which on a faster dive is told of."""


def remarks(mission: Mission) -> list[NamedWarning]:
    """Warn of waypoints that count as reached before they are flown to, and of dives that the water makes faster."""
    return [
        *(NamedWarning("waypoint_within_radius", text) for text in _within_radius(mission)),
        *(NamedWarning("faster_than_asked", text) for text in _faster_than_asked(mission)),
    ]


def _faster_than_asked(mission: Mission) -> Iterator[str]:
    """Water whose density varies so much that dives as slow as asked would stop in it."""
    asked, deployment = mission.scenario.dives.speed_m_s, mission.deployment
    if asked is None:
        return
    ballast = ballast_volumes(deployment, neutral_ballast(deployment))
    for way, speed in (("descent", ballast.speed_down), ("ascent", ballast.speed_up)):
        if speed > NOTABLY * asked:
            yield (
                f"dives.speed_m_s = {asked:g}: the {way} is {speed:.2f} m/s on average, so that it does not stop where "
                "the water's density drives it least; dives.least_speed_m_s bounds that"
            )


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
