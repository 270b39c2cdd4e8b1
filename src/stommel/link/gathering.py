"""Items by number that are gathered until none is missing: streamed at first, or asked for singly, a few at a time."""

from math import inf

from stommel.link.question import Pace, Question
from stommel.link.timing import MOST

WINDOW = 8
"""Questions that are in flight at a time."""
_GAPS = 2.0
"""A stream has ended when it is silent for so many of its longest gaps."""


class Gathering:
    """What is there, what is missing, and what to ask for next.

    Parameters
    ----------
    count
        Of the items; they are numbered from 0.
    pace
        Of this peer.
    window
        Questions in flight.
    """

    def __init__(self, count: int, pace: Pace, window: int = WINDOW) -> None:
        self.count = count
        self.missing = dict.fromkeys(range(count))
        """Numbers of the items that are missing, in order."""
        self._pace, self._window = pace, window
        self._asked: dict[int, Question] = {}
        self._stream_ends, self._streamed, self._longest_gap = -inf, -inf, 0.0
        self._streams = 0

    @property
    def is_whole(self) -> bool:
        """Whether nothing is missing."""
        return not self.missing

    def stream(self, t: float, *, is_quiet: bool = False) -> None:
        """Expect all items unasked from a time [s] on: they were asked for as one."""
        self._streams += 1
        self._streamed, self._stream_ends = t, t + (MOST if is_quiet else self._pace.wait(self._streams))

    def is_stream_due(self, t: float) -> bool:
        """Whether all items are to be asked for as one: none has come."""
        return t >= self._stream_ends and len(self.missing) == self.count

    def take(self, number: int, t: float) -> bool:
        """Note that an item has come; whether it was missing."""
        if t < self._stream_ends:
            self._longest_gap = max(self._longest_gap, t - self._streamed)
            self._streamed = t
            self._stream_ends = t + max(self._pace.time_out, _GAPS * self._longest_gap)
        if number not in self.missing:
            return False
        del self.missing[number]
        question = self._asked.pop(number, None)
        if question is not None:
            question.answered(t)
        return True

    def due(self, t: float, *, is_quiet: bool = False) -> list[int]:
        """Return the items to ask for at a time [s], and count them as asked; seldom if the peer is not heard."""
        if t < self._stream_ends:
            return []
        due = [number for number, question in self._asked.items() if question.is_due(t)]
        for number in self.missing:
            if len(self._asked) >= self._window:
                break
            if number not in self._asked:
                self._asked[number] = Question(self._pace)
                due.append(number)
        for number in due:
            self._asked[number].asked(t, is_quiet=is_quiet)
        return due

    def again(self) -> None:
        """Ask at once for what is missing: the peer is heard again."""
        self._stream_ends = -inf
        for question in self._asked.values():
            question.again()
