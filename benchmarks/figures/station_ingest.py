"""The shore station under load: telemetry over TCP into the archive, with browsers that watch it live."""

import json
import multiprocessing
import os
import re
import socket
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any, NamedTuple

from figures.registry import Measurement, figure
from stommel.link.frames import frame_bytes
from stommel.messages.mavlink import message_named

BAR = 2000.0
SECONDS, BROWSERS = 15.0, 20
SETTLED, QUIET = 300.0, 10.0
"""Time in which the station has stored what was sent, and after which no more comes [s]."""
WATCHED = ["depth_m", "pitch_deg", "heading_deg", "ballast_ml", "voltage_v", "latitude_deg", "longitude_deg", "phase"]
MESSAGES = (
    "HEARTBEAT", "GLIDER_STATE", "GLOBAL_POSITION_INT", "NAVIGATION_ESTIMATE", "GPS_RAW_INT", "VFR_HUD", "ATTITUDE",
    "SYS_STATUS", "BATTERY_STATUS", "ENERGY_STATE", "BUOYANCY_ENGINE_STATE", "MOVING_MASS_STATE",
)  # fmt: skip
"""What a vehicle says, in turn."""
BURST = 0.02
"""Between two bursts of a steady stream [s]."""


class Ingested(NamedTuple):
    """What became of a stream of messages."""

    sent: int
    stored: int
    seconds: float
    """From the first message until all of them were stored."""
    memory_mib: list[float]
    """Of the station, every so often."""
    cpu_s: float
    """Of the station."""
    seen: int
    """Messages that the browsers had."""
    slowest_s: float
    """Longest time that a browser waited for the next values."""


def ingest(seconds: float, rate: float | None, browsers: int = BROWSERS) -> Ingested:
    """Send telemetry to a station at a steady rate [1/s], or as fast as it takes it, and count what it has stored."""
    with (
        tempfile.TemporaryDirectory() as folder,
        socket.create_server(("127.0.0.1", 0)) as listening,
        _station(Path(folder), listening.getsockname()[1]) as (process, page),
    ):
        counts: Any = multiprocessing.Queue()
        ends = multiprocessing.Event()
        watching = multiprocessing.Process(target=_watch, args=(page, browsers, ends, counts))
        watching.start()
        connection, _ = listening.accept()
        sending = multiprocessing.Process(target=_send, args=(connection, seconds, rate, counts))
        began = time.monotonic()
        sending.start()
        memory = []
        while sending.is_alive():
            memory.append(_memory(process.pid))
            sending.join(max(1.0, seconds / 100.0))
        sent = counts.get(timeout=10.0)
        took = _settled(Path(folder) / "archive.sqlite") - began
        stored = _stored(Path(folder) / "archive.sqlite")
        memory.append(_memory(process.pid))
        cpu = _cpu(process.pid)
        ends.set()
        seen, slowest = counts.get(timeout=30.0)
        watching.join(10.0)
        connection.close()
        return Ingested(sent, stored, took, memory, cpu, seen, slowest)


@figure(unit="1/s", bar=BAR, at_least=True)
def station_ingest_messages_per_s() -> Measurement:
    """Measure how many telemetry messages a second are stored, none lost, with 20 browsers that watch [1/s]."""
    found = ingest(SECONDS, None)
    if found.stored != found.sent:
        raise AssertionError(f"{found.sent} messages were sent, and {found.stored} are stored")
    return Measurement(found.sent / found.seconds, {
        "sent": found.sent, "seconds": round(found.seconds, 1), "cpu_s": round(found.cpu_s, 1),
        "memory_mib": [round(found.memory_mib[0], 1), round(found.memory_mib[-1], 1)],
        "messages_seen_by_browsers": found.seen, "browsers": BROWSERS,
    })  # fmt: skip


@contextmanager
def _station(folder: Path, port: int) -> Iterator[tuple[subprocess.Popen[str], str]]:
    """A station of its own process, and the address of its live data."""
    command = [
        sys.executable, "-c", "from stommel.cli import main; main()", "station", "serve", "--folder", str(folder),
        "--link", f"tcp:127.0.0.1:{port}", "--unsigned", "--port", "0",
    ]  # fmt: skip
    process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    try:
        assert process.stdout is not None
        for line in process.stdout:
            if found := re.search(r"http://(\S+:\d+)", line):
                break
        else:
            raise AssertionError("the station did not start")
        yield process, f"ws://{found[1]}/api/live"
    finally:
        process.terminate()
        process.wait(20.0)


