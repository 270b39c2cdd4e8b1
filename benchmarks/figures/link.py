"""The radio link's session: what is said, packed, split, checked and heard, on one core."""

import itertools
from collections.abc import Iterator
from time import process_time

from figures.registry import Measurement, figure
from stommel.link.outbox import Outbox, Priority
from stommel.link.presence import SHORE_HEARTBEAT, Presence
from stommel.link.service import Received
from stommel.link.session import Session
from stommel.link.statistics import Statistics
from stommel.link.time_sync import TimeSync
from stommel.messages.mavlink import Fields

_MESSAGES, _REPEATS, _MODEM = 10_000, 3, 2880
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


def _end(system: int, component: int) -> tuple[Session, _Talker]:
    talker, sync = _Talker(_MESSAGES), TimeSync()
    session = Session(system, component, [Presence(lambda: SHORE_HEARTBEAT), sync, talker])
    session.services.append(Statistics(session, sync))
    return session, talker


def _talk() -> float:
    """Processor time of both ends saying and hearing all [s]."""
    (vehicle, told), (shore, asked) = _end(1, 1), _end(255, 190)
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
    """Measure how many messages both ends together say and hear, each way, on one core [1/s]."""
    _talk()
    times = [_talk() for _ in range(_REPEATS)]
    return Measurement(
        _MESSAGES / min(times), {"messages_each_way": _MESSAGES, "us_a_message": 5e5 * min(times) / _MESSAGES}
    )
