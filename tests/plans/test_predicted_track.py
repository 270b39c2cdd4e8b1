"""Thinning of a predicted track, and the distance from it. Oracle: closed forms, and geodesics by pyproj.

On the equator and along a meridian lines are straight on every map, so that the place nearest to a point is known.
"""

import math
from itertools import pairwise

import pytest
from hypothesis import given
from hypothesis import strategies as st
from pyproj import Geod

from stommel.geometry.geodesics import Place
from stommel.plans.predicted_track import PredictedTrack, thinned

EARTH = Geod(ellps="WGS84")
METRE = math.degrees(1.0 / 6_378_137.0)
"""Of the equator [deg]; north of it, a degree is 0.7 % shorter."""


def metres(one: Place, other: Place) -> float:
    return float(EARTH.inv(one.longitude_deg, one.latitude_deg, other.longitude_deg, other.latitude_deg)[2])


@pytest.mark.parametrize("latitude", [0.0, 28.7, -65.0, 80.0])
@pytest.mark.parametrize("middle", [126.1, 179.99])
def test_off_a_meridian_it_is_the_way_to_it(latitude: float, middle: float) -> None:
    """The shortest way from a point to a meridian meets it at a right angle: 800 m east or west of it are 800 m off."""
    track = PredictedTrack([Place(latitude - 1.0, middle), Place(latitude + 1.0, middle)])
    for bearing in (90.0, 270.0):
        longitude, beside, _ = EARTH.fwd(middle, latitude, bearing, 800.0)
        assert track.off([Place(beside, longitude)]) == [pytest.approx(800.0, rel=1e-4)]


def test_beyond_its_ends_it_is_the_way_to_the_end() -> None:
    begin, end, beyond = Place(0.0, 10.0), Place(0.0, 10.1), Place(0.03, 10.14)
    track = PredictedTrack([begin, end])
    assert track.off([beyond, None, begin]) == [pytest.approx(metres(beyond, end), rel=1e-3), None, 0.0]


def test_of_several_pieces_the_nearest_counts_and_one_point_is_a_track() -> None:
    """A rectangle's three sides; 300 m from the second, and 200 m from the third."""
    side = 10_000.0 * METRE
    track = PredictedTrack([Place(0.0, 0.0), Place(0.0, side), Place(side, side), Place(side, 0.0)])
    places = [Place(side / 2.0, side + 300.0 * METRE), Place(side - 200.0 * METRE, side / 2.0)]
    assert track.off(places) == [pytest.approx(300.0, rel=1e-3), pytest.approx(200.0, rel=0.01)]
    assert PredictedTrack([Place(0.0, 0.0)]).off([Place(0.0, 300.0 * METRE)]) == [pytest.approx(300.0, rel=1e-6)]
    assert track.off([]) == []


def wave(count: int, high_m: float) -> list[Place]:
    """Points along the equator, a kilometre apart, every other one so far north of it."""
    return [Place(high_m * METRE * (k % 2), 1000.0 * METRE * k) for k in range(count)]


def test_what_lies_within_the_bound_is_left_out_and_corners_stay() -> None:
    track = wave(101, 8.0)
    assert thinned(track, 1000, 10.0).kept.tolist() == [0, 100]
    assert thinned(track, 1000, 4.0).kept.tolist() == list(range(101))
    turn = [
        *(Place(0.0, 1000.0 * METRE * k) for k in range(50)),
        *(Place(1000.0 * METRE * k, 49_000.0 * METRE) for k in range(1, 9)),
    ]
    found = thinned(turn, 1000, 10.0)
    assert (found.kept.tolist(), found.within_m) == ([0, 49, 57], 10.0)


def test_so_many_points_that_the_bound_must_give_way_say_so() -> None:
    """Waves 300 m high; no line through fewer than all is nearer than 150 m to every point."""
    found = thinned(wave(201, 300.0), 50, 20.0)
    assert len(found.kept) <= 50
    assert found.within_m == 320.0


@given(
    st.lists(st.tuples(st.floats(-3e4, 3e4), st.floats(-3e4, 3e4)), min_size=2, max_size=60),
    st.integers(2, 30), st.floats(1.0, 500.0),
)  # fmt: skip
def test_no_point_is_farther_from_the_line_than_is_said(
    points: list[tuple[float, float]], most: int, within_m: float
) -> None:
    """Oracle: the distance from a straight piece in the plane, which the Earth is around 0, 0 to some 1e-3 of it."""
    track = [Place(north * METRE, east * METRE) for east, north in points]
    found = thinned(track, most, within_m)
    kept = found.kept.tolist()
    assert kept[0] == 0
    assert kept[-1] == len(points) - 1
    assert len(kept) <= most
    for first, last in pairwise(kept):
        for between in points[first + 1 : last]:
            assert plane(between, points[first], points[last]) <= found.within_m * 1.01 + 0.01


def plane(point: tuple[float, float], begin: tuple[float, float], end: tuple[float, float]) -> float:
    """Distance of a point from a straight piece."""
    (x, y), (x0, y0), (x1, y1) = point, begin, end
    length = math.dist(begin, end)
    if length == 0.0:
        return math.dist(point, begin)
    along = ((x - x0) * (x1 - x0) + (y - y0) * (y1 - y0)) / length
    if not 0.0 <= along <= length:
        return min(math.dist(point, begin), math.dist(point, end))
    return abs((x - x0) * (y1 - y0) - (y - y0) * (x1 - x0)) / length
