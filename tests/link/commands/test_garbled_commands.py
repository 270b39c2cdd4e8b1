"""Whatever the fields hold: no service falls over, nothing is executed that was not sayable, queues stay bounded."""

import random

import pytest

from stommel.link.commands.identity import Identity
from stommel.link.commands.standard import StandardCommands
from stommel.link.commands.table import COMMANDS
from stommel.link.outbox import Outbox
from stommel.link.service import Received
from stommel.messages.mavlink import message_named
from tests.link.commands.quay import SHORE, VEHICLE, Quay

NAMES = ("GLIDER_COMMAND", "GLIDER_COMMAND_ASK", "GLIDER_COMMAND_STATUS", "COMMAND_LONG", "COMMAND_INT", "COMMAND_ACK")


class NoTelemetry:
    def request(self, number: int, t: float) -> bool:
        return False

    def set_interval(self, number: int, interval: float | None, t: float) -> bool:
        return False


@pytest.mark.parametrize("seed", range(3))
def test_any_bytes_as_a_command(seed: int) -> None:
    draw = random.Random(seed)
    quay = Quay(seed=seed)
    standard = StandardCommands(*VEHICLE, quay.port, NoTelemetry(), Identity("1.0.0"), quay.server.abort_came)
    quay.give("start")
    numbers = {row.number for row in COMMANDS}
    now = int(quay.shore_clock * 1000.0)
    for _ in range(2000):
        kind = message_named(draw.choice(NAMES))
        values = kind.unpack(draw.randbytes(kind.layout.size))
        sensible = {
            "target_system": draw.choice(VEHICLE[:1] + SHORE[:1]),
            "target_component": draw.choice(VEHICLE[1:] + SHORE[1:]),
            "given": now, "expires": now + draw.choice([1, 60_000, 10**12]), "when": draw.randrange(4),
            "command": draw.choice([*numbers, 20, 185, 300, 400, 511, 512, 520]),
        }  # fmt: skip
        values |= {name: value for name, value in sensible.items() if name in values and draw.random() < 0.9}
        received = Received(*draw.choice([SHORE, VEHICLE]), kind.name, values)
        for service, t in ((quay.server, quay.t), (standard, quay.t), (quay.client, quay.shore_t)):
            outbox = Outbox()
            service.take(received, t)
            service.poll(t, outbox)
            assert outbox.dropped == 0
    assert {command.number for command in quay.port.begun} <= numbers
    assert len(quay.vehicle_disk.files["commands"].data) < 100_000
