"""Every variable of the Dataset is the raw record's column, converted to the unit that the variable states.

The oracle is a table of units (SI in the record, the unit of each attribute here), and rigid-body kinematics written
out once more: a mission in a uniform current with a known turn is put together again from the Dataset alone.
"""

import dataclasses
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
import xarray as xr

from stommel.simulation.flight import Flown
from stommel.simulation.results.dataset import dataset_of
from stommel.simulation.results.energy import DRAINS
from stommel.simulation.results.summary import summary
from tests.simulation.conftest import EXACT, flown, sampled

Array = np.ndarray[Any, Any]

CONVERSIONS: dict[tuple[str, str], Callable[[Array], Array]] = {
    ("rad", "degree"): lambda x: x * 180.0 / np.pi,
    ("rad", "degrees_north"): lambda x: x * 180.0 / np.pi,
    ("rad", "degrees_east"): lambda x: x * 180.0 / np.pi,
    ("rad s-1", "degree s-1"): lambda x: x * 180.0 / np.pi,
    ("m3", "ml"): lambda x: x / 1e-6,
    **{(same, same): lambda x: x for same in ("m", "m s-1", "kg m-3", "degree_C", "g kg-1", "V", "A", "Pa", "s", "1")},
}
"""What is done to a number of the first unit to tell it in the second; what is not here is no conversion."""

RECORD = {
    "latitude": ("latitude", "rad"),
    "longitude": ("longitude", "rad"),
    "depth": ("depth", "m"),
    "roll": ("roll", "rad"),
    "pitch": ("pitch", "rad"),
    "heading": ("heading", "rad"),
    "surge": ("u", "m s-1"),
    "sway": ("v", "m s-1"),
    "heave": ("w", "m s-1"),
    "roll_rate": ("p", "rad s-1"),
    "pitch_rate": ("q", "rad s-1"),
    "yaw_rate": ("r", "rad s-1"),
    "moving_mass_position": ("moving_mass", "m"),
    "ballast_volume": ("ballast", "m3"),
    "rudder_angle": ("rudder", "rad"),
    "roll_mass_angle": ("roll_mass", "rad"),
    "measured_pitch": ("measured_pitch", "rad"),
    "measured_heading": ("measured_heading", "rad"),
    "measured_depth": ("measured_depth", "m"),
    "density": ("density", "kg m-3"),
    "temperature": ("temperature", "degree_C"),
    "salinity": ("salinity", "g kg-1"),
    "current_north": ("current_north", "m s-1"),
    "current_east": ("current_east", "m s-1"),
    "bottom_depth": ("bottom_depth", "m"),
    "battery_voltage": ("voltage", "V"),
    "battery_current": ("current", "A"),
    "internal_pressure": ("internal_pressure", "Pa"),
    "reckoned_latitude": ("reckoned_latitude", "rad"),
    "reckoned_longitude": ("reckoned_longitude", "rad"),
}
"""Variable: its column of `stommel.simulation.log.ROW`, and the unit of that column."""

SURFACINGS = {
    "surfacing_latitude": ("latitude", "rad"),
    "surfacing_longitude": ("longitude", "rad"),
    "depth_averaged_current_north": ("current_north", "m s-1"),
    "depth_averaged_current_east": ("current_east", "m s-1"),
    "true_current_north": ("true_current_north", "m s-1"),
    "true_current_east": ("true_current_east", "m s-1"),
    "reckoning_error": ("reckoning_error", "m"),
    "time_submerged": ("submerged", "s"),
    "dive_number": ("dive", "1"),
}

TURNED = (90.0, 0.0)
"""Headings [deg] of the two legs: first to the east, then to the north."""
CURRENT_NORTH, CURRENT_EAST = 0.06, -0.04


def converted(values: Array, raw: str, told: str) -> Array:
    return CONVERSIONS[raw, told](np.asarray(values, float))


