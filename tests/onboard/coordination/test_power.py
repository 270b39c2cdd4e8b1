"""When the controller decides and what wakes it; the battery's account. Oracle: by hand."""

from math import inf

import numpy as np
import pytest

from stommel.control.dive_cycle import ASCENT, DESCENT, DRIFT, PHASES, SURFACE
from stommel.control.flight_table import FlightTable
from stommel.control.orders import Alarms, Laws, Orders
from stommel.messages.codec import Decoder, Encoder, Received
from stommel.messages.frames import Frame
from stommel.onboard.coordination.power import (
    BatteryAccount,
    PowerSchedule,
    Sleeper,
    orders_for,
    wakes,
)

SCHEDULE = PowerSchedule(decide=tuple({DRIFT: 30.0, DESCENT: 5.0}.get(phase, 1.0) for phase in range(len(PHASES))))


def decided(sleeper: Sleeper, phase: int, seconds: int, begin: int = 0) -> list[int]:
    return [t for t in range(begin, begin + seconds) if sleeper.due(float(t), phase)]


def test_it_decides_as_often_as_the_phase_asks() -> None:
    sleeper = Sleeper(SCHEDULE)
    assert decided(sleeper, SURFACE, 4) == [0, 1, 2, 3]
    assert sleeper.elapsed == 1.0
    assert decided(sleeper, DESCENT, 12, 4) == [8, 13]
    assert sleeper.elapsed == 5.0
    assert decided(sleeper, DRIFT, 70, 16) == [43, 73]
    assert sleeper.sleeps_until(DRIFT) == 103.0
    assert decided(sleeper, ASCENT, 3, 86) == [86, 87, 88]
    assert sleeper.woken == 0


def test_danger_wakes_it_once() -> None:
    sleeper = Sleeper(SCHEDULE)
    assert decided(sleeper, DRIFT, 10) == [0]
    sleeper.hear(False)
    assert not sleeper.due(10.0, DRIFT)
    sleeper.hear(True)
    sleeper.hear(False)
    assert sleeper.due(11.0, DRIFT)
    assert (sleeper.elapsed, sleeper.woken) == (11.0, 1)
    assert decided(sleeper, DRIFT, 40, 12) == [41]


def test_it_does_not_sleep_while_it_brings_the_vehicle_up_nor_after_a_jump_of_the_clock() -> None:
    sleeper = Sleeper(SCHEDULE)
    assert [sleeper.due(float(t), DRIFT, abort=True) for t in range(4)] == [True] * 4
    assert sleeper.due(-5000.0, DRIFT)
    assert sleeper.elapsed == 30.0  # no time that went backwards


def frames() -> list[tuple[str, Frame, bool]]:
    encoder = Encoder()
    hull = {
        "internal_pressure": 7e4, "temperature": 15.0, "leak_proven": 1, "vacuum_proven": 1, "pressure_measured": 1,
        "leak_measured": 1,
    }  # fmt: skip
    return [
        ("abort", encoder.frame("Abort", reason=1, drop_weight=0), True),
        ("emergency", encoder.frame("MotionEmergency", code=1, active=1, detail=0), True),
        ("emergency", encoder.frame("AcquisitionEmergency", code=12, active=1, detail=0), True),
        ("dry", encoder.frame("Hull", leak_fore=0, leak_aft=0, **hull), False),
        ("leak", encoder.frame("Hull", leak_fore=1, leak_aft=0, **hull), True),
        ("leak", encoder.frame("Hull", leak_fore=0, leak_aft=1, **hull), True),
        ("sync", encoder.frame("Sync", vehicle_time=1.0), False),
    ]


def test_frames_that_wake() -> None:
    decoder = Decoder()
    for word, frame, expected in frames():
        received = decoder.take(frame)
        assert isinstance(received, Received), word
        assert wakes(received) is expected, word


def test_orders_count_by_their_step() -> None:
    nothing = np.zeros(0)
    orders = Orders(
        step=1.0, guidance_every=10, dives=None, laws=Laws(None, None, None), table=FlightTable(*[nothing] * 8),  # type: ignore[arg-type]
        waypoints=nothing, radius=1.0, lookahead=1.0, alarms=Alarms(1.0, True, inf), sampled=nothing,
    )  # fmt: skip
    assert orders_for(orders, 1.0) is orders
    slower = orders_for(orders, 4.0)
    assert (slower.step, slower.guidance_every) == (4.0, 2)
    assert orders_for(orders, 30.0).guidance_every == 1
    assert slower._replace(step=1.0, guidance_every=10) == orders


def test_account_of_the_battery() -> None:
    """A constant 2 W out of 1 kWh, of which 0.4 were taken before: 0.6 kWh less what was taken last 300 h less that."""
    account = BatteryAccount(3.6e6, used=0.4 * 3.6e6)
    assert account.update(0.0, 0.0).hours_left == inf
    for t in range(60, 36060, 60):
        told = account.update(float(t), 2.0 * t)
    assert told.power == pytest.approx(2.0, rel=1e-9)
    assert told.used == pytest.approx(0.4 * 3.6e6 + 72_000)
    assert told.hours_left == pytest.approx(300.0 - 10.0, rel=1e-6)
    assert account.update(36000.0, 72_000.0).hours_left == told.hours_left  # a clock that stands still


def test_mean_power_follows_the_dive() -> None:
    account = BatteryAccount(1e9, mean_over=1000.0)
    energy = 0.0
    for t in range(20000):
        energy += 1.0 if t < 10000 else 5.0
        told = account.update(float(t), energy)
    assert told.power == pytest.approx(5.0, abs=0.01)
    assert BatteryAccount(10.0).update(0.0, 50.0).left == 0.0
