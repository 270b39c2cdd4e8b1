"""Whether the waypoints were reached, against distances on a sphere and closed forms on the equator."""

import json
from dataclasses import replace
from math import cos, pi, radians, sqrt
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray as xr

from stommel.control.dive_cycle import PHASES
from stommel.geometry.geodesics import Place, beside_line
from stommel.simulation.flight import Flown
from stommel.simulation.log import OUTSIDE_DATA
from stommel.simulation.pictures.extracts import dives_in
from stommel.simulation.results.dataset import dataset_of, write_netcdf
from stommel.simulation.results.events import NAMES
from stommel.simulation.results.summary import summary
from stommel.simulation.results.waypoints import Waypoints, waypoints_of
from stommel.simulation.scenario.remarks import remarks
from tests.simulation.conftest import QUIET, flown, made, mission_document
from tests.support.command import Command

STILL = {"name": "uniform", "parameters": {"current_east_m_s": 0.0}}
RADIUS = 300.0
TWO = [
    {"latitude_deg": 18.01, "longitude_deg": 116.0},
    {"latitude_deg": 18.01, "longitude_deg": 116.012},
    {"latitude_deg": 18.1, "longitude_deg": 116.012},
]


def haversine(latitude: Any, longitude: Any, to: tuple[float, float]) -> Any:
    """Distance on a sphere of the Earth's mean radius [m]; within 0.6 % of that on the ellipsoid."""
    a, b = np.radians(latitude), radians(to[0])
    half = np.sin(0.5 * (a - b)) ** 2 + np.cos(a) * cos(b) * np.sin(0.5 * np.radians(longitude - to[1])) ** 2
    return 2.0 * 6371008.8 * np.arcsin(np.sqrt(half))


@pytest.fixture(scope="module")
def three() -> Flown:
    return flown(ocean=STILL, waypoints=TWO, guidance={"acceptance_radius_m": RADIUS})


def place(point: dict[str, float]) -> tuple[float, float]:
    return point["latitude_deg"], point["longitude_deg"]


def test_reached_when_the_believed_position_comes_within_the_radius(three: Flown) -> None:
    found = waypoints_of(three)
    assert found.reached == three.waypoints_reached == 2
    record = three.record
    believed = np.degrees(record["reckoned_latitude"]), np.degrees(record["reckoned_longitude"])
    since = 0.0
    for waypoint, point in zip(found.all[:2], TWO, strict=False):
        assert waypoint.reached_s is not None
        away = haversine(*believed, place(point))
        before = (record["time"] >= since) & (record["time"] < waypoint.reached_s)
        assert away[before].min() > RADIUS * 0.994
        assert away[record["time"] == waypoint.reached_s][0] < RADIUS * 1.006
        since = waypoint.reached_s
    assert found.all[2].reached_s is None


def test_distance_to_go_and_nearest_approach_are_true_distances(three: Flown) -> None:
    last = waypoints_of(three).all[2]
    assert last.sought_from_s is not None
    part = three.record[three.record["time"] >= last.sought_from_s]
    away = haversine(np.degrees(part["latitude"]), np.degrees(part["longitude"]), place(TWO[2]))
    assert last.to_go_m == pytest.approx(away[-1], rel=0.006)
    assert last.closest_m == pytest.approx(away.min(), rel=0.006)
    assert last.flown is not None
    assert last.flown.made_good_m == pytest.approx(away[0] - away[-1], rel=0.01)
    assert last.flown.time_s == part["time"][-1] - last.sought_from_s


