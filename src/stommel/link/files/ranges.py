"""Stretches of bytes: which there are, which are missing."""

from bisect import bisect_left, bisect_right
from collections.abc import Iterable, Iterator
from typing import NamedTuple


class Range(NamedTuple):
    """Bytes from `first` on, to the one before `last`."""

    first: int
    last: int

    @property
    def size(self) -> int:
        """Number of bytes."""
        return self.last - self.first


class Ranges:
    """A set of bytes, as stretches that neither touch nor overlap, in order."""

    def __init__(self, ranges: Iterable[tuple[int, int]] = ()) -> None:
        self._firsts: list[int] = []
        self._lasts: list[int] = []
        self.bytes = 0
        """How many."""
        for first, last in ranges:
            self.add(first, last)

    def __iter__(self) -> Iterator[Range]:
        return map(Range, tuple(self._firsts), tuple(self._lasts))

    def __len__(self) -> int:
        return len(self._firsts)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Ranges):
            return NotImplemented
        return (self._firsts, self._lasts) == (other._firsts, other._lasts)

    __hash__ = None  # type: ignore[assignment]

    def __repr__(self) -> str:
        return f"Ranges({[tuple(each) for each in self]})"

    def add(self, first: int, last: int) -> int:
        """Add bytes, and return how many of them are new."""
        if last <= first:
            return 0
        i, j = bisect_left(self._lasts, first), bisect_right(self._firsts, last)
        before = sum(self._lasts[i:j]) - sum(self._firsts[i:j])
        if i < j:
            first, last = min(first, self._firsts[i]), max(last, self._lasts[j - 1])
        self._firsts[i:j], self._lasts[i:j] = [first], [last]
        self.bytes += last - first - before
        return last - first - before

    def remove(self, first: int, last: int) -> int:
        """Take bytes out, and return how many of them were there."""
        if last <= first:
            return 0
        i, j = bisect_right(self._lasts, first), bisect_left(self._firsts, last)
        if i >= j:
            return 0
        before = sum(self._lasts[i:j]) - sum(self._firsts[i:j])
        pieces = [(self._firsts[i], first), (last, self._lasts[j - 1])]
        left = [(start, end) for start, end in pieces if start < end]
        self._firsts[i:j], self._lasts[i:j] = [start for start, _ in left], [end for _, end in left]
        gone = before - sum(end - start for start, end in left)
        self.bytes -= gone
        return gone

    def within(self, first: int, last: int) -> list[Range]:
        """Return the stretches of it that lie between two bytes."""
        i, j = bisect_right(self._lasts, first), bisect_left(self._firsts, last)
        return [Range(max(self._firsts[k], first), min(self._lasts[k], last)) for k in range(i, j)]

    def pop(self, most: int) -> Range:
        """Take out the first stretch, or its first bytes where it has more than so many."""
        first = self._firsts[0]
        taken = Range(first, min(self._lasts[0], first + most))
        self.remove(*taken)
        return taken

    def missing(self, size: int) -> "Ranges":
        """Return the bytes from 0 to `size` that are not in it."""
        rest = Ranges([(0, size)])
        for each in self:
            rest.remove(*each)
        return rest
