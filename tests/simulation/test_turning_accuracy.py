"""The error of the integration steps where the lateral motion is excited: a mission that turns at every waypoint."""

import numpy as np
import pytest

from stommel.simulation.results.summary import summary
from tests.simulation.conftest import EXACT, column, flown

ZIGZAG = [{"latitude_deg": 18.0 + 0.005 * k, "longitude_deg": 116.0 + 0.008 * (k % 2)} for k in range(1, 30)]


@pytest.mark.parametrize("pitch", [35.0, 45.0])
def test_ten_times_smaller_steps_change_little(pitch: float) -> None:
    """Without dead band of the rudder: its decisions differ after the first difference, and so would the way."""
    mission = {
        "waypoints": ZIGZAG,
        "guidance": {"acceptance_radius_m": 150.0, "lookahead_m": 300.0},
        "sensors": EXACT,
        "heading_control": {"dead_band_deg": 0.0},
        "dives": {"depth_m": 100.0, "pitch_deg": pitch, "speed_m_s": 0.35},
    }
    coarse = flown(**mission)
    cut = coarse.mission.scenario.integration
    finer = {"steady_steps": 10 * cut.steady_steps, "moving_steps": 10 * cut.moving_steps}
    fine = flown(**mission, integration=finer)
    heading = np.unwrap(column(coarse, "heading"))
    assert np.sum(np.abs(np.diff(heading))) > np.radians(300.0)  # it turns
    assert np.abs(column(coarse, "v")).max() > 0.005
    assert np.abs(column(fine, "depth") - column(coarse, "depth")).max() < 1.0
    made_good = [summary(one)["distance_made_good_km"] for one in (coarse, fine)]
    assert min(made_good) > 0.3  # not the nothing of a mission without a position
    assert made_good[0] == pytest.approx(made_good[1], rel=1e-3)
    apart = np.hypot(*(6.37e6 * (column(fine, n) - column(coarse, n)) for n in ("latitude", "longitude")))
    assert apart.max() < 1e-3 * coarse.distance_through_water
