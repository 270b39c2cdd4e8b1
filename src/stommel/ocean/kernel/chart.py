"""A plane for the horizontal search: a conformal projection centred on the ocean, cut by no pole or date line.

The ellipsoid is mapped to a sphere by the conformal latitude, and the sphere to the plane by the stereographic
projection (Snyder 1987, sections 3 and 21). Angles are kept, so that a vector in the plane turns to north and east by
one rotation, and the scale is the same in all directions.
"""

from math import atan2, cos, cosh, sin, sqrt, tanh
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from stommel.compilation import compiled, inlined

SEMI_MAJOR_AXIS = 6378137.0
"""Of the ellipsoid WGS 84 [m]."""
ECCENTRICITY = 0.0818191908426215
"""Of the ellipsoid WGS 84."""
_STEEPEST = 1.5707963250
"""Latitude taken for the pole itself, 1 cm from it, where north is still a direction [rad]."""


class Chart(NamedTuple):
    """The plane's centre."""

    sin_chi: float
    """Sine of its conformal latitude."""
    cos_chi: float
    """Cosine of its conformal latitude."""
    longitude: float
    """Its longitude [rad]."""


class PlanePoint(NamedTuple):
    """A place in the plane and the way its axes lie there."""

    x: float
    """[m]"""
    y: float
    """[m]"""
    north_x: float
    """Unit vector to the north, along x."""
    north_y: float
    """Unit vector to the north, along y."""
    scale: float
    """Metres in the plane per metre on the ellipsoid."""


@inlined
def _isometric(latitude: float) -> tuple[float, float]:
    """Isometric latitude on the sphere, and what the ellipsoid takes from it."""
    s = sin(min(max(latitude, -_STEEPEST), _STEEPEST))
    return np.arctanh(s), ECCENTRICITY * np.arctanh(ECCENTRICITY * s)


@compiled
def chart_at(latitude: float, longitude: float) -> Chart:
    """Chart whose centre is at this geodetic latitude and longitude [rad]."""
    sphere, flattening = _isometric(latitude)
    psi = sphere - flattening
    return Chart(tanh(psi), 1.0 / cosh(psi), longitude)


@inlined
def project(chart: Chart, latitude: float, longitude: float) -> PlanePoint:
    """Map a geodetic latitude and longitude [rad] to the plane; the point opposite to the centre is at infinity."""
    sphere, flattening = _isometric(latitude)
    psi = sphere - flattening
    sin_chi, cos_chi = tanh(psi), 1.0 / cosh(psi)
    sin_l, cos_l = sin(longitude - chart.longitude), cos(longitude - chart.longitude)
    k = 2.0 / (1.0 + chart.sin_chi * sin_chi + chart.cos_chi * cos_chi * cos_l)
    x = k * cos_chi * sin_l
    y = k * (chart.cos_chi * sin_chi - chart.sin_chi * cos_chi * cos_l)
    # derivative of (x, y) by the conformal latitude: along the meridian, of length k
    k_chi = -0.5 * k * k * (chart.sin_chi * cos_chi - chart.cos_chi * sin_chi * cos_l)
    north_x = k_chi * cos_chi * sin_l - k * sin_chi * sin_l
    north_y = k_chi * y / k + k * (chart.cos_chi * cos_chi + chart.sin_chi * sin_chi * cos_l)
    length = sqrt(north_x * north_x + north_y * north_y)
    # radius of the parallel on the sphere of radius a over that on the ellipsoid
    s = ECCENTRICITY * tanh(sphere)
    parallels = cosh(sphere) / cosh(psi) * sqrt(1.0 - s * s)
    return PlanePoint(SEMI_MAJOR_AXIS * x, SEMI_MAJOR_AXIS * y, north_x / length, north_y / length, k * parallels)


@compiled
def project_nodes(
    chart: Chart, latitude: NDArray[np.float64], longitude: NDArray[np.float64], out: NDArray[np.float64]
) -> None:
    """Write x, y, north_x, north_y of flat arrays of nodes [rad] into the columns of `out` (nodes x 4)."""
    for n in range(latitude.size):
        point = project(chart, latitude[n], longitude[n])
        out[n, 0], out[n, 1], out[n, 2], out[n, 3] = point.x, point.y, point.north_x, point.north_y


def centre_of(latitude: NDArray[np.float64], longitude: NDArray[np.float64]) -> tuple[float, float]:
    """Middle of a set of places [rad]: the direction of the mean of their unit vectors."""
    x = float(np.mean(np.cos(latitude) * np.cos(longitude)))
    y = float(np.mean(np.cos(latitude) * np.sin(longitude)))
    z = float(np.mean(np.sin(latitude)))
    return atan2(z, sqrt(x * x + y * y)), atan2(y, x)
