"""How fast segments come, and how long their absence means nothing."""

import math

_UNLIKELY = math.log(1e-5)
_TURN = 0.15
"""For which a half-duplex radio may keep the other end silent [s]."""
_WEIGHT = 0.1
_FIRST = 1.0
"""Between two frames, before any came [s]: of a slow radio."""
_FEW = 4
"""Gaps of which each counts as it is."""
_PAUSE = 4.0
"""A gap of so many usual ones is a pause, and tells nothing of the pace."""


class Pace:
    """Times between segments, as they come."""

    def __init__(self) -> None:
        self.heard = float("-inf")
        """When a segment came last [s]."""
        self.rate = 0.0
        """New bytes a second, smoothed over some seconds."""
        self._between, self._gaps = _FIRST, 0

    def note(self, new: int, t: float) -> None:
        """Note a segment with so many new bytes at a time [s]."""
        gap = t - self.heard
        self.heard = t
        if not math.isfinite(gap):
            return
        self._gaps += 1
        usual = gap if self._gaps <= _FEW else min(gap, _PAUSE * self._between + 0.01)
        self._between += max(_WEIGHT, 1.0 / self._gaps) * (usual - self._between)
        weight = max(1.0 - math.exp(-gap / 3.0), 1.0 / self._gaps)
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
