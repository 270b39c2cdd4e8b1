"""The one way in which longitudes are written: above -180 and up to 180."""

from math import ceil

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


def wrapped_deg(longitude: float) -> float:
    """The same meridian, above -180 and up to 180 [deg]."""
    return longitude - 360.0 * ceil((longitude - 180.0) / 360.0)


def all_wrapped_deg(longitudes: Array) -> Array:
    """The same meridians, each above -180 and up to 180 [deg]; what is not a number stays so."""
    found: Array = longitudes - 360.0 * np.ceil((longitudes - 180.0) / 360.0)
    return found


def continued_deg(longitudes: Array) -> Array:
    """Longitudes of a way in its order, without a leap where it goes over the date line [deg]; all are numbers."""
    found: Array = np.unwrap(longitudes, period=360.0)
    return found


def mean_deg(longitudes: Array) -> float:
    """Mean longitude of a way in its order, on both sides of the date line or not [deg]; at least one, all numbers."""
    return wrapped_deg(float(continued_deg(longitudes).mean()))
