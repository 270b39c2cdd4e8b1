"""Questions that are asked until they are answered, no more often than the line allows."""

from math import inf

from stommel.link.timing import MOST, RetransmissionTimer

_LONGER = (1.0, 1.5, 2.0)
"""How many time-outs the first, second and every later wait is. A lossy line is no crowded one: whoever doubles for
ever waits a minute for what the next try would have brought."""
_SIGNS = 3
"""So many answers in a row, sooner after the last try than an answer can come: the time-out is too short."""
_SOONEST = 0.9
"""Share of the usual round trip."""


class Pace:
    """How long answers of one peer take; all questions to it learn from each other."""

    def __init__(self) -> None:
        self._timer = RetransmissionTimer()
        self._signs = 0

    @property
    def time_out(self) -> float:
        """After which a question is asked again the first time [s]."""
        return self._timer.time_out

    def wait(self, tries: int) -> float:
        """How long to wait after so many tries [s]."""
        return min(self.time_out * _LONGER[min(tries, len(_LONGER)) - 1], MOST)

    def learn(self, since_first: float, since_last: float, tries: int) -> None:
        """Learn from an answer so long after the first and the last of so many tries [s]."""
        if tries == 1:
            self._signs = 0
            self._timer.measure(since_first)
        elif tries:
            # nobody knows which try was answered (Karn), unless the last one cannot be
            usual = self._timer.round_trip
            if usual is None or since_last < _SOONEST * usual:
                self._signs += 1
            if self._signs >= _SIGNS:
                self._signs = 0
                self._timer.back_off()


class Question:
    """One question, and when it is due.

    Parameters
    ----------
    pace
        Of its peer; learns from the answer.
    """

    def __init__(self, pace: Pace) -> None:
        self._pace = pace
        self._first, self._last, self._next = 0.0, 0.0, -inf
        self.tries = 0
        """How often it was asked."""

    def is_due(self, t: float) -> bool:
        """Whether it is to be asked at a time [s]."""
        return t >= self._next

    def asked(self, t: float, *, is_quiet: bool = False) -> None:
        """Note that it was asked at a time [s]; a peer that is not heard is asked seldom."""
        if not self.tries:
            self._first = t
        self.tries += 1
        self._last = t
        self._next = t + (MOST if is_quiet else self._pace.wait(self.tries))

    def answered(self, t: float) -> None:
        """Note that it was answered at a time [s]; the next question is due at once."""
        self._pace.learn(t - self._first, t - self._last, self.tries)
        self.forget()

    def forget(self) -> None:
        """Drop it unanswered; the next question is due at once."""
        self.tries, self._next = 0, -inf

    def again(self) -> None:
        """Ask at once: the peer is heard again."""
        self._next = -inf
