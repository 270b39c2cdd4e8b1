"""A question that is asked until it is answered: when to ask it again, and when to give up."""

from stommel.link.files.fetching import MOST_WAIT
from stommel.link.timing import RetransmissionTimer

PATIENCE = 600.0
"""Time without an answer after which a request has failed [s]; time in which it is paused does not count."""
FIRST = 1.0
"""Before the round trip is known [s] (RFC 6298, section 2.1)."""
_UNDOUBLED = 3


class Asking:
    """Times of a question that is repeated into silence.

    Parameters
    ----------
    timer
        What is known of the round trip; None: nothing.
    patience
        Time without an answer after which to give up [s]; None: never.
    """

    def __init__(self, timer: RetransmissionTimer | None, patience: float | None = PATIENCE) -> None:
        self.timer = RetransmissionTimer(FIRST) if timer is None else timer
        self.patience = patience
        self.tries = 0
        self._asked = self._other = float("-inf")
        self._answered: float | None = None

    def heard(self, t: float) -> None:
        """Something came from the other end: if it was away, it is asked now."""
        if self.tries > 1 and t - self._other > self.timer.time_out:
            self._asked, self.tries = float("-inf"), 0
        self._other = t

    def start(self, t: float) -> None:
        """Begin, or begin anew: silence counts from here."""
        self._answered = t
        self._asked, self.tries = float("-inf"), 0

    def is_due(self, t: float) -> bool:
        """Whether to ask now."""
        doubled = 2.0 ** min(max(self.tries - 1 - _UNDOUBLED, 0), 8)
        return t - self._asked >= (min(self.timer.time_out * doubled, MOST_WAIT) if self.tries else 0.0)

    def asked(self, t: float) -> None:
        """Note that it was asked."""
        self._asked = t
        self.tries += 1

    def answered(self, t: float) -> None:
        """Note that it was answered; the round trip is measured if it was asked once only (Karn)."""
        if self.tries == 1:
            self.timer.measure(t - self._asked)
        self._asked, self.tries = float("-inf"), 0
        self._answered = t

    def goes_on(self, t: float) -> None:
        """Note that what was asked for is coming."""
        self._answered = t

    def is_hopeless(self, t: float) -> bool:
        """Whether there was no answer for longer than the patience."""
        if self._answered is None:
            self._answered = t
        return self.patience is not None and t - self._answered > self.patience