@pytest.fixture(scope="module")
def turning() -> Flown:
    """East, then north, in a uniform current, without any noise; every second is written."""
    ocean = {
        "name": "uniform",
        "parameters": {"current_north_m_s": CURRENT_NORTH, "current_east_m_s": CURRENT_EAST},
    }
    return flown(
        ocean=ocean,
        start={"latitude_deg": 18.0, "longitude_deg": 116.0},
        heading_deg=90.0,
        waypoints=[{"latitude_deg": 18.0, "longitude_deg": 116.003}, {"latitude_deg": 18.2, "longitude_deg": 116.003}],
        guidance={"acceptance_radius_m": 100.0},
        dives={"depth_m": 30.0, "pitch_deg": 30.0, "speed_m_s": 0.4},
        sensors=EXACT,
        output_every_s=1.0,
        duration_days=0.08,
    )


@pytest.fixture(scope="module")
def marked(turning: Flown) -> Flown:
    """The same with every column of the record filled with numbers of its own, so that no two can be mistaken."""
    draw = np.random.default_rng(5)
    record, surfacings = turning.record.copy(), turning.surfacings.copy()
    for k, name in enumerate(sorted({column for column, _ in RECORD.values()})):
        if name not in ("latitude", "longitude", "depth"):  # what the waypoints are told from
            record[name] = (k + 1.0) * draw.uniform(0.01, 0.09, len(record))
    for k, name in enumerate(sorted({column for column, _ in SURFACINGS.values()} - {"latitude", "longitude", "dive"})):
        surfacings[name] = (k + 1.0) * draw.uniform(0.1, 0.9, len(surfacings))
    record["energy"] = np.cumsum(draw.uniform(0.0, 1.0, record["energy"].shape), axis=0)
    return dataclasses.replace(turning, record=record, surfacings=surfacings)


def test_every_variable_of_time_is_its_column_in_the_unit_that_it_states(marked: Flown) -> None:
    dataset = dataset_of(marked)
    for name, (column, unit) in RECORD.items():
        expected = converted(marked.record[column], unit, dataset[name].attrs["units"])
        np.testing.assert_allclose(dataset[name].values, expected, rtol=2e-7, err_msg=name)
    others = {"waypoint_sought", "distance_to_waypoint", "phase", *(f"energy_{name}" for name in DRAINS)}
    assert {str(name) for name in dataset.data_vars if dataset[name].dims == ("time",)} == set(RECORD) | others
    assert np.array_equal(dataset["phase"].values, marked.record["phase"])
    seconds = (dataset["time"].values - np.datetime64("2026-07-01T00:00:00")) / np.timedelta64(1, "ns") / 1e9
    np.testing.assert_allclose(seconds, marked.record["time"], atol=1e-6)


def test_every_energy_is_its_consumers_own(marked: Flown) -> None:
    dataset = dataset_of(marked)
    assert DRAINS[-1] == "self_discharge"
    for k, name in enumerate(DRAINS[:-1]):
        assert dataset[f"energy_{name}"].attrs["units"] == "J"
        np.testing.assert_array_equal(dataset[f"energy_{name}"].values, marked.record["energy"][:, k])
    power = dataset.attrs["battery_self_discharge_w"]
    step = marked.mission.scenario.integration.control_step_s
    np.testing.assert_allclose(dataset["energy_self_discharge"].values, power * (marked.record["time"] + step))
    assert power > 0.0


def test_every_variable_of_the_surfacings_is_its_column(marked: Flown) -> None:
    dataset = dataset_of(marked)
    found = {str(name) for name in dataset.data_vars if dataset[name].dims == ("surfacing",)}
    assert found == set(SURFACINGS) | {"surfacing_time"}
    for name, (column, unit) in SURFACINGS.items():
        expected = converted(marked.surfacings[column], unit, dataset[name].attrs["units"])
        np.testing.assert_allclose(dataset[name].values, expected, rtol=1e-12, err_msg=name)


def test_dives_are_numbered_from_one_as_they_end(turning: Flown) -> None:
    dataset = dataset_of(turning)
    count = dataset.sizes["surfacing"]
    assert count >= 3
    assert dataset["dive_number"].values.tolist() == list(range(1, count + 1))
    # counted once more from the depth: dives that have been deep and come up again
    deep = (dataset["depth"].values > 15.0).astype(int)
    for number, when in zip(dataset["dive_number"].values, dataset["surfacing_time"].values, strict=True):
        begun = np.diff(deep[dataset["time"].values <= when]) == 1
        assert begun.sum() == number


