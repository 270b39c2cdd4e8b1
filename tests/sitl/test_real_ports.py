"""The software on real ports: `stommel vehicle run` in a process of its own, against a simulated vehicle.

Oracle: what it says and does in the loop. The CAN bus is one of multicast frames, the serial ports are terminals.
"""

import json
import os
import re
import subprocess
import sys
import time
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import pytest

import stommel
from stommel.errors import StommelError
from stommel.messages.adapters import Adapter, BusError
from stommel.messages.bus import CanBus
from stommel.messages.parameter_files import ParameterFiles
from stommel.messages.parameters import ParameterServer
from stommel.onboard.execution.motion_node import MotionNode
from stommel.onboard.nodes.motion_settings import MotionSettings
from stommel.onboard.nodes.node_settings import parameters_of
from stommel.simulation.scenario.shipped import mission_path
from stommel.sitl.stand_in import StandIn, Terminals
from tests.support.command import PROGRAM, run_here

SECONDS = 40
CHANNEL = f"239.74.163.{1 + os.getpid() % 250}:{30000 + os.getpid() % 10000}"
"""A port of its own: a bus of another test on this machine would be heard."""


@pytest.fixture
def bus() -> Iterator[CanBus]:
    try:
        opened = CanBus(Adapter("udp_multicast", CHANNEL))
    except BusError as error:
        pytest.skip(f"no multicast here: {error}")
    yield opened
    opened.close()


def configured(folder: Path) -> Path:
    """A configuration of the paper's vehicle on the stand-in's ports, and a mission."""
    assert run_here(folder, "vehicle", "config", "zju", "--output", folder).status == 0
    assert run_here(folder, "orders", mission_path("kuroshio"), "--output", folder / "orders.toml").status == 0
    path = folder / "CONFIG.toml"
    text = path.read_text()
    text = text.replace('interface = "socketcan"', 'interface = "udp_multicast"')
    text = text.replace('channel = ""', f'channel = "{CHANNEL}"')
    for k, name in enumerate(("compass", "gnss", "radio")):
        text = text.replace(f"/dev/ttyUSB{k}", str(folder / "ports" / name))
    path.write_text(text)
    return path


def test_vehicle_run_checks_itself_and_begins_its_mission(tmp_path: Path, bus: CanBus) -> None:
    """Every start check passes through real ports within seconds, and the nodes obey."""
    path = configured(tmp_path)
    path.write_text(path.read_text().replace("motion = {}", "motion = { quiet_after = 8.0 }"))
    mission = stommel.load_mission(mission_path("kuroshio"))
    sensors = mission.scenario.sensors.model_copy(update={"first_fix_s": 3.0})
    mission = replace(mission, scenario=mission.scenario.model_copy(update={"sensors": sensors}))
    arguments = ["--mission", tmp_path / "orders.toml", "--start", "--json", "--seconds", SECONDS]
    with StandIn(mission, bus, tmp_path / "ports", parameters=tmp_path / "kept") as vehicle:
        process = subprocess.Popen(
            [PROGRAM, "vehicle", "run", path, *map(str, arguments)],
            stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
        )  # fmt: skip
        vehicle.run(SECONDS + 60.0, lambda: process.poll() is not None)
        out, told = process.communicate(timeout=120.0)
        assert process.returncode == 0, told
        assert vehicle.modes == {"motion": "operational", "acquisition": "operational"}
        assert isinstance(vehicle.system.motion, MotionNode)
        assert vehicle.system.motion.settings.quiet_after == 8.0
    assert "communicate: told to start, mission valid, all proven, no alarm forbids it" in told
    assert json.loads(out)["decisions"] >= SECONDS - 3
    logs = sorted((tmp_path / "log").iterdir())
    assert logs
    for log in logs:
        assert run_here(tmp_path, "vehicle", "log", log, "--json").json["status"] == "whole"
    assert (tmp_path / "missions" / "mission-000001.orders").exists()
    assert any(b"Motion: quiet_after = 8.0 s: Ok" in log.read_bytes() for log in logs)


