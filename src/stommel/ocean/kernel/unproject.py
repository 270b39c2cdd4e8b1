"""From the plane of a chart back to latitude and longitude (NumPy)."""

import numpy as np
from numpy.typing import NDArray

from stommel.ocean.kernel.chart import ECCENTRICITY, SEMI_MAJOR_AXIS, Chart

Array = NDArray[np.float64]
_ROUNDS = 12
"""Of the fixed point for the geodetic latitude, each of which gains two digits."""


def unproject(chart: Chart, x: Array, y: Array) -> tuple[Array, Array]:
    """Return geodetic latitude and longitude of points of the plane [rad]; longitudes lie within half a turn."""
    rho = np.hypot(x, y) / SEMI_MAJOR_AXIS
    c = 2.0 * np.arctan(0.5 * rho)
    share = np.divide(np.sin(c), rho, out=np.ones_like(rho), where=rho > 0.0) / SEMI_MAJOR_AXIS
    sin_chi = np.clip(np.cos(c) * chart.sin_chi + y * share * chart.cos_chi, -1.0, 1.0)
    angle = np.arctan2(x * share, chart.cos_chi * np.cos(c) - y * share * chart.sin_chi)
    longitude = (chart.longitude + angle + np.pi) % (2.0 * np.pi) - np.pi
    psi = np.arctanh(np.clip(sin_chi, -1.0 + 1e-15, 1.0 - 1e-15))
    sine = sin_chi
    for _ in range(_ROUNDS):
        sine = np.tanh(psi + ECCENTRICITY * np.arctanh(ECCENTRICITY * sine))
    return np.arcsin(sine), longitude
