"""How records become bytes: sync word, kind, length, sequence number, payload, checksum; and the header of a file."""

import json
import struct
from collections.abc import Callable
from dataclasses import asdict, dataclass
from typing import Any, NamedTuple
from zlib import crc32

from stommel.messages.log.layout import BYTES, HEAD, HEADER_KIND, LONGEST_PAYLOAD, MAGIC, SERIES, SYNC, TAIL, TEXT
from stommel.onboard.coordination.logbook.records import KINDS, RecordKind

Encoder = Callable[[int, tuple[Any, ...]], bytes]
"""From a sequence number and values to the bytes of a record."""


@dataclass(frozen=True)
class LogIdentity:
    """What writes a log."""

    software: str
    """Version of stommel."""
    database_hash: int
    """Of the CAN database, `stommel.messages.database.database_hash`."""
    vehicle: str = ""
    """Name."""
    started: float | None = None
    """When the software started [s since 1970-01-01 UTC]; None if it did not know."""


def framed(kind: int, sequence: int, payload: bytes) -> bytes:
    """The bytes of a record."""
    body = HEAD.pack(SYNC, kind, len(payload), sequence)[2:] + payload
    return SYNC + body + TAIL.pack(crc32(body))


class ClockReading(NamedTuple):
    """What the vehicle's clock showed when a file was begun: by it the times of the file's records are dated."""

    t: float
    """Time of the software [s]."""
    utc: float
    """[s since 1970]"""


def header(
    identity: LogIdentity, restarts: int, series: int, first_sequence: int, clock: ClockReading | None = None
) -> bytes:
    """First bytes of a file, which tell all that is needed to read it.

    Parameters
    ----------
    restarts
        How often the software has started before.
    series
        `ESSENTIAL`, `DETAIL` or `RAW`.
    first_sequence
        Sequence number of the file's first record.
    clock
        None where there is no clock.
    """
    told = asdict(identity) | {
        "restarts": restarts,
        "series": SERIES[series],
        "first_sequence": first_sequence,
        "clock": None if clock is None else clock._asdict(),
        "kinds": [_described(kind) for kind in KINDS if kind.series == series],
    }
    return MAGIC + framed(HEADER_KIND, 0, json.dumps(told, separators=(",", ":")).encode())


def _described(kind: RecordKind) -> dict[str, Any]:
    fields = [{key: value for key, value in asdict(field).items() if value} for field in kind.fields]
    return {"number": kind.number, "name": kind.name, "meaning": kind.meaning, "fields": fields}


def encoder(kind: RecordKind) -> Encoder:
    """How records of a kind are made; worked out once, since a record must take microseconds."""
    open_end = kind.fields[-1].format in (TEXT, BYTES)
    fixed = kind.fields[:-1] if open_end else kind.fields
    packed = struct.Struct("<BHI" + "".join(field.format for field in fixed))
    number, size = kind.number, packed.size - 7
    texts = [i for i, field in enumerate(fixed) if field.format.endswith("s")]

    def plain(sequence: int, values: tuple[Any, ...]) -> bytes:
        body = packed.pack(number, size, sequence, *values)
        return SYNC + body + crc32(body).to_bytes(4, "little")

    def ended(sequence: int, values: tuple[Any, ...]) -> bytes:
        *first, last = values
        for i in texts:
            first[i] = _cut(first[i].encode(), int(fixed[i].format[:-1]))
        tail = _cut(last.encode() if isinstance(last, str) else bytes(last), LONGEST_PAYLOAD - size)
        body = packed.pack(number, size + len(tail), sequence, *first) + tail
        return SYNC + body + crc32(body).to_bytes(4, "little")

    return ended if open_end else plain


def _cut(content: bytes, longest: int) -> bytes:
    return content[:longest]
