"""A leak and lost vacuum end the mission at the surface; oracles: the leak's rate, Archimedes, the perfect gas."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from stommel.simulation.flight import Flown
from tests.simulation.conftest import EXACT, column, events, flown, stays

STILL = {"name": "still"}
BALLAST = {"depth_m": 180.0, "pitch_deg": 35.0, "ballast_ml": 100.0}


def test_leak_brings_the_vehicle_up() -> None:
    """1 ml/min from 0.1 h on: 5 ml are there after 5 min, seen at the next look, every 10 s."""
    dives = {"depth_m": 180.0, "pitch_deg": 35.0, "speed_m_s": 0.35}
    found = flown(leak={"after_hours": 0.1, "rate_ml_min": 1.0}, sensors={"leak_ml": 5.0}, dives=dives)
    (seen, phase, reason), *_ = [event for event in events(found) if event[2] != "nothing"]
    assert (phase, reason) == ("inflection", "abort: leak")
    assert 0.1 * 3600.0 + 300.0 <= seen <= 0.1 * 3600.0 + 311.0
    assert events(found)[-1][1:] == ("recovery", "abort: leak")
    assert found.outcome == "aborted, waiting at the surface"
    assert column(found, "depth")[-1] == 0.0
    assert len(stays(found, "descent")) == 1


def test_leak_at_the_surface_ends_the_mission_there() -> None:
    found = flown(leak={"rate_ml_min": 5.0})
    assert [event[1:] for event in events(found)] == [("recovery", "abort: leak")]
    assert found.outcome == "aborted, waiting at the surface"


def test_without_the_rule_it_goes_on() -> None:
    found = flown(leak={"after_hours": 0.2, "rate_ml_min": 0.2}, abort={"leak": False})
    assert found.outcome == "time over"
    assert len(stays(found, "descent")) > 5
    assert all("leak" not in reason for _, _, reason in events(found))


def test_water_in_the_hull_costs_buoyancy() -> None:
    """Archimedes: the oil drives the climb less the water that came in; speed goes with the root of the drive."""
    rate = 1.0
    tight, leaking = (
        flown(ocean=STILL, dives=BALLAST, sensors=EXACT, duration_days=0.03, output_every_s=1.0, leak=leak,
              abort={"leak": False}, pitch_control={"gain_mm_per_deg": 0.0})
        for leak in ({}, {"rate_ml_min": rate})
    )  # fmt: skip
    speeds, leaked = [], 0.0
    for found in (tight, leaking):
        begin, end = stays(found, "ascent")[0]
        middle = round(0.5 * (begin + end))
        speeds.append(float(np.linalg.norm([column(found, name)[middle] for name in "uvw"])))
        leaked = rate * middle / 60.0
        oil = 1e6 * column(found, "ballast")[middle]
        assert oil == pytest.approx(1e6 * column(tight, "ballast")[middle], rel=1e-3)  # the engine does not see water
    drive = 1e6 * float(column(tight, "ballast")[middle])
    assert leaked > 15.0
    assert speeds[1] / speeds[0] == pytest.approx(np.sqrt((drive - leaked) / drive), rel=0.02)


@pytest.fixture(scope="module")
def two_layers() -> Flown:
    """Through a sharp thermocline, 25 to 10 deg C, with the air in the hull following in 20 min."""
    air = {"pressure_kpa": 70.0, "temperature_c": 18.0, "volume_l": 12.0, "settle_minutes": 20.0}
    return flown(ocean={"name": "two_layer"}, sensors=EXACT, duration_days=0.1, hull_air=air)


def test_hull_air_is_a_perfect_gas(two_layers: Flown) -> None:
    """p V / T is the same; T follows the water's by a first-order lag, here solved anew by a general method."""
    t, water = column(two_layers, "time"), column(two_layers, "temperature")
    air = solve_ivp(
        lambda now, T: (np.interp(now, t, water) - T) / 1200.0,
        (0.0, t[-1]), [water[0]], t_eval=t, max_step=10.0, rtol=1e-8,
    ).y[0]  # fmt: skip
    assert np.ptp(air) > 3.0
    room = 12e-3 + column(two_layers, "ballast")
    expected = 70e3 * (12e-3 / room) * (air + 273.15) / (18.0 + 273.15)
    measured = column(two_layers, "internal_pressure")
    assert measured == pytest.approx(expected, rel=5e-4)
    assert np.ptp(measured) > 1500.0  # some 300 ml of 12 l, and the temperature


def test_lost_vacuum_ends_the_mission() -> None:
    """59.0 kPa at the water's 15 deg C; 100 ml of oil drawn into 15 l raise it by 0.7 %."""
    by_pressure = [
        flown(ocean=STILL, dives=BALLAST, sensors=EXACT, duration_days=0.05, abort={"internal_pressure_kpa": limit})
        for limit in (59.2, 59.7)
    ]
    assert by_pressure[0].outcome == "aborted, waiting at the surface"
    (_, phase, reason), *_ = [event for event in events(by_pressure[0]) if event[2] != "nothing"]
    assert (phase, reason) == ("inflection", "abort: pressure inside the hull")
    assert by_pressure[1].outcome == "time over"
    assert 59.2e3 < column(by_pressure[1], "internal_pressure").max() < 59.7e3


def test_a_leak_that_wins_loses_the_vehicle() -> None:
    """Oracle: the hull's rating of 200 m times its safety factor of 2; a plan that forbids nothing and a large leak."""
    sea = {"name": "still", "parameters": {"bottom_m": 2000.0}}
    found = flown(ocean=sea, dives=BALLAST, leak={"rate_ml_min": 100.0}, abort={"leak": False, "depth_m": 5000.0})
    assert found.outcome == "lost: deeper than the hull bears"
    assert column(found, "depth").max() == pytest.approx(400.0, abs=10.0)


def test_on_the_bottom_a_sinking_vehicle_stays() -> None:
    sea = {"name": "still", "parameters": {"bottom_m": 190.0}}
    found = flown(ocean=sea, dives=BALLAST, leak={"rate_ml_min": 100.0}, abort={"leak": False, "depth_m": 5000.0})
    assert found.outcome == "time over"
    assert column(found, "depth")[-1] == pytest.approx(190.0)