def test_first_line_says_whether_the_waypoints_were_reached(stommel: Command, tmp_path: Path) -> None:
    document = mission_document(ocean=STILL, waypoints=TWO, guidance={"acceptance_radius_m": RADIUS})
    path = tmp_path / "three.toml"
    path.write_text(toml(document))
    done = stommel("simulate", path)
    assert done.status == 0, done.err
    row = stommel("simulate", path, "--json").json
    assert done.out.splitlines()[0] == row["verdict"]
    km = row["waypoints"][2]["distance_at_end_m"] / 1e3
    assert row["verdict"] == f"2 of 3 waypoints reached, number 3 is {km:.1f} km away: time over"
    assert row["waypoints_reached"] == 2
    assert row["events"]["waypoint reached"] == 2
    assert [w["reached"] for w in row["waypoints"]] == [True, True, False]
    assert row["waypoints"][0]["reached_utc"].startswith("2026-07-01T0")
    table = [line.split() for line in done.out.splitlines() if line.startswith("   ") and line.split()[:1] == ["3"]]
    assert table[0][:3] == ["3", "no", f"{row['waypoints'][2]['closest_m']:.0f}"]


def toml(document: dict[str, Any]) -> str:
    """A document without tables of arrays as TOML, which inline JSON nearly is."""

    def value(item: Any) -> str:
        if isinstance(item, dict):
            return "{ " + ", ".join(f"{key} = {value(inner)}" for key, inner in item.items()) + " }"
        if isinstance(item, list):
            return "[" + ", ".join(map(value, item)) + "]"
        return str(item) if isinstance(item, str) and item[:4] == "2026" else json.dumps(item)

    return "\n".join(f"{key} = {value(item)}" for key, item in document.items())


def test_all_reached_is_said_with_the_time_of_the_last() -> None:
    result = flown(ocean=STILL, waypoints=TWO[:2], guidance={"acceptance_radius_m": RADIUS})
    row = summary(result)
    assert result.outcome == "mission complete"
    reached = row["waypoints"][-1]["reached_utc"]
    assert row["verdict"].startswith(
        f"All 2 waypoints reached, the last on {reached[:10]} {reached[11:16]} UTC, after "
    )
    assert row["waypoint_distance_m"] is None
    assert row["events"] == {"mission complete": 1, "waypoint reached": 2}


def test_rows_far_apart_find_the_same_waypoints(three: Flown) -> None:
    coarse = flown(ocean=STILL, waypoints=TWO, guidance={"acceptance_radius_m": RADIUS}, output_every_s=600)
    fine, found = waypoints_of(three), waypoints_of(coarse)
    assert found.reached == fine.reached
    for one, other in zip(fine.all[:2], found.all[:2], strict=True):
        assert one.reached_s is not None
        assert other.reached_s == pytest.approx(one.reached_s, abs=600.0)
        assert other.closest_m == pytest.approx(one.closest_m, abs=250.0)


A, E2 = 6378137.0, 0.0066943799901413165
"""WGS 84: equatorial radius [m], squared eccentricity."""


def along_the_equator(three: Flown, east_m: Any, north_m: Any, reached: int, radius: float) -> Waypoints:
    """Waypoints at 1, 2 and 3 km east of 0, 179.99 E, and a record that passes near them: a row each 100 m."""
    east, north = np.asarray(east_m, float), np.asarray(north_m, float)
    record = np.zeros(len(east), three.record.dtype)
    record["time"] = 10.0 * np.arange(len(east))
    longitude = radians(179.99) + east / A
    record["longitude"] = (longitude + pi) % (2.0 * pi) - pi
    record["latitude"] = north / (A * (1.0 - E2))
    record["reckoned_latitude"], record["reckoned_longitude"] = record["latitude"], record["longitude"]
    degree = 179.99 + np.degrees(1e3 * np.arange(1, 4) / A)
    points = [{"latitude_deg": 0.0, "longitude_deg": float(x if x <= 180.0 else x - 360.0)} for x in degree]
    document = mission_document(
        start={"latitude_deg": 0.0, "longitude_deg": 179.99},
        waypoints=points, guidance={"acceptance_radius_m": radius}, ocean=STILL,
    )  # fmt: skip
    return waypoints_of(
        replace(
            three, mission=made(document), record=record, surfacings=three.surfacings[:0], waypoints_reached=reached
        )
    )


