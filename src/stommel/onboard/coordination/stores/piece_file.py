"""The file of a mission on its way: what was announced, then piece after piece, each with its checksum.

Pieces are only added. A loss of power at any byte leaves the pieces before it; what follows the first that is not sound
is not read.
"""

import struct
from collections.abc import Iterator
from typing import NamedTuple
from zlib import crc32

_MAGIC = b"stommel reception 1\n"
_ANNOUNCED = struct.Struct("<I32s")
"""Bytes of the mission, and their SHA-256."""
_PIECE = struct.Struct("<II")
"""Place of the first byte, and number of bytes."""
_CHECK = struct.Struct("<I")
"""CRC-32 of the head and the bytes; of a piece, it begins from that of the announcement."""
_BEGIN = len(_MAGIC) + _ANNOUNCED.size + _CHECK.size

PIECE_OVERHEAD = _PIECE.size + _CHECK.size
"""Bytes that a piece takes beside its own."""


class PieceFile(NamedTuple):
    """What is sound of a file."""

    size: int
    """Bytes that were announced."""
    sha256: str
    pieces: tuple[tuple[int, bytes], ...]
    """Each with the place of its first byte; all within the size."""


def announcement(size: int, sha256: str) -> bytes:
    """First bytes of a file."""
    told = _ANNOUNCED.pack(size, bytes.fromhex(sha256))
    return _MAGIC + told + _CHECK.pack(crc32(told))


def piece(size: int, sha256: str, offset: int, data: bytes) -> bytes:
    """The bytes of one piece of the mission that was announced so."""
    body = _PIECE.pack(offset, len(data)) + data
    return body + _CHECK.pack(crc32(body, crc32(_ANNOUNCED.pack(size, bytes.fromhex(sha256)))))


def read_pieces(content: bytes) -> PieceFile | None:
    """Return what is sound of a file; None if not even the announcement is."""
    if len(content) < _BEGIN or not content.startswith(_MAGIC):
        return None
    told = content[len(_MAGIC) : len(_MAGIC) + _ANNOUNCED.size]
    check = crc32(told)
    if _CHECK.pack(check) != content[_BEGIN - _CHECK.size : _BEGIN]:
        return None
    size, digest = _ANNOUNCED.unpack(told)
    return PieceFile(size, digest.hex(), tuple(_sound(content, size, check)))


def _sound(content: bytes, size: int, check: int) -> Iterator[tuple[int, bytes]]:
    at = _BEGIN
    while at + PIECE_OVERHEAD < len(content):
        offset, length = _PIECE.unpack_from(content, at)
        end = at + _PIECE.size + length
        if length == 0 or offset + length > size or end + _CHECK.size > len(content):
            return
        if crc32(content[at:end], check) != _CHECK.unpack_from(content, end)[0]:
            return
        yield offset, content[at + _PIECE.size : end]
        at = end + _CHECK.size
