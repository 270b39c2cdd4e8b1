"""`kill -9` of the whole server at random moments under load: what was acknowledged is in the archive.

Acknowledged is a frame before a TIMESYNC that the link has answered, a sample that a browser has seen, and a command
that HTTP has answered. Oracle: what the test has heard, against what SQLite has after the death.

mavlink/qgroundcontrol#7474: the archive opens after a death at any moment, with the last values.

20 deaths share the time of CI; `STOMMEL_STATION_KILLS=200` has them all.
"""

import json
import os
import random
import re
import sqlite3
import sys
import threading
import time
from collections.abc import Iterator
from contextlib import closing, contextmanager, suppress
from multiprocessing.process import BaseProcess
from pathlib import Path

import httpx
import pytest
from websockets.exceptions import WebSocketException
from websockets.sync.client import ClientConnection, connect

from stommel.archive import Archive
from stommel.link.frames import HEAD
from stommel.messages.mavlink import message_named
from tests.station.served import served
from tests.station.speaker import Speaker, speaker, until
from tests.support.lives import command_line, life
from tests.support.orders import ORDERS

KILLS = int(os.environ.get("STOMMEL_STATION_KILLS", "20"))
LONGEST = 1.2
"""After which a server dies at the latest, from its first acknowledgement on [s]."""
STATE = message_named("GLIDER_STATE")


@contextmanager
def server(folder: Path, link: str) -> Iterator[tuple[BaseProcess, str]]:
    """The whole server in a process of its own, and its page."""
    arguments = ("station", "serve", "--folder", str(folder), "--link", link, "--unsigned", "--port", "0")
    with life(command_line, *arguments) as (process, told):
        said = []
        for line in told:
            said.append(line)
            if found := re.search(r"http://(\S+:\d+)", line):
                break
        else:
            raise AssertionError("".join(said))
        yield process, found[1]


class Load:
    """Says, watches and commands, and keeps what was acknowledged."""

    def __init__(self, vehicle: Speaker) -> None:
        self.vehicle = vehicle
        self.said = 0
        """Number of the last state; counts on over all deaths."""
        self.questions: dict[int, int] = {}
        """Number of the last state before each TIMESYNC."""
        self.kept = 0
        """All states up to this one were acknowledged, but for those that a death has cut off."""
        self.cut_off: list[range] = []
        self.seen: set[float] = set()
        self.commands: set[str] = set()

    def say(self) -> None:
        """Say some states, and ask for an answer."""
        burst = b""
        for _ in range(20):
            self.said += 1
            burst += self.vehicle.frame("GLIDER_STATE", {"time_boot_ms": self.said, "depth": float(self.said)})
        question = len(self.questions) + 1
        self.questions[question] = self.said
        self.vehicle.send(burst + self.vehicle.frame("TIMESYNC", {"tc1": 0, "ts1": question}))

    def listen(self) -> None:
        """Take note of answers."""
        for frame in self.vehicle.listen():
            if frame.message.name == "TIMESYNC":
                values = frame.message.unpack(frame.payload)
                if values["tc1"] != 0 and (answered := self.questions.get(int(values["ts1"]))):  # type: ignore[arg-type]
                    self.kept = max(self.kept, answered)
        self.vehicle.heard.clear()

    def watch(self, socket: ClientConnection) -> None:
        """Take note of samples that a browser sees."""
        with suppress(TimeoutError):
            while True:
                message = json.loads(socket.recv(timeout=0))
                if message["type"] == "samples":
                    self.seen |= set(message["samples"]["depth_m"][1])

    def command(self, page: str, ends: threading.Event) -> None:
        """Give commands until the server dies."""
        with httpx.Client(base_url=f"http://{page}", timeout=60.0) as client:
            while not ends.is_set():
                try:
                    answer = client.post("/api/vehicles/1/commands", json={"name": "hold", "valid_for_s": 3600})
                except httpx.HTTPError:
                    return
                if answer.status_code == 201:
                    self.commands.add(answer.json()["id"])
                time.sleep(0.03)


