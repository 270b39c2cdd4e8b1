"""Which way a real glider's fin turns it, in dives and in climbs, and what lateral coefficients make of it.

Oracle: the log of the Slocum glider *comet* (North Sea, 23 June 2016; data of Merckelbach et al. 2019), not in the
repository. Positive is to starboard for fin and heading alike.
"""

from math import degrees

import numpy as np
import pytest
from numpy.typing import NDArray

from stommel.analysis import authority, linearise, modes, trim
from stommel.vehicle import Vehicle, load_vehicle
from tests.support.shared_data import shared_data
from tests.support.slocum_log import read_log

SENSORS = ("m_present_time", "m_fin", "m_heading", "m_pitch", "m_depth")
SPAN = 4
"""Cycles of some 4 s over which the heading's rate is taken: longer than the yaw of such a vehicle takes to settle."""


@pytest.fixture(scope="module")
def comet() -> NDArray[np.float64]:
    folder = shared_data("slocum-comet-2016")
    log = np.concatenate([read_log(path, folder, SENSORS) for path in sorted(folder.glob("*.dbd"))])
    log = log[np.argsort(log[:, 0])]
    assert len(log) > 3000
    return log


def turn_per_fin(log: NDArray[np.float64], side: float) -> tuple[float, float, int]:
    """Slope of heading rate over fin [deg/s per rad], their correlation, and the number of samples; side -1 dives."""
    t, fin, heading, pitch, depth = log.T
    heading = np.unwrap(heading)
    flying = (side * pitch > 0.25) & (depth > 5.0)
    fins, rates = [], []
    for k in range(len(t) - SPAN):
        piece = slice(k, k + SPAN + 1)
        if flying[piece].all() and np.all(np.diff(t[piece]) > 0.5) and t[k + SPAN] - t[k] < 8.0 * SPAN:
            fins.append(fin[piece].mean())
            rates.append((heading[k + SPAN] - heading[k]) / (t[k + SPAN] - t[k]))
    slope = degrees(float(np.polyfit(fins, rates, 1)[0]))
    return slope, float(np.corrcoef(fins, rates)[0, 1]), len(fins)


def test_the_log_is_read(comet: NDArray[np.float64]) -> None:
    """About four hours with dives to 42 m, as the data set says of itself."""
    assert np.nanmax(comet[:, 4]) == pytest.approx(42.0, abs=0.5)
    assert (comet[-1, 0] - comet[0, 0]) / 3600.0 == pytest.approx(4.0, abs=0.3)


@pytest.mark.parametrize(("side", "least", "most"), [(-1.0, 2.0, 4.0), (1.0, 3.5, 6.0)], ids=["dives", "climbs"])
def test_the_fin_of_a_real_slocum_turns_it_the_same_way(
    comet: NDArray[np.float64], side: float, least: float, most: float
) -> None:
    slope, correlation, samples = turn_per_fin(comet, side)
    assert samples > 500
    assert correlation > 0.6
    assert least < slope < most


def turning(vehicle: Vehicle, pitch_deg: float) -> float:
    """Final turn rate per rudder angle at 0.4 m/s [deg/s per rad]."""
    flight = trim(vehicle, speed_m_s=0.4, pitch_deg=pitch_deg, within_limits=False)
    found = authority(linearise(vehicle, flight)).turn_rate_deg_s_per_rudder_deg
    assert found is not None
    return degrees(found)


def slowest(vehicle: Vehicle, pitch_deg: float) -> float:
    flight = trim(vehicle, speed_m_s=0.4, pitch_deg=pitch_deg, within_limits=False)
    lateral = modes(linearise(vehicle, flight)).lateral
    assert lateral is not None
    return max(mode.eigenvalue.real for mode in lateral)


ZJU = load_vehicle("zju")
AT_115 = ZJU.with_value("hydrodynamics.side_force_per_rad_kg_m", 115.0)
"""The side force of Sea-Wing's published set, the upper end of the interval in the file."""


def test_with_the_side_force_of_the_file_the_rudder_turns_climbs_the_other_way() -> None:
    """The three claims that rest on it: reversal in climbs, a dead zone near -14 deg, a spiral that diverges."""
    assert turning(ZJU, -25.0) > 0.5
    assert turning(ZJU, 25.0) < -0.5
    assert abs(turning(ZJU, -14.0)) < 0.05
    assert slowest(ZJU, -45.0) > 0.0


@pytest.mark.parametrize("pitch", [-50.0, -40.0, -25.0, -14.0, -5.0, 5.0, 14.0, 25.0, 45.0])
def test_with_that_of_seawing_all_three_claims_are_gone(pitch: float) -> None:
    """One way in dives and climbs, as comet's fin; authority at every pitch; every lateral mode dies out."""
    assert turning(AT_115, pitch) > 0.5
    assert slowest(AT_115, pitch) < 0.0


def test_the_intervals_of_the_file_hold_both() -> None:
    """The laterals are assumptions with an interval, in both files, and no source."""
    for vehicle in (ZJU, load_vehicle("slocum")):
        for key in ("side_force_per_rad_kg_m", "roll_moment_per_rad_kg", "yaw_moment_per_rad_kg", "roll_damping_kg_s",
                    "yaw_damping_kg_s"):  # fmt: skip
            origin = vehicle.provenance_of(f"hydrodynamics.{key}")
            assert origin.kind == "assumption", key
            assert origin.range is not None
            low, high = origin.range
            assert low <= vehicle.value(f"hydrodynamics.{key}") <= high
    seawing = load_vehicle("seawing")
    for key in ("side_force_per_rad_kg_m", "yaw_moment_per_rad_kg", "yaw_damping_kg_s"):
        origin = ZJU.provenance_of(f"hydrodynamics.{key}")
        assert origin.range is not None
        assert origin.range[0] <= seawing.value(f"hydrodynamics.{key}") <= origin.range[1], key
