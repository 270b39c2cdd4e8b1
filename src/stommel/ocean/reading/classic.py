"""How long a NetCDF file of a classic format must be, and whether its header agrees with itself.

Where a file was cut short, its library reads zeros silently; where a bit of the header was flipped, other numbers.

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
_LONGEST_NAME = 1 << 16


_UNKNOWN = (1 << 32) - 1
"""Size of a variable that is too large for its four bytes."""


class HeaderDamageError(Exception):
    """A header whose parts contradict each other."""


@dataclass(frozen=True)
class _Variable:
    """Where the numbers of a variable lie."""

    name: str
    begin: int
    size: int
    """Bytes by its dimensions and type, of one record."""
    stated: int
    """The same, filled up to a multiple of 4, as the header says it."""
    recorded: bool

    @property
    def filled(self) -> int:
        return -(-self.size // 4) * 4


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
        """Skip bytes, which are filled up with zeros to a multiple of 4."""
        if length > _MOST:
            raise EOFError
        self.stream.seek(length, 1)
        if self.number(-length % 4):
            raise HeaderDamageError("a name or an attribute is longer than its header says")

    def name(self) -> str:
        length = self.count()
        if length > _LONGEST_NAME:
            raise EOFError
        found = self.stream.read(length)
        if self.number(-length % 4):
            raise HeaderDamageError("a name is longer than its header says")
        return found.decode("utf-8", "replace")

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

    def variable(self, lengths: list[int]) -> _Variable:
        name = self.name()
        dims = [self.count() for _ in range(self.count())]
        self.attributes()
        size = _SIZES.get(self.number(4), 1)
        stated = self.number(self.wide)
        begin = self.number(self.offset)
        recorded = bool(dims) and lengths[dims[0]] == 0
        return _Variable(name, begin, size * prod(lengths[d] for d in dims[int(recorded) :]), stated, recorded)


def expected_length(path: Path) -> int | None:
    """Least length of a file of a classic format by its own header [bytes]; none for other files.

    A header that itself was cut short is expected to be longer than the file.

    Raises
    ------
    HeaderDamageError
        What the header says of a variable twice differs, variables lie over each other, or there are more records than
        it counts.
    """
    with path.open("rb") as stream:
        magic = stream.read(4)
        if len(magic) < 4 or magic[:3] != b"CDF" or magic[3] not in (1, 2, 5):
            return None
        header = _Header(stream, 8 if magic[3] == 5 else 4, 4 if magic[3] == 1 else 8)
        try:
            return _end(header, path.stat().st_size)
        except (EOFError, IndexError):
            return path.stat().st_size + 1


def _end(header: _Header, length: int) -> int:
    records = header.count()
    lengths = header.dimensions()
    header.attributes()
    header.number(4)
    variables = [header.variable(lengths) for _ in range(header.count())]
    _require_sizes(variables)
    fixed = [variable for variable in variables if not variable.recorded]
    recorded = [variable for variable in variables if variable.recorded]
    _require_order(header.stream.tell(), [*sorted(fixed, key=_begin), *sorted(recorded, key=_begin)])
    end = max((variable.begin + variable.size for variable in fixed), default=0)
    unknown = (1 << (8 * header.wide)) - 1
    if not recorded:
        return end
    # a single variable with records is not filled up between them
    step = recorded[0].size if len(recorded) == 1 else sum(variable.filled for variable in recorded)
    whole = length - min(variable.begin for variable in recorded)
    if records != unknown and step > 0 and whole >= (records + 1) * step:
        raise HeaderDamageError(f"it counts {records} records, and the file has {whole // step}")
    if records in (0, unknown):
        return end
    return max(end, *(variable.begin + (records - 1) * step + variable.size for variable in recorded))


def _begin(variable: _Variable) -> int:
    return variable.begin


def _require_sizes(variables: list[_Variable]) -> None:
    """The size of a variable stands in the header, and follows from its type and dimensions."""
    for variable in variables:
        if variable.filled < _UNKNOWN and variable.stated not in (variable.size, variable.filled):
            raise HeaderDamageError(
                f"{variable.name} has {variable.stated} bytes, and {variable.filled} by its type and dimensions"
            )


def _require_order(header: int, variables: list[_Variable]) -> None:
    """Numbers begin after the header and do not lie over each other; those with records come last."""
    end, before = header, "the header"
    for variable in variables:
        if variable.size and variable.begin < end:
            raise HeaderDamageError(f"{variable.name} begins at byte {variable.begin}, within {before}")
        end, before = variable.begin + variable.size, variable.name
