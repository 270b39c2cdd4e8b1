"""Fades of the radio: Gilbert and Elliott's two states, in time."""

import math

import numpy as np


class Fading:
    """Whether there is a fade at a time; times do not go back.

    Good and bad stretches last an exponentially distributed time each, so that `length / (every + length)` of all time
    is bad. Gilbert (1960), Elliott (1963).
    """

    def __init__(self, every: float, length: float, draw: np.random.Generator) -> None:
        self._means = (every, length)
        self._draw = draw
        self._bad = False
        self._until = draw.exponential(every) if math.isfinite(every) and length > 0.0 else math.inf

    def at(self, t: float) -> bool:
        """Whether there is a fade [s]."""
        while t >= self._until:
            self._bad = not self._bad
            self._until += self._draw.exponential(self._means[self._bad])
        return self._bad
