"""The part of a grid that lies within bounds of latitude and longitude."""

import numpy as np
from numpy.typing import NDArray

from stommel.ocean.answers import Region
from stommel.ocean.errors import UnknownOceanError
from stommel.ocean.reading.horizontal import Nodes
from stommel.ocean.reading.variables import File

_SAME_MERIDIAN = 1e-9
"""Meridians closer than this are one [rad]."""


def inside(file: File, nodes: Nodes, bounds: Region | None) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """Rows and columns of the nodes within the bounds, and one more on each side; columns in order from the west."""
    rows, columns = nodes.latitude.shape
    if bounds is None:
        return np.arange(rows), np.arange(columns)
    south, north, west, east = _checked(bounds)
    width = (east - west) % 360.0 if (east - west) % 360.0 else 360.0
    beside = np.radians((np.degrees(nodes.longitude) - west + 180.0 - 0.5 * width) % 360.0 - 180.0 + 0.5 * width)
    within = (nodes.latitude >= np.radians(south)) & (nodes.latitude <= np.radians(north))
    within &= (beside >= 0.0) & (beside <= np.radians(width))
    if not within.any():
        file.refuse("bounds", f"has no node within latitude {south:g} to {north:g}, longitude {west:g} to {east:g}")
    j = _span(np.flatnonzero(within.any(axis=1)), rows)
    separable = bool(np.all(np.ptp(nodes.longitude, axis=0) == 0.0))
    if not separable:
        return j, _span(np.flatnonzero(within.any(axis=0)), columns)
    # meridians: the region may lie across the file's first and last column
    order = np.argsort(beside[0], kind="stable")
    # a file that goes around the Earth may have its first meridian twice
    order = order[np.diff(beside[0][order], prepend=-np.inf) > _SAME_MERIDIAN]
    return j, order[_span(np.flatnonzero(within.any(axis=0)[order]), columns)]


def _span(found: NDArray[np.intp], count: int) -> NDArray[np.intp]:
    return np.arange(max(int(found[0]) - 1, 0), min(int(found[-1]) + 2, count))


def _checked(bounds: Region) -> Region:
    if len(bounds) != 4 or not np.all(np.isfinite(bounds)):
        raise UnknownOceanError(f"bounds = {bounds}: must be south, north, west and east in deg")
    south, north, west, east = bounds
    if not -90.0 <= south < north <= 90.0:
        raise UnknownOceanError(f"bounds: south {south:g}, north {north:g} deg: must increase within -90 to 90")
    return south, north, west, east
