"""What people see first of a vehicle. Oracle: reckoned by hand from dives of round numbers."""

import math
from typing import Any

import pytest

from stommel.archive import DiveRow
from stommel.link.statistics import NOTHING_REFUSED, LinkStatistics
from stommel.station.vehicles.line_status import LineStatus
from stommel.station.vehicles.summary import Approach, Known, Usage, summary_of
from stommel.station.vehicles.underway import Underway

NOW = 1_800_000_000.0
FIGURES = LinkStatistics(0, 0, 0, 0, NOTHING_REFUSED, math.nan, math.nan, 0.0, 0.0, 0, math.nan, is_signing=True)
SILENT = LineStatus(False, None, None, "tcp:there:1", True, "nothing comes", "", 0, FIGURES, ())


def known(latest: dict[str, float] | None = None, dives: tuple[DiveRow, ...] = (), **more: Any) -> Known:
    values = {key: (NOW - 30.0, value) for key, value in (latest or {}).items()}
    return Known(
        1, "one", "zju", False, 1.0, NOW, SILENT, values, dives, **{"left_surface": None, "approach": None, **more}
    )


def dive(number: int, begin: float, minutes: float, **more: Any) -> DiveRow:
    return DiveRow(number, begin, begin + 60.0 * minutes, **more)


def test_nothing_is_told_without_its_source_and_each_has_its_reason() -> None:
    """jenseva/spray_pilot#39, #88."""
    summary = summary_of(known())
    nulls = {key for key, value in summary.items() if value is None}
    assert nulls == set(summary["missing"])
    assert all(summary["missing"].values())


def test_speed_made_good_is_the_way_between_the_ends_of_the_last_dive_by_its_time() -> None:
    # one minute of arc to the north is 1848 m at 30 deg on WGS 84 (a degree: 110 852 m)
    way = dive(
        4, NOW - 7200, 100, latitude_begin=30.0, longitude_begin=126.0, latitude_end=30.0 + 1 / 60, longitude_end=126.0
    )
    found = summary_of(known(dives=(way,)))["speed_made_good"]
    assert found["m_s"] == pytest.approx(110_852 / 60 / 6000, rel=1e-3)
    assert found["course_deg"] == pytest.approx(0.0, abs=1e-6)
    assert (found["dive"], found["t"]) == (4, NOW - 7200 + 6000)
    later = dive(5, NOW - 1000, 10)  # without positions: the one before stands, and says which it is
    assert summary_of(known(dives=(way, later)))["speed_made_good"] == found
    over = way._replace(latitude_end=30.0, longitude_begin=179.99, longitude_end=-179.99)
    found = summary_of(known(dives=(over,)))["speed_made_good"]
    assert found["course_deg"] == pytest.approx(90.0, abs=0.01)  # where it begins: a geodesic bends towards the pole
    assert found["m_s"] == pytest.approx(0.02 * 96_486 / 6000, rel=1e-3)  # a degree of longitude at 30 deg: 96 486 m


def test_current_is_of_the_last_dive_that_has_one() -> None:
    dives = (
        dive(1, NOW - 9000, 60, current_north_m_s=0.1, current_east_m_s=-0.2),
        dive(2, NOW - 5000, 60, current_north_m_s=0.3, current_east_m_s=0.4),
        dive(3, NOW - 1000, 10),
    )
    summary = summary_of(known(dives=dives))
    assert summary["current"] == {"north_m_s": 0.3, "east_m_s": 0.4, "dive": 2, "t": NOW - 5000 + 3600}
    assert summary["speed_made_good"] is None


def test_next_surfacing_is_the_begin_of_the_dive_and_the_mean_of_the_last_three() -> None:
    dives = tuple(dive(k, NOW - 20_000 + 4000 * k, minutes) for k, minutes in enumerate((999, 50, 60, 70), 1))
    under_way = known({"phase": 1.0}, dives, left_surface=NOW - 600.0)
    found = summary_of(under_way)["next_surfacing"]
    assert found["t"] == NOW - 600.0 + 3600.0
    assert "3 dives" in found["why"]
    afloat = known({"phase": 0.0, "surface_time_left_s": 90.0}, dives)
    assert summary_of(afloat)["next_surfacing"]["t"] == NOW - 30.0 + 90.0 + 3600.0
    unseen = summary_of(known({"phase": 1.0}, dives))
    assert unseen["next_surfacing"] is None
    assert "not seen" in unseen["missing"]["next_surfacing"]
    held = summary_of(known({"phase": 0.0}, dives))
    assert "no dive is announced" in held["missing"]["next_surfacing"]


