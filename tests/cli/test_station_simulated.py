"""The main job of `make run`: a simulated glider and the station in one command, until Ctrl-C."""

import os
import re
import signal
import socket
import subprocess
import sys
import time
from pathlib import Path

import httpx
import pytest

from stommel.cli.station.simulated import SimulatedGlider, SimulatedGliderError, ended_words
from stommel.link.transports import inherited
from tests.station.speaker import until
from tests.support.command import PROGRAM, run_here


def test_one_command_launches_a_glider_and_serves_it(tmp_path: Path) -> None:
    """It is heard over its signed link, its archive is there afterwards, and no process of it is left."""
    command = [PROGRAM, "station", "--sitl", "east_china_sea", "--folder", tmp_path, "--port", "0"]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as process:
        try:
            assert process.stdout is not None
            told = process.stdout.readline()
            address = re.search(r"page: (http://127\.0\.0\.1:\d+/)", told)
            assert address, told
            with httpx.Client(base_url=address[1], timeout=60.0) as client:
                summary = heard(client)
            assert (summary["simulated"], summary["speed"], summary["model"]) == (True, 20.0, "zju")
        finally:
            process.send_signal(signal.SIGINT)
            assert process.wait(120) == 0
    assert (tmp_path / "archive.sqlite").is_file()
    assert (tmp_path / "glider" / "log").is_dir()
    assert not flying(tmp_path)


def test_the_page_is_told_that_the_glider_flies_no_more(tmp_path: Path) -> None:
    """Its program is killed; the vehicle's summary says so in words, where it said that the connection is refused."""
    command = [PROGRAM, "station", "--sitl", "east_china_sea", "--folder", tmp_path, "--port", "0"]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as process:
        try:
            assert process.stdout is not None
            address = re.search(r"page: (http://127\.0\.0\.1:\d+/)", process.stdout.readline())
            assert address
            os.kill(glider_of(process.pid), signal.SIGKILL)
            with httpx.Client(base_url=address[1]) as client:
                until(lambda: "simulated glider was ended from outside" in reason(client), within=60.0)
                assert "SIGKILL" in reason(client)
                assert client.get("/api/vehicles/1/link").json()["reason"] == reason(client)
        finally:
            process.send_signal(signal.SIGINT)
            assert process.wait(30) == 0


def test_nobody_can_take_the_port_of_a_glider_before_it_listens(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Another program tries, at a glider that takes its time; the port is free again when the glider has ended."""
    slow = [sys.executable, "-c", "import time; time.sleep(600)"]
    monkeypatch.setattr(SimulatedGlider, "_command", lambda *_: slow)
    with SimulatedGlider("east_china_sea", 20.0, tmp_path) as glider:
        place = ("127.0.0.1", int(glider.address.rpartition(":")[2]))
        with pytest.raises(OSError, match="in use"):
            socket.create_server(place)
        with pytest.raises(ConnectionRefusedError):
            socket.create_connection(place)
    socket.create_server(place).close()


def test_a_machine_without_a_free_port_is_told(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def none(_: str) -> socket.socket:
        raise OSError(98, "Address already in use")

    monkeypatch.setattr(inherited, "reserved", none)
    with (
        pytest.raises(SimulatedGliderError, match="Address already in use"),
        SimulatedGlider("east_china_sea", 20.0, tmp_path),
    ):
        pass


def reason(client: httpx.Client) -> str:
    (summary,) = client.get("/api/vehicles").raise_for_status().json()
    return str(summary["link_reason"])


def glider_of(station: int) -> int:
    """The process of its simulated glider."""
    (child,) = Path(f"/proc/{station}/task/{station}/children").read_text().split()
    return int(child)


@pytest.mark.parametrize(
    ("status", "said", "words"),
    [
        (0, "flown", "the simulated flight is over"),
        (
            2,
            "first\nerror: mission.toml: dives.depth_m = 3: too deep\n",
            "has failed: error: mission.toml: dives.depth_m",
        ),
        (1, "", "it has not said why"),
        (1, "x" * 100_000, "has failed: xxx"),
        (-9, "", "ended from outside (SIGKILL)"),
        (-99, "", "ended from outside (99)"),
    ],
)
def test_why_a_glider_ended_is_one_short_line(tmp_path: Path, status: int, said: str, words: str) -> None:
    path = tmp_path / "glider.txt"
    path.write_text(said)
    told = ended_words(status, path)
    assert words in told
    assert "\n" not in told
    assert len(told) < 300 + len(str(path))


def heard(client: httpx.Client) -> dict[str, object]:
    """Summary of the only vehicle once it is heard; the first start compiles the simulated glider."""
    for _ in range(6000):
        (summary,) = client.get("/api/vehicles").raise_for_status().json()
        if summary["heard"]:
            found: dict[str, object] = summary
            return found
        time.sleep(0.1)
    raise AssertionError(summary)


def flying(folder: Path) -> bool:
    """Whether a process still has the folder in its command line."""
    return any(
        str(folder).encode() in line.read_bytes() for line in Path("/proc").glob("[0-9]*/cmdline") if exists(line)
    )


def exists(line: Path) -> bool:
    try:
        return bool(line.read_bytes())
    except OSError:
        return False


@pytest.mark.parametrize(
    ("option", "value", "words"),
    [("--sitl", "atlantis", "neither a file nor a shipped mission"), ("--speed", "0", "must be between 0.1 and 100")],
)
def test_wrong_flights_are_refused_before_anything_starts(tmp_path: Path, option: str, value: str, words: str) -> None:
    told = {"--sitl": "east_china_sea"} | {option: value}
    done = run_here(tmp_path, "station", *(word for pair in told.items() for word in pair), "--folder", "flight")
    assert done.status == 2
    assert words in done.err
    assert not (tmp_path / "flight").exists()
