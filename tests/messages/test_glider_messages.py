"""Oracles: the extra bytes of released messages, written down once, and pymavlink's own code on both sides."""

import importlib.util
import math
import random
import struct
import sys
from collections.abc import Iterator
from pathlib import Path
from types import ModuleType
from typing import Any

import pytest
from pymavlink.dialects.v20 import common
from pymavlink.generator import mavgen

from stommel.link.frames import FrameSplitter, frame_bytes
from stommel.messages.mavlink import DIALECT, Field, Fields, MessageType, message_named, message_types

RELEASED = {
    "GLIDER_STATE": (47000, 119),
    "BUOYANCY_ENGINE_STATE": (47001, 135),
    "MOVING_MASS_STATE": (47002, 144),
    "CTD_SAMPLE": (47003, 101),
    "DIVE_SUMMARY": (47004, 179),
    "ENERGY_STATE": (47005, 200),
    "NAVIGATION_ESTIMATE": (47006, 203),
    "LINK_STATISTICS": (47007, 75),
    "GLIDER_COMMAND": (47010, 116),
    "GLIDER_COMMAND_ASK": (47011, 7),
    "GLIDER_COMMAND_STATUS": (47012, 140),
    "FILE_OPEN": (47020, 97),
    "FILE_IDENTITY": (47021, 142),
    "FILE_REQUEST": (47022, 236),
    "FILE_DATA": (47023, 104),
    "FILE_OFFER": (47024, 185),
    "FILE_OUTCOME": (47025, 162),
    "FILE_RELEASE": (47026, 79),
    "KEY_CHANGE_OFFER": (47030, 186),
    "KEY_CHANGE_ANSWER": (47031, 1),
    "KEY_CHANGE_CONFIRM": (47032, 39),
    "KEY_CHANGE_REFUSED": (47033, 193),
    "KEY_CHALLENGE": (47034, 140),
    "KEY_CHALLENGE_ANSWER": (47035, 29),
    "PARAMETER_DIGEST_REQUEST": (47040, 33),
    "PARAMETER_DIGEST": (47041, 74),
    "PARAMETER_DESCRIPTION_REQUEST": (47042, 229),
    "PARAMETER_DESCRIPTION": (47043, 190),
    "PARAMETER_WRITE": (47044, 61),
    "PARAMETER_OUTCOME": (47045, 153),
    "ORDERS_ANNOUNCE": (47050, 167),
    "ORDERS_PIECE": (47051, 77),
    "ORDERS_MISSING": (47052, 152),
    "ORDERS_REQUEST": (47053, 56),
    "ORDERS_OUTCOME": (47054, 133),
    "ORDERS_PROBLEM": (47055, 140),
    "ORDERS_STATE_REQUEST": (47056, 104),
    "ORDERS_STATE": (47057, 244),
    "WAYPOINTS_REFUSED": (47058, 67),
}
"""Number and extra byte of the checksum. The extra byte follows from names, types and order of the fields: a message of
which it changes is another message, and gets another name and number."""
ROUNDS = 10
LIMITS = {"b": 7, "B": 8, "h": 15, "H": 16, "i": 31, "I": 32, "q": 63, "Q": 64}


def ours() -> list[MessageType]:
    return [kind for kind in message_types().values() if kind.id not in common.mavlink_map]


@pytest.fixture(scope="module")
def generated(tmp_path_factory: pytest.TempPathFactory) -> Iterator[ModuleType]:
    """The dialect as pymavlink's generator makes it from the same file."""
    target = tmp_path_factory.mktemp("dialect") / "glider_dialect.py"
    options = mavgen.Opts(str(target), wire_protocol="2.0", language="Python3", validate=False)
    mavgen.mavgen(options, [str(DIALECT)])
    spec = importlib.util.spec_from_file_location("glider_dialect", target)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    sys.modules["glider_dialect"] = module
    spec.loader.exec_module(module)
    yield module
    del sys.modules["glider_dialect"]


def single(code: str, draw: random.Random) -> int | float:
    if code in "fd":
        value = draw.choice([0.0, -1.5, math.inf, draw.uniform(-1e6, 1e6), draw.uniform(-1e-3, 1e-3)])
        return struct.unpack(f"<{code}", struct.pack(f"<{code}", value))[0]  # type: ignore[no-any-return]
    high = (1 << LIMITS[code]) - 1
    low = 0 if code.isupper() else -high - 1
    return draw.choice([0, low, high, draw.randint(low, high)])


