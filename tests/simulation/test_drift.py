"""Hanging in the water at depth: held within a few metres, and the current found by drifting with it."""

import numpy as np
import pytest

from stommel.simulation.flight import Flown
from tests.simulation.conftest import QUIET, Document, column, flown, stays, surfaced

OCEANS: list[Document] = [
    {"name": "south_china_sea"},
    {"name": "still"},
    {"name": "two_layer"},
]


def drifting(depth: float = 100.0, **changes: object) -> Flown:
    dives = {"depth_m": depth, "pitch_deg": 35.0, "speed_m_s": 0.35, "drift_hours": 2.0}
    return flown(**{"dives": dives, "duration_days": 0.15} | changes)


@pytest.mark.parametrize("ocean", OCEANS, ids=lambda ocean: ocean["name"])
@pytest.mark.parametrize("sensors", [QUIET, {}], ids=["quiet", "noisy"])
def test_depth_is_held(ocean: Document, sensors: Document) -> None:
    """In stratified water, and in uniform water, which gives no help but the hull's compressibility against it."""
    found = drifting(ocean=ocean, sensors=sensors)
    begin, end = stays(found, "drift")[0]
    assert end - begin == pytest.approx(7200.0, abs=1.0)
    t, depth = column(found, "time"), column(found, "depth")
    held = depth[(t > begin + 1800.0) & (t < end)]
    assert np.abs(held - 100.0).max() < 5.0
    assert np.abs(depth[(t > begin) & (t < end)] - 100.0).max() < 15.0
    pitch = np.degrees(column(found, "pitch")[(t > begin + 1800.0) & (t < end)])
    assert np.abs(pitch).max() < 12.0


def test_drifting_takes_less_than_flying() -> None:
    drift, fly = (drifting(dives={"depth_m": 100.0, "pitch_deg": 35.0, "speed_m_s": 0.35, "drift_hours": hours})
                  for hours in (2.0, 0.0))  # fmt: skip
    moved = [sum(float(column(f, f"energy_{name}")[-1]) for name in ("pump", "pitch_drive", "steering"))
             for f in (drift, fly)]  # fmt: skip
    assert moved[0] < 0.6 * moved[1]


def test_current_is_found_by_drifting() -> None:
    """Within 2 cm/s: level, the vehicle still glides forward by seven times the few mm/s at which it sinks or rises
    within the dead band, and no sensor tells.
    """
    ocean = {"name": "uniform", "parameters": {"current_east_m_s": 0.12, "current_north_m_s": 0.05}}
    found = drifting(ocean=ocean, sensors=QUIET, duration_days=0.3)
    assert len(found.surfacings) >= 2
    miss = np.hypot(surfaced(found, "current_north") - 0.05, surfaced(found, "current_east") - 0.12)
    assert miss.max() < 0.02
