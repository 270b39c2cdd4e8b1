"""Where a vehicle was at some times: between the positions that it told in each minute, those that can be true."""

import numpy as np
from numpy.typing import NDArray

from stommel.archive.archive import Archive
from stommel.archive.cells import LEVELS
from stommel.archive.whereabouts.sift import believed
from stommel.archive.whereabouts.told import told_places
from stommel.geometry.longitudes import all_wrapped_deg, continued_deg

FARTHEST = 7200.0
"""Time from a sample to a position, over which none is made up [s]."""
Array = NDArray[np.float64]


def positions(archive: Archive, vehicle: int, time: Array) -> tuple[Array, Array]:
    """Latitude and longitude [deg] at some times in order [s since 1970].

    Where the next told position is more than `FARTHEST` away in time there is none.
    """
    if not time.size:
        return np.empty(0), np.empty(0)
    begin, end = float(time[0]) - FARTHEST, float(time[-1]) + FARTHEST
    told = told_places(archive, vehicle, max(0.0, begin), end, LEVELS[0])
    known = told.of(believed(told))
    if not known.t.size:
        return np.full(time.size, np.nan), np.full(time.size, np.nan)
    latitude = np.interp(time, known.t, known.latitude)
    longitude = all_wrapped_deg(np.interp(time, known.t, continued_deg(known.longitude)))
    after = np.clip(np.searchsorted(known.t, time), 0, known.t.size - 1)
    nearest = np.minimum(np.abs(known.t[after] - time), np.abs(known.t[np.maximum(after - 1, 0)] - time))
    far = nearest > FARTHEST
    return np.where(far, np.nan, latitude), np.where(far, np.nan, longitude)
