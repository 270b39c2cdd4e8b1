"""Reading a log's file: its valid beginning, what is wrong behind it, and on demand what comes after that."""

import json
import re
import struct
from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Any, NamedTuple
from zlib import crc32

from stommel.errors import FileError, Problem
from stommel.messages.log.layout import BYTES, HEAD, HEADER_KIND, MAGIC, SEQUENCES, SYNC, TAIL, TEXT

WHOLE, TRUNCATED, CORRUPT = "whole", "truncated", "corrupt"
"""A file ends with its last record; within one, as after a loss of power; or it holds what no log has written."""

_FORMAT = re.compile(rf"[?bBhHiIqQfd]|[1-9]\d?s|{TEXT}|{BYTES}")


class Record(NamedTuple):
    """One record."""

    kind: str
    sequence: int
    offset: int
    """Of its first byte in the file."""
    values: tuple[Any, ...]
    """In the order of the kind's fields."""


@dataclass(frozen=True)
class ReadKind:
    """A kind of record, as the file's header describes it."""

    name: str
    meaning: str
    fields: tuple[dict[str, Any], ...]
    """Of each at least `name` and `format`; `unit`, `meaning` and `words` where it has them."""
    packed: struct.Struct
    open_end: str
    """`TEXT` or `BYTES` if the last field has no fixed length, else empty."""

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the fields."""
        return tuple(str(told["name"]) for told in self.fields)

    def values(self, payload: bytes) -> tuple[Any, ...]:
        """Values of a record; raises struct.error if the payload is not of this kind."""
        if not self.open_end and len(payload) != self.packed.size:
            raise struct.error("length")
        values = [
            value.rstrip(b"\0").decode(errors="replace") if isinstance(value, bytes) else value
            for value in self.packed.unpack_from(payload)
        ]
        if self.open_end:
            rest = payload[self.packed.size :]
            values.append(rest.decode(errors="replace") if self.open_end == TEXT else rest)
        return tuple(values)


@dataclass
class LogContents:
    """What a file of a log holds."""

    header: dict[str, Any] = field(default_factory=dict)
    """What wrote it; empty if that is not readable."""
    kinds: dict[int, ReadKind] = field(default_factory=dict)
    records: list[Record] = field(default_factory=list)
    status: str = WHOLE
    offset: int = 0
    """Where the valid beginning ends [byte]."""
    valid_records: int = 0
    """In the valid beginning."""
    missing: int = 0
    """Sequence numbers that are left out."""
    skipped_bytes: int = 0
    """Without a valid record, among those that were read."""

    @property
    def verdict(self) -> str:
        """The status in words."""
        if self.status == WHOLE:
            return f"whole, {self.valid_records} records"
        behind = len(self.records) - self.valid_records
        more = f"; {behind} more records behind it" if behind else ""
        return f"{self.status} after record {self.valid_records} at byte {self.offset}{more}"

    def columns(self, kind: str) -> dict[str, list[Any]]:
        """Values of one kind of record, as a list for each field."""
        names = next((known.names for known in self.kinds.values() if known.name == kind), ())
        rows = [record.values for record in self.records if record.kind == kind]
        return {name: [row[i] for row in rows] for i, name in enumerate(names)}


class _Frame(NamedTuple):
    kind: int
    sequence: int
    payload: bytes
    end: int


def read_log(data: bytes, origin: str = "log", resynchronise: bool = False) -> LogContents:
    """Read a file of a log; `origin` names it in messages.

    Parameters
    ----------
    resynchronise
        Whether to go on behind what is corrupt, with the next record whose checksum is right.

    Raises
    ------
    FileError
        It is no log.
    """
    contents, first = opened_log(data, origin)
    if contents.header:
        contents.records = list(records_of(contents, data, first, resynchronise))
    return contents


def opened_log(data: bytes, origin: str = "log") -> tuple[LogContents, int]:
    """Read the header alone; also where the first record begins [byte].

    A header that cannot be read leaves the contents without kinds, and says in them what is wrong.

    Raises
    ------
    FileError
        It is no log.
    """
    contents = LogContents()
    if not data.startswith(MAGIC):
        if not MAGIC.startswith(data.rstrip(b"\0")):
            raise FileError([Problem(origin, "", "is no log of a vehicle: it does not begin with 'stommel log 1'")])
        contents.status = TRUNCATED
        return contents, len(data)
    first = _frame(data, len(MAGIC))
    if first is None or not _take_header(contents, first):
        contents.offset = len(MAGIC)
        contents.status = CORRUPT if first is not None else _status_at(data, len(MAGIC))
        contents.skipped_bytes = len(data) - len(MAGIC)
        return contents, len(data)
    return contents, first.end


def _take_header(contents: LogContents, frame: _Frame) -> bool:
    if frame.kind != HEADER_KIND:
        return False
    try:
        told = json.loads(frame.payload)
        kinds = {int(kind["number"]): _kind(kind) for kind in told["kinds"]}
        int(told["first_sequence"]), str(told["series"]), str(told["software"])
    except (ValueError, TypeError, KeyError, struct.error, RecursionError):
        return False
    contents.header, contents.kinds = {key: value for key, value in told.items() if key != "kinds"}, kinds
    return True


def _kind(told: dict[str, Any]) -> ReadKind:
    fields = tuple(dict(one) for one in told["fields"])
    formats = [str(one["format"]) for one in fields]
    open_end = formats[-1] if formats[-1] in (TEXT, BYTES) else ""
    fixed = formats[:-1] if open_end else formats
    if not all(_FORMAT.fullmatch(one) for one in formats) or TEXT in fixed or BYTES in fixed:
        raise ValueError("format")
    packed = struct.Struct("<" + "".join(fixed))
    return ReadKind(str(told["name"]), str(told.get("meaning", "")), fields, packed, open_end)


def records_of(contents: LogContents, data: bytes, offset: int, resynchronise: bool = False) -> Iterator[Record]:
    """Read record by record from where one begins; `contents` learns of each what is missing, and at the end the rest.

    Parameters
    ----------
    contents
        Of the header, from `opened_log`.
    data
        The whole file.
    offset
        Of the first record, or of a later one [byte].
    resynchronise
        Whether to go on behind what is corrupt.
    """
    expected, good, count = _first_sequence(contents, data, offset), True, 0
    while offset < len(data):
        frame = _frame(data, offset)
        record = _record(contents, frame, offset) if frame is not None else None
        if frame is None or record is None:
            if good:
                good, contents.offset, contents.valid_records = False, offset, count
                contents.status = CORRUPT if frame is not None else _status_at(data, offset)
            behind = _next_valid(data, offset + 1) if resynchronise else len(data)
            contents.skipped_bytes += behind - offset
            offset = behind
            continue
        contents.missing += (frame.sequence - expected) % SEQUENCES
        expected = (frame.sequence + 1) % SEQUENCES
        offset, count = frame.end, count + 1
        yield record
    if good:
        contents.offset, contents.valid_records = offset, count


def _first_sequence(contents: LogContents, data: bytes, offset: int) -> int:
    """Sequence number that the record at an offset should have: of the file's first, that of its header."""
    frame = _frame(data, offset)
    first = _frame(data, len(MAGIC))
    if (first is not None and first.end == offset) or frame is None:
        return int(contents.header["first_sequence"])
    return frame.sequence


