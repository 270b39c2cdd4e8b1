"""Planned beside flown."""

from typing import Any

import pytest
from pyproj import Geod

from stommel.geometry.geodesics import Place
from stommel.plans.comparison import compared
from stommel.plans.predicted_track import PredictedTrack


def dive(number: int, begin: float, **values: Any) -> dict[str, Any]:
    return {
        "dive": number, "t_begin": begin, "t_end": begin + 600.0, "latitude_begin": 28.7, "longitude_begin": 126.1,
        "latitude_end": 28.7, "longitude_end": 126.1, "greatest_depth_m": 68.0, "energy_j": 4500.0,
    } | values  # fmt: skip


def test_dives_are_aligned_by_their_numbers_in_the_mission() -> None:
    """The vehicle has flown 40 dives before this mission, and the report of the second one of it was lost."""
    predicted = [dive(k, 1000.0 * k) for k in (1, 2, 3, 4)]
    flown = [dive(39, -500.0), dive(40, 500.0), dive(41, 1010.0), dive(43, 3025.0, t_end=3700.0)]
    rows = compared(predicted, flown, begin=900.0)
    assert [(row.dive, row.predicted is not None, row.flown is not None) for row in rows] == [
        (1, True, True), (2, True, False), (3, True, True), (4, True, False),
    ]  # fmt: skip
    assert rows[1].difference is None
    third = rows[2].difference
    assert third is not None
    assert (third.end_s, third.duration_s, third.depth_m, third.energy_j) == (100.0, 75.0, 0.0, 0.0)


def test_differences_are_flown_less_predicted() -> None:
    ((_, _, _, found, *ways),) = compared(
        [dive(1, 0.0)], [dive(1, 5.0, longitude_end=126.12, greatest_depth_m=70.5, energy_j=4400.0)], begin=0.0
    )
    assert found is not None
    _, _, away = Geod(ellps="WGS84").inv(126.1, 28.7, 126.12, 28.7)
    assert found.distance_m == pytest.approx(away, rel=1e-9)
    assert ways == [0.0, pytest.approx(away, rel=1e-9), None]
    assert (found.depth_m, found.energy_j) == (2.5, -100.0)


def test_what_is_not_known_has_no_difference() -> None:
    """Oracle: the report that it is about: spray_pilot#39, a value that is missing is empty and not zero."""
    ((_, _, _, found, *_),) = compared(
        [dive(1, 0.0)], [dive(1, 5.0, t_end=None, latitude_end=None, energy_j=None)], begin=0.0
    )
    assert found is not None
    assert found == (None, None, None, 0.0, None)


def test_more_dives_than_were_planned_are_listed_too() -> None:
    rows = compared([dive(1, 0.0)], [dive(7, 1.0), dive(8, 1000.0)], begin=0.0)
    assert [(row.dive, row.predicted is None) for row in rows] == [(1, False), (2, True)]
    assert compared([], [], begin=0.0) == []


def test_off_the_track_is_told_of_flown_dives_that_have_an_end() -> None:
    """Predicted is a way straight east along 28.7 N; a dive that ended 0.01 deg to the north of it is 1.1 km off."""
    track = PredictedTrack([Place(28.7, 126.0), Place(28.7, 126.3)])
    flown = [dive(1, 5.0, latitude_end=28.71), dive(2, 1000.0, latitude_end=None)]
    rows = compared([dive(k, 1000.0 * k - 1000.0) for k in (1, 2, 3)], flown, 0.0, track)
    _, _, north = Geod(ellps="WGS84").inv(126.1, 28.7, 126.1, 28.71)
    assert [row.off_track_m for row in rows] == [pytest.approx(north, rel=1e-3), None, None]
