"""Analytic oceans that vary from place to place: nodes on a rectangle around a middle, by distance and bearing."""

import numpy as np
from numpy.typing import NDArray
from pyproj import Geod

_WGS84 = Geod(ellps="WGS84")

Array = NDArray[np.float64]


def rectangle(
    latitude_deg: float, longitude_deg: float, bearing_deg: float, across: Array, along: Array
) -> tuple[Array, Array, Array]:
    """Latitude and longitude (j, i) [rad] of nodes `along` a bearing (j) and `across` it to the right (i) [m].

    The third array is the bearing there, away from the middle [rad].

    The nodes are polar coordinates on the ellipsoid: a node lies at the end of the geodesic from the middle whose
    length and bearing those of (along, across) are in the plane.
    """
    a, s = np.meshgrid(across, along)
    azimuth = bearing_deg + np.degrees(np.arctan2(a, s))
    start = np.full(a.shape, longitude_deg), np.full(a.shape, latitude_deg)
    longitude, latitude, back = _WGS84.fwd(*start, azimuth, np.hypot(a, s))
    return np.radians(latitude), np.radians(longitude), np.radians(np.asarray(back) + 180.0)
