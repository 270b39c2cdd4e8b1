"""Latitude and longitude of the nodes of a CF file, and the angle of its axes to east and north."""

import warnings
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, NoReturn

import numpy as np
from numpy.typing import NDArray
from pyproj import CRS, Transformer
from pyproj.exceptions import CRSError

from stommel.ocean.reading.units import EAST, NORTH
from stommel.ocean.reading.variables import File

Array = NDArray[np.float64]

_STEP = 100.0
"""Length along the grid's x over which its direction is taken [m]."""
_STEP_DEG = 1e-3
"""The same on a grid with a rotated pole [deg]."""
_MISFIT = 0.02
"""Largest departure of a grid line from a straight one that passes, in cells."""
_ROTATED = {"projection_x_coordinate": "grid_longitude", "projection_y_coordinate": "grid_latitude"}
_MAP_TEXTS = ("crs_wkt", "spatial_ref", "proj4_string", "proj4", "proj4text")


@dataclass(frozen=True)
class Nodes:
    """Where the nodes are."""

    rows: str
    """Dimension j."""
    columns: str
    """Dimension i."""
    latitude: Array
    """(j, i) [rad]"""
    longitude: Array
    """(j, i) [rad]"""
    angle: Array
    """From east to the grid's x axis, counterclockwise (j, i) [rad]."""
    how: str
    """How the angle was found."""


def read_nodes(file: File, variable: str, others: tuple[str, ...], *, turned: bool) -> Nodes:
    """Nodes of a variable whose dimensions, beside `others` and those of size 1, are the two horizontal ones.

    With `turned`, the angle of the grid's axes to east is found too.
    """
    flat = [str(d) for d in file.data[variable].dims if d not in others]
    latitude, longitude = _coordinate(file, "latitude", flat), _coordinate(file, "longitude", flat)
    named = _dims(file, latitude) | _dims(file, longitude)
    flat = [d for d in flat if d in named or file.data.sizes[d] > 1]
    mapping = _mapping(file, variable)
    if latitude is None or longitude is None:
        if len(flat) != 2:
            _refuse_shape(file, variable, flat)
        return _projected(file, flat, mapping, variable)
    lat, lon = file.numbers(latitude, "angle"), file.numbers(longitude, "angle")
    dims = tuple(map(str, file.data[latitude].dims))
    if not flat and lat.size == 1 and lon.size == 1:
        here = lat.reshape(1, 1), lon.reshape(1, 1)
        nodes = Nodes("", "", *here, *_turning(file, mapping, *here, turned))
    elif len(flat) != 2 or (lat.ndim == 1 and dims == tuple(map(str, file.data[longitude].dims))):
        _refuse_shape(file, variable, flat)
    elif lat.ndim == 1 and lon.ndim == 1:
        rows, columns = dims[0], str(file.data[longitude].dims[0])
        _check_monotonic(file, latitude, lat)
        _check_monotonic(file, longitude, np.unwrap(lon[np.isfinite(lon)]))
        file.require_count(latitude, lat.size * lon.size, "nodes")
        lon2, lat2 = np.meshgrid(lon, lat)
        nodes = Nodes(rows, columns, lat2, lon2, np.zeros_like(lat2), "the axes are east and north")
    else:
        lon = lon if file.data[longitude].dims == file.data[latitude].dims else lon.T
        if lat.ndim != 2 or lon.shape != lat.shape:
            file.refuse(latitude, f"{latitude} and {longitude} must both be over {', '.join(flat)}")
        nodes = Nodes(dims[0], dims[1], lat, lon, *_turning(file, mapping, lat, lon, turned))
    _check(file, latitude, nodes)
    return nodes


def _check_monotonic(file: File, name: str, values: Array) -> None:
    values = values[np.isfinite(values)]
    steps = np.diff(values)
    if not (np.all(steps > 0.0) or np.all(steps < 0.0)):
        n = int(np.flatnonzero(np.sign(steps) != np.sign(steps[0]))[0]) if steps[0] != 0.0 else 0
        pair = " is followed by ".join(f"{np.degrees(value):g}" for value in values[n : n + 2])
        file.refuse(name, f"{name} neither increases nor decreases from node to node: {pair} deg at index {n}")


def _turning(file: File, mapping: CRS | None, lat: Array, lon: Array, turned: bool) -> tuple[Array, str]:
    if turned:
        return _angle(file, mapping, lat, lon)
    return np.zeros_like(lat), "nothing: they are east and north"


