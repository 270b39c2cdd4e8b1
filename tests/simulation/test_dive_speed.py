"""Oracle: what the keys of [dives] say. A speed is the mean along the path; a depth is the greatest."""

import numpy as np
import pytest

from stommel.analysis.stratified import mean_speed
from stommel.errors import StommelError
from stommel.planning.ballasting import ballast_volumes, neutral_ballast
from stommel.simulation.results.speed import flown_speed
from stommel.simulation.results.summary import summary
from stommel.simulation.scenario.remarks import remarks
from tests.simulation.conftest import column, flown, made, mission_document, stays

STILL = {"name": "still"}


@pytest.mark.parametrize(("ocean", "speed"), [("still", 0.3), ("still", 0.4), ("still", 0.5), ("south_china_sea", 0.5)])
def test_the_speed_of_dives_is_the_mean_along_the_path(ocean: str, speed: float) -> None:
    """Way over time while no oil flows; getting under way from the surface costs some per cent of it."""
    found = flown(
        ocean={"name": ocean}, dives={"depth_m": 190.0, "pitch_deg": 35.0, "speed_m_s": speed}, duration_days=0.4
    )
    assert flown_speed(found.record) == pytest.approx(speed, rel=0.06)
    assert summary(found)["flown_speed_m_s"] == flown_speed(found.record)
    assert not [one for one in remarks(found.mission) if one.name == "faster_than_asked"]


def test_water_that_would_stop_slow_dives_makes_them_faster_and_says_so() -> None:
    mission = made(mission_document(dives={"depth_m": 190.0, "pitch_deg": 35.0, "speed_m_s": 0.3}))
    told = [one for one in remarks(mission) if one.name == "faster_than_asked"]
    assert len(told) == 2
    assert "dives.speed_m_s = 0.3: the descent is 0.3" in told[0].message


def test_a_lower_least_speed_lets_them_be_slow() -> None:
    def speeds(**dives: float) -> tuple[float, float]:
        mission = made(mission_document(dives={"depth_m": 190.0, "pitch_deg": 35.0} | dives))
        found = ballast_volumes(mission.deployment, neutral_ballast(mission.deployment))
        return found.speed_down, found.speed_up

    usual, patient = speeds(speed_m_s=0.35), speeds(speed_m_s=0.35, least_speed_m_s=0.05)
    assert min(usual) > 0.36
    assert patient == pytest.approx((0.35, 0.35), rel=1e-6) or max(patient) < min(usual)


def test_a_least_speed_alone_is_kept_everywhere() -> None:
    dives = {"depth_m": 100.0, "pitch_deg": 35.0, "least_speed_m_s": 0.35}
    found = flown(dives=dives, duration_days=0.15)
    begin, end = stays(found, "descent")[1]
    t = column(found, "time")
    settled = (t > begin + 150.0) & (t < end - 20.0)
    speed = np.sqrt(sum(column(found, name) ** 2 for name in "uvw"))
    assert speed[settled].min() > 0.345


def test_mean_of_a_drive_that_grows_evenly_with_depth_is_the_closed_form() -> None:
    """v = k sqrt(a + b s) over s = 0..1: the mean by time is k b / (2 (sqrt(a + b) - sqrt(a)))."""
    a, b, k = 10e-6, 120e-6, 0.4 / np.sqrt(55e-6)
    spare = np.linspace(0.0, b, 4001)
    exact = k * b / (2.0 * (np.sqrt(a + b) - np.sqrt(a)))
    assert mean_speed(spare, a, 55e-6, 0.4) == pytest.approx(exact, rel=1e-5)


@pytest.mark.parametrize("speed", [0.3, 0.5])
@pytest.mark.parametrize("depth", [12.0, 60.0, 195.0])
@pytest.mark.parametrize("ocean", ["still", "south_china_sea"])
def test_no_dive_is_deeper_than_its_depth(ocean: str, depth: float, speed: float) -> None:
    dives = {"depth_m": depth, "pitch_deg": 35.0, "speed_m_s": speed}
    found = flown(ocean={"name": ocean}, dives=dives, duration_days=0.12)
    deepest = column(found, "depth").max()
    assert deepest <= depth + 0.02 * depth
    assert deepest > 0.75 * depth


def test_a_speed_and_a_greater_least_speed_are_refused() -> None:
    with pytest.raises(StommelError, match=r"dives.least_speed_m_s = 0.4: must be at most dives.speed_m_s = 0.3"):
        made(mission_document(dives={"depth_m": 100.0, "pitch_deg": 35.0, "speed_m_s": 0.3, "least_speed_m_s": 0.4}))


def test_the_stroke_of_the_engine_bounds_the_ballast_of_a_mission() -> None:
    """A working range of 152.8 mm at a bore of 50 mm moves 300 ml, whatever the stated volume."""
    changes = {"engine.reservoirs.0.working_range_mm.0": 73.6, "engine.reservoirs.0.working_range_mm.1": 226.4}
    found = flown(changes=changes, dives={"depth_m": 60.0, "pitch_deg": 35.0, "speed_m_s": 0.35}, duration_days=0.1)
    swing = np.ptp(column(found, "ballast")) * 1e6
    assert swing <= 300.1
    assert column(found, "ballast").max() * 1e6 == pytest.approx(150.0, abs=0.1)
