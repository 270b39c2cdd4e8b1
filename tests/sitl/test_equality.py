"""The loop and the fast simulator fly the same mission. Oracle: the fast simulator, which knows no frame and no byte.

Sensors are without errors. The vehicle in the loop checks itself first and dives some 50 s later, so that only dives
are compared, and places from where the first one began. In the pool the fast simulator dives while the vehicle
still swings from being put into the water; there the first dive is left out.
"""

import pytest

from stommel.simulation.flight import fly_mission
from stommel.sitl.flight import fly
from stommel.sitl.system import System
from tests.sitl.comparison import apart, mission_of


@pytest.mark.parametrize(
    ("name", "seconds", "first", "dives"),
    [("kuroshio", 5200, 0, 4), ("still_20_days", 3700, 0, 3), ("pool_trial", 900, 1, 3)],
)
def test_the_same_dives(name: str, seconds: float, first: int, dives: int) -> None:
    mission = mission_of(name, seconds)
    found = apart(fly_mission(mission), fly(System(mission)), first)
    assert min(found.dives) == dives
    assert found.period < 0.01
    assert found.depth < 1.0
    assert found.place < 0.01