def _refuse_shape(file: File, variable: str, flat: list[str]) -> NoReturn:
    found = ", ".join(flat) or "none"
    file.refuse(
        variable,
        f"{variable} must have two horizontal dimensions with a latitude and a longitude, has {found}; unstructured "
        "grids and tracks must be interpolated to a grid first",
    )


def _dims(file: File, name: str | None) -> set[str]:
    return set(map(str, file.data[name].dims)) if name is not None else set()


def _coordinate(file: File, what: str, flat: list[str]) -> str | None:
    """Latitude or longitude variable over the horizontal dimensions; one number where there are none."""
    units = {"latitude": NORTH, "longitude": EAST}[what]
    name = file.find(what, needed=False)
    if name is None or not _dims(file, name) <= set(flat):
        for candidate in map(str, file.data.variables):
            given = str(file.data[candidate].attrs.get("units", "")).lower()
            if given in units and _dims(file, candidate) <= set(flat):
                return candidate
        return None
    return name


def _check(file: File, latitude: str, nodes: Nodes) -> None:
    if min(nodes.latitude.shape) < 2 and nodes.latitude.size != 1:
        rows, columns = nodes.latitude.shape
        file.refuse(latitude, f"the grid has {rows} x {columns} nodes; a single one or at least 2 x 2 are needed")


def _mapping(file: File, variable: str) -> CRS | None:
    """Map projection of a variable, by its grid mapping (CF, section 5.6)."""
    name = str(file.data[variable].attrs.get("grid_mapping", "")).split(":")[0].strip()
    if name not in file.data.variables:
        return None
    attributes: dict[str, Any] = dict(file.data[name].attrs)
    texts = [attributes.pop(key) for key in _MAP_TEXTS if key in attributes]
    found = next((crs for text in texts if (crs := _crs(CRS.from_user_input, text)) is not None), None)
    found = _crs(CRS.from_cf, attributes) if found is None else found
    if found is None:
        return None
    rotated = found.is_geographic and found.is_derived
    return found if found.is_projected or rotated else None


def _crs(make: Callable[[Any], CRS], given: Any) -> CRS | None:
    try:
        return make(given)
    except (CRSError, KeyError, ValueError, TypeError):
        return None


def _axis(file: File, dimension: str, standard: str) -> Array | None:
    """Map coordinate of a dimension [m, or rotated deg]."""
    if dimension not in file.data.variables:
        return None
    given = file.standard_name(dimension)
    if given == standard:
        return file.numbers(dimension, "length_of_map")
    if given == _ROTATED[standard]:
        return np.degrees(file.numbers(dimension, "angle"))
    return None


def _axes(file: File, flat: list[str]) -> tuple[str, str, Array, Array] | None:
    """Dimensions j and i with their projection coordinates."""
    for rows, columns in (flat, flat[::-1]):
        x = _axis(file, columns, "projection_x_coordinate")
        y = _axis(file, rows, "projection_y_coordinate")
        if x is not None and y is not None:
            return rows, columns, x, y
    return None


def _projected(file: File, flat: list[str], mapping: CRS | None, variable: str) -> Nodes:
    """Nodes of a file that gives only map coordinates."""
    axes = _axes(file, flat)
    if mapping is None or axes is None:
        file.refuse(
            variable,
            f"{variable} has the dimensions {', '.join(map(str, file.data[variable].dims))}, and over "
            f"{', '.join(flat)} the file has neither latitude and longitude nor projection_x_coordinate and "
            "projection_y_coordinate with a map projection (grid_mapping); interpolate a staggered grid to one set of "
            "nodes first",
        )
    rows, columns, x, y = axes
    file.require_count(variable, x.size * y.size, "nodes")
    X, Y = np.meshgrid(x, y)
    lon, lat = _geodetic(mapping).transform(X, Y, direction="INVERSE")
    latitude, longitude = np.radians(lat), np.radians(lon)
    nodes = Nodes(rows, columns, latitude, longitude, map_angle(mapping, latitude, longitude), "the map projection")
    _check(file, variable, nodes)
    return nodes


def _angle(file: File, mapping: CRS | None, latitude: Array, longitude: Array) -> tuple[Array, str]:
    name = file.find("angle", needed=False)
    if name is not None:
        angle = file.numbers(name, "angle")
        angle = angle if angle.shape == latitude.shape else angle.T
        if angle.shape != latitude.shape:
            file.refuse(name, f"{name} must be given at the nodes, {' x '.join(map(str, latitude.shape))}")
        return angle, f"the variable {name}"
    if mapping is not None and (latitude.size == 1 or _fits(mapping, latitude, longitude)):
        return map_angle(mapping, latitude, longitude), "the map projection"
    if latitude.size == 1:
        file.refuse("current_x", "has currents along a grid's axes at one place, and neither their angle nor a map")
    return node_angle(latitude, longitude), "the places of the nodes: no angle and no map projection that fits"


