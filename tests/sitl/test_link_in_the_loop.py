"""The radio link in the loop. Oracle: what a shore at the other end of the air hears, and is told of its commands."""

import os
import random
from pathlib import Path

from stommel.link.commands.states import State, When
from stommel.link.shore.shore_end import ShoreEnd, ShoreSettings
from stommel.link.signing.guard import Guard
from stommel.sitl.campaign.flight import FaultFlight
from stommel.sitl.campaign.kit import fly_seed
from stommel.sitl.campaign.run import TRIAL, load_kit, scenario_text
from stommel.sitl.faults.disk import MemoryDisk
from stommel.sitl.scenario import load_scenario
from stommel.sitl.separate_nodes import SeparateNodes
from stommel.sitl.system import System
from tests.sitl.comparison import mission_of

UTC = 1.8e9
"""Of the shore at the beginning of the mission [s]."""


class Shore:
    """A shore station in the loop, by its own clock."""

    def __init__(self) -> None:
        settings = ShoreSettings(1, 115_200.0)
        self.end = ShoreEnd(settings, Guard.unsigned(255), random.Random(1), os.urandom, MemoryDisk(), UTC)

    def take(self, data: bytes, t: float) -> None:
        self.end.take(data, UTC + t)

    def poll(self, t: float, room: int) -> bytes:
        return self.end.poll(UTC + t, room)

    def state(self, id: int, t: float) -> State:
        return self.end.commands.report(id, UTC + t).state


def fly_until(system: System, seconds: float) -> None:
    while system.running and system.plant.time < seconds:
        system.step()


def test_nodes_in_processes_of_their_own_leave_the_link_as_it_is() -> None:
    shore = Shore()
    system = System(mission_of("kuroshio", 900), shore=shore)
    with SeparateNodes(system):
        fly_until(system, 60.0)
        held = shore.end.commands.give("hold", {}, UTC + 60.0, valid_for=300.0)
        fly_until(system, 90.0)
    assert shore.end.heard.last["GLIDER_STATE"].t > UTC + 85.0
    assert shore.state(held, 90.0) is State.DONE


def test_a_command_for_the_next_surfacing_waits_for_the_dive() -> None:
    """The radio is off under water, and yet the dive must be seen: else it would wait for ever."""
    shore = Shore()
    system = System(mission_of("pool_trial", 1000), shore=shore)
    fly_until(system, 20.0)
    held = shore.end.commands.give("hold", {}, UTC + 20.0, valid_for=3600.0, when=When.AT_NEXT_SURFACING)
    fly_until(system, 40.0)
    assert shore.state(held, 40.0) is State.WAITING
    dived = False
    while system.running and shore.state(held, system.plant.time) is State.WAITING:
        dived = dived or system.plant.depth > 1.5
        system.step()
    assert dived
    fly_until(system, system.plant.time + 10.0)
    assert shore.state(held, system.plant.time) is State.DONE
    assert system.plant.depth < 1.0


def test_a_campaign_flies_through_the_air_of_its_scenario(tmp_path: Path) -> None:
    path = tmp_path / "windy.toml"
    text = TRIAL.read_text().replace("duration_days = 0.08333333333333333", "duration_days = 0.001")
    path.write_text(text + "\n[radio]\nloss = 0.4\nlatency_ms = 500\n")
    kit = load_kit(path)
    assert (kit.radio.loss, kit.radio.latency) == (0.4, 0.5)
    assert FaultFlight(kit.mission, (), kit.radio).system.air.channel.settings == kit.radio
    assert fly_seed(kit, 1, (1,))["verdict"] == "passed"
    again = tmp_path / "again.toml"
    again.write_text(scenario_text(kit, 1, ()))
    assert load_scenario(again).radio == kit.radio