def test_samples_and_events_stand_at_their_times_and_places(turning: Flown) -> None:
    dataset, start = dataset_of(turning), np.datetime64("2026-07-01T00:00:00")
    for kind, rows in (("sample", turning.samples), ("event", dataset_events(turning))):
        seconds = (dataset[f"{kind}_time"].values - start) / np.timedelta64(1, "ns") / 1e9
        np.testing.assert_allclose(seconds, rows["time"], atol=1e-6)
        for name in ("latitude", "longitude"):
            told = dataset[f"{kind}_{name}"]
            expected = converted(rows[name], "rad", told.attrs["units"])
            np.testing.assert_allclose(told.values, expected, rtol=1e-14)
        assert np.array_equal(dataset[f"{kind}_phase"].values, rows["phase"])
    assert np.array_equal(dataset["event_depth"].values, dataset_events(turning)["depth"])
    assert dataset["event_depth"].attrs["units"] == "m"


def dataset_events(result: Flown) -> Any:
    """The log's events with those of the waypoints among them, by their times."""
    from stommel.simulation.results.events import events_of
    from stommel.simulation.results.waypoints import waypoints_of

    return events_of(result, waypoints_of(result)).rows


def test_pressure_of_the_samples_is_in_decibar(turning: Flown) -> None:
    dataset = dataset_of(turning)
    told = dataset["sample_pressure"]
    assert told.attrs["units"] == "dbar"
    noise = turning.mission.scenario.ctd.pressure_noise_dbar
    miss = told.values - sampled(turning, "pressure") / 1e4  # 1 dbar is 10 kPa
    assert np.abs(miss).max() < 6.0 * noise
    assert miss.std() == pytest.approx(noise, rel=0.2)


@pytest.fixture(scope="module")
def turned(turning: Flown) -> xr.Dataset:
    return dataset_of(turning)


def in_radians(dataset: xr.Dataset, name: str) -> Array:
    assert dataset[name].attrs["units"].startswith("degree")
    return np.radians(np.asarray(dataset[name].values, float))


def to_ned(dataset: xr.Dataset) -> Array:
    """Velocity through the water, from body axes to north, east, down by roll, pitch and heading (z-y-x)."""
    phi, theta, psi = (in_radians(dataset, name) for name in ("roll", "pitch", "heading"))
    u, v, w = (np.asarray(dataset[name].values, float) for name in ("surge", "sway", "heave"))
    y, z = v * np.cos(phi) - w * np.sin(phi), v * np.sin(phi) + w * np.cos(phi)
    forward, down = u * np.cos(theta) + z * np.sin(theta), -u * np.sin(theta) + z * np.cos(theta)
    return np.stack([forward * np.cos(psi) - y * np.sin(psi), forward * np.sin(psi) + y * np.cos(psi), down])


def submerged(dataset: xr.Dataset, least: float = 5.0) -> Array:
    """Rows with their neighbours clear of the surface."""
    deep = np.asarray(dataset["depth"].values) > least
    return np.flatnonzero(deep[:-2] & deep[1:-1] & deep[2:]) + 1


def test_way_over_ground_is_the_way_through_the_water_and_the_current(turned: xr.Dataset) -> None:
    """Differences of the places, on the ellipsoid at 18 N, against attitude, velocity and current of each row."""
    metres = np.array([[110_680.4], [105_904.9], [1.0]])  # a degree of latitude and longitude at 18 N, WGS 84
    places = np.stack([turned[name].values for name in ("latitude", "longitude", "depth")]).astype(float) * metres
    k = submerged(turned)
    assert len(k) > 2000
    over_ground = 0.5 * (places[:, k + 1] - places[:, k - 1])  # rows are a second apart
    current = np.stack([turned["current_north"].values, turned["current_east"].values, np.zeros(turned.sizes["time"])])
    np.testing.assert_allclose(current[0], CURRENT_NORTH, rtol=1e-6)
    np.testing.assert_allclose(current[1], CURRENT_EAST, rtol=1e-6)
    miss = over_ground - (to_ned(turned) + current)[:, k]
    assert np.abs(miss).mean(axis=1).max() < 5e-4
    assert np.abs(miss).max() < 0.02


