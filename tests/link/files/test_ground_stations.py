"""Files of the vehicle in the hands of others. Oracles: `mavsdk` and `MAVProxy`, as they are."""

import asyncio
import select
import socket
import subprocess
import sys
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

from stommel.link.files.server import FileServer
from stommel.link.outbox import Outbox, Priority
from stommel.link.service import Received
from stommel.link.session import Session
from tests.link.files.fakes import MemoryFiles, noise
from tests.link.files.pair import VEHICLE

LOG = noise(30_000, 5)
FULL_PIECES = noise(239 * 20, 6)
"""Ends with a full piece: nothing short says where the file ends."""


class Heartbeat:
    """The vehicle is there."""

    def __init__(self) -> None:
        self._next = 0.0

    def take(self, received: Received, t: float) -> None:
        pass

    def poll(self, t: float, outbox: Outbox) -> None:
        if t >= self._next:
            self._next = t + 0.2
            values = {"type": 12, "autopilot": 0, "base_mode": 81, "system_status": 4, "mavlink_version": 3}
            outbox.put(Priority.STATE, "HEARTBEAT", values)


class Aboard(threading.Thread):
    """A vehicle at a UDP port of this machine; every so many datagrams each way may be lost."""

    def __init__(self, files: MemoryFiles, port: int, lose_every: int = 0) -> None:
        super().__init__(daemon=True)
        self._session = Session(*VEHICLE, [Heartbeat(), FileServer(*VEHICLE, files)])
        self._socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self._socket.bind(("127.0.0.1", 0))
        self._peer: tuple[str, int] = ("127.0.0.1", port)
        self._lose_every, self._count = lose_every, 0
        self._ends = threading.Event()

    def run(self) -> None:
        while not self._ends.is_set():
            if select.select([self._socket], [], [], 0.002)[0]:
                data, self._peer = self._socket.recvfrom(65536)
                if not self._is_lost():
                    self._session.take(data, time.monotonic())
            for _ in range(16):
                data = self._session.poll(time.monotonic(), 280)
                if not data:
                    break
                if not self._is_lost():
                    self._socket.sendto(data, self._peer)
        self._socket.close()

    def _is_lost(self) -> bool:
        self._count += 1
        return bool(self._lose_every) and self._count % self._lose_every == 0

    def end(self) -> None:
        self._ends.set()
        self.join(5.0)


@contextmanager
def aboard(files: MemoryFiles, lose_every: int = 0) -> Iterator[int]:
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
        probe.bind(("127.0.0.1", 0))
        port = probe.getsockname()[1]
    vehicle = Aboard(files, port, lose_every)
    vehicle.start()
    try:
        yield port
    finally:
        vehicle.end()


def vehicle_files() -> MemoryFiles:
    many = {f"logs/dive-{number:04}.log": noise(10 * number) for number in range(40)}
    return MemoryFiles({"logs/a.log": LOG, "logs/full.log": FULL_PIECES, **many})


async def with_mavsdk(port: int, tmp_path: Path) -> None:
    from mavsdk.asyncio.mavsdk import Configuration, Mavsdk
    from mavsdk.asyncio.plugins.ftp import FtpAsync
    from mavsdk.component_type import ComponentType

    config = Configuration.create_with_component_type(ComponentType.GROUND_STATION)
    async with Mavsdk(config) as mavsdk:
        await mavsdk.add_any_connection(f"udpin://127.0.0.1:{port}")
        system = await mavsdk.first_autopilot(timeout_s=20.0)
        assert system is not None
        ftp = FtpAsync(system)
        listed = await ftp.list_directory("/logs")
        assert len(listed.entries) == 42
        assert ("a.log", len(LOG)) in [(entry.name, entry.size_bytes) for entry in listed.entries]
        for use_burst in (True, False):
            folder = tmp_path / str(use_burst)
            folder.mkdir()
            for name, data in (("a.log", LOG), ("full.log", FULL_PIECES)):
                async for _ in ftp.download(f"/logs/{name}", str(folder), use_burst):
                    pass
                assert (folder / name).read_bytes() == data
        mission = tmp_path / "m.orders"
        mission.write_bytes(noise(3000, 9))
        async for _ in ftp.upload(str(mission), "/missions"):
            pass
        assert await ftp.are_files_identical(str(mission), "/missions/m.orders")
        await ftp.create_directory("/missions/old")
        await ftp.rename("/missions/m.orders", "/missions/old/m.orders")
        await ftp.remove_file("/missions/old/m.orders")
        await ftp.remove_directory("/missions/old")
        with pytest.raises(Exception, match="PROTECTED"):
            await ftp.remove_file("/logs/a.log")
        with pytest.raises(Exception, match="NOT_EXIST"):
            async for _ in ftp.download("/logs/none.log", str(tmp_path), True):
                pass
        ftp.destroy()


@pytest.mark.parametrize("lose_every", [0, 29])
def test_mavsdk_lists_fetches_sends_and_cannot_delete_data(tmp_path: Path, lose_every: int) -> None:
    files = vehicle_files()
    with aboard(files, lose_every) as port:
        asyncio.run(asyncio.wait_for(with_mavsdk(port, tmp_path), 60.0))
    assert files["logs/a.log"] == LOG
    assert ("missions", "m.orders") not in files.files


def test_mavproxy_lists_fetches_and_sends(tmp_path: Path) -> None:
    files = vehicle_files()
    mission = noise(3000, 9)
    (tmp_path / "m.orders").write_bytes(mission)
    steps = [
        ("ftp list logs", "Total size"),
        ("ftp get logs/a.log a.log", "Wrote 30000 bytes"),
        ("ftp get logs/full.log full.log", "Wrote 4780 bytes"),
        ("ftp put m.orders missions/m.orders", "Sent file of length 3000"),
        ("ftp rm logs/a.log", "Remove failed"),
    ]
    with aboard(files) as port:
        program = [sys.executable, str(Path(sys.executable).with_name("mavproxy.py"))]
        options = [f"--master=udpin:127.0.0.1:{port}", "--default-modules=ftp", "--state-basedir=."]
        process = subprocess.Popen(
            [*program, *options],
            cwd=tmp_path, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, bufsize=1,
        )  # fmt: skip
        try:
            said = converse(process, steps)
        finally:
            process.kill()
            process.communicate()
    assert "dive-0039.log" in said
    assert (tmp_path / "a.log").read_bytes() == LOG
    assert (tmp_path / "full.log").read_bytes() == FULL_PIECES
    assert files["missions/m.orders"] == mission
    assert files["logs/a.log"] == LOG


def converse(process: "subprocess.Popen[str]", steps: list[tuple[str, str]]) -> str:
    """Say each line and wait for its answer."""
    heard: list[str] = []
    assert process.stdout is not None
    assert process.stdin is not None
    stream = process.stdout
    reader = threading.Thread(target=lambda: heard.extend(iter(lambda: stream.read(1), "")), daemon=True)
    reader.start()

    def wait_for(words: str, most: float = 30.0) -> None:
        end = time.monotonic() + most
        while words not in "".join(heard):
            assert time.monotonic() < end, f"{words!r} was not said: {''.join(heard)}"
            time.sleep(0.05)

    wait_for("Detected vehicle 1:1")
    for line, answer in steps:
        process.stdin.write(line + "\n")
        process.stdin.flush()
        wait_for(answer)
    return "".join(heard)