def test_a_damaged_parameter_store_is_told_and_the_last_good_copy_holds(tmp_path: Path, bus: CanBus) -> None:
    """A stand-in's nodes keep their parameters in files when given a folder."""
    bus.close()  # the command opens its own
    kept = tmp_path / "kept"
    server = ParameterServer(parameters_of(MotionSettings()), ParameterFiles(kept, "motion"))
    for _ in range(2):
        assert server.save() == "Ok"
    assert sorted(path.name for path in kept.iterdir()) == ["motion.0", "motion.1"]
    (kept / "motion.1").write_bytes(b"nonsense")
    arguments = ("--ports", tmp_path / "ports", "--channel", CHANNEL, "--parameters", kept, "--seconds", 1)
    done = run_here(tmp_path, "sitl", "stand-in", "pool_trial", *arguments)
    assert done.status == 0
    assert "note: motion node: parameter store, copy 1: it is not a parameter store" in done.err
    assert "note: motion node: parameter store: copy 0 holds, the last good one" in done.err


def test_every_missing_port_is_named(tmp_path: Path) -> None:
    assert run_here(tmp_path, "vehicle", "config", "zju", "--output", tmp_path).status == 0
    path = tmp_path / "CONFIG.toml"
    path.write_text(path.read_text().replace("/dev/ttyUSB", f"{tmp_path}/nothing"))
    done = run_here(tmp_path, "vehicle", "run", path)
    assert done.status == 2
    lines = done.err.splitlines()
    for key in ("compass.port", "gnss.port", "radio.port"):
        assert any(line.startswith(f"error: {path}: {key} = ") for line in lines), done.err
    if not Path("/sys/class/net/can0").exists():
        assert any("can.interface = 'socketcan'" in line or "can.channel" in line for line in lines), done.err


@pytest.mark.skipif(not Path("/proc/self/status").exists(), reason="the system does not tell the memory of a process")
def test_a_small_board_has_room_for_it() -> None:
    """150 MB: the greatest memory of a process that imports all and has read the CAN database."""
    program = (
        "from pathlib import Path\n"
        "import stommel.onboard.running.vehicle_software\n"
        "from stommel.messages.database import database\n"
        "database()\n"
        "status = Path('/proc/self/status').read_text()\n"
        "print(status.split('VmHWM:')[1].split()[0])\n"
    )
    environment = os.environ | {"STOMMEL_COMPILE": "0"}
    done = subprocess.run(
        [sys.executable, "-c", program], capture_output=True, text=True, check=True, timeout=300, env=environment
    )
    assert 10 * 1024 < int(done.stdout) < 150 * 1024


def test_terminals_carry_bytes_both_ways_and_go(tmp_path: Path) -> None:
    terminals = Terminals(tmp_path / "ports", ["compass"])
    with terminals.paths["compass"].open("r+b", buffering=0) as port:
        terminals.write("compass", b"\x00\r\n\xff")
        assert port.read(4) == b"\x00\r\n\xff"
        port.write(b"LOG\r\n")
        until, heard = time.monotonic() + 60.0, b""
        while heard != b"LOG\r\n" and time.monotonic() < until:
            heard += terminals.read("compass")
    assert heard == b"LOG\r\n"
    terminals.close()
    assert not list((tmp_path / "ports").iterdir())


def test_a_file_in_the_way_stays(tmp_path: Path) -> None:
    (tmp_path / "gnss").write_text("mine")
    with pytest.raises(StommelError, match=re.escape(f"{tmp_path / 'gnss'}: is there already")):
        Terminals(tmp_path, ["compass", "gnss"])
    assert (tmp_path / "gnss").read_text() == "mine"
    assert [path.name for path in tmp_path.iterdir()] == ["gnss"]
