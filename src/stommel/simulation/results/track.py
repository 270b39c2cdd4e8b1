"""The track for maps of others: GeoJSON (RFC 7946) or KML 2.2, with surfacings, waypoints, radius and planned legs.

Both are small, fixed formats of text; the standard library writes them.
"""

import json
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple
from xml.etree import ElementTree as ET

import numpy as np

from stommel.files.whole import require_file, write_whole
from stommel.geometry.geodesics import travel
from stommel.simulation.results.date_line import Point, area_pieces, line_pieces, rounded

if TYPE_CHECKING:
    import xarray as xr

ENDINGS = (".geojson", ".kml")
"""Of the names of track files."""

_MOST_POINTS = 5000
"""Of the track; of a longer record every so many rows, and the last."""
_BEARINGS = np.linspace(0.0, -360.0, 73)
"""Against the clock, as RFC 7946 asks of the outline of an area."""


class Feature(NamedTuple):
    """Something to draw, and what there is to say of it."""

    kind: str
    """LineString, Point or Polygon."""
    pieces: Sequence[Sequence[Point]]
    """Lines cut at the date line; one piece of a point or an outline."""
    properties: Mapping[str, Any]


def write_track(dataset: "xr.Dataset", path: Path) -> None:
    """Write a mission's track as the name of the file ends, whole or not at all.

    Raises
    ------
    OutputError
        The name ends otherwise, or the file cannot be written; what stood there before still does.
    """
    require_file(path, ENDINGS)
    write_whole(path, kml(dataset) if path.suffix.lower() == ".kml" else geojson(dataset))


def geojson(dataset: "xr.Dataset") -> str:
    """Return the track as a FeatureCollection of RFC 7946; the property `kind` says what each feature is."""
    features = [
        {"type": "Feature", "geometry": _geometry(feature), "properties": dict(feature.properties)}
        for feature in features_of(dataset)
    ]
    collection = {"type": "FeatureCollection", "name": str(dataset.attrs["title"]), "features": features}
    return json.dumps(collection, allow_nan=False, ensure_ascii=False) + "\n"


def _geometry(feature: Feature) -> dict[str, Any]:
    if feature.kind == "Point":
        return {"type": "Point", "coordinates": feature.pieces[0][0]}
    if feature.kind == "Polygon":
        if len(feature.pieces) == 1:
            return {"type": "Polygon", "coordinates": feature.pieces}
        return {"type": "MultiPolygon", "coordinates": [[piece] for piece in feature.pieces]}
    if len(feature.pieces) == 1:
        return {"type": "LineString", "coordinates": feature.pieces[0]}
    return {"type": "MultiLineString", "coordinates": feature.pieces}


def features_of(dataset: "xr.Dataset") -> list[Feature]:
    """Track, planned legs, waypoints with their radius, surfacings."""
    return [_track(dataset), *_plan(dataset), *_surfacings(dataset)]


