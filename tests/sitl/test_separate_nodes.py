"""Nodes in processes of their own: one that dies is silent and noticed, and no process is left over.

Oracle: the system's list of processes, and the table of failsafes for what a silent node leads to.
"""

import os
import signal
from pathlib import Path

import pytest

from stommel.onboard.coordination.executive import State
from stommel.sitl import separate_nodes
from stommel.sitl.multicast import own_bus, works
from stommel.sitl.real_time import Pace
from stommel.sitl.separate_nodes import SeparateNodes
from stommel.sitl.system import System
from tests.sitl.comparison import mission_of

DIVES_AT = 420
"""Time at which the first dive is under way [s]."""


def is_alive(pid: int) -> bool:
    stat = Path(f"/proc/{pid}/stat")
    if not stat.parent.parent.joinpath("self").exists():
        pytest.skip("this system does not tell its processes")
    return stat.exists() and stat.read_text().rpartition(")")[2].split()[0] != "Z"


def fly_until(system: System, seconds: float) -> None:
    while system.running and system.plant.time < seconds:
        system.step()


@pytest.mark.parametrize(
    ("node", "alarm"), [("motion", "silent motion node"), ("acquisition", "silent acquisition node")]
)
def test_a_node_that_dies_is_noticed_and_the_vehicle_comes_up(node: str, alarm: str) -> None:
    system, said = System(mission_of("kuroshio", 900)), []
    with SeparateNodes(system, say=said.append) as nodes:
        fly_until(system, DIVES_AT)
        view = system.coordinator.view
        assert view is not None
        assert view.executive.state is State.MISSION
        assert not view.safety.active
        pids = {name: process.pid for name, process in nodes.processes.items()}
        dead, other = pids[node], next(pid for name, pid in pids.items() if name != node)
        assert dead is not None
        assert other is not None
        os.kill(dead, signal.SIGKILL)
        fly_until(system, DIVES_AT + 30)
        view = system.coordinator.view
        assert [word for word in said if node in word and "silent" in word] == said != []
        assert not is_alive(dead)
        assert is_alive(other)
        assert alarm in [active.name for active in view.safety.active]
        assert view.executive.coming_up
    assert not is_alive(other)


def test_a_node_that_hangs_counts_as_dead_and_is_ended(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(separate_nodes, "ANSWERS_WITHIN", 0.5)
    system, said = System(mission_of("pool_trial", 60)), []
    with SeparateNodes(system, say=said.append) as nodes:
        fly_until(system, 5)
        pid = nodes.processes["motion"].pid
        assert pid is not None
        os.kill(pid, signal.SIGSTOP)
        system.step()
        assert said
        assert not is_alive(pid)
        monkeypatch.setattr(separate_nodes, "ANSWERS_WITHIN", 1e5)
        system.step()  # it is waited for once only: this would last a day


def test_nodes_end_with_an_error_of_ours() -> None:
    nodes = SeparateNodes(System(mission_of("pool_trial", 60)))
    with pytest.raises(RuntimeError, match="of ours"):
        _fail_within(nodes)
    assert len(PIDS) == 2
    assert not any(is_alive(pid) for pid in PIDS)


PIDS: list[int] = []


def _fail_within(nodes: SeparateNodes) -> None:
    with nodes:
        PIDS.extend(pid for process in nodes.processes.values() if (pid := process.pid) is not None)
        raise RuntimeError("of ours")


def test_over_multicast_the_start_checks_pass() -> None:
    """Frames really go over sockets: without the nodes' own frames the motors would stay unproven."""
    objection = works(own_bus())
    if objection:
        pytest.skip(objection)
    system, pace = System(mission_of("pool_trial", 60)), Pace(20.0)
    with SeparateNodes(system, own_bus()):
        while system.plant.time < 50.0:
            pace.wait(system.plant.time)
            system.step()
    view = system.coordinator.view
    assert view is not None
    assert view.safety.unproven == ()
    assert view.executive.state is State.COMMUNICATE
    assert system.coordinator.perception.decoder.received.total() > 200
