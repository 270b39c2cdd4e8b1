"""The pool trial of section 5.2: the compass drifts by about 35 deg, the vehicle does not; shielding ends it."""

import tomllib
from pathlib import Path

import numpy as np
import pytest

from stommel.simulation.flight import Flown, fly_mission
from stommel.simulation.scenario.loading import mission_from
from stommel.simulation.scenario.shipped import mission_path


def _flown(shielding: float) -> Flown:
    path = mission_path("pool_trial")
    document = tomllib.loads(path.read_text(encoding="utf-8"))
    document["sensors"]["shielding"] = shielding
    return fly_mission(mission_from(document, str(path), Path()))


@pytest.fixture(scope="module")
def bare() -> Flown:
    return _flown(0.0)


def _range(flown: Flown, name: str) -> float:
    """Greatest difference of headings [deg]."""
    heading = np.unwrap(flown.record[name])
    return float(np.degrees(np.ptp(heading)))


def test_measured_heading_drifts_as_the_paper_met_it(bare: Flown) -> None:
    assert 28.0 < _range(bare, "measured_heading") < 42.0


def test_true_heading_stays(bare: Flown) -> None:
    assert _range(bare, "heading") < 0.5


def test_shielding_ends_the_drift() -> None:
    """What remains is the compass's own accuracy of 0.3 deg, as a spread of normal draws."""
    shielded = _flown(1.0)
    assert _range(shielded, "measured_heading") < 10.0 * 0.3
    assert _range(shielded, "heading") < 0.5


def test_sawtooth_stays_off_the_bottom(bare: Flown) -> None:
    depth = bare.record["depth"]
    assert 2.4 < depth.max() < 3.2
    assert len(bare.surfacings) >= 3
    assert bare.outcome == "time over"