def test_angles_turn_at_their_rates(turned: xr.Dataset) -> None:
    phi, theta = in_radians(turned, "roll"), in_radians(turned, "pitch")
    p, q, r = (in_radians(turned, f"{name}_rate") for name in ("roll", "pitch", "yaw"))
    yaw = (q * np.sin(phi) + r * np.cos(phi)) / np.cos(theta)
    rates = {
        "heading": yaw,
        "pitch": q * np.cos(phi) - r * np.sin(phi),
        "roll": p + np.sin(theta) * yaw,
    }
    k = submerged(turned)
    for name, rate in rates.items():
        angle = np.unwrap(in_radians(turned, name))
        found = 0.5 * (angle[k + 1] - angle[k - 1])
        assert np.abs(found - rate[k]).mean() < 0.05 * np.abs(rate[k]).mean() + 1e-6, name


def test_the_turn_is_from_east_to_north(turned: xr.Dataset) -> None:
    """Each leg is steered so that the way over ground, not the nose, leads to its waypoint."""
    assert turned["waypoint_reached"].values.tolist() == [1, 0]
    k = submerged(turned)
    sought = turned["waypoint_sought"].values[k]
    ways = np.stack([turned["latitude"].values * 110_680.4, turned["longitude"].values * 105_904.9])
    north, east = 0.5 * (ways[:, k + 1] - ways[:, k - 1])
    last = k > k[sought == 2][0] + 900  # once the turn is over
    legs = {1: sought == 1, 2: (sought == 2) & last}
    for leg, course in zip((1, 2), TURNED, strict=True):
        made = np.degrees(np.arctan2(east[legs[leg]].mean(), north[legs[leg]].mean()))
        assert abs((made - course + 180.0) % 360.0 - 180.0) < 12.0
    heading = turned["heading"].values[k]
    before, after = (np.median(heading[legs[leg]]) for leg in (1, 2))
    # against a current to the north the nose points south of east, against one to the west east of north
    assert 92.0 < before < 125.0
    assert 2.0 < (after + 180.0) % 360.0 - 180.0 < 20.0


def test_the_current_is_found_and_told_with_its_sign(turning: Flown, turned: xr.Dataset) -> None:
    found, true = turned["depth_averaged_current_north"].values, turned["true_current_north"].values
    assert true == pytest.approx(CURRENT_NORTH, abs=1e-6)
    assert found == pytest.approx(CURRENT_NORTH, abs=0.02)
    found, true = turned["depth_averaged_current_east"].values, turned["true_current_east"].values
    assert true == pytest.approx(CURRENT_EAST, abs=1e-6)
    assert found == pytest.approx(CURRENT_EAST, abs=0.02)
    miss = np.hypot(
        turned["depth_averaged_current_north"] - CURRENT_NORTH, turned["depth_averaged_current_east"] - CURRENT_EAST
    ).values
    error = summary(turning)["current_error_m_s"]
    assert (error["mean"], error["greatest"]) == pytest.approx((miss.mean(), miss.max()), abs=1e-6)


def test_what_the_file_says_of_itself(turning: Flown, turned: xr.Dataset) -> None:
    told = turned.attrs
    plan = turning.mission.scenario
    assert told["seed"] == str(plan.seed)
    assert (told["title"], told["outcome"]) == ("test", turning.outcome)
    assert told["verdict"] == summary(turning)["verdict"]
    assert told["ocean"] == "uniform"
    assert "ZJU" in told["summary"]
    assert told["vehicle_neutral_density_kg_m3"] == turning.mission.vehicle.neutral_density_kg_m3
    speeds = np.sqrt(sum(np.asarray(turning.record[name]) ** 2 for name in ("u", "v", "w")))
    assert told["distance_through_water_m"] == pytest.approx(speeds.sum() * 1.0, rel=1e-12)
