"""The simulated glider and pymavlink alone: a signed link through the command, and what an ordinary decoder shows.

Oracle: pymavlink's own signing, and its decoder with the common dialect.
"""

import os
import re
import subprocess
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest

from stommel.link.signing.key_file import KeyFile
from stommel.onboard.coordination.executive import State
from stommel.onboard.radio.telemetry_table import FIRST_MODE, STATES
from stommel.sitl.scenario import load_scenario
from stommel.sitl.system import System
from tests.clients.afloat import scenario_in
from tests.support.command import PROGRAM, Command

os.environ.setdefault("MAVLINK20", "1")
from pymavlink import mavutil
from pymavlink.dialects.v20 import common

PATIENCE = 120.0
"""For anything that is asked for, and for the vehicle to begin [s]: without machine code it compiles a minute."""


@contextmanager
def in_the_loop(folder: Path, key: Path) -> Iterator[int]:
    """`stommel sitl` with a signed radio; the port where a shore may connect."""
    options = ["--speed", "5", "--link", "tcp-listen:127.0.0.1:0", "--key", key, "--no-live"]
    with (folder / "said.txt").open("w+") as said:
        process = subprocess.Popen([PROGRAM, "sitl", scenario_in(folder), *options], stderr=said, cwd=folder)
        try:
            end = time.monotonic() + PATIENCE
            while not (found := re.search(r"shore: \S*:(\d+)\n", (folder / "said.txt").read_text())):
                assert process.poll() is None, (folder / "said.txt").read_text()
                assert time.monotonic() < end, "the vehicle is not on the air"
                time.sleep(0.1)
            yield int(found[1])
        finally:
            process.kill()
            process.wait()


def connected(port: int) -> Any:
    return mavutil.mavlink_connection(f"tcp:127.0.0.1:{port}", source_system=255, source_component=190)


def heard(connection: Any, name: str, **wanted: object) -> Any:
    """A message with these values; a heartbeat is said meanwhile."""
    end, beat = time.monotonic() + PATIENCE, 0.0
    while time.monotonic() < end:
        if time.monotonic() >= beat:
            connection.mav.heartbeat_send(6, 8, 0, 0, 4)
            beat = time.monotonic() + 1.0
        message = connection.recv_match(type=name, blocking=True, timeout=1.0)
        if message is not None and all(getattr(message, key) == value for key, value in wanted.items()):
            return message
    raise AssertionError(f"{name} with {wanted} was not heard")


def disarm(connection: Any) -> None:
    connection.mav.command_long_send(1, 1, common.MAV_CMD_COMPONENT_ARM_DISARM, 0, 0, 0, 0, 0, 0, 0, 0)


def test_who_has_the_key_commands_and_nobody_else(stommel: Command, tmp_path: Path) -> None:
    key = tmp_path / "zju-1.key"
    assert stommel("link", "key", "new", key, "--vehicle", 1).status == 0
    secret = bytes(KeyFile(key).read().current.secret)
    with in_the_loop(tmp_path, key) as port:
        signed = connected(port)
        signed.setup_signing(secret, sign_outgoing=True, link_id=3)
        armed = heard(signed, "HEARTBEAT", base_mode=common.MAV_MODE_FLAG_SAFETY_ARMED | 1)
        assert armed.get_signed()
        disarm(signed)
        heard(signed, "COMMAND_ACK", command=common.MAV_CMD_COMPONENT_ARM_DISARM, result=common.MAV_RESULT_ACCEPTED)
        heard(signed, "HEARTBEAT", base_mode=1)
        signed.close()
        for wrong in (None, bytes(32)):
            stranger = connected(port)
            if wrong is not None:
                stranger.setup_signing(wrong, sign_outgoing=True, allow_unsigned_callback=lambda *_: True)
            begin = time.monotonic()
            while time.monotonic() < begin + 4.0:
                stranger.mav.command_long_send(1, 1, common.MAV_CMD_COMPONENT_ARM_DISARM, 0, 1, 0, 0, 0, 0, 0, 0)
                answer = stranger.recv_match(type="COMMAND_ACK", blocking=True, timeout=0.5)
                assert answer is None
            stranger.close()
        again = connected(port)
        again.setup_signing(secret, sign_outgoing=True, link_id=3)
        assert heard(again, "HEARTBEAT").base_mode == 1, "a stranger has started the mission"
        disarm(again)
        heard(again, "COMMAND_ACK", command=common.MAV_CMD_COMPONENT_ARM_DISARM, result=common.MAV_RESULT_ACCEPTED)
        again.close()


@pytest.fixture(scope="module")
def under_way(tmp_path_factory: pytest.TempPathFactory) -> System:
    """A vehicle some metres deep."""
    path = scenario_in(tmp_path_factory.mktemp("under_way"))
    path.write_text(path.read_text().replace("session_s = 1800", "session_s = 60"))
    system = System(load_scenario(path).mission)
    while system.plant.depth < 8.0:
        assert system.plant.time < 900.0
        system.step()
    return system


def shown(system: System) -> dict[str, Any]:
    """What an ordinary decoder makes of all that the vehicle would say now, by name."""
    decoder = common.MAVLink(None)
    decoder.robust_parsing = True
    messages: dict[str, Any] = {}
    t = system.plant.time
    for tenth in range(10):
        data = system.link.poll(t + tenth / 10.0, 4096)
        messages |= {message.get_type(): message for message in decoder.parse_buffer(data) or []}
    return messages


def test_depth_is_negative_altitude(under_way: System) -> None:
    messages, depth = shown(under_way), under_way.plant.depth
    assert depth >= 8.0
    assert messages["GLOBAL_POSITION_INT"].relative_alt / 1e3 == pytest.approx(-depth, abs=1.0)
    assert messages["GLOBAL_POSITION_INT"].alt == messages["GLOBAL_POSITION_INT"].relative_alt
    assert messages["VFR_HUD"].alt == pytest.approx(-depth, abs=1.0)
    assert messages["VFR_HUD"].climb < 0.0
    assert messages["GLOBAL_POSITION_INT"].vz > 0
    assert messages["VFR_HUD"].airspeed == pytest.approx(0.5, abs=0.4)


def test_type_and_mode_are_shown_as_they_are(under_way: System) -> None:
    beat = shown_again(under_way)["HEARTBEAT"]
    assert beat.type == common.MAV_TYPE_SUBMARINE
    assert beat.autopilot == common.MAV_AUTOPILOT_GENERIC
    assert beat.system_status == common.MAV_STATE_ACTIVE
    assert mavutil.mode_string_v10(beat) == f"Mode({FIRST_MODE + STATES.index(State.MISSION)})"


def test_no_state_has_the_number_of_a_mode_of_ardusub() -> None:
    numbers = {FIRST_MODE + number for number in range(len(STATES))}
    assert not numbers & set(mavutil.mode_mapping_sub)


def shown_again(system: System) -> dict[str, Any]:
    for _ in range(2):
        system.step()
    return shown(system)
