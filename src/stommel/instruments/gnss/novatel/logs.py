"""Layouts of the logs: what stands in them, once for both formats."""

import struct
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import Any, NamedTuple

from stommel.instruments.gnss.novatel.words import (
    CLOCK,
    COM1,
    DATUM,
    FINESTEERING,
    SOLUTION,
    SOLUTION_TYPE,
    UTC,
    WGS84,
    Words,
)


class Header(NamedTuple):
    """What stands before every log."""

    week: int
    """GPS week, counted on through roll-overs."""
    ms: int
    """Of the week."""
    time_status: int = FINESTEERING
    port: int = COM1
    sequence: int = 0
    idle: float = 47.0
    """Of the receiver's processor [%], in halves."""
    receiver_status: int = 0
    definition: int = 0
    """Reserved; NovAtel's own programs tell versions of a log by it."""
    version: int = 3620
    """Build of the receiver's software."""


class BestPos(NamedTuple):
    """The best position that the receiver has."""

    status: int
    kind: int
    latitude: float
    """[deg]"""
    longitude: float
    """[deg]"""
    height: float
    """Above mean sea level [m]."""
    undulation: float
    """Of the geoid above the ellipsoid [m]."""
    datum: int
    latitude_sigma: float
    """[m]"""
    longitude_sigma: float
    """[m]"""
    height_sigma: float
    """[m]"""
    station: str
    differential_age: float
    """[s]"""
    solution_age: float
    """[s]"""
    tracked: int
    """Satellites."""
    used: int
    """Satellites."""
    used_l1: int = 0
    used_l2: int = 0
    reserved: int = 0
    extended_status: int = 0
    reserved_mask: int = 0
    signals: int = 1


class BestVel(NamedTuple):
    """The best velocity that the receiver has."""

    status: int
    kind: int
    latency: float
    """Of the velocity behind the time of the log [s]."""
    age: float
    """Of differential corrections [s]."""
    speed: float
    """Horizontal, over ground [m/s]."""
    course: float
    """Over ground, from true north [deg]."""
    rising: float
    """Vertical speed, up positive [m/s]."""
    reserved: float = 0.0


class Time(NamedTuple):
    """The receiver's clock, and UTC by it."""

    clock: int
    offset: float
    """Of the receiver's clock from GPS time [s]."""
    offset_sigma: float
    """[s]"""
    utc_offset: float
    """UTC minus GPS time [s]: minus the leap seconds."""
    year: int
    month: int
    day: int
    hour: int
    minute: int
    ms: int
    """Of the minute."""
    utc: int
    """Whether UTC is valid."""


Log = BestPos | BestVel | Time


@dataclass(frozen=True)
class Field:
    """One value: how binary has it, how ASCII is written and read."""

    code: str
    written: Callable[[Any], str]
    read: Callable[[str], Any]


def _number(code: str, decimals: int) -> Field:
    return Field(code, f"{{:.{decimals}f}}".format, float)


def _words(words: Words) -> Field:
    return Field("I", words.word, words.number)


_INTEGER = Field("B", str, int)
_HEX = Field("B", "{:02x}".format, lambda text: int(text, 16))
_SMALL = Field("d", "{:.9e}".format, float)
_STATION = Field("4s", '"{}"'.format, lambda text: text.strip('"'))


@dataclass(frozen=True)
class Layout:
    """A log in both formats."""

    name: str
    number: int
    make: Callable[..., Log]
    fields: tuple[Field, ...]

    @cached_property
    def form(self) -> struct.Struct:
        """Of the body in binary."""
        return struct.Struct("<" + "".join(field.code for field in self.fields))


_SOLUTION, _TYPE = _words(SOLUTION), _words(SOLUTION_TYPE)

BESTPOS = Layout(
    "BESTPOS",
    42,
    BestPos,
    (
        *(_SOLUTION, _TYPE, _number("d", 11), _number("d", 11), _number("d", 4), _number("f", 4), _words(DATUM)),
        *(_number("f", 4), _number("f", 4), _number("f", 4), _STATION, _number("f", 3), _number("f", 3)),
        *(_INTEGER, _INTEGER, _INTEGER, _INTEGER, _INTEGER, _HEX, _HEX, _HEX),
    ),
)
BESTVEL = Layout(
    "BESTVEL",
    99,
    BestVel,
    (
        *(_SOLUTION, _TYPE, _number("f", 3), _number("f", 3)),
        *(_number("d", 4), _number("d", 6), _number("d", 4), _number("f", 1)),
    ),
)
TIME = Layout(
    "TIME",
    101,
    Time,
    (
        *(_words(CLOCK), _SMALL, _SMALL, _number("d", 11), Field("I", str, int)),
        *(_INTEGER, _INTEGER, _INTEGER, _INTEGER, Field("I", str, int), _words(UTC)),
    ),
)
LAYOUTS = (BESTPOS, BESTVEL, TIME)
BY_NUMBER = {layout.number: layout for layout in LAYOUTS}
BY_NAME = {layout.name: layout for layout in LAYOUTS}
BY_TYPE: dict[type, Layout] = {BestPos: BESTPOS, BestVel: BESTVEL, Time: TIME}


def no_position(tracked: int = 0) -> BestPos:
    """BESTPOS of a receiver that hears too few satellites."""
    return BestPos(1, 0, 0.0, 0.0, 0.0, 0.0, WGS84, 0.0, 0.0, 0.0, "", 0.0, 0.0, tracked, 0, signals=0)
