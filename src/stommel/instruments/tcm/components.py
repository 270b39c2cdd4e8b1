"""What the compass measures: components of a kDataResp, and its configuration values."""

import struct
from enum import IntEnum
from functools import cache
from typing import NamedTuple


class Component(IntEnum):
    """Numbers of components, as in the manual."""

    HEADING = 5
    TEMPERATURE = 7
    DISTORTION = 8
    CAL_STATUS = 9
    ACCELERATION_X = 21
    ACCELERATION_Y = 22
    ACCELERATION_Z = 23
    PITCH = 24
    ROLL = 25
    FIELD_X = 27
    FIELD_Y = 28
    FIELD_Z = 29
    HEADING_STATUS = 79
    """Newer firmware only."""


class Kind(NamedTuple):
    """How a component is written, and what it can be."""

    code: str
    """Of `struct`."""
    low: float
    high: float


KINDS: dict[int, Kind] = {
    Component.HEADING: Kind("f", 0.0, 360.0),  # [deg]
    Component.TEMPERATURE: Kind("f", -60.0, 125.0),  # [degC]
    Component.DISTORTION: Kind("B", 0, 1),
    Component.CAL_STATUS: Kind("B", 0, 1),
    Component.ACCELERATION_X: Kind("f", -3.0, 3.0),  # [g]
    Component.ACCELERATION_Y: Kind("f", -3.0, 3.0),
    Component.ACCELERATION_Z: Kind("f", -3.0, 3.0),
    Component.PITCH: Kind("f", -90.0, 90.0),  # [deg]
    Component.ROLL: Kind("f", -180.0, 180.0),
    Component.FIELD_X: Kind("f", -1000.0, 1000.0),  # [uT]
    Component.FIELD_Y: Kind("f", -1000.0, 1000.0),
    Component.FIELD_Z: Kind("f", -1000.0, 1000.0),
    Component.HEADING_STATUS: Kind("B", 0, 255),
}

MEASURED = (
    *(Component.HEADING, Component.PITCH, Component.ROLL),
    *(Component.ACCELERATION_X, Component.ACCELERATION_Y, Component.ACCELERATION_Z),
    *(Component.FIELD_X, Component.FIELD_Y, Component.FIELD_Z),
    *(Component.TEMPERATURE, Component.DISTORTION, Component.CAL_STATUS),
)
"""What the driver asks for."""


class Config(IntEnum):
    """Numbers of configuration values."""

    DECLINATION = 1
    TRUE_NORTH = 2
    BIG_ENDIAN = 6
    MOUNTING = 10
    CALIBRATION_POINTS = 12
    AUTO_SAMPLING = 13
    BAUD = 14
    MIL_OUTPUT = 15
    DATA_CAL = 16
    COEFFICIENT_SET = 18
    ACCELERATION_COEFFICIENT_SET = 19


CONFIG_CODES: dict[int, str] = {
    Config.DECLINATION: "f",
    Config.TRUE_NORTH: "B",
    Config.BIG_ENDIAN: "B",
    Config.MOUNTING: "B",
    Config.CALIBRATION_POINTS: "I",
    Config.AUTO_SAMPLING: "B",
    Config.BAUD: "B",
    Config.MIL_OUTPUT: "B",
    Config.DATA_CAL: "B",
    Config.COEFFICIENT_SET: "I",
    Config.ACCELERATION_COEFFICIENT_SET: "I",
}


def order_mark(big_endian: bool) -> str:
    """Mark of `struct` for an order of bytes."""
    return ">" if big_endian else "<"


@cache
def layout(components: tuple[int, ...], big_endian: bool) -> struct.Struct:
    """Payload of a kDataResp with some components: their count, then number and value of each."""
    return struct.Struct(order_mark(big_endian) + "B" + "".join("B" + KINDS[c].code for c in components))


def config_payload(number: int, value: float, big_endian: bool) -> bytes:
    """Payload of a kSetConfig or kConfigResp."""
    code = CONFIG_CODES[number]
    return struct.pack(order_mark(big_endian) + "B" + code, number, value if code == "f" else int(value))


def config_value(payload: bytes, big_endian: bool) -> tuple[int, float] | None:
    """Number and value of a kSetConfig or kConfigResp; None where they do not fit each other."""
    code = CONFIG_CODES.get(payload[0])
    layout = struct.Struct(order_mark(big_endian) + "B" + code) if code else None
    if layout is None or layout.size != len(payload):
        return None
    number, value = layout.unpack(payload)
    return number, value
