"""A peer with another release of the messages is named. Oracle: frames packed with another extra byte, by hand."""

import random

import pytest

from stommel.link.frames import frame_bytes
from stommel.link.session import Session
from stommel.messages.mavlink import message_named


def frames(name: str, other: int, count: int) -> bytes:
    kind = message_named(name)
    draw = random.Random(1)
    payloads = [draw.randbytes(kind.layout.size - 1) + b"\1" for _ in range(count)]
    kind = kind._replace(crc_extra=kind.crc_extra ^ other)
    return b"".join(frame_bytes(kind, payload, 1, 1, number) for number, payload in enumerate(payloads))


@pytest.mark.parametrize("name", ["HEARTBEAT", "GLIDER_STATE", "FILE_OPEN"])
@pytest.mark.parametrize("other", [1, 0x5A, 0xFF])
def test_other_version_of_a_message_is_named(name: str, other: int) -> None:
    session = Session(255, 190, [])
    assert session.take(frames(name, other, 2), 0.0) == []
    assert session.versions == ""
    assert session.take(frames(name, other, 1), 0.1) == []
    assert f"another version of {name}: " in session.versions
    assert len(session.take(frames("PING", 0, 3), 0.2)) == 3


def test_spoilt_frames_are_not_taken_for_another_version() -> None:
    session = Session(255, 190, [])
    draw = random.Random(2)
    for number in range(1000):
        raw = bytearray(frames("HEARTBEAT", 0, 1))
        raw[draw.randrange(10, len(raw))] ^= draw.randrange(1, 256)
        assert session.take(bytes(raw), float(number)) == []
    assert session.versions == ""


def test_many_names_are_counted() -> None:
    session = Session(255, 190, [])
    for name in ("HEARTBEAT", "PING", "ATTITUDE", "GLIDER_STATE", "FILE_OPEN"):
        session.take(frames(name, 7, 3), 0.0)
    assert "HEARTBEAT, PING, ATTITUDE and 2 more" in session.versions
