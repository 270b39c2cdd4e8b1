"""Pace by a clock of the test: how long is waited, and what is lost when the loop is too slow."""

import pytest

from stommel.sitl.real_time import PATIENCE, Pace


class Clock:
    """A clock that only passes when somebody sleeps or works."""

    def __init__(self) -> None:
        self.now = 1000.0
        self.slept = 0.0

    def __call__(self) -> float:
        return self.now

    def sleep(self, seconds: float) -> None:
        assert seconds > 0.0
        self.now += seconds
        self.slept += seconds


@pytest.mark.parametrize("speed", [1.0, 20.0])
def test_the_mission_passes_at_its_speed(speed: float) -> None:
    clock = Clock()
    pace = Pace(speed, clock, clock.sleep)
    for second in range(101):
        pace.wait(float(second))
        clock.now += 0.3 / speed  # work
    assert clock.now - 1000.0 == pytest.approx(100.3 / speed, abs=1e-9)
    assert pace.lost == 0.0


def test_a_short_delay_is_made_up_for() -> None:
    clock = Clock()
    pace = Pace(1.0, clock, clock.sleep)
    for second in range(11):
        pace.wait(float(second))
        clock.now += 1.9 if second == 3 else 0.1
    assert clock.now - 1000.0 == pytest.approx(10.1, abs=1e-9)
    assert pace.lost == 0.0


def test_a_slow_machine_falls_behind_and_tells_by_how_much() -> None:
    clock = Clock()
    pace = Pace(20.0, clock, clock.sleep)
    for second in range(1001):
        pace.wait(float(second))
        clock.now += 0.08  # a step may take 0.05
    wanted, took = 1000 / 20.0, clock.now - 0.08 - 1000.0
    assert took == pytest.approx(80.0, abs=1e-6)
    assert took - wanted - PATIENCE - 0.08 <= pace.lost <= took - wanted
    assert clock.slept == 0.0


def test_a_hanging_loop_does_not_race_afterwards() -> None:
    clock = Clock()
    pace = Pace(1.0, clock, clock.sleep)
    pace.wait(0.0)
    clock.now += 60.0
    pace.wait(1.0)
    before = clock.now
    for second in range(2, 12):
        pace.wait(float(second))
    assert clock.now - before == pytest.approx(10.0)
    assert pace.lost == pytest.approx(59.0)
