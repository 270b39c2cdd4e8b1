"""MAVLink 2 frames: out of a stream of bytes that may hold anything, and back into bytes."""

from typing import NamedTuple

from fastcrc import crc16

from stommel.link.versions import OtherVersions
from stommel.messages.mavlink import MessageType, message_types

MARK = 0xFD
HEAD = 10
"""Bytes before the payload."""
CHECKSUM = 2
SIGNATURE = 13
"""Bytes of a signature: link, time stamp, 48 bits of SHA-256."""
SIGNED = 0x01
"""The one incompatibility flag that we know; a frame with another is not understood and passed over."""


class RawFrame(NamedTuple):
    """A frame whose checksum is right; nobody has looked at its signature."""

    system: int
    component: int
    sequence: int
    message: MessageType
    payload: bytes
    raw: bytes
    """All of it, as it came."""

    @property
    def is_signed(self) -> bool:
        """Whether it carries a signature."""
        return bool(self.raw[2] & SIGNED)


class FrameSplitter:
    """Finds the frames in a stream, and counts what is none.

    What a wrong checksum has spoilt is searched again from the byte behind its mark, so that a frame that begins
    inside of it is not lost.
    """

    def __init__(self) -> None:
        self._rest = bytearray()
        self._in_garbage = False
        self.bad = 0
        """Frames with a wrong checksum, and stretches of bytes without any frame."""
        self.unknown = 0
        """Frames of a message that neither dialect has: their checksum cannot be told."""
        self.versions = OtherVersions()
        """Messages that the other end defines otherwise."""

    def take(self, data: bytes) -> list[RawFrame]:
        """Return the frames that are whole now."""
        rest = self._rest
        rest += data
        found: list[RawFrame] = []
        at = 0
        while (at := self._mark(at)) >= 0 and len(rest) - at >= HEAD:
            size = HEAD + rest[at + 1] + CHECKSUM + (SIGNATURE if rest[at + 2] & SIGNED else 0)
            if rest[at + 2] & ~SIGNED:
                at = self._pass_over(at)
                continue
            if len(rest) - at < size:
                break
            frame = self._frame(bytes(rest[at : at + size]))
            if frame is None:
                at = self._pass_over(at)
                continue
            found.append(frame)
            self._in_garbage = False
            at += size
        del rest[: len(rest) if at < 0 else at]
        return found

    @property
    def pending(self) -> int:
        """Bytes that may be the beginning of a frame."""
        return len(self._rest)

    def forget(self) -> list[RawFrame]:
        """Expect the rest of a frame no longer, after a silence; return frames that lay behind a false beginning."""
        found: list[RawFrame] = []
        while self._rest:
            self._pass_over(0)
            rest = bytes(self._rest[1:])
            self._rest.clear()
            found += self.take(rest)
        self._in_garbage = False
        return found

    def _mark(self, at: int) -> int:
        """Place of the next mark; -1 if there is none."""
        found = self._rest.find(MARK, at)
        if found != at and len(self._rest) > at and not self._in_garbage:
            self._in_garbage = True
            self.bad += 1
        return found

    def _pass_over(self, at: int) -> int:
        if not self._in_garbage:
            self._in_garbage = True
            self.bad += 1
        return at + 1

    def _frame(self, raw: bytes) -> RawFrame | None:
        """The frame of these bytes; None if its checksum is wrong or nobody knows it."""
        length = raw[1]
        message = message_types().get(raw[7] | raw[8] << 8 | raw[9] << 16)
        if message is None:
            self.unknown += 1
            return None
        end = HEAD + length
        told = raw[end] | raw[end + 1] << 8
        if checksum(raw[1:end], message.crc_extra) != told:
            self.versions.look(message.name, raw[1:end], told)
            return None
        return RawFrame(raw[5], raw[6], raw[4], message, raw[HEAD:end], raw)


def frame_bytes(
    message: MessageType, payload: bytes, system: int, component: int, sequence: int, *, signed: bool = False
) -> bytes:
    """Return a frame without its signature; whoever says `signed` appends it."""
    number = message.id
    body = bytes((
        len(payload), SIGNED if signed else 0, 0, sequence, system, component,
        number & 0xFF, number >> 8 & 0xFF, number >> 16,
    ))  # fmt: skip
    body += payload
    return bytes((MARK,)) + body + checksum(body, message.crc_extra).to_bytes(2, "little")


def checksum(body: bytes, extra: int) -> int:
    """CRC-16/MCRF4XX over all but the mark, and the message's extra byte."""
    found: int = crc16.mcrf4xx(body + bytes((extra,)))
    return found
