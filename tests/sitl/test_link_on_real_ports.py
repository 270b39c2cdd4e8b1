"""The radio link from end to end: `stommel link` against `vehicle run` on a `stand-in`, each in a process of its own.

Oracle: what the vehicle's folders and its own words say.
"""

import hashlib
import json
import os
import re
import subprocess
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest

from stommel.link.signing.key_file import KeyFile, new_keys
from stommel.messages.adapters import Adapter, BusError
from stommel.messages.bus import CanBus
from stommel.simulation.scenario.shipped import mission_path
from tests.support.command import PROGRAM, run_here

CHANNEL = f"239.74.163.{1 + os.getpid() % 250}:{31000 + os.getpid() % 9000}"
STARTS_WITHIN = 180.0
"""The loop is compiled first, where no cache has it [s]."""


@pytest.fixture
def _multicast() -> None:
    try:
        CanBus(Adapter("udp_multicast", CHANNEL)).close()
    except BusError as error:
        pytest.skip(f"no multicast here: {error}")


@contextmanager
def running(log: Path, *arguments: object) -> Iterator[subprocess.Popen[bytes]]:
    with log.open("wb") as told:
        process = subprocess.Popen([PROGRAM, *map(str, arguments)], stdout=told, stderr=subprocess.STDOUT)
        try:
            yield process
        finally:
            process.terminate()
            process.wait(120.0)


def said(log: Path, pattern: str) -> str:
    """Wait until a program has said something; the group of the pattern."""
    until = time.monotonic() + STARTS_WITHIN
    while time.monotonic() < until:
        if found := re.search(pattern, log.read_text()):
            return found[1]
        time.sleep(0.1)
    raise AssertionError(log.read_text())


def configured(folder: Path) -> Path:
    """The paper's vehicle on the ports of the stand-in, with its key, and another copy of that for the shore."""
    assert run_here(folder, "vehicle", "config", "zju", "--output", folder).status == 0
    assert run_here(folder, "orders", mission_path("kuroshio"), "--output", folder / "orders.toml").status == 0
    path, keys = folder / "CONFIG.toml", new_keys(1, time.time())
    text = path.read_text().replace('interface = "socketcan"', 'interface = "udp_multicast"')
    text = text.replace('channel = ""', f'channel = "{CHANNEL}"')
    for k, name in enumerate(("compass", "gnss", "radio")):
        text = text.replace(f"/dev/ttyUSB{k}", str(folder / "ports" / name))
    path.write_text(text)
    for name in ("radio.key", "shore.key"):
        KeyFile(folder / name).write(keys)
    return path


@pytest.mark.usefixtures("_multicast")
def test_shore_and_vehicle_through_the_air_of_a_stand_in(tmp_path: Path) -> None:
    path = configured(tmp_path)
    air, vehicle = tmp_path / "stand_in.txt", tmp_path / "vehicle.txt"
    stand_in = ("sitl", "stand-in", "kuroshio", "--ports", tmp_path / "ports", "--channel", CHANNEL)
    with running(air, *stand_in, "--link", "tcp-listen:127.0.0.1:0"):
        address = said(air, r"shore: (tcp:\S+)")
        said(air, r"(radio): ")
        with running(vehicle, "vehicle", "run", path, "--supervised") as software:
            said(vehicle, r"(start-up)")

            def link(*arguments: object) -> Any:
                line = ("--to", address, "--key", tmp_path / "shore.key", "--state", tmp_path / "state", "--json")
                done = subprocess.run(
                    [PROGRAM, "link", *map(str, (*arguments, *line))], capture_output=True, text=True, timeout=120.0,
                    check=False,
                )  # fmt: skip
                assert done.returncode == 0, (done.stderr, vehicle.read_text())
                return json.loads(done.stdout)

            status = link("status", "--within", 60, "--seconds", 3)
            assert status["signing"] == "signing"
            assert status["link"]["good"] > 5
            link("mission", "upload", tmp_path / "orders.toml")
            said(vehicle, r"(mission 1: Across the Kuroshio)")
            found = link("files", "get", "missions/active.orders", tmp_path / "home" / "active.orders")
            assert found["sha256"] == hashlib.sha256((tmp_path / "orders.toml").read_bytes()).hexdigest()
            assert (tmp_path / "home" / "active.orders").read_bytes() == (tmp_path / "orders.toml").read_bytes()
            assert link("command", "send", "hold")["state"] == "done"
            assert link("command", "send", "restart", "--yes")["state"] == "done"
            assert software.wait(30.0) == 75
