"""Where a layer lies."""

import math
from typing import NamedTuple

from stommel.errors import StommelError


class LayerError(StommelError):
    """A layer that cannot be drawn, or that there is no room for.

    Parameters
    ----------
    words
        What is wrong.
    key
        What is to be mended.
    allowed
        What may stand there.
    """

    def __init__(self, words: str, key: str, allowed: str) -> None:
        super().__init__(words)
        self.key, self.allowed = key, allowed


class Bounds(NamedTuple):
    """A rectangle of longitude and latitude [deg]."""

    west: float
    south: float
    east: float
    north: float


LEAST_SPAN = 1e-6
"""Of an image, on each side [deg]; a tenth of a metre."""


def require_area(bounds: Bounds) -> None:
    """Hold the bounds of an image against the globe.

    Raises
    ------
    LayerError
        They are outside, or span nothing.
    """
    for low, high, names, most in (
        (bounds.west, bounds.east, "west, east", 180.0),
        (bounds.south, bounds.north, "south, north", 90.0),
    ):
        if not (-most <= low and high <= most and high - low >= LEAST_SPAN and math.isfinite(high - low)):
            words = f"{names} = {low:g}, {high:g}: must rise, between -{most:g} and {most:g} deg"
            raise LayerError(words, names.partition(",")[0], f"-{most:g} to {most:g}")
