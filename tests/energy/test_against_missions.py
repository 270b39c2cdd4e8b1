"""Oracle: missions. What `endurance` says of a dive is what the simulator spends on it, in three oceans.

The balance has neither dynamics nor control; the mission has nothing of the balance but the prices of oil and of moving
the mass. Dives of 100 m and more; the shorter the dive, the more of it is turning, which the balance only estimates.
"""

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from stommel.design.endurance import Endurance, endurance
from stommel.design.endurance.sea import Sea
from stommel.simulation.flight import Flown, fly_mission
from stommel.simulation.scenario.loading import mission_from
from stommel.vehicle import PHYSICS

OCEANS: dict[str, tuple[float, float, dict[str, Any]]] = {
    "south_china_sea": (18.0, 116.0, {}),
    "east_china_sea": (26.2, 126.6, {}),
    "pool": (28.0, 126.0, {"parameters": {"bottom_m": 400.0}}),
}


def both(name: str, **dives: float) -> tuple[Flown, Endurance]:
    """A day of dives, and the endurance of the same dives."""
    latitude, longitude, parameters = OCEANS[name]
    document = {
        "name": "the same dives",
        "vehicle": "zju",
        "start_time": "2026-07-01T00:00:00Z",
        "duration_days": 1.0,
        "start": {"latitude_deg": latitude, "longitude_deg": longitude},
        "waypoints": [{"latitude_deg": latitude + 0.9, "longitude_deg": longitude}],
        "dives": {"pitch_deg": 35.0} | dives,
        "surface": {"session_s": 180.0},
        "ocean": {"name": name} | parameters,
    }
    mission = mission_from(document, "test.toml", Path())
    flown = fly_mission(mission)
    found = endurance(
        mission.vehicle,
        speed_m_s=dives["speed_m_s"],
        pitch_deg=-35.0,
        depth_m=dives["depth_m"],
        sea=Sea(mission.ocean, mission.scenario.start_seconds, latitude, longitude),
        physics=PHYSICS[mission.scenario.physics],
    )
    return flown, found


@pytest.mark.parametrize("name", OCEANS)
@pytest.mark.parametrize(("speed", "depth"), [(0.4, 190.0), (0.5, 190.0)])
def test_endurance_is_what_a_mission_gives(name: str, speed: float, depth: float) -> None:
    flown, found = both(name, speed_m_s=speed, depth_m=depth)
    spent, time = flown.record["energy"][-1].sum(), flown.record["time"][-1]
    power = spent / time + flown.plant.battery.self_discharge
    days = flown.plant.battery.energy / power / 86400.0
    assert found.days == pytest.approx(days, rel=0.02)


@pytest.mark.parametrize("name", ["south_china_sea", "east_china_sea"])
def test_a_battery_is_as_warm_as_the_water_of_its_dives(name: str) -> None:
    """lithium polymer gives 0.95 at 10 deg C, 1 at 25 deg C; the balance and the mission see the same water."""
    flown, found = both(name, speed_m_s=0.5, depth_m=190.0)
    mean = np.interp(np.linspace(0.0, 190.0, 96), *_temperatures(flown)).mean()
    usable = 45 * 24 * 0.9 * np.interp(mean, [-20, 0, 10, 25, 45], [0.7, 0.88, 0.95, 1.0, 1.0])
    assert flown.plant.battery.energy / 3600.0 == pytest.approx(usable, rel=2e-3)
    assert found.stored.usable_j == pytest.approx(flown.plant.battery.energy, rel=1e-12)


def _temperatures(flown: Flown) -> tuple[np.ndarray, np.ndarray]:
    """Depths and temperatures at the start of the mission."""
    scenario, depths = flown.mission.scenario, np.linspace(0.0, 190.0, 20)
    place = scenario.start_seconds, scenario.start.latitude_deg, scenario.start.longitude_deg
    return depths, np.array([flown.mission.ocean.at(*place, float(z)).temperature for z in depths])
