"""Parameters of the nodes in the loop: read by the coordinator, kept by the nodes. Oracle: the nodes' own settings."""

import struct
from dataclasses import replace
from pathlib import Path

import pytest

from stommel.messages.database import ACQUISITION, MOTION
from stommel.messages.parameter_files import ParameterFiles
from stommel.messages.parameters import ParameterServer
from stommel.onboard.coordination.node_mirror import ParameterState
from stommel.onboard.execution.acquisition_node import AcquisitionNode
from stommel.onboard.execution.motion_node import MotionNode
from stommel.onboard.nodes.motion_settings import MotionSettings
from stommel.onboard.nodes.node_settings import parameters_of
from stommel.simulation.scenario.shipped import mission_path
from stommel.sitl import system as loop
from stommel.sitl.faults.fault import Fault
from stommel.sitl.faults.injector import Injector
from stommel.sitl.separate_nodes import SeparateNodes
from stommel.sitl.system import System
from tests.sitl.comparison import mission_of
from tests.support.command import Command

QUIET_AFTER, BLOW_AFTER = 15, 16
READ = 130
"""Seconds within which both nodes are read: five requests a parameter, one a second."""


def stepped(system: System, seconds: int) -> System:
    for _ in range(seconds):
        system.step()
    return system


def values(system: System, node: int) -> dict[str, object]:
    return {p.name: p.value for p in system.coordinator.parameters.of(node)}


def states(system: System, node: int) -> set[ParameterState]:
    return {p.state for p in system.coordinator.parameters.of(node)}


def settings(system: System, node: int) -> dict[str, object]:
    owner = system.motion if node == MOTION else system.acquisition
    assert isinstance(owner, MotionNode | AcquisitionNode)
    return {name: getattr(owner.settings, name) for name in values(system, node)}


@pytest.mark.parametrize("node", [MOTION, ACQUISITION])
def test_the_coordinator_knows_what_the_nodes_have(node: int) -> None:
    system = stepped(System(mission_of("pool_trial", 600)), READ)
    assert states(system, node) == {ParameterState.KNOWN}
    known, set_to = values(system, node), settings(system, node)
    if node == MOTION:
        set_to["oil_crept"] = known["oil_crept"]  # a counter, of when it was read
    assert known == pytest.approx(set_to, rel=1e-6)
    assert system.bus.load(system.plant.time) < 0.02


def test_it_reads_while_it_checks_itself_and_asks_for_nothing_afterwards() -> None:
    system = stepped(System(mission_of("pool_trial", 600)), READ)
    counted = system.coordinator.perception.decoder.received
    before = counted["MotionParameterAnswer"] + counted["AcquisitionParameterAnswer"]
    assert before == 5 * len(values(system, MOTION)) + 5 * len(values(system, ACQUISITION))
    stepped(system, 60)
    assert counted["MotionParameterAnswer"] + counted["AcquisitionParameterAnswer"] == before


def test_what_was_saved_outlives_a_loss_of_power_and_the_rest_does_not() -> None:
    fault = Fault("brown_out", "motion", READ + 10.0, 20.0, 0.5)
    system = stepped(System(mission_of("pool_trial", 700), inject=Injector((fault,))), READ)
    mirror = system.coordinator.parameters
    mirror.write(MOTION, BLOW_AFTER, 90.0)
    mirror.save(MOTION)
    mirror.write(MOTION, QUIET_AFTER, 9.0)
    told = []
    for _ in range(8):
        system.step()
        assert system.coordinator.view is not None
        told += [outcome.result for outcome in system.coordinator.view.parameters]
    assert told == ["Ok", "Ok", "Ok"]
    assert (settings(system, MOTION)["blow_after"], settings(system, MOTION)["quiet_after"]) == (90.0, 9.0)
    stepped(system, 10)
    assert states(system, MOTION) == {ParameterState.SILENT}
    assert states(system, ACQUISITION) == {ParameterState.KNOWN}
    stepped(system, READ + 20)
    assert system.restarts[MOTION] == 1
    assert (settings(system, MOTION)["blow_after"], settings(system, MOTION)["quiet_after"]) == (90.0, 5.0)
    assert (values(system, MOTION)["blow_after"], values(system, MOTION)["quiet_after"]) == (90.0, 5.0)


def test_a_configured_value_is_set_again_after_each_start_of_the_node(monkeypatch: pytest.MonkeyPatch) -> None:
    usual, wanted = loop.coordinator_settings, {MOTION: {"quiet_after": 9.0}}
    monkeypatch.setattr(loop, "coordinator_settings", lambda *a: replace(usual(*a), node_parameters=wanted))
    fault = Fault("brown_out", "motion", 30.0, 5.0, 0.5)
    system = stepped(System(mission_of("pool_trial", 600), inject=Injector((fault,))), 29)
    assert settings(system, MOTION)["quiet_after"] == 9.0
    stepped(system, 8)
    assert settings(system, MOTION)["quiet_after"] in (5.0, 9.0)
    stepped(system, 8)
    assert settings(system, MOTION)["quiet_after"] == 9.0


def kept(folder: Path, value: float) -> Path:
    """A folder in which a motion node has saved how long a quiet bus may be."""
    server = ParameterServer(parameters_of(MotionSettings()), ParameterFiles(folder, "motion"))
    (number,) = [number for number, p in server.parameters.items() if p.name == "quiet_after"]
    assert number == QUIET_AFTER
    bits = int.from_bytes(struct.pack("<f", value), "little")
    assert (server.write(number, bits), server.save()) == ("Ok", "Ok")
    return folder


@pytest.mark.parametrize("separate", [False, True])
def test_nodes_keep_their_parameters_in_a_folder(tmp_path: Path, separate: bool) -> None:
    system = System(mission_of("pool_trial", 600), parameters=kept(tmp_path / "kept", 7.0))
    if not separate:
        stepped(system, READ)
    else:
        with SeparateNodes(system):
            stepped(system, READ)
            system.coordinator.parameters.write(MOTION, QUIET_AFTER, 11.0)
            system.coordinator.parameters.save(MOTION)
            stepped(system, 5)
        assert values(system, MOTION)["quiet_after"] == 11.0
        again = System(mission_of("pool_trial", 600), parameters=tmp_path / "kept")
        assert settings(again, MOTION)["quiet_after"] == 11.0
        return
    assert values(system, MOTION)["quiet_after"] == 7.0


def test_a_flight_begins_with_what_the_one_before_has_kept(stommel: Command, tmp_path: Path) -> None:
    folder = kept(tmp_path / "kept", 7.0)
    (folder / "motion.1").write_bytes(b"nonsense")
    path = tmp_path / "short.toml"

    text = Path(mission_path("pool_trial")).read_text(encoding="utf-8")
    path.write_text(text.replace("duration_days = 0.0125", f"duration_days = {60 / 86400:.8f}"), encoding="utf-8")
    found = stommel("sitl", path, "--parameters", folder)
    assert found.status == 0
    assert "note: motion node: parameter store, copy 1: it is not a parameter store" in found.err
    assert "note: motion node: parameter store: copy 0 holds, the last good one" in found.err
