"""Messages that nobody sensible sends. Oracle: nothing raises, nothing grows, and the next sensible one is obeyed."""

import random

from stommel.link.channel.settings import ChannelSettings
from stommel.link.files.digests import MOST_JOBS
from stommel.link.files.download import Download
from stommel.link.files.progress import State
from stommel.link.files.receiving import MOST_INCOMING
from stommel.link.files.sending import MOST_TRANSFERS
from stommel.link.files.server import FileServer
from stommel.link.files.upload import Upload
from stommel.link.outbox import Outbox, Priority
from stommel.link.service import Received
from stommel.messages.mavlink import message_named
from tests.link.files.fakes import MemoryDisk, MemoryFiles, noise
from tests.link.files.pair import SHORE, VEHICLE
from tests.link.files.test_download import Transfer

NAMES = ("OPEN", "IDENTITY", "REQUEST", "DATA", "OFFER", "OUTCOME", "RELEASE")
PATHS = (b"logs/a.log", b"missions/m", b"../x", b"", b"\xff\xfe", b"logs")


def garbage(draw: random.Random, transfers: tuple[int, ...]) -> Received:
    """A message FILE_* whose fields are anything, but often of a transfer that there is."""
    kind = message_named(f"FILE_{draw.choice(NAMES)}")
    values = kind.unpack(draw.randbytes(draw.randint(0, kind.layout.size)))
    values |= {"transfer": draw.choice((*transfers, draw.randrange(1 << 16)))}
    for name in ("target_system", "target_component"):
        if name in values:
            values[name] = 0
    if "path" in values:
        values["path"] = draw.choice(PATHS).decode("utf-8", "replace")
    if "size" in values and draw.random() < 0.7:
        values["size"] = draw.randrange(3000)
    if "length" in values and draw.random() < 0.7:
        values["length"] = draw.randrange(245)
    return Received(draw.choice((VEHICLE[0], SHORE[0], 77)), draw.choice((1, 190)), kind.name, values)


def test_garbage_neither_ends_nor_fills_a_server() -> None:
    draw = random.Random(1)
    files = MemoryFiles({"logs/a.log": noise(2000), "missions/m": b"m"})
    server, outbox = FileServer(*VEHICLE, files), Outbox()
    for k in range(5000):
        server.take(garbage(draw, (1, 2, 3)), 0.01 * k)
        server.poll(0.01 * k, outbox)
        outbox.next()
    assert len(server._sender._transfers) <= MOST_TRANSFERS
    assert len(server._receiving._incoming) <= MOST_INCOMING
    assert len(server._digests._jobs) <= MOST_JOBS
    assert files["logs/a.log"] == noise(2000)
    assert outbox.dropped == 0, "says only what there is room for"


def test_garbage_does_not_end_a_shore_otherwise_than_in_words() -> None:
    for seed in range(60):
        draw = random.Random(seed)
        outbox = Outbox()
        services = (
            Download(SHORE, VEHICLE, "logs/a.log", MemoryDisk(), "a"), Upload(SHORE, VEHICLE, noise(999), "missions/m"),
        )  # fmt: skip
        for k in range(200):
            for service in services:
                service.take(garbage(draw, (service.transfer,)), 0.1 * k)
                service.poll(0.1 * k, outbox)
                outbox.next()
                assert service.state is not State.WHOLE or isinstance(service, Upload)
                assert not service.state.is_over or service.state is State.WHOLE or service.reason


def test_another_system_changes_nothing() -> None:
    transfer = Transfer(ChannelSettings(whole_frames=True))
    transfer.pair.run(lambda: transfer.download.progress.done > 5000, 10.0)
    done = transfer.download.progress.done
    draw = random.Random(2)
    for _ in range(500):
        received = garbage(draw, (transfer.download.transfer,))
        transfer.download.take(received._replace(system=77), transfer.pair.t)
    assert transfer.download.progress.done == done
    assert transfer.run() is State.WHOLE


def test_data_wait_for_room_so_that_commands_overtake() -> None:
    transfer = Transfer(ChannelSettings(whole_frames=True))
    transfer.pair.run(lambda: transfer.download.progress.done > 5000, 10.0)
    outbox = Outbox(most=600)
    for k in range(100):
        transfer.server.poll(transfer.pair.t + 0.001 * k, outbox)
    assert outbox.dropped == 0
    assert outbox.waiting <= 600
    outbox.put(Priority.COMMAND, "HEARTBEAT", {})
    first = outbox.next()
    assert first is not None
    assert first.name == "HEARTBEAT"
