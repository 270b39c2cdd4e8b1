"""Which water to expect at a place where nobody says: the sea that lies there, or one that is the same everywhere."""

from math import cos, radians, sin

from stommel.geometry.geodesics import Place, leg

EAST_CHINA_SEA, EVERYWHERE = "east_china_sea", "south_china_sea"
"""The analytic ocean of the shelf that the glider is meant for; and water at rest, stratified, without a place."""

_MIDDLE, _BEARING_DEG = Place(28.2, 126.6), 45.0
"""Of the shelf break, and which way it runs."""
_ALONG, _ACROSS = (-290e3, 290e3), (-240e3, 190e3)
"""How far that ocean reaches, less a dive's way [m]."""
_DEEP_FROM = 60e3
"""Across it, from where on any dive has room [m]."""
SHELF_M = 70.0
"""Depth of dives that the shelf has room for [m]."""


def ocean_at(place: Place) -> str:
    """Name of the analytic ocean to expect at a place."""
    along, across = _from_middle(place)
    inside = _ALONG[0] <= along <= _ALONG[1] and _ACROSS[0] <= across <= _ACROSS[1]
    return EAST_CHINA_SEA if inside else EVERYWHERE


def room_at(place: Place, wanted: float) -> float:
    """Depth of dives that the expected water has room for around a place: as wanted, or less on the shelf [m]."""
    on_shelf = ocean_at(place) == EAST_CHINA_SEA and _from_middle(place)[1] < _DEEP_FROM
    return min(wanted, SHELF_M) if on_shelf else wanted


def _from_middle(place: Place) -> tuple[float, float]:
    """Way along the shelf break, and across it, positive offshore [m]."""
    way = leg(*_MIDDLE, *place)
    angle = radians(way.bearing_deg - _BEARING_DEG)
    return way.distance_m * cos(angle), way.distance_m * sin(angle)
