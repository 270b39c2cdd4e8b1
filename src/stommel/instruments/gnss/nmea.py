"""Sentences of NMEA 0183: read by pynmeagps, and written for the simulated receiver."""

import math
import re
from datetime import UTC, date, datetime
from datetime import time as time_of_day
from functools import reduce
from operator import xor
from typing import Any

from pynmeagps import VALNONE, NMEAReader
from pynmeagps.exceptions import NMEAMessageError, NMEAParseError, NMEATypeError

READ = {"GGA": 8, "RMC": 9, "ZDA": 4, "GSA": 16, "VTG": 6}
"""Sentences that are read, with the fewest fields that say what is asked of them; others pass by."""
_CHECKED = re.compile(rb"\$[A-Z0-9]{3,}[ -)+-~]*\*[0-9A-Fa-f]{2}\r\n")
KNOT = 1852.0 / 3600.0
"""[m/s]"""


def checksum(content: bytes) -> int:
    """Checksum of what stands between `$` and `*`."""
    return reduce(xor, content, 0)


def believed(sentence: bytes) -> bool:
    """Whether a sentence has a checksum and it is right."""
    return _CHECKED.fullmatch(sentence) is not None and checksum(sentence[1:-5]) == int(sentence[-4:-2], 16)


def kind_of(sentence: bytes) -> str:
    """Which sentence it is, of any talker."""
    return sentence[3:6].decode("ascii")


def parsed(sentence: bytes) -> Any | None:
    """Return one of the sentences `READ` that is `believed`, with its fields; None where they make no sense."""
    if sentence.count(b",") < READ[kind_of(sentence)]:
        return None
    try:
        return NMEAReader.parse(sentence, validate=VALNONE)
    except (NMEAParseError, NMEATypeError, NMEAMessageError, ValueError, LookupError, ArithmeticError):
        return None


def number(value: object) -> float | None:
    """Return a field that is a number; pynmeagps has an empty one as text."""
    return float(value) if isinstance(value, int | float) and math.isfinite(value) else None


def second_of_day(value: object) -> float | None:
    """Return a field that is a time of day [s]."""
    if not isinstance(value, time_of_day):
        return None
    return value.hour * 3600.0 + value.minute * 60.0 + value.second + value.microsecond * 1e-6


def midnight(day: object) -> float | None:
    """Return a field that is a date as seconds since 1970."""
    if not isinstance(day, date):
        return None
    return datetime(day.year, day.month, day.day, tzinfo=UTC).timestamp()


def sentence(content: str) -> bytes:
    """Bytes of a sentence: what stands between `$` and `*`, with its checksum and line end."""
    data = content.encode("ascii")
    return b"$%b*%02X\r\n" % (data, checksum(data))


def angle(degrees: float, digits: int, positive: str, negative: str) -> str:
    """Latitude or longitude in degrees and minutes, with its letter after a comma."""
    minutes = round(abs(degrees) * 60.0 * 1e6)
    whole, rest = divmod(minutes, 60_000_000)
    return f"{whole:0{digits}d}{rest / 1e6:09.6f},{negative if degrees < 0.0 else positive}"
