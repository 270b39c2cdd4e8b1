"""How fast segments come, and how long their absence means nothing."""

import math

_UNLIKELY = math.log(1e-5)
_TURN = 0.15
"""For which a half-duplex radio may keep the other end silent [s]."""
_WEIGHT = 0.1
_PAUSE = 4.0
"""A gap of so many usual ones is a pause, and tells nothing of the pace."""


class Pace:
    """Times between segments, as they come."""

    def __init__(self) -> None:
        self.heard = float("-inf")
        """When a segment came last [s]."""
        self.rate = 0.0
        """New bytes a second, smoothed over some seconds."""
        self._between = 0.05

    def note(self, new: int, t: float) -> None:
        """Note a segment with so many new bytes at a time [s]."""
        gap = t - self.heard
        self.heard = t
        if not math.isfinite(gap):
            return
        self._between += _WEIGHT * (min(gap, _PAUSE * self._between + 0.01) - self._between)
        weight = 1.0 - math.exp(-gap / 3.0)
        self.rate += weight * (new / max(gap, 1e-3) - self.rate)

    def frame_time(self, loss: float) -> float:
        """Time between the frames of the other end [s], lost ones among them."""
        return max(self._between * max(1.0 - loss, 0.05), 1e-4)

    def silence(self, loss: float, expected: float) -> float:
        """Silence after which none of so many expected frames will come [s].

        Either they would all have come by now, or so many in a row would have been lost that it is not likely.
        """
        unlikely = _UNLIKELY / math.log(min(max(loss, 0.01), 0.95))
        return min(expected + 2.0, unlikely) * self.frame_time(loss) + _TURN
