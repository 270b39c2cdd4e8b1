"""How records become bytes: sync word, kind, length, sequence number, payload, checksum; and the header of a file."""

import json
import struct
from collections.abc import Callable
from dataclasses import asdict, dataclass
from typing import Any
from zlib import crc32

from stommel.onboard.coordination.logbook.records import BYTES, KINDS, SERIES, TEXT, RecordKind

MAGIC = b"stommel log 1\n"
"""First bytes of a file."""
SYNC = b"\xd5\xaa"
"""First bytes of a record."""
HEADER_KIND = 0
"""Kind of the one record that is the file's header, in JSON."""
HEAD = struct.Struct("<2sBHI")
"""Sync word, kind, length of the payload [bytes], sequence number."""
TAIL = struct.Struct("<I")
"""CRC-32 of all between the sync word and itself."""
LONGEST_PAYLOAD = 0xFFFF
"""[bytes]"""
SEQUENCES = 1 << 32

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


def header(identity: LogIdentity, restarts: int, series: int, first_sequence: int) -> bytes:
    """First bytes of a file, which tell all that is needed to read it.

    Parameters
    ----------
    restarts
        How often the software has started before.
    series
        `ESSENTIAL`, `DETAIL` or `RAW`.
    first_sequence
        Sequence number of the file's first record.
    """
    told = asdict(identity) | {
        "restarts": restarts,
        "series": SERIES[series],
        "first_sequence": first_sequence,
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
