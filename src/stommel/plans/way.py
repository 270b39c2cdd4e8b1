"""The way of a plan on the map: its legs, and whether they stay within the geofence."""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from itertools import pairwise
from typing import NamedTuple

from stommel.geometry.geodesics import Place, leg
from stommel.mission.plan import Position
from stommel.plans.geofence import WIDEST_DEG, Geofence
from stommel.plans.plan import StationPlan
from stommel.plans.problems import PlanProblem

START = "start"


class PlannedLeg(NamedTuple):
    """The way from one place of a plan to the next."""

    key: str
    """Of the place where it ends."""
    begin: Place
    end: Place

    @property
    def length_m(self) -> float:
        """Along the shortest way."""
        return leg(*self.begin, *self.end).distance_m


def places_of(plan: StationPlan) -> dict[str, Place]:
    """Start and waypoints by their keys, in the order in which they are sought."""
    found = {START: plan.start} | {f"waypoints.{k}": place for k, place in enumerate(plan.waypoints)}
    return {key: Place(place.latitude_deg, place.longitude_deg) for key, place in found.items()}


def legs_of(plan: StationPlan) -> list[PlannedLeg]:
    """Legs of a plan; with `guidance.repeat` the way from the last waypoint back to the first is one too."""
    named = list(places_of(plan).items())
    if plan.guidance.repeat and len(plan.waypoints) > 1:
        named.append(named[1])
    return [PlannedLeg(key, before, here) for (_, before), (key, here) in pairwise(named)]


def fence_of(corners: Sequence[Position]) -> Geofence:
    """The geofence of a plan, which has at least three corners."""
    return Geofence([Place(corner.latitude_deg, corner.longitude_deg) for corner in corners])


def first_outside(corners: Sequence[Position], track: Iterable[Mapping[str, float]]) -> Mapping[str, float] | None:
    """The first point of a track (`t`, `lat`, `lon`) that is not within a geofence; None where there is none."""
    if not corners:
        return None
    fence = fence_of(corners)
    return next((point for point in track if not fence.holds(Place(point["lat"], point["lon"]))), None)


def way_problems(plan: StationPlan) -> list[PlanProblem]:
    """A way without waypoints, places and legs that leave the geofence, and a geofence that crosses itself."""
    if not plan.waypoints:
        reason = "waypoints: none: the mission would be complete before its first dive: must be at least 1"
        return [PlanProblem("waypoints", "none", reason, "at least 1")]
    if not plan.geofence:
        return []
    fence = fence_of(plan.geofence)
    if fence.is_too_wide():
        allowed = f"less than {WIDEST_DEG:g} deg of longitude wide"
        reason = f"geofence: its corners lie too far apart to say on which side of the Earth it is: must be {allowed}"
        return [PlanProblem("geofence", "", reason, allowed)]
    crossed = fence.crosses_itself()
    if crossed is not None:
        one, other = (_side(number, len(plan.geofence)) for number in crossed)
        reason = f"geofence: the side from {one} crosses that from {other}: must be an area whose sides do not cross"
        return [PlanProblem("geofence", f"{one}, {other}", reason, "an area whose sides do not cross")]
    return list(_outside(plan, fence))


def _side(number: int, count: int) -> str:
    """A side of a geofence in words, by its corners counted from 1."""
    return f"corner {number + 1} to {(number + 1) % count + 1}"


def _outside(plan: StationPlan, fence: Geofence) -> Iterator[PlanProblem]:
    outside = {key for key, place in places_of(plan).items() if not fence.holds(place)}
    for key, place in places_of(plan).items():
        if key in outside:
            value = f"({place.latitude_deg:.5g}, {place.longitude_deg:.6g})"
            yield PlanProblem(key, value, f"{key} = {value}: must lie within the geofence", "within the geofence")
    for each in legs_of(plan):
        if each.key not in outside and fence.holds(each.begin) and fence.cuts(each.begin, each.end):
            reason = f"{each.key}: the way there leaves the geofence: must stay within it"
            yield PlanProblem(each.key, "", reason, "a way within the geofence")
