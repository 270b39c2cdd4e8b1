"""Which bytes are missing, which were asked for, and which of those are lost.

Whoever sends, sends in the order of the requests. So a byte that was asked for is lost as soon as bytes that were asked
for after it have arrived: no time-out has to pass. It is not asked for again before that, or before `give_up` says
that nothing will come any more. What is overtaken may yet come: for three frames (as in QUIC, RFC 9002, section 6.1.1),
or for a short time where no more frames come.
"""

from collections import deque
from collections.abc import Iterable

from stommel.link.files.ranges import Range, Ranges

REORDERED = 3
"""Frames that must have come that were to come after a byte, before it counts as lost."""
OVERTAKEN = 0.06
"""Time after which an overtaken byte counts as lost [s], if there are no more frames."""
MOST_REQUESTS = 64
"""Requests that are answered at once; less than half of the numbers that there are."""


class Recovery:
    """The missing bytes of one file: to be asked for, asked for, or overtaken.

    Parameters
    ----------
    missing
        What is not there.
    """

    def __init__(self, missing: Iterable[tuple[int, int]]) -> None:
        self.missing = Ranges(missing)
        """What is not there, whether it was asked for or not."""
        self.to_ask = Ranges(self.missing)
        """What nobody was asked for, or what was lost."""
        self._asked: dict[int, Ranges] = {}
        self._overtaken: deque[tuple[int, float, Range]] = deque()
        self._frames = 0

    @property
    def asked_bytes(self) -> int:
        """Bytes that are still expected, copies included."""
        return sum(ranges.bytes for ranges in self._asked.values())

    @property
    def is_expecting(self) -> bool:
        """Whether anything that was asked for may still come."""
        return bool(self._asked) or bool(self._overtaken)

    @property
    def requests(self) -> int:
        """Requests that are not answered wholly."""
        return len(self._asked)

    def ask(self, serial: int, most_ranges: int, longest: int, furthest: int) -> list[Range]:
        """Take out what a request can name: so many ranges, each so long, and so far apart at most."""
        taken: list[Range] = []
        while len(self.to_ask) and len(taken) < most_ranges:
            first = next(iter(self.to_ask)).first
            if taken and first - taken[-1].last > furthest:
                break
            taken.append(self.to_ask.pop(longest))
        if taken:
            self._asked[serial] = Ranges(taken)
        return taken

    def ask_again(self, serial: int, ranges: Iterable[Range]) -> None:
        """Note a copy of a request under a number of its own."""
        self._asked[serial] = Ranges(ranges)

    def take(self, serial: int, offset: int, length: int, t: float) -> int:
        """Note bytes that have come at a time [s], in answer to a request; return how many of them were missing."""
        last = offset + length
        self._frames += 1
        if serial in self._asked:
            self._overtake(serial, offset, t)
        for number, ranges in tuple(self._asked.items()):
            ranges.remove(offset, last)
            if not ranges:
                del self._asked[number]
        self.to_ask.remove(offset, last)
        new = self.missing.remove(offset, last)
        self.settle(t)
        return new

    def give_up(self) -> int:
        """Nothing will come any more: everything missing is to be asked for. Returns how many bytes were expected."""
        expected = self.asked_bytes
        self._asked.clear()
        self._overtaken.clear()
        self.to_ask = Ranges(self.missing)
        return expected

    def _overtake(self, serial: int, offset: int, t: float) -> None:
        """What was to come before a byte of a request is late now."""
        for number, ranges in tuple(self._asked.items()):
            before = ranges.within(0, offset) if number == serial else list(ranges)
            for each in before:
                self._overtaken.append((self._frames - 1, t, each))
                ranges.remove(*each)
            if number == serial:
                break
            del self._asked[number]

    def settle(self, t: float) -> None:
        """What was overtaken by enough, or for long, is lost, unless a copy of it is still to come."""
        while self._overtaken:
            frames, since, late = self._overtaken[0]
            if self._asked and self._frames - frames < REORDERED and t - since < OVERTAKEN:
                break
            self._overtaken.popleft()
            for first, last in self.missing.within(*late):
                lost = Ranges([(first, last)])
                for ranges in self._asked.values():
                    for each in ranges.within(first, last):
                        lost.remove(*each)
                for each in lost:
                    self.to_ask.add(*each)
