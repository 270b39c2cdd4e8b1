"""Logs to bytes and back.

ASCII: `#NAMEA,header;body*CRC`; binary: `AA 44 12`, a header of 28 bytes, body, CRC. The CRC-32 is the reflected
polynomial 0xEDB88320 from zero and without a final inversion, over what stands between `#` and `*`, or before it.
"""

import struct
from typing import NamedTuple
from zlib import crc32

from stommel.instruments.gnss.novatel.logs import BY_NAME, BY_NUMBER, BY_TYPE, LAYOUTS, Header, Layout, Log
from stommel.instruments.gnss.novatel.words import PORT, TIME_STATUS

SYNC = b"\xaa\x44\x12"
_HEADER = struct.Struct("<3sBHBBHHBBHIIHH")
HEADER_SIZE = _HEADER.size
_ALL_ONES = 0xFFFFFFFF
SIZES = {layout.number: HEADER_SIZE + layout.form.size + 4 for layout in LAYOUTS}
"""Bytes of each log in binary, CRC included."""


class Message(NamedTuple):
    """A log and what stands before it."""

    header: Header
    log: Log


def crc(data: bytes) -> int:
    """NovAtel's CRC-32 of some bytes."""
    return crc32(data, _ALL_ONES) ^ _ALL_ONES


def to_binary(message: Message) -> bytes:
    """Bytes of a log in binary."""
    header, log = message
    layout = BY_TYPE[type(log)]
    values = [value.encode("ascii") if isinstance(value, str) else value for value in log]
    head = _HEADER.pack(
        *(SYNC, HEADER_SIZE, layout.number, 0, header.port, layout.form.size, header.sequence),
        *(round(2.0 * header.idle), header.time_status, header.week, header.ms, header.receiver_status),
        *(header.definition, header.version),
    )
    data = head + layout.form.pack(*values)
    return data + crc(data).to_bytes(4, "little")


def whole(data: bytes) -> bool:
    """Whether the CRC of a binary log is right."""
    return crc(data[:-4]) == int.from_bytes(data[-4:], "little")


def from_binary(data: bytes) -> Message | None:
    """Return the log of `SIZES` bytes; None if its CRC is wrong."""
    if not whole(data):
        return None
    head = _HEADER.unpack_from(data)
    _, _, number, _, port, _, sequence, idle, time_status, week, ms, status, definition, version = head
    layout = BY_NUMBER[number]
    values = [
        value.rstrip(b"\0").decode("ascii", "replace") if isinstance(value, bytes) else value
        for value in layout.form.unpack_from(data, HEADER_SIZE)
    ]
    header = Header(week, ms, time_status, port, sequence, idle / 2.0, status, definition, version)
    return Message(header, layout.make(*values))


def to_ascii(message: Message) -> bytes:
    """Bytes of a log in ASCII, with its line end."""
    header, log = message
    layout = BY_TYPE[type(log)]
    fields = ",".join(field.written(value) for field, value in zip(layout.fields, log, strict=True))
    text = (
        f"{layout.name}A,{PORT.word(header.port)},{header.sequence},{header.idle:.1f},"
        f"{TIME_STATUS.word(header.time_status)},{header.week},{header.ms / 1000.0:.3f},"
        f"{header.receiver_status:08x},{header.definition:04x},{header.version};{fields}"
    ).encode("ascii")
    return b"#%b*%08x\r\n" % (text, crc(text))


def from_ascii(line: bytes) -> Message | None:
    """Return the log of a line that begins with #; None if it has no right CRC, or is none that is known."""
    text, star, said = line.rstrip(b"\r\n").partition(b"*")
    if not star or len(said) != 8:
        return None
    try:
        if crc(text[1:]) != int(said, 16):
            return None
        head, _, body = text[1:].decode("ascii").partition(";")
        name, *rest = head.split(",")
        layout = BY_NAME.get(name[:-1]) if name.endswith("A") else None
        return Message(_header(rest), _body(layout, body)) if layout else None
    except (ValueError, OverflowError):
        return None


def _header(fields: list[str]) -> Header:
    port, sequence, idle, time_status, week, seconds, status, definition, version = fields
    return Header(
        int(week),
        round(float(seconds) * 1000.0),
        TIME_STATUS.number(time_status),
        PORT.number(port),
        int(sequence),
        float(idle),
        int(status, 16),
        int(definition, 16),
        int(version),
    )


def _body(layout: Layout, body: str) -> Log:
    texts = body.split(",")
    return layout.make(*(field.read(text) for field, text in zip(layout.fields, texts, strict=True)))