def test_legs_across_the_date_line_against_closed_forms(three: Flown) -> None:
    """50 m north of the equator, where arcs are A dlon and A (1 - e2) dlat."""
    found = along_the_equator(three, np.arange(0.0, 3500.0, 100.0), np.full(35, 50.0), 3, 60.0)
    assert [w.reached_s for w in found.all] == [100.0, 200.0, 300.0]  # each first row no farther than 60 m
    for waypoint in found.all:
        assert waypoint.flown is not None
        assert waypoint.closest_m == pytest.approx(50.0, abs=1e-3)
        assert waypoint.flown.length_m == pytest.approx(1000.0, abs=1e-3)
        assert waypoint.flown.over_ground_m == pytest.approx(1000.0, abs=1e-3)
        assert waypoint.flown.beside_line_rms_m == pytest.approx(50.0, abs=1e-3)
        assert waypoint.flown.beside_line_greatest_m == pytest.approx(50.0, abs=1e-3)
    first = found.all[0].flown
    assert first is not None
    assert first.made_good_m == pytest.approx(sqrt(1000.0**2 + 50.0**2) - 50.0, abs=1e-2)
    assert first.made_good_m_s == pytest.approx(first.made_good_m / 100.0)


@pytest.mark.parametrize(("latitude", "north_m"), [(60.0, 100.0), (60.0, -250.0), (-72.0, 100.0)])
def test_distance_from_a_leg_along_a_parallel(latitude: float, north_m: float) -> None:
    """A parallel is the rhumb line from east to west; beside it the meridian's radius of curvature gives metres."""
    w = 1.0 - E2 * np.sin(radians(latitude)) ** 2
    beside = latitude + np.degrees(north_m / (A * (1.0 - E2) / w**1.5))
    start, end = Place(latitude, 179.0), Place(latitude, -179.0)
    found = beside_line(np.full(3, beside), np.array([179.0, 180.0, -179.5]), start, end)
    assert found == pytest.approx(np.full(3, -north_m), rel=1e-4)  # north of an eastward leg is to port


def test_what_happens_during_a_dive_is_no_dive(three: Flown) -> None:
    extra = three.events[:1].copy()
    descent = float(PHASES.index("descent"))
    extra["phase"], extra["reason"], extra["time"] = descent, OUTSIDE_DATA, three.events["time"][0] + 1.0
    more = replace(three, events=np.concatenate([three.events[:1], extra, three.events[1:]]))
    descents = int(np.sum(three.events["phase"] == descent))
    assert summary(more)["dives"] == summary(three)["dives"] == descents
    assert dives_in(dataset_of(more)) == descents
    assert summary(more)["events"]["outside the ocean's data"] == 1


def test_self_discharge_is_power_times_time(three: Flown) -> None:
    battery = three.plant.battery
    assert battery.self_discharge > 0.0
    spent = summary(three)["energy_wh"]["self_discharge"]
    assert spent == pytest.approx(battery.self_discharge * 0.25 * 24.0, rel=1e-3)  # a quarter of a day, but a row
    curve = dataset_of(three)["energy_self_discharge"].values
    assert np.diff(curve) == pytest.approx(np.full(len(curve) - 1, battery.self_discharge * 10.0))


def test_missed_by_how_much_between_rows(three: Flown) -> None:
    """Rows 600 m apart pass a waypoint at 80 m between two of them: the nearest row is farther."""
    found = along_the_equator(three, [100.0, 700.0, 1300.0, 1900.0], np.full(4, 80.0), 0, 60.0)
    assert found.all[0].closest_m == pytest.approx(80.0, abs=1e-2)
    assert found.missed_by(found.all[0]) == pytest.approx(20.0, abs=1e-2)
    assert found.all[0].to_go_m == pytest.approx(sqrt(900.0**2 + 80.0**2), abs=1e-2)
    assert found.all[1].closest_m is None
    assert found.sought.tolist() == [0, 0, 0, 0]
    assert found.distance_m[1] == pytest.approx(sqrt(300.0**2 + 80.0**2), abs=1e-2)


