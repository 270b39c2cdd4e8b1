"""The geofence. Oracle: matplotlib's test of points in polygons, and areas that are seen by eye."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from matplotlib.path import Path

from stommel.geometry.geodesics import Place
from stommel.plans.geofence import Geofence
from stommel.plans.problems import plan_from
from stommel.plans.way import legs_of, way_problems
from tests.plans.plans import place, plan_with

SQUARE = [Place(28.0, 126.0), Place(29.0, 126.0), Place(29.0, 127.0), Place(28.0, 127.0)]
BAY = [Place(0.0, 0.0), Place(10.0, 0.0), Place(10.0, 10.0), Place(0.0, 10.0), Place(0.0, 6.0), Place(8.0, 6.0),
       Place(8.0, 4.0), Place(0.0, 4.0)]  # fmt: skip
"""A square with a slot from the south."""

DEGREES = st.floats(-5.0, 15.0).map(lambda value: round(value, 2) + 0.001)


def star(angles: list[float], radii: list[float]) -> list[Place]:
    """A polygon that does not cross itself: its corners around a middle, in order."""
    return [
        Place(5.0 + r * float(np.sin(a)), 5.0 + r * float(np.cos(a)))
        for a, r in zip(sorted(angles), radii, strict=False)
    ]


@given(
    st.lists(st.floats(0.0, 6.28), min_size=3, max_size=12, unique_by=lambda angle: round(angle, 2)),
    st.lists(st.floats(1.0, 9.0), min_size=12, max_size=12),
    DEGREES,
    DEGREES,
)
def test_a_place_is_inside_where_another_library_says_so(
    angles: list[float], radii: list[float], latitude: float, longitude: float
) -> None:
    corners = star(angles, radii)
    points = [(corner.longitude_deg, corner.latitude_deg) for corner in corners]
    outline = Path([*points, points[0]], closed=True)
    at = (longitude, latitude)
    sure = outline.contains_point(at, radius=1e-6) == outline.contains_point(at, radius=-1e-6)
    if sure:
        assert Geofence(corners).holds(Place(latitude, longitude)) == outline.contains_point(at)


def test_a_way_that_leaves_and_comes_back_is_cut() -> None:
    fence = Geofence(BAY)
    assert fence.holds(Place(2.0, 2.0))
    assert fence.holds(Place(2.0, 8.0))
    assert not fence.holds(Place(2.0, 5.0))
    assert fence.cuts(Place(2.0, 2.0), Place(2.0, 8.0))
    assert not fence.cuts(Place(9.0, 2.0), Place(9.0, 8.0))


def test_it_may_lie_across_the_date_line() -> None:
    fence = Geofence([Place(10.0, 179.0), Place(12.0, 179.0), Place(12.0, -179.0), Place(10.0, -179.0)])
    assert fence.holds(Place(11.0, 180.0))
    assert fence.holds(Place(11.0, -179.5))
    assert not fence.holds(Place(11.0, 178.0))
    assert not fence.cuts(Place(11.0, 179.5), Place(11.0, -179.5))


def test_one_that_crosses_itself_is_told() -> None:
    assert Geofence([SQUARE[0], SQUARE[2], SQUARE[1], SQUARE[3]]).crosses_itself() is not None
    assert Geofence(SQUARE).crosses_itself() is None
    assert Geofence(BAY).crosses_itself() is None


def fenced(**changes: object) -> list[tuple[str, str]]:
    corners = [place(*corner) for corner in SQUARE]
    plan = plan_from(plan_with(**({"geofence": corners} | changes)))
    return [(problem.key, problem.allowed) for problem in way_problems(plan)]


def test_places_and_ways_outside_are_named_each() -> None:
    assert fenced() == []
    assert fenced(start=place(27.0, 126.5)) == [("start", "within the geofence")]
    found = fenced(waypoints=[place(28.5, 126.5), place(30.0, 126.5), place(28.2, 126.5)])
    assert found == [("waypoints.1", "within the geofence")]
    bay = [place(*corner) for corner in BAY]
    through = fenced(geofence=bay, start=place(2.0, 2.0), waypoints=[place(2.0, 8.0)])
    assert through == [("waypoints.0", "a way within the geofence")]
    crossed = [place(*SQUARE[k]) for k in (0, 2, 1, 3)]
    assert fenced(geofence=crossed) == [("geofence", "an area whose sides do not cross")]


def test_a_way_that_repeats_has_a_leg_back() -> None:
    plan = plan_with(guidance={"repeat": True})
    assert [leg.key for leg in legs_of(plan_from(plan))] == ["waypoints.0", "waypoints.1", "waypoints.0"]
    assert [leg.key for leg in legs_of(plan_from(plan_with()))] == ["waypoints.0", "waypoints.1"]


def test_a_way_without_waypoints_leads_nowhere() -> None:
    """Oracle: the dive cycle: with no waypoint left the mission is complete, before the first dive."""
    plan = plan_from(plan_with(waypoints=[]))
    assert legs_of(plan) == []
    assert [(problem.key, problem.allowed) for problem in way_problems(plan)] == [("waypoints", "at least 1")]