def _send(connection: socket.socket, seconds: float, rate: float | None, counts: Any) -> None:
    """Say telemetry; put how many messages were said."""
    began, said = time.monotonic(), 0
    kind = message_named("SYSTEM_TIME")
    utc = {"time_unix_usec": int(time.time() * 1e6), "time_boot_ms": 0}
    connection.sendall(frame_bytes(kind, kind.pack(utc), 1, 1, 0))
    said += 1
    while (elapsed := time.monotonic() - began) < seconds:
        due = said + 100 if rate is None else int(rate * elapsed) + 1
        burst = bytearray()
        while said < due:
            burst += _frame(said, int(1000.0 * elapsed))
            said += 1
        connection.sendall(burst)
        if rate is not None:
            time.sleep(BURST)
    counts.put(said)


def _frame(number: int, boot_ms: int) -> bytes:
    kind = message_named(MESSAGES[number % len(MESSAGES)])
    values: dict[str, Any] = {}
    for field in kind.fields:
        if field.type in ("float", "int32_t", "int16_t") and not field.elements:
            values[field.name] = number % 97
    if any(field.name == "time_boot_ms" for field in kind.fields):
        values["time_boot_ms"] = boot_ms
    return frame_bytes(kind, kind.pack(values), 1, 1, number % 256)


def _watch(page: str, browsers: int, ends: Any, counts: Any) -> None:
    """Watch as so many browsers; put how many messages they had, and the longest wait."""
    import asyncio  # noqa: PLC0415

    from websockets.asyncio.client import connect  # noqa: PLC0415

    async def browser(number: int, found: list[int], waits: list[float]) -> None:
        async with connect(page, max_size=1 << 24) as socket:
            ask = {"type": "subscribe", "id": "a", "vehicle": 1, "channels": WATCHED, "every": number % 4 == 0}
            await socket.send(json.dumps(ask))
            last = time.monotonic()
            while not ends.is_set():
                try:
                    message = json.loads(await asyncio.wait_for(socket.recv(), 0.5))
                except TimeoutError:
                    continue
                found[0] += 1
                if message["type"] in ("values", "samples"):
                    now = time.monotonic()
                    if found[0] > browsers:
                        waits[0] = max(waits[0], now - last)
                    last = now

    async def all_of_them() -> tuple[int, float]:
        found, waits = [0], [0.0]
        await asyncio.gather(*(browser(k, found, waits) for k in range(browsers)), return_exceptions=True)
        return found[0], waits[0]

    counts.put(asyncio.run(all_of_them()))


def _settled(archive: Path) -> float:
    """When the last frame was stored, once none was for a while [s of the monotonic clock]."""
    import sqlite3  # noqa: PLC0415

    last, changed, ends = -1, time.monotonic(), time.monotonic() + SETTLED
    with sqlite3.connect(f"file:{archive}?mode=ro", uri=True) as database:
        while time.monotonic() - changed < QUIET and time.monotonic() < ends:
            chosen = "SELECT id FROM frames WHERE direction = 'in' ORDER BY id DESC LIMIT 1"
            (newest,) = database.execute(chosen).fetchone() or (0,)
            if newest != last:
                last, changed = newest, time.monotonic()
            time.sleep(0.05)
    return changed


def _stored(archive: Path) -> int:
    """Frames of the vehicle that are stored."""
    import sqlite3  # noqa: PLC0415

    with sqlite3.connect(f"file:{archive}?mode=ro", uri=True) as database:
        chosen = "SELECT count(*) FROM frames WHERE direction = 'in'"
        return int(database.execute(chosen).fetchone()[0])


def _memory(process: int) -> float:
    status = Path(f"/proc/{process}/status").read_text()
    found = re.search(r"VmRSS:\s+(\d+) kB", status)
    return int(found[1]) / 1024.0 if found else 0.0


def _cpu(process: int) -> float:
    fields = Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")