def _track(dataset: "xr.Dataset") -> Feature:
    rows = dataset.sizes["time"]
    chosen = np.unique(np.append(np.arange(0, rows, -(-rows // _MOST_POINTS)), rows - 1))
    places = (dataset[name].values[chosen] for name in ("longitude", "latitude"))
    properties = {
        "kind": "track",
        "name": str(dataset.attrs["title"]),
        "outcome": str(dataset.attrs["outcome"]),
        "verdict": str(dataset.attrs["verdict"]),
        "start_utc": _utc(dataset["time"].values[0]),
        "end_utc": _utc(dataset["time"].values[-1]),
    }
    return Feature("LineString", line_pieces(*places), properties)


def _plan(dataset: "xr.Dataset") -> Iterator[Feature]:
    """Planned legs from the start, and each waypoint with its radius."""
    if not dataset.sizes["waypoint"]:
        return
    longitude, latitude = (
        np.concatenate([dataset[name].values[:1], dataset[f"waypoint_{name}"].values])
        for name in ("longitude", "latitude")
    )
    yield Feature("LineString", line_pieces(longitude, latitude), {"kind": "planned legs", "name": "planned legs"})
    radius = float(dataset["acceptance_radius"])
    for k in range(dataset.sizes["waypoint"]):
        after = float(dataset["waypoint_reached_after"].values[k])
        reached = _utc(dataset["time"].values[0] + np.timedelta64(round(after), "s")) if np.isfinite(after) else None
        nearest = float(dataset["waypoint_closest_approach"].values[k])
        properties = {
            "name": f"waypoint {k + 1}",
            "reached_utc": reached,
            "closest_m": round(nearest, 1) if np.isfinite(nearest) else None,
            "acceptance_radius_m": radius,
        }
        place = float(longitude[k + 1]), float(latitude[k + 1])
        yield Feature("Point", [[rounded(*place)]], {"kind": "waypoint"} | properties)
        circle = [travel(place[1], place[0], float(bearing), radius) for bearing in _BEARINGS]
        outline = [(p.longitude_deg, p.latitude_deg) for p in circle]
        yield Feature("Polygon", area_pieces(outline, place[0]), {"kind": "acceptance radius"} | properties)


def _surfacings(dataset: "xr.Dataset") -> Iterator[Feature]:
    for k in range(dataset.sizes["surfacing"]):
        place = (float(dataset[f"surfacing_{name}"].values[k]) for name in ("longitude", "latitude"))
        current = {
            f"current_{way}_m_s": round(float(dataset[f"depth_averaged_current_{way}"].values[k]), 4)
            for way in ("north", "east")
        }
        when = _utc(dataset["surfacing_time"].values[k])
        properties = {"kind": "surfacing", "name": f"surfacing {k + 1}", "time_utc": when} | current
        yield Feature("Point", [[rounded(*place)]], properties)


def _utc(time: np.datetime64) -> str:
    return f"{np.datetime_as_string(time, unit='s')}Z"


_KML = "http://www.opengis.net/kml/2.2"
_STYLES = {
    "track": ("ffa4620b", 3), "planned legs": ("ff75685c", 2), "acceptance radius": ("ff1b50c4", 2),
    "waypoint": ("ff1b50c4", 0), "surfacing": ("ff33271d", 0),
}  # fmt: skip
"""Colour (opacity, blue, green, red) and width of each kind."""


def kml(dataset: "xr.Dataset") -> str:
    """Return the track as a KML document, a folder for each kind; surfacings carry their time."""
    root = ET.Element("kml", xmlns=_KML)
    document = ET.SubElement(root, "Document")
    ET.SubElement(document, "name").text = str(dataset.attrs["title"])
    ET.SubElement(document, "description").text = str(dataset.attrs["verdict"])
    for kind, (colour, width) in _STYLES.items():
        style = ET.SubElement(document, "Style", id=kind.replace(" ", "_"))
        line = ET.SubElement(style, "LineStyle")
        ET.SubElement(line, "color").text = colour
        ET.SubElement(line, "width").text = str(max(width, 1))
        ET.SubElement(ET.SubElement(style, "PolyStyle"), "fill").text = "0"
    folders: dict[str, ET.Element] = {}
    for feature in features_of(dataset):
        kind = str(feature.properties["kind"])
        if kind not in folders:
            folders[kind] = ET.SubElement(document, "Folder")
            ET.SubElement(folders[kind], "name").text = kind
        _placemark(folders[kind], feature)
    ET.indent(root)
    return ET.tostring(root, encoding="unicode", xml_declaration=True) + "\n"


def _placemark(folder: ET.Element, feature: Feature) -> None:
    mark = ET.SubElement(folder, "Placemark")
    told = dict(feature.properties)
    ET.SubElement(mark, "name").text = str(told.pop("name"))
    kind = str(told.pop("kind"))
    if "time_utc" in told:
        ET.SubElement(ET.SubElement(mark, "TimeStamp"), "when").text = str(told["time_utc"])
    ET.SubElement(mark, "styleUrl").text = f"#{kind.replace(' ', '_')}"
    data = ET.SubElement(mark, "ExtendedData")
    for name, value in told.items():
        if value is not None:
            ET.SubElement(ET.SubElement(data, "Data", name=name), "value").text = str(value)
    place = mark if len(feature.pieces) == 1 else ET.SubElement(mark, "MultiGeometry")
    for piece in feature.pieces:
        shape = ET.SubElement(place, feature.kind)
        if feature.kind == "LineString":
            ET.SubElement(shape, "tessellate").text = "1"
        elif feature.kind == "Polygon":
            shape = ET.SubElement(ET.SubElement(shape, "outerBoundaryIs"), "LinearRing")
        ET.SubElement(shape, "coordinates").text = " ".join(f"{east},{north}" for east, north in piece)
