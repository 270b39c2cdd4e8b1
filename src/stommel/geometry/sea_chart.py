"""Mercator's map of WGS 84: true to angles, rhumb lines straight, one scale around each place."""

import numpy as np
from numpy.typing import NDArray
from pyproj import Proj

from stommel.geometry.earth import FLATTENING

Array = NDArray[np.float64]

FARTHEST_NORTH_DEG = 89.9
"""A pole lies at infinity: what is farther north, or south, is shown here."""


class SeaChart:
    """A chart around a meridian [deg], on which nothing may lie half a turn away from it."""

    def __init__(self, middle_deg: float) -> None:
        self._project = Proj(proj="merc", ellps="WGS84", lon_0=middle_deg)

    def points(self, latitude_deg: Array, longitude_deg: Array) -> Array:
        """East and north of places, a row each [m at the equator]."""
        return np.column_stack(self._project(longitude_deg, _off_the_pole(latitude_deg)))

    @staticmethod
    def scale(latitude_deg: Array) -> Array:
        """How many metres of the chart a metre is at these latitudes."""
        sine = np.sin(np.radians(_off_the_pole(latitude_deg)))
        return np.asarray(np.sqrt((1.0 - FLATTENING * (2.0 - FLATTENING) * sine**2) / (1.0 - sine**2)))


def _off_the_pole(latitude_deg: Array) -> Array:
    return np.clip(latitude_deg, -FARTHEST_NORTH_DEG, FARTHEST_NORTH_DEG)
