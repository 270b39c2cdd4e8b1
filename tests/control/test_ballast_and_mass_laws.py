"""Oracles of the laws of moving mass and drift: geometric convergence, rest inside the dead band."""

import pytest

from stommel.control.laws import DriftLaw, PitchLaw, drift_correction, pitch_correction

PITCH = PitchLaw(gain=0.1, dead_band=0.009, period=120.0, tolerance=0.0005)
DRIFT = DriftLaw(gain=6e-5, return_time=600.0, fastest=0.05, dead_band=3.0, period=60.0)


def test_pitch_error_shrinks_by_the_same_part_each_period() -> None:
    """A flight whose pitch falls by 1 rad for 0.3 m of mass: each correction takes gain / 0.3 of the error away."""
    wanted, theta, correction, slope = -0.6, -0.5, 0.0, 0.3
    errors = []
    for _ in range(12):
        errors.append(wanted - theta)
        correction = pitch_correction(PITCH, correction, wanted, theta)
        theta = -0.5 - correction / slope
    for n, error in enumerate(errors):
        if abs(errors[max(n - 1, 0)]) >= PITCH.dead_band:
            assert error == pytest.approx(errors[0] * (1.0 - PITCH.gain / slope) ** n)
    assert abs(errors[-1]) < PITCH.dead_band
    assert errors[-1] == errors[-2]  # the battery is not spent on the rest


@pytest.mark.parametrize("start", [20.0, -20.0, 5.0, 100.0])
def test_drift_returns_and_stays_near(start: float) -> None:
    """A body whose vertical speed answers the ballast at once, 5 mm/s for each ml, with a weight of 2 ml too much.

    Without a correction it would sink by 36 m an hour.
    """
    depth, correction, depths, speeds = start, 0.0, [], []
    for _ in range(600):
        sinking = (2e-6 - correction) * 5e3
        correction = drift_correction(DRIFT, correction, depth, sinking)
        depth += (2e-6 - correction) * 5e3 * DRIFT.period
        depths.append(abs(depth))
        speeds.append(abs(sinking))
    assert max(depths[120:]) < 2.0 * DRIFT.dead_band
    assert max(speeds[1:]) < 1.05 * DRIFT.fastest
    assert correction == pytest.approx(2e-6, abs=1e-6)


def test_drift_within_the_dead_band_and_slow_is_left_alone() -> None:
    assert drift_correction(DRIFT, 7e-6, 2.9, 0.0049) == 7e-6
    assert drift_correction(DRIFT, 7e-6, 3.1, 0.0) > 7e-6  # too deep: more volume
    assert drift_correction(DRIFT, 7e-6, -3.1, 0.0) < 7e-6
    assert drift_correction(DRIFT, 7e-6, 0.0, 0.006) > 7e-6  # it sinks out of the band
