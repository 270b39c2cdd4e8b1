"""The frame of a map: as long and wide as the track, in degrees that go on across the date line."""

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.ticker import Formatter

Array = NDArray[np.float64]

_ROOM = 0.08
"""Of the longer side, around what is drawn."""
_NARROWEST = 0.4
"""A frame is not narrower than this share of its length, or nothing beside a straight track could be read."""
_LEAST_DEG = 2e-5
"""A frame is not shorter, about 2 m."""
_FLATTEST = 0.01
"""Of the cosine of the latitude, towards the poles."""


@dataclass(frozen=True)
class Frame:
    """A part of the Earth, true to scale at its middle."""

    south: float
    north: float
    west: float
    """Longitudes go on beyond 180."""
    east: float
    squeeze: float
    """Length of a degree of longitude over that of latitude."""

    @property
    def aspect(self) -> float:
        """Width over height on the ground."""
        return (self.east - self.west) * self.squeeze / (self.north - self.south)

    def around(self, longitude: Array) -> Array:
        """Longitudes in the turn about the middle of the frame."""
        middle = 0.5 * (self.west + self.east)
        return np.asarray(middle + (longitude - middle + 180.0) % 360.0 - 180.0)

    def holds(self, latitude: float, longitude: float) -> bool:
        """Whether a place lies within."""
        east = float(self.around(np.asarray(longitude)))
        return bool(self.south <= latitude <= self.north and self.west <= east <= self.east)

    def set_on(self, axes: "Axes") -> None:
        """Make axes show the frame, with degrees as people write them."""
        axes.set_xlim(self.west, self.east)
        axes.set_ylim(self.south, self.north)
        axes.set_aspect(1.0 / self.squeeze)
        axes.set_autoscale_on(False)
        axes.xaxis.set_major_formatter(_degrees("E", "W", self.east - self.west))
        axes.yaxis.set_major_formatter(_degrees("N", "S", self.north - self.south))
        axes.locator_params(axis="x", nbins=max(3, round(6 * min(1.0, self.aspect))))
        axes.locator_params(axis="y", nbins=max(3, round(6 * min(1.0, 1.0 / self.aspect))))


def frame_of(latitude: Array, longitude: Array) -> Frame:
    """Return a frame that holds all places, whose first is on the side of the date line that the others join."""
    first = longitude[0]
    east = first + (longitude - first + 180.0) % 360.0 - 180.0
    squeeze = max(_FLATTEST, float(np.cos(np.radians(0.5 * (latitude.min() + latitude.max())))))
    height, width = max(float(np.ptp(latitude)), _LEAST_DEG), float(np.ptp(east)) * squeeze
    longer = (1.0 + 2.0 * _ROOM) * max(height, width)
    half_height = 0.5 * max(height + 2.0 * _ROOM * longer, _NARROWEST * longer)
    half_width = 0.5 * max(width + 2.0 * _ROOM * longer, _NARROWEST * longer) / squeeze
    middle, across = 0.5 * (latitude.min() + latitude.max()), 0.5 * (east.min() + east.max())
    return Frame(middle - half_height, middle + half_height, across - half_width, across + half_width, squeeze)


def _degrees(positive: str, negative: str, span: float) -> "Formatter":
    from matplotlib.ticker import FuncFormatter  # noqa: PLC0415 - start-up counts

    digits = int(np.clip(np.ceil(1.0 - np.log10(span)), 0, 6))

    def text(value: float, _position: int) -> str:
        beside = (value + 180.0) % 360.0 - 180.0 if positive == "E" else value
        written = f"{abs(beside):.{digits}f}"
        side = (
            "" if float(written) in (0.0, 180.0 if positive == "E" else 0.0) else negative if beside < 0.0 else positive
        )
        return f"{written}°{side}"

    return FuncFormatter(text)
