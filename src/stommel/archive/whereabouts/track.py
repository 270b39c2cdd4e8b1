"""Where a vehicle was: its positions over time, as many as a map can show."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from stommel.archive.archive import Archive
from stommel.archive.reduction import Curve, largest_triangles
from stommel.archive.whereabouts.sift import Places, believed
from stommel.archive.whereabouts.told import told_places, value_before

FRESH_FIX = 15.0
"""A position is by GPS if its fix is no older [s]."""
BY_GPS, ESTIMATED = "gps", "estimate"
"""Sources of a position."""


class Track(NamedTuple):
    """Positions in the order of time [s since 1970]."""

    t: list[float]
    latitude: list[float]
    """[deg]"""
    longitude: list[float]
    """[deg]"""
    sigma_m: list[float | None]
    source: list[str]
    """`BY_GPS` or `ESTIMATED`."""
    left_out: int
    """Of the positions that were looked at, those at which the vehicle cannot have been."""


def read_track(archive: Archive, vehicle: int, begin: float, end: float, points: int) -> Track:
    """Read the positions of a vehicle in a range [s since 1970], about as many as are wanted.

    Those are kept that the shape of latitude or of longitude over time needs, of those that can be true.

    Raises
    ------
    ArchiveError
        The archive fails.
    """
    told = told_places(archive, vehicle, begin, end)
    can_be = believed(told)
    whole = told.of(can_be)
    age = value_before(archive, vehicle, "fix_age_s", begin, end, whole.t)
    chosen = thinned(whole, points, age <= FRESH_FIX)
    kept = whole.of(chosen)
    return Track(
        kept.t.tolist(), kept.latitude.tolist(), kept.longitude.tolist(),
        [None if np.isnan(each) else each for each in kept.sigma.tolist()],
        [source_of(each) for each in age[chosen].tolist()],
        int(np.count_nonzero(~can_be)),
    )  # fmt: skip


def source_of(fix_age: float | None) -> str:
    """From what a position is known, by the time since the last fix [s]; it is an estimate if that is not told."""
    return BY_GPS if fix_age is not None and fix_age <= FRESH_FIX else ESTIMATED


def thinned(places: Places, points: int, fixed: NDArray[np.bool_]) -> NDArray[np.intp]:
    """Which of the positions to show, about as many as are wanted.

    They draw the same track, and show each surfacing by the ends of its fixes if that takes no more than a half.
    """
    if len(places.t) <= points:
        return np.arange(len(places.t))
    t_us = np.rint(places.t * 1e6).astype(np.int64)
    none: NDArray[np.intp] = np.empty(0, dtype=np.intp)
    change = np.flatnonzero(fixed[1:] != fixed[:-1])
    fixes = np.where(fixed[change], change, change + 1)
    fixes = fixes if fixes.size <= points // 2 else none
    over = np.unwrap(places.longitude, period=360.0)
    kept = [
        largest_triangles(Curve(t_us, value, len(t_us), 0.0), max(4, (points - fixes.size) // 2), none)
        for value in (places.latitude, over)
    ]
    return np.unique(np.concatenate([*kept, fixes]))
