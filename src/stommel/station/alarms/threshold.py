"""When a number is beyond its limit: with hysteresis, with a delay, and whatever the order in which samples come."""

from math import inf, isnan
from typing import NamedTuple

_LATE_IN_A_ROW = 10
"""So many samples from before the newest one mean that the vehicle's clock was set back."""


class Transition(NamedTuple):
    """An alarm begins or ends."""

    raised: bool
    t: float
    """Of the sample that decided it [s]."""
    value: float


Transitions = tuple[Transition, ...]


class Threshold:
    """Watches one side of one number.

    It is raised when samples were beyond the limit for the whole delay, and cleared by the first one that is inside by
    the hysteresis or more. A sample that is no number says nothing. Times are those of the samples, not of their
    arrival: one that comes late, from before the newest, raises a threshold without delay if nobody was told since,
    and then the newest one decides whether it is cleared at once. With a delay, late ones change nothing.

    Parameters
    ----------
    limit
        The last value that is allowed.
    above
        Whether more than the limit is beyond it, or less.
    hysteresis
        How far inside a value must be to clear it, in the unit of the value; 0 or more.
    delay
        For how long samples must be beyond it [s].
    raised
        Whether it is raised already, as after a restart.
    """

    def __init__(
        self, limit: float, *, above: bool, hysteresis: float = 0.0, delay: float = 0.0, raised: bool = False
    ) -> None:
        self.limit, self.above, self.hysteresis, self.delay = limit, above, hysteresis, delay
        self.raised = raised
        self._newest = self._cleared = -inf
        self._value = limit
        self._since: float | None = None
        self._late = 0

    def is_beyond(self, value: float) -> bool:
        """Whether a value is not allowed."""
        return value > self.limit if self.above else value < self.limit

    def is_back(self, value: float) -> bool:
        """Whether a value is inside by the hysteresis."""
        return value <= self.limit - self.hysteresis if self.above else value >= self.limit + self.hysteresis

    def take(self, t: float, value: float) -> Transitions:
        """Take a sample."""
        if isnan(value) or isnan(t):
            return ()
        if t < self._newest:
            self._late += 1
            if self._late <= _LATE_IN_A_ROW:
                return self._taken_late(t, value)
            self._since, self._cleared = None, -inf
        self._late = 0
        self._newest, self._value = t, value
        if self.raised:
            return self._cleared_at(t) if self.is_back(value) else ()
        if not self.is_beyond(value):
            self._since = None
            return ()
        if self._since is None:
            self._since = t
        return self._raised_at(t) if t - self._since >= self.delay else ()

    def look(self, t: float) -> Transitions:
        """See whether the delay is over, though no sample came: the last one is all that is known."""
        if self._since is None or t - self._since < self.delay:
            return ()
        return self._raised_at(self._since + self.delay)

    def _taken_late(self, t: float, value: float) -> Transitions:
        if self.raised or self.delay > 0.0 or t <= self._cleared or not self.is_beyond(value):
            return ()
        newest = self._value
        self._value = value
        told = self._raised_at(t)
        self._value = newest
        return told + (self._cleared_at(self._newest) if self.is_back(newest) else ())

    def _raised_at(self, t: float) -> Transitions:
        self.raised, self._since = True, None
        return (Transition(True, t, self._value),)

    def _cleared_at(self, t: float) -> Transitions:
        self.raised, self._cleared = False, t
        return (Transition(False, t, self._value),)
