"""What the radio costs the loop, counted in looks, and that sparing them changes nothing that is heard."""

from math import inf, nan

import pytest

from stommel.link.channel.settings import ChannelSettings
from stommel.simulation.scenario.mission import Mission
from stommel.sitl.faults.fault import Fault
from stommel.sitl.faults.injector import Injector
from stommel.sitl.radio.air import LOOKS
from stommel.sitl.system import System

DEAD = Fault("radio_dead", "", 0.0, inf, nan)


class Counted:
    """An end that counts how often it is asked, and says so much in each step."""

    def __init__(self, says: bytes = b"") -> None:
        self.asked = 0
        self.heard = b""
        self.times: list[float] = []
        """At which something was heard."""
        self._says, self._said = says, -1.0

    def take(self, data: bytes, t: float) -> None:
        self.heard += data
        if data:
            self.times.append(t)

    def poll(self, t: float, room: int) -> bytes:
        self.asked += 1
        if int(t) == self._said:
            return b""
        self._said = int(t)
        return self._says


def flown(
    trial: Mission, ashore: Counted | None, steps: int = 60, radio: ChannelSettings | None = None
) -> tuple[System, int]:
    """A system at the surface, and how often its vehicle was asked."""
    system = System(trial, shore=ashore, radio=radio)
    asked = 0
    poll = system.link.poll

    def counted(t: float, room: int) -> bytes:
        nonlocal asked
        asked += 1
        return poll(t, room)

    system.link.poll = counted  # type: ignore[method-assign]
    for _ in range(steps):
        system.step()
    return system, asked


def test_with_nobody_ashore_a_step_costs_one_look(trial: Mission) -> None:
    system, asked = flown(trial, None)
    assert 0 < asked <= 60
    assert system.air.channel.vehicle.counts.sent_bytes > 1000, "it calls all the same"


def test_a_step_in_which_nobody_speaks_on_is_soon_over(trial: Mission) -> None:
    ashore = Counted()
    _, asked = flown(trial, ashore)
    assert 0 < asked < 60 * LOOKS / 2


def test_what_is_said_in_a_step_is_heard_in_it(trial: Mission) -> None:
    ashore = Counted(bytes(50))
    system, _ = flown(trial, ashore)
    counts = system.air.channel.vehicle.counts
    assert len(ashore.heard) == counts.arrived_bytes
    assert counts.arrived_bytes + 172 * counts.lost >= counts.sent_bytes - 172
    assert system.air.channel.next_event() == float("inf"), "bytes are left behind on their way"


def test_a_step_is_not_over_while_something_is_on_its_way(trial: Mission) -> None:
    """What the vehicle says at the beginning of a step is there half a second later, not with the next step."""
    ashore = Counted()
    flown(trial, ashore, radio=ChannelSettings(latency=0.5))
    assert len(ashore.times) > 20
    assert all(0.45 < t % 1.0 < 0.95 for t in ashore.times)


def test_under_water_nobody_is_asked(trial: Mission) -> None:
    ashore = Counted()
    system, _ = flown(trial, ashore, 1)
    while system.plant.depth < 2.0:
        assert system.plant.time < 900.0
        system.step()
    assert not system.switched.radio
    system.link.poll = lambda *_: pytest.fail("the vehicle speaks under water")  # type: ignore[method-assign]
    before = ashore.asked
    for _ in range(20):
        system.step()
    assert ashore.asked == before + 20


def test_on_a_cable_the_vehicle_is_heard_under_water(trial: Mission) -> None:
    """Oracle: the depth of the plant; without the cable the same second is silent (the test above)."""
    ashore = Counted()
    system, _ = flown(trial, ashore, 1, radio=ChannelSettings(tethered=True))
    while system.plant.depth < 2.0:
        assert system.plant.time < 900.0
        system.step()
    assert not system.switched.radio, "its own software has switched it off"
    before, t = len(ashore.heard), system.plant.time
    for _ in range(20):
        system.step()
    assert len(ashore.heard) > before + 20
    assert {int(at) for at in ashore.times} >= set(range(int(t) + 1, int(t) + 20))


def test_a_dead_radio_is_silent_on_a_cable_too(trial: Mission) -> None:
    ashore = Counted()
    system = System(trial, shore=ashore, radio=ChannelSettings(tethered=True), inject=Injector([DEAD], 0))
    for _ in range(60):
        system.step()
    assert not ashore.heard
