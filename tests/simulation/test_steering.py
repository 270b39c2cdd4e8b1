"""A commanded turn is reached and held, on the dive and on the climb, by rudder and by rolling mass."""

from pathlib import Path

import numpy as np
import pytest

import stommel.vehicle
from stommel.errors import StommelError
from stommel.simulation.flight import Flown, fly_mission
from stommel.simulation.scenario.loading import mission_from
from tests.simulation.conftest import QUIET, Document, column, made, mission_document, stays

SEAWING = Path(stommel.vehicle.__file__).parent / "builtin" / "seawing.toml"


def turning(goal_deg: float, **changes: object) -> Document:
    """Starts to the north and is sent `goal_deg` to the east of it, far away in still water."""
    far = {"latitude_deg": 18.0 + 2.0 * np.cos(np.radians(goal_deg)), "longitude_deg": 116.0}
    far["longitude_deg"] += 2.0 * np.sin(np.radians(goal_deg)) / np.cos(np.radians(18.0))
    still: Document = {"ocean": {"name": "still"}, "duration_days": 0.04, "output_every_s": 1.0, "sensors": QUIET}
    return mission_document(**still | {"waypoints": [far]} | changes)


def error_deg(found: Flown) -> np.ndarray:
    """Heading less the bearing of the waypoint on the sphere, hardly changed by the way flown [deg]."""
    place = found.mission.scenario.waypoints[0]
    a, b = np.radians(18.0), np.radians(place.latitude_deg)
    turn = np.radians(place.longitude_deg - 116.0)
    bearing = np.arctan2(np.sin(turn) * np.cos(b), np.cos(a) * np.sin(b) - np.sin(a) * np.cos(b) * np.cos(turn))
    return np.asarray(np.degrees(np.angle(np.exp(1j * (column(found, "heading") - bearing)))))


def worst(found: Flown, phase: str, after: float) -> float:
    """Greatest error [deg] from so long after the first such phase began until it ends."""
    begin, end = stays(found, phase)[0]
    t = column(found, "time")
    return float(np.abs(error_deg(found)[(t >= begin + after) & (t < end)]).max())


@pytest.mark.parametrize(
    ("pitch", "speed", "after"),
    [(25.0, 0.35, 700.0), (35.0, 0.35, 400.0), (45.0, 0.35, 500.0), (45.0, 0.5, 400.0), (50.0, 0.35, 500.0)],
)
@pytest.mark.parametrize("goal", [90.0, -90.0])
def test_turn_is_reached_and_held_where_the_spiral_is_stable_and_where_not(
    pitch: float, speed: float, after: float, goal: float
) -> None:
    """At 45 deg and more the spiral is unstable: told to turn as fast as it can, the vehicle would not stop.

    The vehicle takes five minutes to gather way; 25 deg turns by the rudder alone, slowly. Held means: within what the
    dead band of 1 deg of rudder leaves.
    """
    found = fly_mission(made(turning(goal, dives={"depth_m": 180.0, "pitch_deg": pitch, "speed_m_s": speed})))
    assert worst(found, "descent", after) < 6.0
    assert worst(found, "ascent", 120.0) < 6.0
    turns = np.ptp(np.unwrap(column(found, "heading")))
    assert np.degrees(turns) < 90.0 + 25.0
    spent = sum(float(column(found, f"energy_{name}")[-1]) for name in ("pump", "pitch_drive"))
    assert 0.0 < column(found, "energy_steering")[-1] < 0.05 * spent


@pytest.mark.parametrize("pitch", [35.0, 45.0])
def test_noise_of_the_compass_does_not_wear_the_rudder(pitch: float) -> None:
    """With the noise of section 5.2's compass: still held, and the steering takes less than 5 % of all energy."""
    dives = {"depth_m": 180.0, "pitch_deg": pitch, "speed_m_s": 0.35}
    found = fly_mission(made(turning(90.0, dives=dives, sensors={})))
    assert worst(found, "ascent", 120.0) < 8.0
    whole = float(found.record["energy"][-1].sum())
    assert column(found, "energy_steering")[-1] < 0.05 * whole


def test_pitch_beyond_the_travel_of_the_mass_is_refused() -> None:
    """The zju glider's mass takes it to 52 deg, not to 55."""
    dives = {"depth_m": 180.0, "pitch_deg": 55.0, "speed_m_s": 0.35}
    with pytest.raises(StommelError, match="not reachable: needs the moving mass at"):
        fly_mission(made(turning(90.0, dives=dives)))


@pytest.mark.parametrize("pitch", [25.0, 35.0])
def test_rolling_mass_turns_and_holds(pitch: float, tmp_path: Path) -> None:
    """Sea-Wing, with a pump of 5 ml/s that its sources do not give, by its rolling battery."""
    table = "[actuators.buoyancy]\n"
    path = tmp_path / "seawing_with_pump.toml"
    path.write_text(SEAWING.read_text(encoding="utf-8").replace(table, f"{table}flow_ml_s = 5\n"), encoding="utf-8")
    dives = {"depth_m": 150.0, "pitch_deg": pitch, "speed_m_s": 0.4}
    document = turning(60.0, vehicle=path.name, dives=dives, heading_control={"limit_deg": 45.0}, duration_days=0.035)
    found = fly_mission(mission_from(document, "test.toml", tmp_path))
    assert worst(found, "descent", 400.0) < 3.0
    assert worst(found, "ascent", 200.0) < 3.0
    assert np.ptp(column(found, "roll_mass")) > np.radians(20.0)
    assert not column(found, "rudder").any()
    descent = stays(found, "descent")[0]
    settled = (column(found, "time") > descent[0] + 200.0) & (column(found, "time") < descent[1])
    assert np.degrees(column(found, "pitch")[settled]) == pytest.approx(-pitch, abs=4.0)
