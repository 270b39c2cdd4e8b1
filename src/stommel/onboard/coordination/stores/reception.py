"""A mission on its way: pieces in any order, some of them twice, until all are there and the hash is right."""

import hashlib

from stommel.errors import StommelError
from stommel.files.opening import TOML_MIB

MOST_BYTES = TOML_MIB << 20
"""Of a mission."""


class ReceptionError(StommelError):
    """A piece, or the whole, is not what was announced."""


class Reception:
    """Bytes that were announced by their number and SHA-256."""

    def __init__(self, size: int, sha256: str) -> None:
        if not 0 < size <= MOST_BYTES:
            raise ReceptionError(f"mission: size = {size}: must be between 1 and {MOST_BYTES} bytes")
        if len(sha256) != 64 or set(sha256) - set("0123456789abcdef"):
            raise ReceptionError("mission: sha256: must be a SHA-256 digest, 64 digits and letters a to f")
        self.sha256 = sha256
        self.size = size
        self._data = bytearray(size)
        self._missing = [(0, size)]

    @property
    def held(self) -> list[tuple[int, bytes]]:
        """Every run of bytes that are there, with its first byte's place."""
        ends = [0, *(end for gap in self._missing for end in gap), self.size]
        runs = zip(ends[::2], ends[1::2], strict=True)
        return [(first, bytes(self._data[first:last])) for first, last in runs if first < last]

    @property
    def missing(self) -> list[tuple[int, int]]:
        """First byte and the one behind the last of every gap."""
        return list(self._missing)

    def take(self, offset: int, piece: bytes) -> list[tuple[int, bytes]]:
        """Take a piece, and return what was missing of it, with its place; one that comes again changes nothing.

        Raises
        ------
        ReceptionError
            It lies outside of what was announced.
        """
        end, size = offset + len(piece), len(self._data)
        if offset < 0 or end > size:
            raise ReceptionError(f"mission: piece of bytes {offset} to {end}: must lie within 0 to {size}")
        new, gaps = [], []
        for first, last in self._missing:
            low, high = max(first, offset), min(last, end)
            if low < high:
                new.append((low, piece[low - offset : high - offset]))
            gaps += [(first, min(last, offset)), (max(first, end), last)]
        self._missing = [(first, last) for first, last in gaps if first < last]
        for place, run in new:
            self._data[place : place + len(run)] = run
        return new

    def whole(self) -> bytes:
        """All bytes.

        Raises
        ------
        ReceptionError
            Some are missing, or the hash is another: then all have to come again.
        """
        if self._missing:
            count = sum(last - first for first, last in self._missing)
            raise ReceptionError(f"mission: {count} of {len(self._data)} bytes are missing")
        found = hashlib.sha256(self._data).hexdigest()
        if found != self.sha256:
            self._missing = [(0, len(self._data))]
            told = f"sha256 = {found[:12]}..., not {self.sha256[:12]}..."
            raise ReceptionError(f"mission: what has come is not the file that was sent; send it again ({told})")
        return bytes(self._data)
