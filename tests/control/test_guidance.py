"""Oracles of guidance: the geodesic, and the triangle of course, heading and current."""

import math

import pytest
from pyproj import Geod

from stommel.control.dead_reckoning import depth_averaged_current
from stommel.control.guidance import course_to_steer
from stommel.geometry.earth import to_waypoint

ELLIPSOID = Geod(ellps="WGS84")


@pytest.mark.parametrize("place", [(18.0, 116.0), (-45.0, 179.9), (70.0, -179.95), (0.0, 0.0)])
@pytest.mark.parametrize("azimuth", [0.0, 63.0, 140.0, 250.0])
def test_waypoint_lies_where_the_geodesic_goes(place: tuple[float, float], azimuth: float) -> None:
    longitude, latitude, _ = ELLIPSOID.fwd(place[1], place[0], azimuth, 20_000.0)
    north, east = to_waypoint(*(math.radians(a) for a in (*place, latitude, longitude)))
    assert math.hypot(north, east) == pytest.approx(20_000.0, rel=1e-4)
    # the course of the middle of the way: meridians converge towards the poles
    middle = ELLIPSOID.fwd(place[1], place[0], azimuth, 10_000.0)
    assert math.remainder(math.atan2(east, north) - math.radians(middle[2] + 180.0), 2.0 * math.pi) == pytest.approx(
        0.0, abs=1e-4
    )


@pytest.mark.parametrize("current", [(0.1, 0.0), (-0.1, 0.15), (0.0, -0.2)])
@pytest.mark.parametrize("bearing", [0.0, 1.0, 2.5, -2.0])
def test_crab_angle_keeps_the_course(current: tuple[float, float], bearing: float) -> None:
    """Way through the water plus current goes along the bearing."""
    speed, far = 0.3, 5e4
    heading = course_to_steer(far * math.cos(bearing), far * math.sin(bearing), 0.0, 0.0, 3e3, current, speed)
    north, east = speed * math.cos(heading) + current[0], speed * math.sin(heading) + current[1]
    assert -north * math.sin(bearing) + east * math.cos(bearing) == pytest.approx(0.0, abs=1e-12)


def test_current_stronger_than_the_vehicle_is_met_across() -> None:
    heading = course_to_steer(1e4, 0.0, 0.0, 0.0, 3e3, (0.0, 1.0), 0.3)
    assert heading == pytest.approx(-math.asin(0.99))


def test_line_is_sought_ahead() -> None:
    """2 km beside a line to the north, 30 km from the goal: aims at the line, the lookahead distance ahead."""
    heading = course_to_steer(30_000.0, -2_000.0, 40_000.0, 0.0, 3_000.0, (0.0, 0.0), 0.3)
    assert heading == pytest.approx(math.atan2(-2_000.0, 3_000.0))
    # closer to the goal than that, at the goal
    heading = course_to_steer(1_000.0, -500.0, 40_000.0, 0.0, 3_000.0, (0.0, 0.0), 0.3)
    assert heading == pytest.approx(math.atan2(-500.0, 1_000.0))


def test_current_is_what_reckoning_misses() -> None:
    assert depth_averaged_current(100.0, 50.0, 460.0, -130.0, 1800.0) == pytest.approx((0.2, -0.1))
    assert depth_averaged_current(100.0, 50.0, 460.0, -130.0, 0.0) == (0.0, 0.0)
