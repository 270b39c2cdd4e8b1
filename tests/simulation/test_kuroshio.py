"""The shipped mission across the Kuroshio, its first half day."""

import tomllib
from pathlib import Path

import numpy as np
import pytest
from pyproj import Geod

from stommel.simulation.flight import Flown, fly_mission
from stommel.simulation.results.summary import summary
from stommel.simulation.scenario.loading import load_mission, mission_from
from stommel.simulation.scenario.shipped import mission_path
from tests.simulation.conftest import column, surfaced


@pytest.fixture(scope="module")
def half_day() -> Flown:
    path = mission_path("kuroshio")
    document = tomllib.loads(path.read_text(encoding="utf-8")) | {"duration_days": 0.5}
    return fly_mission(mission_from(document, str(path), Path()))


def test_it_loads_as_it_is() -> None:
    mission = load_mission(mission_path("kuroshio"))
    assert mission.scenario.duration_days == 5.0
    assert mission.ocean.name == "east_china_sea"


def test_it_gets_away_towards_its_waypoint(half_day: Flown) -> None:
    """By more than half of its way through the water, and within 40 deg of the waypoint's bearing."""
    place = half_day.mission.scenario.waypoints[0]
    longitude, latitude = np.degrees(column(half_day, "longitude")), np.degrees(column(half_day, "latitude"))
    geod = Geod(ellps="WGS84")
    flew, _, distance = geod.inv(longitude[0], latitude[0], longitude[-1], latitude[-1])
    wanted, _, _ = geod.inv(longitude[0], latitude[0], place.longitude_deg, place.latitude_deg)
    assert distance > 0.5 * half_day.distance_through_water
    assert abs((flew - wanted + 180.0) % 360.0 - 180.0) < 40.0


def test_it_dives_in_the_jet_and_knows_it(half_day: Flown) -> None:
    row = summary(half_day)
    assert row["outcome"] == "time over"
    assert row["dives"] > 8
    assert 100.0 < row["deepest_m"] < 190.0
    speed = np.hypot(column(half_day, "current_north"), column(half_day, "current_east"))
    assert speed.max() > 0.3
    miss = np.hypot(surfaced(half_day, "current_north") - surfaced(half_day, "true_current_north"),
                    surfaced(half_day, "current_east") - surfaced(half_day, "true_current_east"))  # fmt: skip
    assert np.median(miss) < 0.03
