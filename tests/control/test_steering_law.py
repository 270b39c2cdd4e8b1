"""Oracles of the steering law: the damped oscillator in closed form, and what full steering can hold."""

import math

import numpy as np
import pytest

from stommel.control.laws import ENDABLE, HeadingLaw, steering_command, steering_gains
from stommel.geometry.attitude import wrapped

FREE = HeadingLaw(response=30.0, dead_band=0.0, limit=10.0)
"""No dead band and no limit that matters."""


def turned(law: HeadingLaw, pole: float, drive: float, goal: float, seconds: float, step: float = 0.05) -> np.ndarray:
    """Heading over time of r' = pole r + drive delta under the law, by the midpoint rule; delta as commanded."""
    psi = rate = command = 0.0
    found = []
    for _ in range(round(seconds / step)):
        command = steering_command(law, command, wrapped(goal - psi), rate, pole, drive, 1.0)
        delta = min(law.limit, max(-law.limit, command))
        middle = rate + 0.5 * step * (pole * rate + drive * delta)
        psi += step * middle
        rate += step * (pole * middle + drive * delta)
        found.append(psi)
    return np.array(found)


@pytest.mark.parametrize(("pole", "drive"), [(-0.02, 0.005), (-0.06, -0.003), (0.0, 0.01), (-0.0666, 0.01)])
def test_answer_is_that_of_a_critically_damped_oscillator(pole: float, drive: float) -> None:
    """K and D make s^2 + 2 w s + w^2 of a flight with less damping of its own, w = 1 / response."""
    w = 1.0 / FREE.response
    stiffness, damping = steering_gains(FREE.response, pole)
    assert damping - pole == pytest.approx(2.0 * w, rel=1e-12)
    assert stiffness == pytest.approx(w * w, rel=1e-12)
    goal, t = 0.5, np.arange(1, 6001) * 0.05
    expected = goal * (1.0 - (1.0 + w * t) * np.exp(-w * t))
    assert np.abs(turned(FREE, pole, drive, goal, 300.0) - expected).max() < 0.01 * goal


def test_well_damped_flight_gets_no_more_damping() -> None:
    """s^2 - pole s + K = 0 has two real roots where the flight itself damps."""
    stiffness, damping = steering_gains(30.0, -0.4)
    assert damping == 0.0
    assert 0.4**2 - 4.0 * stiffness > 0.0


def test_a_spiral_is_turned_no_faster_than_it_can_be_ended() -> None:
    """Pole and drive of the zju glider at 50 deg; full steering holds drive limit / pole, and the turn stays below."""
    pole, drive, limit = 0.12, 0.013, math.radians(10.0)
    law = HeadingLaw(30.0, 0.0, limit)
    heading = turned(law, pole, drive, math.radians(170.0), 1800.0)
    rates = np.abs(np.diff(heading)) / 0.05
    assert rates.max() == pytest.approx(ENDABLE * drive * limit / pole, rel=0.01)
    assert heading[-1] == pytest.approx(math.radians(170.0), abs=math.radians(0.5))
    assert heading.max() < math.radians(175.0)


def test_a_vehicle_without_way_is_not_asked_to_turn() -> None:
    law = HeadingLaw(30.0, 0.0, 0.2)
    assert steering_command(law, 0.0, 1.0, 0.0, 0.1, 0.01, 0.0) == pytest.approx(0.0)
    slow, fast = (steering_command(law, 0.0, 1.0, 0.0, 0.1, 0.01, way) for way in (0.5, 1.0))
    assert slow == pytest.approx(0.25 * fast)


def test_dead_band_keeps_the_command() -> None:
    law = HeadingLaw(30.0, math.radians(1.0), 1.0)
    before = 0.1
    exact = steering_command(law, 99.0, 0.05, 0.0, -0.1, 0.01, 1.0)
    assert steering_command(law, exact + math.radians(0.9), 0.05, 0.0, -0.1, 0.01, 1.0) != exact
    assert steering_command(law, exact + math.radians(1.1), 0.05, 0.0, -0.1, 0.01, 1.0) == exact
    assert steering_command(law, before, 0.0, 0.0, -0.1, 0.0, 1.0) in (before, 1.0, -1.0)


def test_no_drive_gives_the_limit_not_an_infinity() -> None:
    law = HeadingLaw(30.0, 0.0, 0.3)
    for drive in (0.0, 1e-300, -1e-300):
        assert abs(steering_command(law, 0.0, 0.5, 0.0, -0.1, drive, 1.0)) == pytest.approx(0.3)


@pytest.mark.parametrize("turns", [-2, -1, 0, 1, 3])
@pytest.mark.parametrize("angle", [-3.0, 0.0, 1.0, math.pi])
def test_wrapped(angle: float, turns: int) -> None:
    assert wrapped(angle + 2.0 * math.pi * turns) == pytest.approx(angle, abs=1e-12) or angle == math.pi
    assert -math.pi - 1e-12 < wrapped(angle + 2.0 * math.pi * turns) <= math.pi
