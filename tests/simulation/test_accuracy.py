"""How far the answer is from the truth: currents by dead reckoning, and the error of the integration steps."""

import numpy as np
import pytest

from stommel.simulation.flight import Flown
from stommel.simulation.results.summary import summary
from tests.simulation.conftest import QUIET, column, flown, surfaced

EAST, NORTH = 0.15, -0.08


def test_uniform_current_is_recovered_within_one_percent() -> None:
    ocean = {"name": "uniform", "parameters": {"current_east_m_s": EAST, "current_north_m_s": NORTH}}
    dives = {"depth_m": 180.0, "pitch_deg": 35.0, "speed_m_s": 0.35}
    found = flown(ocean=ocean, sensors=QUIET, dives=dives)
    assert len(found.surfacings) >= 8
    north, east = surfaced(found, "current_north"), surfaced(found, "current_east")
    miss = np.hypot(north - NORTH, east - EAST)
    mean = np.array([north.mean(), east.mean()])
    current = np.hypot(NORTH, EAST)
    assert np.hypot(*(mean - [NORTH, EAST])) < 0.01 * current
    assert miss.max() < 0.01 * current
    true = np.stack([surfaced(found, "true_current_north"), surfaced(found, "true_current_east")], axis=1)
    np.testing.assert_allclose(true, np.tile([NORTH, EAST], (len(true), 1)), rtol=1e-7)  # the ocean keeps floats


def test_ten_times_smaller_steps_change_little() -> None:
    """Depth within 1 m at every row; without noise, whose decisions at dead bands differ after the first difference."""
    coarse = flown(sensors=QUIET, duration_days=1.0)
    cut = coarse.mission.scenario.integration
    finer = {"steady_steps": 10 * cut.steady_steps, "moving_steps": 10 * cut.moving_steps}
    fine = flown(sensors=QUIET, integration=finer, duration_days=1.0)
    assert np.abs(column(fine, "depth") - column(coarse, "depth")).max() < 1.0
    made_good = [summary(one)["distance_made_good_km"] for one in (coarse, fine)]
    assert min(made_good) > 10.0  # not the nothing of a mission without a position
    assert made_good[0] == pytest.approx(made_good[1], rel=1e-3)


def test_dives_reach_their_depth_and_no_more(quarter_day: Flown) -> None:
    deepest = column(quarter_day, "depth").max()
    assert 95.0 < deepest < 100.0


def test_energies_only_grow(quarter_day: Flown) -> None:
    assert (np.diff(quarter_day.record["energy"], axis=0) >= 0.0).all()
    row = summary(quarter_day)
    spent = sum(row["energy_wh"].values())
    assert row["battery_left_wh"] + spent == pytest.approx(row["battery_wh"], rel=1e-9)
