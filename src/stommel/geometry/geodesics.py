"""Distance, bearing and travel on the ellipsoid WGS 84, by pyproj (Karney 2013)."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from pyproj import Geod

from stommel.geometry.sea_chart import SeaChart

Array = NDArray[np.float64]

_WGS84 = Geod(ellps="WGS84")


class Leg(NamedTuple):
    """The shortest way from one place to another."""

    distance_m: float
    bearing_deg: float
    """At the start, clockwise from north, 0 to 360."""
    final_bearing_deg: float
    """At the end."""


class Place(NamedTuple):
    """A geodetic position."""

    latitude_deg: float
    longitude_deg: float


def leg(latitude_deg: float, longitude_deg: float, to_latitude_deg: float, to_longitude_deg: float) -> Leg:
    """Distance and bearings between two places (the inverse problem), to nanometres."""
    azimuth, back, distance = _WGS84.inv(longitude_deg, latitude_deg, to_longitude_deg, to_latitude_deg)
    return Leg(float(distance), float(azimuth) % 360.0, (float(back) + 180.0) % 360.0)


def travel(latitude_deg: float, longitude_deg: float, bearing_deg: float, distance_m: float) -> Place:
    """Place that is reached along the geodesic that starts with a bearing (the direct problem)."""
    longitude, latitude, _ = _WGS84.fwd(longitude_deg, latitude_deg, bearing_deg, distance_m)
    return Place(float(latitude), float(longitude))


def distances(latitude_deg: Array, longitude_deg: Array, to_latitude_deg: float, to_longitude_deg: float) -> Array:
    """Distance of each of many places from one [m]."""
    return np.hypot(*offsets(latitude_deg, longitude_deg, to_latitude_deg, to_longitude_deg))


def offsets(
    latitude_deg: Array, longitude_deg: Array, from_latitude_deg: float, from_longitude_deg: float
) -> tuple[Array, Array]:
    """East and north of many places as seen from one [m]: true distance in the true direction."""
    one = np.ones_like(latitude_deg)
    azimuth, _, distance = _WGS84.inv(from_longitude_deg * one, from_latitude_deg * one, longitude_deg, latitude_deg)
    return distance * np.sin(np.radians(azimuth)), distance * np.cos(np.radians(azimuth))


def line_length(latitude_deg: Array, longitude_deg: Array) -> float:
    """Length of the way through many places [m]."""
    return float(_WGS84.line_length(longitude_deg, latitude_deg))


def lengths_along(latitude_deg: Array, longitude_deg: Array) -> Array:
    """How far along the way through many places each of them lies, from the first [m].

    A place that is not a number lies nowhere, and the way goes past it.
    """
    known = np.isfinite(latitude_deg) & np.isfinite(longitude_deg)
    found = np.full(np.shape(latitude_deg), np.nan)
    steps = _WGS84.line_lengths(longitude_deg[known], latitude_deg[known])
    found[known] = np.concatenate([[0.0], np.cumsum(steps)])[: known.sum()]
    return found


def beside_line(latitude_deg: Array, longitude_deg: Array, start: Place, end: Place) -> Array:
    """Distance of many places from the rhumb line from `start` to `end` and beyond, positive to starboard [m].

    The rhumb line (of one bearing) is straight on the Mercator map, which is true to angles and has one scale around
    each place. Not a number where start and end are the same.
    """
    chart = SeaChart(end.longitude_deg)
    (x0, y0), (x1, y1) = (chart.points(np.array([place[0]]), np.array([place[1]]))[0] for place in (start, end))
    x, y = chart.points(latitude_deg, longitude_deg).T
    along, scale = np.hypot(x1 - x0, y1 - y0), chart.scale(latitude_deg)
    if along == 0.0:
        return np.full_like(scale, np.nan)
    return np.asarray(((x - x1) * (y1 - y0) - (y - y1) * (x1 - x0)) / along / scale)
