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
    """By the way that it sinks meanwhile, and less than a second of it."""
    prompt = fly()
    begins, depths = ([begin for begin, _ in stays(found, "inflection")] for found in (prompt, late)), []
    for found, begin in zip((prompt, late), begins, strict=True):
        depths.append(column(found, "depth")[round(begin[0])])
    sinking = float(np.diff(column(late, "depth"))[np.argmax(column(late, "depth") > 99.0)])
    assert depths[1] - depths[0] == pytest.approx(PRESSURE * sinking, abs=sinking)
