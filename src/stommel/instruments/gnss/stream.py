"""What a receiver sends, cut into lines and binary logs."""

import re
from enum import Enum
from typing import NamedTuple

from stommel.instruments.gnss.novatel.codec import HEADER_SIZE, SIZES, SYNC, whole


class Kind(Enum):
    """What a piece is."""

    NMEA = b"$"
    """A sentence, not yet believed."""
    ASCII = b"#"
    """A log of NovAtel's in ASCII, not yet believed."""
    BINARY = b"\xaa"
    """One in binary, with a right CRC."""
    ANSWER = b"<"
    """The answer to a command, or the prompt after it."""


class Piece(NamedTuple):
    """One line with its end, or one binary log."""

    kind: Kind
    data: bytes


LONGEST_LINE = 400
"""Bytes; NMEA allows 82, a BESTPOS in ASCII has 200."""
_BEGINNING = re.compile(rb"[$#<[]|\xaa")
_PROMPT = re.compile(rb"\[COM[1-3]\]")
_LINE = re.compile(rb"[$#<][ -\"%-~]{0,397}")  # also cut short before $ and #, which begin the next
_OPENING = ord("[")
_END = b"\r\n"
_KINDS = {kind.value[0]: kind for kind in Kind}
_BODY = {number: size - HEADER_SIZE - 4 for number, size in SIZES.items()}


def look(buffer: bytes, at: int) -> tuple[Piece | None, int] | None:
    """Look for a piece, as `framing.Framer` asks."""
    first = buffer[at]
    if first == SYNC[0]:
        return _binary(buffer, at)
    if first == _OPENING:
        return _prompt(buffer, at)
    if first not in _KINDS:
        later = _BEGINNING.search(buffer, at)
        return None, later.start() if later else len(buffer)
    match = _LINE.match(buffer, at)
    assert match is not None
    end = match.end()
    if buffer.startswith(_END, end):
        return Piece(_KINDS[first], buffer[at : end + 2]), end + 2
    rest = buffer[end : end + 2]
    if _END.startswith(rest) and end - at < LONGEST_LINE - 2:
        return None
    return None, end


def _prompt(buffer: bytes, at: int) -> tuple[Piece | None, int] | None:
    match = _PROMPT.match(buffer, at)
    if match:
        return Piece(Kind.ANSWER, match[0]), match.end()
    return None if b"[COM".startswith(buffer[at : at + 6][:4]) and len(buffer) - at < 6 else (None, at + 1)


def _binary(buffer: bytes, at: int) -> tuple[Piece | None, int] | None:
    head = buffer[at : at + 10]
    if not (SYNC.startswith(head[:3]) or head.startswith(SYNC)):
        return None, at + 1
    if len(head) < 10:
        return None
    number = int.from_bytes(head[4:6], "little")
    body = int.from_bytes(head[8:10], "little")
    if head[3] != HEADER_SIZE or _BODY.get(number) != body:
        return None, at + 1
    end = at + SIZES[number]
    if end > len(buffer):
        return None
    if not whole(buffer[at:end]):
        return None, at + 1  # it may hide the log after one that was cut short
    return Piece(Kind.BINARY, buffer[at:end]), end
