"""How a vehicle floats: by the end that stands out of the water (hydrostatics of a slender body).

A vehicle with more volume than it weighs lies still with that surplus above the water. Tilted, it is the end that is up
which emerges: slices of the hull one after the other, beginning at the tip. Where the water line crosses the axis,
which volume is out and where its centre lies are tables over the surplus. Water in a flooded end is lifted with it: it
drains slowly.
"""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from stommel.compilation import inlined
from stommel.geometry.interpolation import interpolated
from stommel.vehicle import VehicleFile

Array = NDArray[np.float64]

SLICES = 2001
"""Of the hull along its axis, from which the tables are made."""


class HullForm(NamedTuple):
    """Both ends of the hull as they come out of the water; empty tables where the file does not tell the form."""

    slender: float
    """Diameter over length: tilted by less, the vehicle lies flat on the water."""
    tail_volume: Array
    """Volume from the tip of the tail forward, rising from zero [m3]."""
    tail_line: Array
    """Where the water line crosses the axis when this volume is out, forward of the origin [m]."""
    tail_moment: Array
    """First moment of this volume along the axis about the origin [m4]."""
    nose_volume: Array
    """The same from the tip of the nose aft."""
    nose_line: Array
    nose_moment: Array


def hull_form(d: VehicleFile) -> HullForm:
    """Form of the hull: half an ellipsoid for a nose, a cylinder, and a cone for a tail."""
    hull, none = d.hull, np.empty(0)
    if hull is None or hull.outer_diameter_mm is None:
        return HullForm(0.0, none, none, none, none, none, none)
    radius = 0.5 * hull.outer_diameter_mm / 1e3
    front, back = hull.nose_position_m, hull.nose_position_m - hull.length_m
    nose, tail = front + hull.nose_length_m, back - hull.tail_length_m
    x = np.linspace(tail, nose, SLICES)
    r = np.full_like(x, radius)
    if hull.nose_length_m > 0.0:
        ahead = np.clip((x - front) / hull.nose_length_m, 0.0, 1.0)
        r = np.minimum(r, radius * np.sqrt(1.0 - ahead**2))
    if hull.tail_length_m > 0.0:
        r = np.minimum(r, radius * np.clip((x - tail) / hull.tail_length_m, 0.0, 1.0))
    area = math.pi * r**2
    return HullForm(2.0 * radius / (nose - tail), *_emerging(x, area), *_emerging(x[::-1], area[::-1]))


def _emerging(x: Array, area: Array) -> tuple[Array, Array, Array]:
    """Volume, water line and first moment while the hull comes out slice by slice from the first."""
    width = np.abs(np.diff(x))
    volume = np.concatenate(([0.0], np.cumsum(0.5 * (area[1:] + area[:-1]) * width)))
    moment = np.concatenate(([0.0], np.cumsum(0.5 * ((area * x)[1:] + (area * x)[:-1]) * width)))
    few = np.unique(np.searchsorted(volume, volume[-1] * np.linspace(0.0, 0.5**0.25, 201) ** 4))
    return volume[few], x[few], moment[few]


@inlined
def tilt_share(form: HullForm, theta: float) -> float:
    """1 for a vehicle that stands out by one end; less, down to 0, for one that lies nearly flat."""
    if len(form.tail_volume) == 0:
        return 0.0
    return min(1.0, abs(math.tan(theta)) / form.slender)


@inlined
def _of_raised_end(form: HullForm, theta: float, surplus: float, tail: Array, nose: Array) -> float:
    """Value at a surplus volume [m3] of the table of the end that is up; the less, the flatter the vehicle lies."""
    share = tilt_share(form, theta)
    if share == 0.0:
        return 0.0
    value: float = (
        interpolated(surplus, form.tail_volume, tail) if theta < 0.0 else interpolated(surplus, form.nose_volume, nose)
    )
    return share * value


@inlined
def water_line(form: HullForm, theta: float, surplus: float) -> float:
    """Where the water's surface crosses the axis of a floating vehicle, forward of the origin [m]."""
    return _of_raised_end(form, theta, surplus, form.tail_line, form.nose_line)


@inlined
def emerged_moment(form: HullForm, theta: float, surplus: float) -> float:
    """First moment of the volume out of the water along the axis [m4]."""
    return _of_raised_end(form, theta, surplus, form.tail_moment, form.nose_moment)


def slice_at(form: HullForm, theta: float, surplus: float) -> float:
    """Area of the hull's cross-section at the water line [m2]."""
    volume, line = (form.tail_volume, form.tail_line) if theta < 0.0 else (form.nose_volume, form.nose_line)
    k = int(np.clip(np.searchsorted(volume, surplus), 1, len(volume) - 1))
    return float((volume[k] - volume[k - 1]) / abs(line[k] - line[k - 1]))