def _record(contents: LogContents, frame: _Frame, offset: int) -> Record | None:
    """A record; None if its payload is not what its kind says. One of an unknown kind is its plain bytes."""
    kind = contents.kinds.get(frame.kind)
    if kind is None:
        return Record(f"kind {frame.kind}", frame.sequence, offset, (frame.payload,))
    try:
        return Record(kind.name, frame.sequence, offset, kind.values(frame.payload))
    except struct.error:
        return None


def _frame(data: bytes, offset: int) -> _Frame | None:
    """Whole record at an offset, if its checksum is right."""
    if len(data) - offset < HEAD.size + TAIL.size:
        return None
    sync, kind, length, sequence = HEAD.unpack_from(data, offset)
    end = offset + HEAD.size + length + TAIL.size
    if sync != SYNC or end > len(data):
        return None
    body = data[offset + len(SYNC) : end - TAIL.size]
    if crc32(body) != TAIL.unpack_from(data, end - TAIL.size)[0]:
        return None
    return _Frame(kind, sequence, body[HEAD.size - len(SYNC) :], end)


def _next_valid(data: bytes, offset: int) -> int:
    """Offset of the next record whose checksum is right; the end if there is none."""
    while True:
        offset = data.find(SYNC, offset)
        if offset < 0:
            return len(data)
        if _frame(data, offset) is not None:
            return offset
        offset += 1


def _status_at(data: bytes, offset: int) -> str:
    """Whether what no record begins at is one that was cut off, or something else.

    A file system may have given the file its length before its content: zeros behind the cut are part of it.
    """
    rest = data[offset:].rstrip(b"\0")
    begun = rest.startswith(SYNC[: len(rest)]) if len(rest) < len(SYNC) else rest.startswith(SYNC)
    unfinished = len(rest) < HEAD.size or HEAD.size + HEAD.unpack_from(rest)[2] + TAIL.size > len(rest)
    if begun and unfinished and _next_valid(data, offset + 1) == len(data):
        return TRUNCATED
    return CORRUPT
