"""Lines and outlines cut at the date line, as RFC 7946 asks, so that no program draws them around the Earth."""

from collections.abc import Sequence
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Point = tuple[float, float]
"""Longitude and latitude [deg]."""

_DIGITS = 7
"""Of a degree: a centimetre."""


def rounded(longitude: float, latitude: float) -> Point:
    """Longitude from -180 to 180, and latitude."""
    beside = (longitude + 180.0) % 360.0 - 180.0
    return round(beside, _DIGITS), round(latitude, _DIGITS)


def line_pieces(longitude: Array, latitude: Array) -> list[list[Point]]:
    """Cut a line where it crosses the date line; both pieces end there, on their own side."""
    pieces: list[list[Point]] = [[rounded(float(longitude[0]), float(latitude[0]))]]
    for east, north in zip(longitude[1:], latitude[1:], strict=True):
        before, here = pieces[-1][-1], rounded(float(east), float(north))
        if abs(here[0] - before[0]) > 180.0:
            side = 180.0 if before[0] > 0.0 else -180.0
            way = here[0] + 2.0 * side - before[0]
            share = (side - before[0]) / way if way else 0.0
            cut = round(before[1] + share * (here[1] - before[1]), _DIGITS)
            pieces[-1].append((side, cut))
            pieces.append([(-side, cut)])
        pieces[-1].append(here)
    if len(pieces) == 1 and len(pieces[0]) == 1:  # a line has two ends, be they in one place
        pieces[0] = pieces[0] * 2
    return pieces


def area_pieces(outline: Sequence[Point], middle: float) -> list[list[Point]]:
    """Cut an outline around the longitude `middle` at the date line: the part on its side, and the part beyond."""
    beside = (middle + 180.0) % 360.0 - 180.0
    unbroken = [(beside + (east - beside + 180.0) % 360.0 - 180.0, north) for east, north in outline]
    side = 180.0 if beside > 0.0 else -180.0
    inner, outer = (_clipped(unbroken, side, within=within) for within in (True, False))
    whole = [
        [(east - (2.0 * side if k else 0.0), north) for east, north in part] for k, part in enumerate((inner, outer))
    ]
    return [[(round(e, _DIGITS), round(n, _DIGITS)) for e, n in part] for part in whole if part]


def _clipped(outline: Sequence[Point], side: float, *, within: bool) -> list[Point]:
    """Part of an outline on one side of a meridian (Sutherland and Hodgman 1974), closed; empty if there is none."""
    sign = 1.0 if (side > 0.0) == within else -1.0
    kept: list[Point] = []
    for (x0, y0), (x1, y1) in pairwise(outline):
        inside, next_inside = sign * (side - x0) >= 0.0, sign * (side - x1) >= 0.0
        if inside:
            kept.append((x0, y0))
        if inside != next_inside:
            kept.append((side, y0 + (side - x0) / (x1 - x0) * (y1 - y0)))
    return [*kept, kept[0]] if len(kept) > 2 else []
