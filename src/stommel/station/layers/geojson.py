"""GeoJSON (RFC 7946) as a chart layer: its geometry is checked whole, other members are left out."""

import math
from collections.abc import Iterator
from typing import Any

from stommel.errors import one_line
from stommel.station.layers.bounds import Bounds, LayerError

MOST_POSITIONS = 100_000
MOST_PARTS = 20_000
"""Features and geometries."""
_DEEPEST = 4
"""Of collections in collections."""
_LONGEST_TEXT = 500
_DEPTH = {
    "Point": 0, "MultiPoint": 1, "LineString": 1, "MultiLineString": 2, "Polygon": 2, "MultiPolygon": 3,
}  # fmt: skip
"""How many lists a position lies in, by type."""
_ALLOWED = "a FeatureCollection, a Feature or a geometry of RFC 7946"


class _Budget:
    """Counts what a layer holds, and where it lies."""

    def __init__(self) -> None:
        self.positions = self.parts = 0
        self.west = self.south = math.inf
        self.east = self.north = -math.inf

    def part(self, where: str) -> None:
        self.parts += 1
        if self.parts > MOST_PARTS:
            raise _refused(where, f"more than {MOST_PARTS} features and geometries", f"at most {MOST_PARTS}")

    def position(self, longitude: float, latitude: float, where: str) -> None:
        self.positions += 1
        if self.positions > MOST_POSITIONS:
            raise _refused(where, f"more than {MOST_POSITIONS} positions; thin it out", f"at most {MOST_POSITIONS}")
        self.west, self.east = min(self.west, longitude), max(self.east, longitude)
        self.south, self.north = min(self.south, latitude), max(self.north, latitude)


def checked_geojson(content: Any) -> tuple[dict[str, Any], Bounds]:
    """Return what is drawn of GeoJSON, and where it lies.

    Raises
    ------
    LayerError
        It is none, has a position that is not on the globe, or too much of everything.
    """
    budget = _Budget()
    drawn = _object(content, "geojson", 0, budget)
    if not budget.positions:
        raise _refused("geojson", "has no position, so nothing would be drawn", "at least one position")
    return drawn, Bounds(budget.west, budget.south, budget.east, budget.north)


def _object(content: Any, where: str, depth: int, budget: _Budget) -> dict[str, Any]:
    budget.part(where)
    kind = content.get("type") if isinstance(content, dict) else None
    if kind == "FeatureCollection" and depth == 0:
        features = _list(content.get("features"), f"{where}.features")
        return {"type": kind, "features": [_feature(one, at, budget) for at, one in features]}
    if kind == "Feature" and depth == 0:
        return _feature(content, where, budget)
    return _geometry(content, where, depth, budget)


def _feature(content: Any, where: str, budget: _Budget) -> dict[str, Any]:
    budget.part(where)
    if not isinstance(content, dict) or content.get("type") != "Feature":
        raise _refused(where, "is no Feature", "a Feature")
    geometry = content.get("geometry")
    drawn = None if geometry is None else _geometry(geometry, f"{where}.geometry", 0, budget)
    return {"type": "Feature", "geometry": drawn, "properties": _properties(content.get("properties"))}


def _geometry(content: Any, where: str, depth: int, budget: _Budget) -> dict[str, Any]:
    budget.part(where)
    kind = content.get("type") if isinstance(content, dict) else None
    if kind == "GeometryCollection":
        if depth >= _DEEPEST:
            raise _refused(where, "collections lie too deep in each other", f"at most {_DEEPEST} levels")
        parts = _list(content.get("geometries"), f"{where}.geometries")
        return {"type": kind, "geometries": [_geometry(one, at, depth + 1, budget) for at, one in parts]}
    if not isinstance(kind, str) or kind not in _DEPTH:
        words = "has no type" if kind is None else f"type = {one_line(repr(kind), 60)} is not known"
        raise _refused(where, words, _ALLOWED)
    coordinates = _coordinates(content.get("coordinates"), _DEPTH[kind], f"{where}.coordinates", budget)
    return {"type": kind, "coordinates": coordinates}


def _coordinates(content: Any, depth: int, where: str, budget: _Budget) -> list[Any]:
    if depth == 0:
        return _position(content, where, budget)
    return [_coordinates(one, depth - 1, at, budget) for at, one in _list(content, where)]


def _position(content: Any, where: str, budget: _Budget) -> list[float]:
    numbers = content[:2] if isinstance(content, list) and 2 <= len(content) <= 4 else []
    if len(numbers) != 2 or not all(type(number) in (int, float) for number in numbers):
        raise _refused(where, "is no position", "[longitude, latitude]")
    longitude, latitude = numbers
    if not (-180 <= longitude <= 180 and -90 <= latitude <= 90):
        words = f"{one_line(str(numbers), 60)} is not on the globe; longitude comes first, in degrees"
        raise _refused(where, words, "longitude -180 to 180, latitude -90 to 90")
    budget.position(longitude, latitude, where)
    return [float(longitude), float(latitude)]


def _list(content: Any, where: str) -> Iterator[tuple[str, Any]]:
    if not isinstance(content, list):
        raise _refused(where, "is no list", "a list")
    return ((f"{where}[{place}]", one) for place, one in enumerate(content))


def _properties(content: Any) -> dict[str, Any]:
    """Names and numbers of a feature; what is longer or nested is left out."""
    if not isinstance(content, dict):
        return {}
    return {
        key: value
        for key, value in list(content.items())[:50]
        if len(key) <= 80 and (value is None or isinstance(value, bool | int | float | str))
        and len(str(value)) <= _LONGEST_TEXT
    }  # fmt: skip


def _refused(where: str, words: str, allowed: str) -> LayerError:
    return LayerError(f"{one_line(where, 120)}: {words}", one_line(where, 120), allowed)
