"""Where a layer lies."""

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
    for low_name, high_name, most in (("west", "east", 180.0), ("south", "north", 90.0)):
        low, high = getattr(bounds, low_name), getattr(bounds, high_name)
        for name, value in ((low_name, low), (high_name, high)):
            if not abs(value) <= most:
                allowed = f"-{most:g} to {most:g} deg"
                raise LayerError(f"{name} = {value:g}: must be between -{most:g} and {most:g} deg", name, allowed)
        if high - low < LEAST_SPAN:
            words = f"{low_name} = {low:g}: must be less than {high_name} = {high:g}"
            raise LayerError(words, low_name, f"less than {high:g} deg")
