"""The part of a grid that lies within bounds of latitude and longitude, and the seam of one that goes around."""

import numpy as np
from numpy.typing import NDArray

from stommel.ocean.answers import Region
from stommel.ocean.errors import UnknownOceanError
from stommel.ocean.reading.horizontal import Nodes
from stommel.ocean.reading.variables import File

Indices = NDArray[np.intp]
Mask = NDArray[np.bool_]

_SAME_PLACE = 2e-6
"""Nodes closer than this are one: 13 m, more than single precision loses [rad]."""
_MOST_OVERLAP = 4
"""Columns that a grid around the Earth may have twice, at its beginning and at its end."""
_WIDEST_SEAM = 2.0
"""Distance across the seam, in those of the columns beside it, up to which a grid goes around."""


def inside(file: File, nodes: Nodes, bounds: Region | None) -> tuple[Indices, Indices]:
    """Rows and columns of the nodes within the bounds, and one more on each side where it has places.

    Columns are in order along the grid; where it goes around the Earth they may lie across its first and last column,
    and all of them end with the first again.

    Raises
    ------
    FileError
        No node lies within the bounds, or one between those that do has no place.
    """
    rows, columns = nodes.latitude.shape
    if bounds is None:
        j, i = np.arange(rows), np.arange(columns)
        if _period(nodes, j) == columns:
            i = np.append(i, 0)
        _require_places(file, nodes, j, i)
        return j, i
    within = _within(file, nodes, _checked(bounds))
    j = _with_margin(np.flatnonzero(within.any(axis=1)), rows)
    i = _columns(nodes, j, np.asarray(within.any(axis=0)))
    return _without_holes(file, nodes, within, j, i)


def _within(file: File, nodes: Nodes, bounds: Region) -> Mask:
    south, north, west, east = bounds
    width = (east - west) % 360.0 if (east - west) % 360.0 else 360.0
    beside = np.radians((np.degrees(nodes.longitude) - west + 180.0 - 0.5 * width) % 360.0 - 180.0 + 0.5 * width)
    within: Mask = (nodes.latitude >= np.radians(south)) & (nodes.latitude <= np.radians(north))
    within &= (beside >= 0.0) & (beside <= np.radians(width))
    if not within.any():
        file.refuse("bounds", f"has no node within latitude {south:g} to {north:g}, longitude {west:g} to {east:g}")
    return within


def _with_margin(found: Indices, count: int) -> Indices:
    return np.arange(max(int(found[0]) - 1, 0), min(int(found[-1]) + 2, count))


def _columns(nodes: Nodes, j: Indices, wanted: Mask) -> Indices:
    """Columns from the first wanted to the last, and one more on each side, around the Earth if the grid goes so."""
    period = _period(nodes, j)
    if period is None:
        return _with_margin(np.flatnonzero(wanted), len(wanted))
    ring = wanted[:period].copy()
    for again in range(period, len(wanted)):
        ring[again - period] |= wanted[again]
    found = np.flatnonzero(ring)
    gaps = np.diff(found, append=found[0] + period)
    largest = int(np.argmax(gaps))
    first = int(found[(largest + 1) % len(found)])
    count = period - int(gaps[largest]) + 1
    if count + 2 > period:
        return np.append(np.arange(period), 0)
    around: Indices = np.arange(first - 1, first + count + 1) % period
    return around


def _period(nodes: Nodes, j: Indices) -> int | None:
    """Columns after which the grid begins again; none where it ends."""
    columns = int(nodes.latitude.shape[1])
    places = _places(nodes, j)
    for overlap in range(min(_MOST_OVERLAP, columns // 3), 0, -1):
        if _greatest(places[:, :, columns - overlap :] - places[:, :, :overlap]) < _SAME_PLACE:
            return columns - overlap
    if columns < 3:
        return None
    seam = np.linalg.norm(places[:, :, 0] - places[:, :, -1], axis=0)
    beside = np.linalg.norm(places[:, :, [1, -1]] - places[:, :, [0, -2]], axis=0).max(axis=1)
    known = np.isfinite(seam) & np.isfinite(beside)
    close = bool(known.any()) and bool(np.all(seam[known] <= _WIDEST_SEAM * beside[known]))
    return columns if close and _goes_around(nodes, j) else None


def _goes_around(nodes: Nodes, j: Indices) -> bool:
    """Whether longitudes along a row add up to a whole turn, the seam among them."""
    row = nodes.longitude[j[len(j) // 2]]
    row = row[np.isfinite(row)]
    steps = (np.diff(row, append=row[:1]) + np.pi) % (2.0 * np.pi) - np.pi
    return bool(abs(abs(steps.sum()) - 2.0 * np.pi) < 1e-6)


def _places(nodes: Nodes, j: Indices) -> NDArray[np.float64]:
    """Places on the unit sphere (3, j, i)."""
    latitude, longitude = nodes.latitude[j], nodes.longitude[j]
    across = np.cos(latitude)
    return np.array([across * np.cos(longitude), across * np.sin(longitude), np.sin(latitude)])


def _greatest(apart: NDArray[np.float64]) -> float:
    """Greatest distance of two sets of places, holes left aside; without end where there is none."""
    distance = np.linalg.norm(apart, axis=0)
    known = distance[np.isfinite(distance)]
    return float(known.max()) if known.size else np.inf


def _without_holes(file: File, nodes: Nodes, within: Mask, j: Indices, i: Indices) -> tuple[Indices, Indices]:
    """Leave out the rows and columns of the margin that have no places everywhere."""
    known = _known(nodes)
    for end in (0, -1):
        if not (within[j[end]].any() or known[j[end]][i].all()):
            j = np.delete(j, end)
    for end in (0, -1):
        if not (within[:, i[end]].any() or known[j][:, i[end]].all()):
            i = np.delete(i, end)
    _require_places(file, nodes, j, i)
    return j, i


def _known(nodes: Nodes) -> Mask:
    known: Mask = np.isfinite(nodes.latitude) & np.isfinite(nodes.longitude)
    return known


def _require_places(file: File, nodes: Nodes, j: Indices, i: Indices) -> None:
    box = np.ix_(j, i)
    if not _known(nodes)[box].all():
        missing, count = int((~_known(nodes)[box]).sum()), len(j) * len(i)
        file.refuse(
            "latitude",
            f"latitude and longitude must be given at every node, on land too; {missing} of {count} lack them: leave "
            "them out with bounds",
        )
    worst = float(np.degrees(np.abs(nodes.latitude[box]).max(initial=0.0)))
    if worst > 90.0 + 1e-7:
        file.refuse("latitude", f"latitude has the value {worst:g} deg: must be between -90 and 90")


def _checked(bounds: Region) -> Region:
    if len(bounds) != 4 or not np.all(np.isfinite(bounds)):
        raise UnknownOceanError(f"bounds = {bounds}: must be south, north, west and east in deg")
    south, north, west, east = bounds
    if not -90.0 <= south < north <= 90.0:
        raise UnknownOceanError(f"bounds: south {south:g}, north {north:g} deg: must increase within -90 to 90")
    return south, north, west, east
