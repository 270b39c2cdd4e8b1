"""Which flights are within limits, and the ballast of a least speed; oracles: the file's limits, V2 over the drive."""

import numpy as np
import pytest

from stommel.analysis.limits import reachable
from stommel.analysis.steady_equations import ALPHA, CONVERGED, QUANTITIES, R_PX, V_B
from stommel.analysis.stratified import WantedDive, ballast_for, drives_at
from stommel.vehicle import FULL, Vehicle


@pytest.mark.parametrize(
    ("quantity", "inside", "outside"),
    [
        (R_PX, (-0.05, 0.25, 0.55), (-0.051, 0.551)),
        (V_B, (-250e-6, 1e-6, 250e-6), (-251e-6, 251e-6)),
        (ALPHA, (-0.1, 0.1), (-1.0, 1.0)),
    ],
)
def test_flights_beyond_either_limit_are_out_of_reach(
    zju: Vehicle, quantity: int, inside: tuple[float, ...], outside: tuple[float, ...]
) -> None:
    values = np.array([*inside, *outside])
    flights = np.zeros((len(values), QUANTITIES))
    flights[:, R_PX] = 0.25
    flights[:, quantity] = values
    codes = np.full(len(values), CONVERGED)
    expected = [True] * len(inside) + [False] * len(outside)
    assert reachable(zju, flights, codes).tolist() == expected
    assert not reachable(zju, flights, codes + 1).any()


@pytest.mark.parametrize("least", [0.2, 0.3])
def test_nowhere_slower_than_the_least_speed(zju: Vehicle, least: float) -> None:
    """Water that takes 200 ml: where it drives least, the speed is the least, by V2 in proportion to the drive."""
    speed, neutral = 0.35, np.linspace(100e-6, -100e-6, 41)
    drives = drives_at(zju, FULL, 35.0, speed)
    found = ballast_for(zju, FULL, neutral, WantedDive(35.0, speed, least))
    for left, drive in ((-100e-6 - found.down, drives[0]), (found.up - 100e-6, drives[1])):
        assert speed * np.sqrt(left / drive) == pytest.approx(least)
    assert min(found.speed_down, found.speed_up) >= speed - 1e-9
