"""How long a NetCDF file of a classic format must be: where one was cut short, its library reads zeros silently.

The format is that of the NetCDF User's Guide, appendix "File Format Specifications": classic (CDF-1), 64-bit offset
(CDF-2) and 64-bit data (CDF-5). Files of the format NetCDF-4 are HDF5, whose library refuses them itself.
"""

from dataclasses import dataclass
from math import prod
from pathlib import Path
from typing import BinaryIO

_SIZES = {1: 1, 2: 1, 3: 2, 4: 4, 5: 4, 6: 8, 7: 1, 8: 2, 9: 4, 10: 8, 11: 8}
"""Bytes of a value by the number of its type."""
_MOST = 1 << 40


@dataclass
class _Header:
    """A header that is read from its beginning to its end."""

    stream: BinaryIO
    wide: int
    """Bytes of a count: 8 in CDF-5, else 4."""
    offset: int
    """Bytes of a place in the file: 4 in CDF-1, else 8."""

    def number(self, width: int) -> int:
        found = self.stream.read(width)
        if len(found) < width:
            raise EOFError
        return int.from_bytes(found, "big")

    def count(self) -> int:
        return self.number(self.wide)

    def skip(self, length: int) -> None:
        """Skip bytes, which are filled up to a multiple of 4."""
        if length > _MOST:
            raise EOFError
        self.stream.seek(-(-length // 4) * 4, 1)

    def name(self) -> None:
        self.skip(self.count())

    def attributes(self) -> None:
        self.number(4)
        for _ in range(self.count()):
            self.name()
            size = _SIZES.get(self.number(4), 1)
            self.skip(size * self.count())

    def dimensions(self) -> list[int]:
        self.number(4)
        lengths = []
        for _ in range(self.count()):
            self.name()
            lengths.append(self.count())
        return lengths

    def variable(self, lengths: list[int]) -> tuple[int, int, bool]:
        """Where a variable begins, its bytes (of one record), and whether it has records."""
        self.name()
        dims = [self.count() for _ in range(self.count())]
        self.attributes()
        size = _SIZES.get(self.number(4), 1)
        self.number(self.wide)
        begin = self.number(self.offset)
        records = bool(dims) and lengths[dims[0]] == 0
        return begin, size * prod(lengths[d] for d in dims[int(records) :]), records


def expected_length(path: Path) -> int | None:
    """Least length of a file of a classic format by its own header [bytes]; none for other files.

    A header that itself was cut short is expected to be longer than the file.
    """
    with path.open("rb") as stream:
        magic = stream.read(4)
        if len(magic) < 4 or magic[:3] != b"CDF" or magic[3] not in (1, 2, 5):
            return None
        header = _Header(stream, 8 if magic[3] == 5 else 4, 4 if magic[3] == 1 else 8)
        try:
            return _end(header)
        except (EOFError, IndexError):
            return path.stat().st_size + 1


def _end(header: _Header) -> int:
    records = header.count()
    lengths = header.dimensions()
    header.attributes()
    header.number(4)
    variables = [header.variable(lengths) for _ in range(header.count())]
    end = max((begin + size for begin, size, recorded in variables if not recorded), default=0)
    recorded = [(begin, size) for begin, size, has_records in variables if has_records]
    unknown = (1 << (8 * header.wide)) - 1
    if not recorded or records in (0, unknown):
        return end
    # a single variable with records is not filled up between them
    step = recorded[0][1] if len(recorded) == 1 else sum(-(-size // 4) * 4 for _, size in recorded)
    return max(end, *(begin + (records - 1) * step + size for begin, size in recorded))
