"""Words of MAVLink FTP: what lies in the payload of FILE_TRANSFER_PROTOCOL.

Source: mavlink.io/en/services/ftp.html. 12 bytes of header, little-endian, then up to 239 of data.
"""

import struct
from enum import IntEnum
from typing import NamedTuple

from stommel.link.files.port import FtpError

MESSAGE = "FILE_TRANSFER_PROTOCOL"
MOST_DATA = 239
_HEADER = struct.Struct("<HBBBBBxI")


class Opcode(IntEnum):
    """What is asked or answered."""

    NONE = 0
    TERMINATE_SESSION = 1
    RESET_SESSIONS = 2
    LIST_DIRECTORY = 3
    OPEN_FILE_RO = 4
    READ_FILE = 5
    CREATE_FILE = 6
    WRITE_FILE = 7
    REMOVE_FILE = 8
    CREATE_DIRECTORY = 9
    REMOVE_DIRECTORY = 10
    OPEN_FILE_WO = 11
    TRUNCATE_FILE = 12
    RENAME = 13
    CALC_FILE_CRC32 = 14
    BURST_READ_FILE = 15
    ACK = 128
    NAK = 129


class Words(NamedTuple):
    """A question or an answer."""

    sequence: int
    session: int
    opcode: int
    size: int = 0
    """Bytes of data; in a question for data, how many are wanted."""
    asked: int = 0
    """In an answer: the opcode of the question."""
    burst_complete: bool = False
    offset: int = 0
    data: bytes = b""

    @property
    def text(self) -> str:
        """The data as a path; what is behind a zero does not count."""
        return self.data.split(b"\0", 1)[0].decode("utf-8", "replace")


def unpacked(payload: bytes) -> Words | None:
    """Return the words of a payload; None if it is none."""
    if len(payload) < _HEADER.size:
        payload = payload.ljust(_HEADER.size, b"\0")
    sequence, session, opcode, size, asked, complete, offset = _HEADER.unpack_from(payload)
    if size > MOST_DATA:
        return None
    data = payload[_HEADER.size : _HEADER.size + size]
    return Words(sequence, session, opcode, size, asked, bool(complete), offset, data)


def packed(words: Words) -> bytes:
    """Return the payload of words."""
    sequence, session, opcode, size, asked, complete, offset, data = words
    return _HEADER.pack(sequence, session, opcode, size, asked, complete, offset) + data


def acknowledgement(question: Words, data: bytes = b"", *, session: int | None = None) -> Words:
    """Return the answer of a question that was obeyed; its sequence is one higher."""
    return Words(
        (question.sequence + 1) & 0xFFFF,
        question.session if session is None else session,
        Opcode.ACK,
        len(data),
        question.opcode,
        False,
        question.offset,
        data,
    )


def refusal(question: Words, code: FtpError) -> Words:
    """Return the answer of a question that was not obeyed."""
    data = bytes((code,)) + (b"\0" if code is FtpError.FAIL_ERRNO else b"")
    return acknowledgement(question, data)._replace(opcode=Opcode.NAK)
