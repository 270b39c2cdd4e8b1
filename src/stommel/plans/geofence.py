"""An area on the map that a plan may not leave.

Its sides are straight on Mercator's map, as the page draws them and as the vehicle steers between waypoints; longitudes
are counted from its first corner, so that it may lie across the date line. It contains no pole.
"""

import math
from collections.abc import Sequence
from itertools import combinations

from stommel.geometry.geodesics import Place

Point = tuple[float, float]
"""Longitude from the first corner [deg], and how far north on Mercator's map [deg of longitude at the equator]."""
WIDEST_DEG = 180.0
"""Of longitude: in a wider one, which way a side goes around the Earth would not be certain."""
_FARTHEST_NORTH_DEG = 89.9


class Geofence:
    """An area by its corners, three at least."""

    def __init__(self, corners: Sequence[Place]) -> None:
        self._middle = corners[0].longitude_deg
        self._corners = [self._point(corner) for corner in corners]

    def holds(self, place: Place) -> bool:
        """Whether a place lies inside; one on a side does not, or does: it makes no difference at sea."""
        x, y = self._point(place)
        inside = False
        for (x0, y0), (x1, y1) in self._sides():
            if (y0 > y) != (y1 > y) and x < x0 + (y - y0) / (y1 - y0) * (x1 - x0):
                inside = not inside
        return inside

    def cuts(self, begin: Place, end: Place) -> bool:
        """Whether the straight way from one place to another goes through a side."""
        way = self._point(begin), self._point(end)
        return any(_cross(way, side) for side in self._sides())

    def crosses_itself(self) -> tuple[int, int] | None:
        """Two sides that cross each other, counted from 0; None where none do."""
        count = len(self._corners)
        sides = list(enumerate(self._sides()))
        for (i, one), (j, other) in combinations(sides, 2):
            neighbours = j - i in (1, count - 1)
            if not neighbours and _cross(one, other):
                return i, j
        return None

    def is_too_wide(self) -> bool:
        """Whether its corners lie too far apart in longitude."""
        longitudes = [x for x, _ in self._corners]
        return max(longitudes) - min(longitudes) >= WIDEST_DEG

    def _sides(self) -> list[tuple[Point, Point]]:
        return list(zip(self._corners, self._corners[1:] + self._corners[:1], strict=True))

    def _point(self, place: Place) -> Point:
        latitude = max(-_FARTHEST_NORTH_DEG, min(_FARTHEST_NORTH_DEG, place.latitude_deg))
        north = math.degrees(math.asinh(math.tan(math.radians(latitude))))
        return (place.longitude_deg - self._middle + 180.0) % 360.0 - 180.0, north


def _cross(one: tuple[Point, Point], other: tuple[Point, Point]) -> bool:
    """Whether two straight pieces cross or touch."""
    (a, b), (c, d) = one, other
    turns = _turn(a, b, c), _turn(a, b, d), _turn(c, d, a), _turn(c, d, b)
    if turns[0] * turns[1] < 0.0 and turns[2] * turns[3] < 0.0:
        return True
    ends = ((turns[0], c, one), (turns[1], d, one), (turns[2], a, other), (turns[3], b, other))
    return any(turn == 0.0 and _between(point, piece) for turn, point, piece in ends)


def _turn(a: Point, b: Point, c: Point) -> float:
    """Positive where a, b, c turn to the left."""
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])


def _between(point: Point, piece: tuple[Point, Point]) -> bool:
    """Whether a point of a piece's line lies on the piece."""
    return all(min(p, q) <= v <= max(p, q) for v, p, q in zip(point, *piece, strict=True))
