"""Distance, bearing and travel on the ellipsoid WGS 84, by pyproj (Karney 2013)."""

from typing import NamedTuple

from pyproj import Geod

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
