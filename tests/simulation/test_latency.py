"""What reaches the software late is what was true before; the record is of one moment."""

import numpy as np
import pytest

from stommel.simulation.flight import Flown
from tests.simulation.conftest import QUIET, column, flown, stays

ATTITUDE, PRESSURE = 3, 7


def fly(**sensors: float) -> Flown:
    return flown(duration_days=0.04, output_every_s=1.0, sensors=QUIET | sensors)


@pytest.fixture(scope="module")
def late() -> Flown:
    return fly(attitude_latency_s=float(ATTITUDE), pressure_latency_s=float(PRESSURE))


def test_without_latency_the_sensors_tell_the_row_s_own_truth() -> None:
    found = fly()
    np.testing.assert_allclose(column(found, "measured_depth"), column(found, "depth"), atol=1e-9)
    np.testing.assert_allclose(column(found, "measured_pitch"), column(found, "pitch"), atol=1e-9)


@pytest.mark.parametrize(("name", "lag"), [("depth", PRESSURE), ("pitch", ATTITUDE), ("heading", ATTITUDE)])
def test_measurements_are_the_truth_some_seconds_ago(late: Flown, name: str, lag: int) -> None:
    true, measured = column(late, name), column(late, f"measured_{name}")
    error = np.angle(np.exp(1j * (measured[lag:] - true[:-lag]))) if name != "depth" else measured[lag:] - true[:-lag]
    assert np.abs(error).max() < 1e-6  # the compass finds north by cross products
    # and not of any other moment
    for other in (lag - 1, lag + 1):
        assert np.abs(measured[other:] - true[:-other]).max() > 1e-3


def test_late_pressure_turns_the_vehicle_late(late: Flown) -> None:
    """By so many seconds after its true depth passes the one at which the prompt vehicle turns, and so much deeper."""
    prompt = fly()
    (turns, _), *_ = stays(prompt, "inflection")
    depth, t = column(prompt, "depth"), column(prompt, "time")
    (turned, _), *_ = stays(late, "inflection")
    true = column(late, "depth")
    # the first decision at or below the depth, by the depth of so long ago: between the prompt turn and a second before
    passed = t[np.argmax(true >= depth[round(turns)] - 1e-6)]
    assert turned - passed == pytest.approx(PRESSURE, abs=1.0)
    sinking = true[round(turned)] - true[round(turned) - 1]
    assert sinking > 0.1
    assert true[round(turned)] - depth[round(turns)] == pytest.approx(PRESSURE * sinking, abs=1.5 * sinking)