def lived(load: Load, page: str, process: BaseProcess, longest: float) -> None:
    """One life of the server, and its death."""
    ends = threading.Event()
    commanding = threading.Thread(target=load.command, args=(page, ends))
    before, dies_at = load.kept, time.monotonic() + 60.0
    try:
        with connect(f"ws://{page}/api/live", max_size=1 << 24) as socket:
            ask = {"type": "subscribe", "id": "a", "vehicle": 1, "channels": ["depth_m"], "every": True}
            socket.send(json.dumps(ask))
            commanding.start()
            while time.monotonic() < dies_at:
                load.say()
                load.listen()
                load.watch(socket)
                if load.kept > before:
                    before, dies_at = sys.maxsize, time.monotonic() + longest
                time.sleep(0.02)
            process.kill()
            process.join()
            load.watch(socket)
    except (OSError, WebSocketException):
        pass  # it is dead
    finally:
        ends.set()
        if commanding.ident is not None:
            commanding.join()
    with suppress(OSError):
        load.listen()


def states(archive: Path) -> set[int]:
    """Numbers of the states whose frames are there, by SQLite itself."""
    with closing(sqlite3.connect(f"file:{archive}?mode=ro", uri=True)) as database:
        assert database.execute("PRAGMA integrity_check").fetchone() == ("ok",)
        rows = database.execute("SELECT frame FROM frames WHERE direction = 'in' AND message_id = ?", (STATE.id,))
        return {int(STATE.unpack(frame[HEAD : HEAD + frame[1]])["time_boot_ms"]) for (frame,) in rows}  # type: ignore[arg-type]


def test_no_acknowledged_record_is_lost_however_often_the_server_is_killed(tmp_path: Path) -> None:
    draw = random.Random(20)
    with speaker() as vehicle:
        load = Load(vehicle)
        for _ in range(KILLS):
            first = load.said + 1
            with server(tmp_path, vehicle.address) as (process, page):
                vehicle.connect()
                lived(load, page, process, draw.uniform(0.0, LONGEST))
            vehicle.hang_up()
            assert load.kept >= first, "the server has acknowledged nothing"
            load.cut_off.append(range(load.kept + 1, load.said + 1))
            with Archive.open(str(tmp_path / "archive.sqlite")) as archive:  # it opens, and knows the last values
                assert archive.latest(1)["depth_m"][1] >= load.kept
                curve = archive.series(1, "depth_m", 0.0, 4e9, 20_000, "raw")
            there = states(tmp_path / "archive.sqlite")
            excused = {number for cut in load.cut_off for number in cut}
            assert set(range(1, load.kept + 1)) - excused <= there
            assert load.seen <= set(curve.value.tolist())
            with closing(sqlite3.connect(tmp_path / "archive.sqlite")) as database:
                kept = {id for (id,) in database.execute("SELECT id FROM commands")}
            assert load.commands <= kept
        assert load.seen
        assert load.commands


def test_a_mission_that_waits_outlives_a_kill_and_is_flown_once(tmp_path: Path) -> None:
    """Given under water, to a server that dies. Oracle: which orders the vehicle held in the end."""
    with served() as vehicle:
        vehicle.under_water = True
        with server(tmp_path, vehicle.address) as (process, page):
            asked = {"orders": ORDERS, "valid_for_s": 7200.0}
            given = httpx.post(f"http://{page}/api/vehicles/1/mission", json=asked, timeout=60.0).json()
            process.kill()
            process.join()
        with server(tmp_path, vehicle.address) as (_, page), httpx.Client(base_url=f"http://{page}/api") as client:
            waits = client.get("/vehicles/1/mission").json()["upload"]
            assert (waits["id"], waits["state"]) == (given["id"], "waiting")
            assert waits["expires"] == pytest.approx(given["expires"], abs=1e-3)
            vehicle.under_water = False
            until(lambda: client.get(f"/vehicles/1/missions/{given['id']}").json()["state"] == "aboard")
            until(lambda: client.get("/vehicles/1/mission").json()["waiting"] == 0)
            assert vehicle.missions.files == [b"the first orders", ORDERS.encode()]
