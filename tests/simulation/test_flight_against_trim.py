"""Oracle: the trim solver. A simulated glide in still uniform water settles at its speed and pitch to 1e-4."""

from math import radians

import numpy as np
import pytest

from stommel.analysis.trim import steady_flight
from stommel.control.dive_cycle import ASCENT, DESCENT
from stommel.simulation.flight import Flown
from stommel.vehicle import PAPER
from tests.simulation.conftest import QUIET, flown

SPEED, PITCH = 0.4, 35.0


@pytest.fixture(scope="module")
def still() -> Flown:
    """Deep dives of the paper's model in its water of constant density; no noise, no corrections, no steering."""
    return flown(
        physics="paper",
        duration_days=0.05,
        dives={"depth_m": 190.0, "pitch_deg": PITCH, "speed_m_s": SPEED},
        heading_deg=45.0,
        sensors=QUIET,
        pitch_control={"gain_mm_per_deg": 0.0, "tolerance_mm": 1e-6},
        heading_control={"limit_deg": 0.0},
        ocean={"name": "still", "parameters": {"density_kg_m3": 1000.0}},
    )


@pytest.mark.parametrize(("phase", "pitch_deg"), [(DESCENT, -PITCH), (ASCENT, PITCH)])
def test_steady_glide_meets_the_trim(still: Flown, phase: int, pitch_deg: float) -> None:
    column = still.record
    rows = np.flatnonzero(column["phase"] == phase)
    ends = np.flatnonzero(np.diff(rows) > 1)
    last = rows[ends[0]] - 1
    trimmed = steady_flight(
        still.mission.vehicle,
        moving_mass_mm=1e3 * float(column["moving_mass"][last]),
        ballast_ml=1e6 * float(column["ballast"][last]),
        physics=PAPER,
        within_limits=False,
    )
    speed = np.sqrt(sum(column[name][last] ** 2 for name in "uvw"))
    assert speed == pytest.approx(trimmed.V, rel=1e-4)
    assert column["pitch"][last] == pytest.approx(trimmed.theta, rel=1e-4)
    # and it is the flight that the mission asked for
    assert speed == pytest.approx(SPEED, rel=2e-3)
    assert column["pitch"][last] == pytest.approx(radians(pitch_deg), rel=2e-3)