@pytest.fixture(scope="module")
def swept() -> Flown:
    """Against a current of 0.9 m/s, which is more than it flies."""
    ocean = {"name": "uniform", "parameters": {"current_east_m_s": 0.0, "current_north_m_s": -0.9}}
    return flown(ocean=ocean, waypoints=[{"latitude_deg": 18.05, "longitude_deg": 116.0}], sensors=QUIET)


def test_a_goal_that_recedes_is_named(swept: Flown) -> None:
    row = summary(swept)
    assert row["swept_away"] is True
    km = row["waypoint_distance_m"] / 1e3
    # nearest at the start, 5.5 km off, of which the radius takes 0.5 km
    assert row["verdict"] == f"Waypoint not reached, swept away, {km:.1f} km off (missed by 5.0 km): time over"
    (receding,) = waypoints_of(swept).receding
    away = haversine(
        np.degrees(swept.surfacings["latitude"]), np.degrees(swept.surfacings["longitude"]), (18.05, 116.0)
    )
    assert np.all(np.diff(away) > 0.0)
    assert receding.since_s == swept.surfacings["time"][0]
    assert receding.named_s == swept.surfacings["time"][3]
    assert receding.growth_m == pytest.approx(away[-1] - away[0], rel=0.006)
    dataset = dataset_of(swept)
    (event,) = np.flatnonzero(dataset["event_reason"].values == NAMES.index("swept away"))
    assert dataset["event_waypoint"].values[event] == 1
    assert (dataset["event_time"].values[event] - dataset["time"].values[0]) / np.timedelta64(1, "s") == pytest.approx(
        receding.named_s, abs=1e-6
    )


@pytest.mark.parametrize(
    ("away", "named"),
    [
        ([900, 800, 850, 900, 1000], True),
        ([900, 800, 850, 900, 890], False),  # two surfacings farther
        ([900, 800, 802, 805, 809], False),  # by less than the positions' noise
        ([900, 950, 1000, 1100, 700], True),  # and came back
    ],
)
def test_receding_needs_several_surfacings_and_some_way(three: Flown, away: list[float], named: bool) -> None:
    document = dict(three.mission.document) | {
        "start": {"latitude_deg": 0.0, "longitude_deg": 10.0},
        "waypoints": [{"latitude_deg": 0.0, "longitude_deg": 10.1}],
    }
    surfacings = np.zeros(len(away), three.surfacings.dtype)
    surfacings["time"] = 1000.0 * np.arange(1, len(away) + 1)
    surfacings["longitude"] = radians(10.1) - np.asarray(away, float) / A
    record = three.record.copy()
    for name, value in (("latitude", 0.0), ("longitude", radians(10.09))):
        record[name] = record[f"reckoned_{name}"] = value
    found = waypoints_of(
        replace(three, mission=made(document), record=record, surfacings=surfacings, waypoints_reached=0)
    )
    assert bool(found.receding) == named
    assert found.swept_away == (named and away[-1] == max(away))


def test_repeated_waypoints_go_on_counting() -> None:
    there_and_back = [{"latitude_deg": 18.012, "longitude_deg": 116.0}, {"latitude_deg": 18.0, "longitude_deg": 116.0}]
    result = flown(ocean=STILL, waypoints=there_and_back, guidance={"acceptance_radius_m": RADIUS, "repeat": True})
    found = waypoints_of(result)
    assert found.reached == result.waypoints_reached >= 3
    assert len(found.all) == found.reached + 1
    times = [w.reached_s for w in found.all[:-1]]
    assert times == sorted(times, key=lambda t: t or 0.0)
    assert {w.place.latitude_deg for w in found.all[::2]} == {18.012}
    lap, number = divmod(found.reached, 2)
    assert summary(result)["verdict"].startswith(
        f"{found.reached} waypoints reached, in lap {lap + 1} number {number + 1} is "
    )