def _fits(mapping: CRS, latitude: Array, longitude: Array) -> bool:
    """Whether the map projection makes the grid's lines straight along its own axes.

    The map coordinates of the file are not asked: files cut or averaged from another grid keep them half a cell off.
    """
    known = np.isfinite(latitude) & np.isfinite(longitude)
    X, Y = (np.array(a) for a in _geodetic(mapping).transform(np.degrees(longitude), np.degrees(latitude)))
    if not (np.all(np.isfinite(X[known])) and np.all(np.isfinite(Y[known]))):
        return False
    X[~known], Y[~known] = np.nan, np.nan
    if not mapping.is_projected:  # rotated longitudes, which may cross their own date line
        middle = np.degrees(np.angle(np.nanmean(np.exp(1j * np.radians(X)))))
        X = middle + (X - middle + 180.0) % 360.0 - 180.0
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # a row without any place
        cell = min(float(np.nanmean(np.abs(np.diff(a, axis=axis)))) for a, axis in _varying(X, Y))
        crooked = max(
            float(np.nanmax(np.nanmax(a, axis=1 - axis) - np.nanmin(a, axis=1 - axis))) for a, axis in _varying(X, Y)
        )
    return crooked < _MISFIT * cell


def _varying(X: Array, Y: Array) -> list[tuple[Array, int]]:
    """Each map coordinate with the axis of the array along which it changes most."""
    along = 1 if np.nanmean(np.abs(np.diff(X, axis=1))) > np.nanmean(np.abs(np.diff(X, axis=0))) else 0
    return [(X, along), (Y, 1 - along)]


def _geodetic(mapping: CRS) -> Transformer:
    """From longitude and latitude on the projection's own ellipsoid [deg] to map coordinates [m, or rotated deg]."""
    base = mapping.geodetic_crs if mapping.is_projected else mapping.source_crs
    return Transformer.from_crs(base, mapping, always_xy=True)


def map_angle(mapping: CRS, latitude: Array, longitude: Array) -> Array:
    """Angle from east to the x axis of a map projection [rad]: the direction of a short step along x, in space."""
    ellipsoid = mapping.ellipsoid
    flattening = 1.0 / ellipsoid.inverse_flattening if ellipsoid is not None and ellipsoid.inverse_flattening else 0.0
    turn = _geodetic(mapping)
    X, Y = turn.transform(np.degrees(longitude), np.degrees(latitude))
    step = _STEP if mapping.is_projected else _STEP_DEG
    ends = []
    for side in (-0.5, 0.5):
        lon, lat = turn.transform(X + side * step, Y, direction="INVERSE")
        with np.errstate(invalid="ignore"):  # nodes without a place
            ends.append(_in_space(np.radians(lat), np.radians(lon), flattening))
    return _direction(latitude, longitude, ends[1] - ends[0])


def node_angle(latitude: Array, longitude: Array) -> Array:
    """Angle from east to the direction of growing i [rad], by differences of neighbouring nodes on the sphere."""
    places = _in_space(latitude, longitude, 0.0)
    steps = np.diff(places, axis=2)
    ahead, behind = (np.concatenate(parts, axis=2) for parts in ((steps, steps[:, :, -1:]), (steps[:, :, :1], steps)))
    # beside a node without a place the difference to the other side is taken
    step = np.where(np.isnan(ahead), behind, np.where(np.isnan(behind), ahead, ahead + behind))
    return _direction(latitude, longitude, step)


def _in_space(latitude: Array, longitude: Array, flattening: float) -> Array:
    """Cartesian places on an ellipsoid of semi-major axis 1 (3, j, i)."""
    square = flattening * (2.0 - flattening)
    normal = 1.0 / np.sqrt(1.0 - square * np.sin(latitude) ** 2)
    across = normal * np.cos(latitude)
    along = normal * (1.0 - square) * np.sin(latitude)
    return np.array([across * np.cos(longitude), across * np.sin(longitude), along])


def _direction(latitude: Array, longitude: Array, step: Array) -> Array:
    """Angle from east to a short step in space [rad], counterclockwise."""
    east = np.array([-np.sin(longitude), np.cos(longitude), np.zeros_like(longitude)])
    north = np.array([-np.sin(latitude) * np.cos(longitude), -np.sin(latitude) * np.sin(longitude), np.cos(latitude)])
    angle: Array = np.arctan2((step * north).sum(axis=0), (step * east).sum(axis=0))
    return angle
