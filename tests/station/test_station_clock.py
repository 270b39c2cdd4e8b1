"""Time of a vehicle's world. Oracle: clocks that the test turns by hand."""

import pytest

from stommel.station.clock import VehicleClock
from tests.onboard.coordination.disk import Disk

NOW = 1_795_000_000.0
SEA = 1_782_864_000.0


class Hands:
    """Clocks of a machine."""

    def __init__(self) -> None:
        self.wall, self.ticks = NOW, 500.0

    def go(self, seconds: float) -> None:
        self.wall += seconds
        self.ticks += seconds

    def clock(self, speed: float = 1.0, *, simulated: bool | None = None) -> VehicleClock:
        return VehicleClock(speed, simulated=simulated, utc=lambda: self.wall, monotonic=lambda: self.ticks)


def test_a_real_vehicle_has_utc_that_goes_on_evenly_whoever_sets_the_clock() -> None:
    hands = Hands()
    clock = hands.clock()
    hands.go(10.0)
    hands.wall -= 86_400.0  # somebody sets the clock of the machine
    assert clock.now() == NOW + 10.0
    assert not clock.hear(SEA, clock.link_now()), "a real vehicle's clock is not believed"
    assert clock.now() == NOW + 10.0


def test_a_simulated_vehicle_sets_the_clock_and_it_goes_as_fast() -> None:
    hands = Hands()
    clock = hands.clock(20.0)
    assert not clock.is_set
    assert clock.hear(SEA, clock.link_now())
    hands.go(3.0)
    assert clock.now() == pytest.approx(SEA + 60.0)


def test_a_simulation_that_lags_is_followed() -> None:
    hands = Hands()
    clock = hands.clock(20.0)
    clock.hear(SEA, clock.link_now())
    for k in range(1, 30):
        hands.go(1.0)
        clock.hear(SEA + 10.0 * k, clock.link_now())  # half as fast as it should be
        assert abs(clock.now() - (SEA + 10.0 * k)) <= 40.0


def test_the_time_of_the_link_goes_on_evenly_over_a_restart_of_the_station() -> None:
    hands, disk = Hands(), Disk()
    clock = hands.clock(20.0)
    clock.hear(SEA, clock.link_now())
    hands.go(100.0)
    clock.keep(disk)
    link, now = clock.link_now(), clock.now()
    hands.go(7.0)
    again = hands.clock(20.0)
    again.restore(disk)
    assert again.link_now() == pytest.approx(link + 140.0)
    assert again.now() == pytest.approx(now + 140.0)


@pytest.mark.parametrize("content", [b"", b"junk", b"\0" * 1000])
def test_a_damaged_clock_is_begun_anew(content: bytes) -> None:
    clock = Hands().clock(20.0)
    clock.restore(Disk({"clock": content}))
    assert not clock.is_set
    assert clock.link_now() == NOW


@pytest.mark.parametrize("utc", [0.0, -5.0, 1e12, float("nan"), float("inf")])
def test_a_time_that_cannot_be_is_not_taken(utc: float) -> None:
    clock = Hands().clock(20.0)
    assert not clock.hear(utc, clock.link_now())
    assert not clock.is_set