@pytest.mark.parametrize(
    ("waypoints", "repeat", "words"),
    [
        ([(18.001, 116.0)], False, ["waypoint 1 lies 111 m from the start", "before the first dive"]),
        (
            [(18.1, 116.0), (18.101, 116.0)],
            False,
            ["waypoint 2 lies 111 m from waypoint 1", "together with waypoint 1"],
        ),
        ([(18.1, 116.0), (18.2, 116.0), (18.101, 116.0)], True, ["waypoint 1 lies 111 m from waypoint 3"]),
        ([(18.1, 116.0), (18.2, 116.0), (18.101, 116.0)], False, []),
        ([(18.1, 116.0)], True, []),
        ([], False, []),
    ],
)
def test_start_and_legs_within_the_radius_are_warned_of(
    waypoints: list[tuple[float, float]], repeat: bool, words: list[str]
) -> None:
    points = [{"latitude_deg": a, "longitude_deg": b} for a, b in waypoints]
    told = remarks(made(mission_document(waypoints=points, guidance={"repeat": repeat})))
    found = [one for one in told if one.name == "waypoint_within_radius"]
    assert len(found) == bool(words)
    for word in words:
        assert word in found[0].message
        assert "guidance.acceptance_radius_m = 500" in found[0].message


def test_warning_is_printed_and_in_json(stommel: Command, tmp_path: Path) -> None:
    path = tmp_path / "near.toml"
    path.write_text(toml(mission_document(waypoints=[{"latitude_deg": 18.001, "longitude_deg": 116.0}])))
    shown = " ".join(stommel("simulate", path).out.split())
    assert "warning: waypoint_within_radius: waypoint 1 lies 111 m from the start" in shown
    warning = stommel("simulate", path, "--json").json["warnings"][0]
    assert warning["name"] == "waypoint_within_radius"


def test_file_holds_the_waypoints(three: Flown, tmp_path: Path) -> None:
    write_netcdf(dataset_of(three), tmp_path / "m.nc")
    found = waypoints_of(three)
    with xr.open_dataset(tmp_path / "m.nc") as read:
        assert read["waypoint_reached"].values.tolist() == [1, 1, 0]
        assert read["waypoint_latitude"].values.tolist() == [18.01, 18.01, 18.1]
        assert float(read["acceptance_radius"]) == RADIUS
        after = read["waypoint_reached_after"].values
        assert after[:2].tolist() == [w.reached_s for w in found.all[:2]]
        assert np.isnan(after[2])
        sought = read["waypoint_sought"].values
        assert sought[0] == 1
        assert sought[-1] == 3
        assert read.attrs["verdict"] == summary(three)["verdict"]
        away = haversine(read["latitude"].values, read["longitude"].values, place(TWO[2]))
        last = sought == 3
        assert read["distance_to_waypoint"].values[last] == pytest.approx(away[last], rel=0.006)
        reached = read["event_reason"].values == NAMES.index("waypoint reached")
        assert read["event_waypoint"].values[reached].tolist() == [1, 2]


def test_no_waypoints_are_said(three: Flown) -> None:
    document = mission_document(waypoints=[], ocean=STILL)
    none = replace(three, mission=made(document), waypoints_reached=0)
    assert summary(none)["verdict"] == "No waypoints to reach: time over"
    assert dataset_of(none).sizes["waypoint"] == 0


def test_a_goal_at_the_pole_is_no_trouble(three: Flown) -> None:
    """A goal at the pole, where Mercator's map ends: distances stay finite."""
    document = mission_document(waypoints=[{"latitude_deg": 90.0, "longitude_deg": 0.0}], ocean=STILL)
    row = summary(replace(three, mission=made(document), waypoints_reached=0))
    quarter = 10001965.729  # meridian from equator to pole, WGS 84
    south = A * (1.0 - E2) * radians(18.0)  # roughly; the rest within a percent
    assert row["waypoint_distance_m"] == pytest.approx(quarter - south, rel=0.01)
