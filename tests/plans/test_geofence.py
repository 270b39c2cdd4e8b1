"""The geofence. Oracle: matplotlib's test of points in polygons on pyproj's Mercator map, areas seen by eye."""

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st
from matplotlib.path import Path
from pyproj import Proj

from stommel.geometry.geodesics import Place
from stommel.plans.geofence import Geofence
from stommel.plans.problems import plan_from
from stommel.plans.way import legs_of, way_problems
from tests.plans.plans import place, plan_with

SQUARE = [Place(28.0, 126.0), Place(29.0, 126.0), Place(29.0, 127.0), Place(28.0, 127.0)]
BAY = [Place(0.0, 0.0), Place(10.0, 0.0), Place(10.0, 10.0), Place(0.0, 10.0), Place(0.0, 6.0), Place(8.0, 6.0),
       Place(8.0, 4.0), Place(0.0, 4.0)]  # fmt: skip
"""A square with a slot from the south."""

CHART = Proj(proj="merc", R=1.0)
"""Longitude and latitude on Mercator's map."""
DEGREES = st.floats(-5.0, 15.0).map(lambda value: round(value, 2) + 0.001)


def star(angles: list[float], radii: list[float]) -> list[Place]:
    """A polygon that does not cross itself: its corners around a middle, in order."""
    return [
        Place(5.0 + r * float(np.sin(a)), 5.0 + r * float(np.cos(a)))
        for a, r in zip(sorted(angles), radii, strict=False)
    ]


@settings(deadline=None)  # on a busy machine the first example waits for its libraries
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
    points = [CHART(corner.longitude_deg, corner.latitude_deg) for corner in corners]
    outline = Path([*points, points[0]], closed=True)
    at = CHART(longitude, latitude)
    sure = outline.contains_point(at, radius=1e-8) == outline.contains_point(at, radius=-1e-8)
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


def test_its_sides_are_those_that_the_vehicle_steers_also_far_north() -> None:
    """Oracle: from 70 to 80 deg a line of one bearing is at 75.84 deg half-way in longitude."""
    _, north = CHART(0.0, 80.0)
    _, south = CHART(0.0, 70.0)
    _, middle = CHART(0.0, (north + south) / 2.0, inverse=True)
    fence = Geofence([Place(70.0, 10.0), Place(80.0, 30.0), Place(70.0, 30.0)])
    assert fence.holds(Place(middle - 0.01, 20.0))
    assert not fence.holds(Place(middle + 0.01, 20.0))
    assert abs(middle - 75.0) > 0.4, "on the map of equal steps it would be elsewhere"


def test_one_that_goes_around_the_earth_is_told() -> None:
    wide = [place(10.0, -100.0), place(20.0, 20.0), place(10.0, 100.0)]
    assert fenced(geofence=wide) == [("geofence", "less than 180 deg of longitude wide")]


def test_the_sides_that_cross_are_named_by_their_corners() -> None:
    corners = [place(*SQUARE[k]) for k in (0, 2, 1, 3)]
    (found,) = way_problems(plan_from(plan_with(geofence=corners)))
    assert found.value == "corner 1 to 2, corner 3 to 4"


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
