"""What the GPCTD has stored: samples of five hexadecimal digits a value, and the list of its casts."""

import re
from calendar import timegm
from typing import NamedTuple

from stommel.instruments.gpctd.reading import CtdReading, checked


class Scale(NamedTuple):
    """A value is digits / divisor - offset."""

    name: str
    divisor: float
    offset: float


SCALES = (
    Scale("pressure", 100.0, 10.0),
    Scale("temperature", 10_000.0, 5.0),
    Scale("conductivity", 100_000.0, 0.05),
    Scale("oxygen", 10.0, 0.0),
)
"""In the order of a line. The oxygen sensor is an option."""
DIGITS = 5
_LARGEST = 16**DIGITS - 1
_SAMPLE = re.compile(rb"[0-9A-F]{15}(?:[0-9A-F]{5})?")
FLUSHED = {False: 22, True: 18}
"""Samples at the end of half a profile that are garbage of the instrument, without and with oxygen (basestation3)."""


class Cast(NamedTuple):
    """A line of the answer to `UH`."""

    number: int
    utc: float
    """Of its first sample, seconds since 1970."""
    first: int
    last: int
    interval: float
    """Between two samples [s]."""
    stop: str
    """Why it ended."""

    @property
    def samples(self) -> int:
        """How many it holds."""
        return self.last - self.first + 1


_CAST = re.compile(
    r"cast\s+(\d{1,6}) (\d{1,2}) (\w{3}) (\d{4}) (\d\d):(\d\d):(\d\d) samples (\d{1,9}) to (\d{1,9}), "
    r"int = (\d{1,6}(?:\.\d{1,6})?), stop = ([\w ]{1,40})"
)
_MONTHS = ("Jan", "Feb", "Mar", "Apr", "May", "Jun", "Jul", "Aug", "Sep", "Oct", "Nov", "Dec")


def sample(line: bytes, oxygen: bool, t: float, utc: float) -> CtdReading | None:
    """Return the sample of a line; None if it is none of as many values as the instrument has."""
    if not _SAMPLE.fullmatch(line) or len(line) != DIGITS * (4 if oxygen else 3):
        return None
    digits = [int(line[at : at + DIGITS], 16) for at in range(0, len(line), DIGITS)]
    values = {
        scale.name: float("inf") if number == _LARGEST else number / scale.divisor - scale.offset
        for number, scale in zip(digits, SCALES, strict=False)
    }
    good, refused = checked(values)
    return CtdReading(t, **good, refused=refused, utc=utc)


def sample_line(pressure: float, temperature: float, conductivity: float, oxygen: float | None = None) -> bytes:
    """Line of a sample, without its end; what it cannot say is its greatest number."""
    values = (pressure, temperature, conductivity, *(() if oxygen is None else (oxygen,)))
    numbers = (
        round((value + scale.offset) * scale.divisor) if value == value else _LARGEST  # noqa: PLR0124 - NaN
        for value, scale in zip(values, SCALES, strict=False)
    )
    return b"".join(b"%05X" % (number if 0 <= number < _LARGEST else _LARGEST) for number in numbers)


def cast_of(line: str) -> Cast | None:
    """Return the cast of a line of `UH`; None if it is none."""
    match = _CAST.fullmatch(line.strip())
    if match is None or match[3] not in _MONTHS:
        return None
    number, day, month, year, hour, minute, second, first, last, interval, stop = match.groups()
    if int(last) < int(first):
        return None
    moment = (int(year), _MONTHS.index(month) + 1, int(day), int(hour), int(minute), int(second))
    try:
        utc = float(timegm(moment))
    except (ValueError, OverflowError):
        return None
    return Cast(int(number), utc, int(first), int(last), float(interval), stop)
