"""The radio link's session: what is said, packed, split, checked and heard, on one core."""

import itertools
from collections.abc import Iterator
from pathlib import Path
from random import Random
from tempfile import TemporaryDirectory
from time import process_time

from figures.registry import Measurement, figure
from stommel.files.folder_storage import FolderStorage
from stommel.link.outbox import Outbox, Priority
from stommel.link.presence import SHORE_HEARTBEAT, Presence
from stommel.link.service import Received
from stommel.link.session import Session
from stommel.link.signing.guard import Guard, PortGuard
from stommel.link.signing.key_file import KeyFile, new_keys
from stommel.link.statistics import Statistics
from stommel.link.time_sync import TimeSync
from stommel.messages.mavlink import Fields

_MESSAGES, _REPEATS, _MODEM = 10_000, 3, 2880
_NOW = 1_800_000_000.0
_SAID: tuple[tuple[str, Fields], ...] = (
    ("GLIDER_STATE", {"time_boot_ms": 7, "phase": 1, "depth": 12.5, "altitude": float("nan"), "dive": 3}),
    ("GLOBAL_POSITION_INT", {"lat": 302_000_000, "lon": 1_221_000_000, "alt": -12_500, "hdg": 9000}),
    ("ATTITUDE", {"time_boot_ms": 7, "roll": 0.01, "pitch": -0.4, "yaw": 1.5}),
    ("FILE_TRANSFER_PROTOCOL", {"payload": bytes(range(250)) + b"\1"}),
)


class _Talker:
    """Says telemetry and pieces of files as fast as it may, and counts what it hears."""

    def __init__(self, count: int) -> None:
        self._messages: Iterator[tuple[str, Fields]] = itertools.islice(itertools.cycle(_SAID), count)
        self.heard = 0

    def take(self, received: Received, t: float) -> None:  # noqa: ARG002
        self.heard += received.name != "HEARTBEAT"

    def poll(self, t: float, outbox: Outbox) -> None:  # noqa: ARG002
        while outbox.room(Priority.DATA) > 300:
            said = next(self._messages, None)
            if said is None:
                return
            outbox.put(Priority.DATA, *said)


def _guards(folder: Path) -> tuple[PortGuard, PortGuard]:
    """Guards of vehicle and shore with one key; keys and stamps are on the disk, as at sea."""
    keys, guards = new_keys(1, _NOW), []
    for system in (1, 255):
        KeyFile(folder / f"{system}.key").write(keys)
        store, storage = KeyFile(folder / f"{system}.key"), FolderStorage(folder / str(system))
        guards.append(PortGuard(Guard(system, store, storage, _NOW, Random(system).randbytes)))
    return guards[0], guards[1]


def _end(system: int, component: int, guard: PortGuard | None) -> tuple[Session, _Talker]:
    talker, sync = _Talker(_MESSAGES), TimeSync()
    session = Session(system, component, [Presence(lambda: SHORE_HEARTBEAT), sync, talker], guard)
    session.services.append(Statistics(session, sync))
    return session, talker


def _talk(*, signed: bool) -> float:
    """Processor time of both ends saying and hearing all [s]."""
    with TemporaryDirectory() as folder:
        guards = _guards(Path(folder)) if signed else (None, None)
        (vehicle, told), (shore, asked) = _end(1, 1, guards[0]), _end(255, 190, guards[1])
        began = process_time()
        for step in itertools.count():
            t = 0.25 * step
            shore.take(vehicle.poll(t, _MODEM), t)
            vehicle.take(shore.poll(t, _MODEM), t)
            if min(told.heard, asked.heard) >= _MESSAGES:
                return process_time() - began
    raise AssertionError


@figure(unit="1/s", bar=5000.0, at_least=True)
def link_messages_per_s() -> Measurement:
    """Measure how many signed messages both ends together say and hear, each way, on one core [1/s]."""
    _talk(signed=True)
    times, unsigned = [[_talk(signed=signed) for _ in range(_REPEATS)] for signed in (True, False)]
    detail = {"messages_each_way": _MESSAGES, "unsigned": _MESSAGES / min(unsigned)}
    return Measurement(_MESSAGES / min(times), detail)
