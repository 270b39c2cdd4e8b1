"""The track that a preview predicts: kept in few points, and how far off it a vehicle is.

All on Mercator's map, on which the vehicle's lines are straight; distances are those at the place in question, true to
a thousandth as far as some tens of kilometres from the track.
"""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from stommel.geometry.geodesics import Place
from stommel.geometry.sea_chart import SeaChart

Array = NDArray[np.float64]


class Thinned(NamedTuple):
    """Which points of a track draw it."""

    kept: NDArray[np.intp]
    """In order; the first and the last are among them."""
    within_m: float
    """No point that was left out lies farther from the line through those that were kept."""


def thinned(track: Sequence[Place], most: int, within_m: float) -> Thinned:
    """Points that draw a track, by the algorithm of Douglas and Peucker (1973).

    Parameters
    ----------
    track
        One point at least.
    most
        Points that may be kept, 2 at least.
    within_m
        How far the line may come to lie from a point that is left out; doubled until there are no more than `most`.
    """
    latitude, longitude = np.array(track, dtype=float).T
    chart = SeaChart(float(longitude[0]))
    points, scale = chart.points(latitude, longitude), chart.scale(latitude)
    while len(kept := _needed(points, scale, within_m)) > most:
        within_m *= 2.0
    return Thinned(kept, within_m)


class PredictedTrack:
    """A track by its points, of which there is one at least."""

    def __init__(self, track: Sequence[Place]) -> None:
        latitude, longitude = np.array(track, dtype=float).T
        self._chart = SeaChart(float(longitude[0]))
        self._points = self._chart.points(latitude, longitude)

    def off(self, places: Sequence[Place | None]) -> list[float | None]:
        """How far each place lies from the nearest point of the line through the track [m]; None of one not known."""
        known = [place for place in places if place is not None]
        if not known:
            return [None] * len(places)
        latitude, longitude = np.array(known, dtype=float).T
        there = self._chart.points(latitude, longitude)
        begins, ends = self._points[:-1], self._points[1:]
        if len(self._points) == 1:
            begins = ends = self._points
        apart = _apart(there, begins, ends).min(axis=1) / self._chart.scale(latitude)
        found = iter(apart.tolist())
        return [None if place is None else next(found) for place in places]


def _needed(points: Array, scale: Array, within_m: float) -> NDArray[np.intp]:
    """Ends of the pieces that lie within a distance of all their points."""
    kept, pieces = {0, len(points) - 1}, [(0, len(points) - 1)]
    while pieces:
        first, last = pieces.pop()
        if last - first < 2:
            continue
        between = slice(first + 1, last)
        away = _apart(points[between], points[[first]], points[[last]])[:, 0] / scale[between]
        farthest = int(np.argmax(away))
        if away[farthest] > within_m:
            middle = first + 1 + farthest
            kept.add(middle)
            pieces += [(first, middle), (middle, last)]
    return np.array(sorted(kept), dtype=np.intp)


def _apart(points: Array, begins: Array, ends: Array) -> Array:
    """Distance of each point (row) from each straight piece (column)."""
    way, since = ends - begins, points[:, None] - begins
    length = np.sum(way**2, axis=-1)
    share = np.clip(np.sum(since * way, axis=-1) / np.where(length > 0.0, length, 1.0), 0.0, 1.0)
    return np.asarray(np.hypot(*np.moveaxis(since - share[..., None] * way, -1, 0)))