def drawn(field: Field, draw: random.Random) -> Any:
    if field.type == "char":
        return "".join(draw.choice("abcxyz089 _") for _ in range(draw.randint(0, field.elements or 1)))
    if field.type == "uint8_t" and field.elements:
        return draw.randbytes(field.elements)
    code = field.code[-1]
    if field.elements:
        return tuple(single(code, draw) for _ in range(field.elements))
    return single(code, draw)


def as_pymavlink_takes(field: Field, value: Any) -> Any:
    if field.type == "char":
        return value.encode()
    return list(value) if field.elements else value


def as_ours(field: Field, value: Any) -> Any:
    if field.type == "char":
        return value.rstrip("\0") if isinstance(value, str) else value.rstrip(b"\0").decode()
    if field.elements:
        return bytes(value) if field.type == "uint8_t" else tuple(value)
    return value


def round_trips(kind: MessageType, dialect: ModuleType, draw: random.Random) -> None:
    values: Fields = {field.name: drawn(field, draw) for field in kind.fields}
    link = dialect.MAVLink(None, srcSystem=3, srcComponent=4)
    sequence = draw.randrange(256)
    heard = link.parse_buffer(frame_bytes(kind, kind.pack(values), 3, 4, sequence))
    assert heard is not None
    (message,) = heard
    assert message.get_type() == kind.name
    assert (message.get_srcSystem(), message.get_srcComponent(), message.get_seq()) == (3, 4, sequence)
    for field in kind.fields:
        assert as_ours(field, getattr(message, field.name)) == values[field.name], field.name
    made = dialect.mavlink_map[kind.id](
        **{field.name: as_pymavlink_takes(field, values[field.name]) for field in kind.fields}
    )
    link.seq = sequence
    (frame,) = FrameSplitter().take(bytes(made.pack(link)))
    assert (frame.system, frame.component, frame.sequence, frame.message.id) == (3, 4, sequence, kind.id)
    assert frame.message.unpack(frame.payload) == values


def test_messages_that_were_released_never_change() -> None:
    found = {kind.name: (kind.id, kind.crc_extra) for kind in ours()}
    assert found == RELEASED, f"a new message belongs into RELEASED: {found}"


def test_the_extra_byte_is_what_the_standard_makes_of_names_types_and_order() -> None:
    """mavlink.io, "Serialization": CRC-16/MCRF4XX of the name and of all fields but extensions, both bytes folded."""
    for kind in ours():
        text, place = f"{kind.name} ".encode(), 0
        for field in kind.fields:
            place += struct.calcsize("<" + field.code)
            if place <= kind.least:
                text += f"{field.type} {field.name} ".encode() + bytes((field.elements,) if field.elements else ())
        crc = 0xFFFF
        for byte in text:
            crc ^= byte
            for _ in range(8):
                crc = crc >> 1 ^ (0x8408 if crc & 1 else 0)
        assert kind.crc_extra == crc & 0xFF ^ crc >> 8, kind.name


def test_the_numbers_are_within_our_range() -> None:
    assert all(47_000 <= kind.id <= 47_099 for kind in ours())


def test_the_generator_finds_the_same_messages(generated: ModuleType) -> None:
    found = {kind.msgname: (number, kind.crc_extra) for number, kind in generated.mavlink_map.items()}
    assert found == {kind.name: (kind.id, kind.crc_extra) for kind in ours()}


@pytest.mark.parametrize("name", sorted(kind.name for kind in ours()))
def test_every_message_of_ours_goes_both_ways(name: str, generated: ModuleType) -> None:
    draw = random.Random(name)
    for _ in range(ROUNDS):
        round_trips(message_named(name), generated, draw)


def test_every_message_of_the_common_dialect_goes_both_ways() -> None:
    draw = random.Random(1)
    for number in common.mavlink_map:
        round_trips(message_types()[number], common, draw)


def test_every_field_says_what_it_is_and_in_what_unit() -> None:
    """A physical quantity without a unit is a guess; counts, numbers and flags have none."""
    text = Path(DIALECT).read_text(encoding="utf-8")
    assert "common.xml" not in text  # pymavlink's wheel has none
    from pymavlink.generator.mavparse import MAVXML

    for message in MAVXML(str(DIALECT), "2.0").message:
        assert message.description.strip().endswith(".")
        for field in message.fields:
            assert field.description.strip().endswith("."), f"{message.name}.{field.name}"
            if field.type in ("float", "double") and field.name not in UNITLESS:
                assert field.units, f"{message.name}.{field.name}"


UNITLESS = {"retransmit_ratio", "parameters", "default_value", "low", "high", "value"}
"""Numbers without one, and those whose unit another message or table tells."""
