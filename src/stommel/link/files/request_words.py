"""What lies in FILE_REQUEST: a flag, ranges as pairs of distance and size, and the number of its transfer."""

import zlib
from collections.abc import Iterable

from stommel.link.files.ranges import Range, Ranges

PROBE = 1
"""Flag: every so many segments, by their number, is half as long."""
MOST_RANGES = 60
"""Of a request."""
LONGEST = 0xFFFF
"""Bytes of a range, and of the distance to the next."""


def transfer_number(what: str, own: tuple[int, int], path: str) -> int:
    """Return the number of the transfer of a file: after a restart the same, so that what is on its way counts."""
    return zlib.crc32(f"{what} {own[0]} {own[1]} {path}".encode("utf-8", "replace")) % 0xFFFF + 1


def packed_ranges(ranges: Iterable[Range]) -> tuple[int, bytes]:
    """Return base and bytes of ranges that are in order and near each other."""
    found = list(ranges)
    if not found:
        return 0, b""
    base = at = found[0].first
    packed = bytearray()
    for first, last in found:
        packed += (first - at).to_bytes(2, "little") + (last - first).to_bytes(2, "little")
        at = last
    return base, bytes(packed)


def unpacked_ranges(base: int, count: int, packed: bytes) -> Ranges:
    """Return the ranges of a request; what is beyond 32 bits is left out."""
    found, at = Ranges(), base
    for k in range(min(count, len(packed) // 4, MOST_RANGES)):
        skip, size = (int.from_bytes(packed[4 * k + i : 4 * k + i + 2], "little") for i in (0, 2))
        at += skip
        if at + size > 0xFFFFFFFF:
            break
        found.add(at, at + size)
        at += size
    return found