def test_a_drift_at_depth_is_a_part_of_the_dive() -> None:
    """In drift the vehicle hangs in the water (docs/guide/missions.md); the expected surfacing stays what it was."""
    dives = (dive(1, NOW - 9000, 60),)
    drifts = known({"phase": 5.0, "surface_time_left_s": 0.0}, dives, left_surface=NOW - 600.0)
    assert summary_of(drifts)["next_surfacing"]["t"] == NOW - 600.0 + 3600.0
    underway = Underway()
    underway.take([("phase", NOW - 10, 0.0), ("waypoint", NOW - 10, 1.0), ("waypoint_distance_m", NOW - 10, 5000.0)])
    underway.take(
        [("phase", NOW, 1.0), ("phase", NOW + 500, 5.0), ("phase", NOW + 900, 2.0), ("phase", NOW + 901, 3.0)]
    )
    assert underway.left_surface == NOW
    underway.take([("waypoint_distance_m", NOW + 1000, 4500.0)])
    assert underway.approach == Approach(NOW - 10, 500.0 / 1010.0), "no drift begins a dive"


def test_eta_is_the_distance_by_how_fast_it_becomes_less() -> None:
    near = known({"waypoint_distance_m": 3000.0}, approach=Approach(NOW - 5000.0, 0.5))
    assert summary_of(near)["eta"] == {"t": NOW - 30.0 + 6000.0}
    away = summary_of(known({"waypoint_distance_m": 3000.0}, approach=Approach(NOW - 5000.0, -0.1)))
    assert "no closer" in away["missing"]["eta"]


def test_the_battery_lasts_as_long_as_what_is_left_at_the_power_of_late() -> None:
    left = known({"energy_left_kj": 720.0}, usage=Usage(2.0, 3))
    found = summary_of(left)["battery_lasts"]
    assert found["t"] == NOW - 30.0 + 360_000.0  # 720 kJ at 2 W
    assert "2 W" in found["why"]
    assert "3 dives" in found["why"]
    for usage in (Usage(0.0, 3), Usage(0.001, 3)):
        assert "more than a year" in summary_of(left._replace(usage=usage))["missing"]["battery_lasts"]
    assert "two dives" in summary_of(left._replace(usage=None))["missing"]["battery_lasts"]
    assert "left" in summary_of(known(usage=Usage(2.0, 3)))["missing"]["battery_lasts"]


def test_the_power_is_over_whole_dives_with_the_time_at_the_surface_and_begins_anew_with_a_mission() -> None:
    """A dive of 1000 s uses 10 kJ, the 500 s at the surface after it 5 kJ: 15 kJ in 1500 s are 10 W."""
    underway, used = Underway(), 100.0
    for k in range(5):
        t = NOW + 1500.0 * k
        assert (underway.usage is None) == (k < 2)
        underway.take([("phase", t - 1.0, 0.0), ("energy_used_kj", t - 1.0, used), ("phase", t, 1.0)])
        underway.take([("energy_used_kj", t + 500.0, used + 9.0), ("phase", t + 1000.0, 0.0)])  # most at depth
        used += 15.0
    assert underway.usage == Usage(pytest.approx(10.0), 3)
    underway.take([("energy_used_kj", NOW + 8000.0, 0.0)])
    assert underway.usage is None


def test_what_the_vehicle_told_says_when() -> None:
    latest = {"state": (NOW - 7.0, 3.0), "waypoint_distance_m": (NOW - 9.0, 100.0), "pitch_deg": (NOW, 0.0)}
    assert summary_of(known()._replace(latest=latest))["told"] == {"state": NOW - 7.0, "waypoint_distance_m": NOW - 9.0}
    assert summary_of(known())["told"] == {}


def test_states_and_phases_of_which_nobody_knows_the_words_are_told_by_number() -> None:
    summary = summary_of(known({"state": 99.0, "phase": 77.0}))
    assert (summary["state"], summary["phase"]) == ("state 99", "phase 77")


def test_the_begin_of_a_dive_and_the_approach_are_seen_in_the_samples() -> None:
    underway = Underway()
    underway.take([("phase", NOW, 0.0), ("waypoint", NOW, 1.0), ("waypoint_distance_m", NOW, 5000.0)])
    assert underway.left_surface is None
    underway.take([("phase", NOW + 100, 1.0), ("phase", NOW + 110, 2.0), ("waypoint_distance_m", NOW + 1000, 4500.0)])
    assert underway.left_surface == NOW + 100
    assert underway.approach is not None
    assert underway.approach.m_s == pytest.approx(0.5)
    underway.take([("waypoint", NOW + 1001, 2.0), ("waypoint_distance_m", NOW + 1002, 9000.0)])
    assert underway.approach is None, "another waypoint is another way"
    underway.take([("phase", NOW + 1010, 0.0)])
    assert underway.left_surface is None
