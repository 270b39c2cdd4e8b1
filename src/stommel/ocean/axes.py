"""Time and depth of a CF file."""

from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from stommel.ocean import times as clock
from stommel.ocean.variables import File

Array = NDArray[np.float64]

_TERRAIN = ("sigma", "ocean_s", "s_coordinate", "ocean_double")
_SURFACE = -10.0
"""Levels higher than this above the surface are refused [m, positive down]; a little is a moving sea surface."""


def time_dimension(file: File, variable: str) -> str | None:
    """Dimension of a variable that is time, if it has one."""
    if "time" in file.names:
        return file.names["time"]
    for dimension in file.data[variable].dims:
        attributes = _attributes(file, str(dimension))
        if (
            attributes.get("standard_name") == "time"
            or attributes.get("axis") == "T"
            or " since " in str(attributes.get("units", ""))
            or str(dimension).lower() in ("time", "ocean_time")
        ):
            return str(dimension)
    return None


def read_times(file: File, dimension: str) -> tuple[Array, tuple[float, float]]:
    """Times [s since 1970-01-01 UTC] and the range that they speak for; with bounds, means lie in their middle."""
    seconds = _decoded(file, dimension, dimension)
    bounds = str(file.data[dimension].attrs.get("bounds", ""))
    if seconds.size == 0:
        file.refuse(dimension, f"{dimension} has no times")
    wrong = np.flatnonzero(np.diff(seconds) <= 0.0)
    if wrong.size:
        n = int(wrong[0])
        file.refuse(
            dimension,
            f"{dimension} does not increase: {clock.text(float(seconds[n]))} at index {n} is followed by "
            f"{clock.text(float(seconds[n + 1]))}",
        )
    if bounds and bounds in file.data.variables:
        edges = _decoded(file, bounds, dimension).reshape(seconds.size, -1)
        middle = edges.mean(axis=1)
        if np.all(np.diff(middle) > 0.0):
            return middle, (float(edges.min()), float(edges.max()))
        file.refuse(bounds, f"{bounds}, the bounds of {dimension}, do not increase")
    return seconds, (float(seconds[0]), float(seconds[-1]))


def _decoded(file: File, variable: str, parent: str) -> Array:
    """Seconds since 1970 of a time variable; bounds have the units of their parent (CF, section 7.1)."""
    attributes: dict[str, Any] = {**_attributes(file, parent), **_attributes(file, variable)}
    if " since " not in str(attributes.get("units", "")):
        given = f"the units {attributes['units']!r}" if attributes.get("units") else "no units"
        file.refuse(parent, f"{parent} has {given}; must be like 'seconds since 1970-01-01 00:00:00'")
    kept = {key: attributes[key] for key in ("units", "calendar", "_FillValue") if key in attributes}
    array = xr.Variable(file.data[variable].dims, np.asarray(file.data[variable].values), kept)
    try:
        decoded = xr.decode_cf(xr.Dataset({"t": array}))["t"].values
    except (ValueError, OverflowError) as error:
        file.refuse(parent, f"{parent} cannot be read as times: {' '.join(str(error).split())}")
    if not np.issubdtype(decoded.dtype, np.datetime64):
        calendar = attributes.get("calendar", "")
        file.refuse(
            parent, f"{parent} has the calendar {calendar!r}; must be standard, gregorian or proleptic_gregorian"
        )
    if np.isnat(decoded).any():
        file.refuse(parent, f"{parent} lacks some of its times")
    found: Array = (decoded - np.datetime64(0, "ns")) / np.timedelta64(1, "ns") * 1e-9
    return found


def depth_dimension(file: File, variable: str) -> str:
    """Dimension of a variable that is vertical."""
    if "depth" in file.names:
        return file.names["depth"]
    for dimension in map(str, file.data[variable].dims):
        attributes = _attributes(file, dimension)
        standard = str(attributes.get("standard_name", ""))
        if any(word in standard or word in dimension.lower() for word in _TERRAIN) or dimension.lower() == "s_rho":
            file.refuse(
                dimension,
                f"{dimension} follows the terrain ({standard or 'sigma or s levels'}); interpolate the file to depth "
                "levels first, with xroms or the model's own tools",
            )
        if standard in ("depth", "height", "altitude", "depth_below_geoid") or "positive" in attributes:
            return dimension
        if attributes.get("axis") == "Z" or dimension.lower() in ("depth", "z", "lev", "level", "deptht"):
            return dimension
    there = ", ".join(map(str, file.data[variable].dims))
    raise file.refusal(variable, f"{variable} has no vertical dimension among {there}")


def read_depths(file: File, dimension: str) -> tuple[Array, NDArray[np.intp]]:
    """Depths [m, positive down], increasing, and the order of the file's levels that makes them so."""
    if dimension not in file.data.variables:
        file.refuse(dimension, f"{dimension} has no coordinate: the depths of its levels are not in the file")
    depths = file.numbers(dimension, "length")
    if _upward(file, dimension, depths):
        depths = -depths
    order = np.argsort(depths)
    if not np.all(np.isfinite(depths)) or np.any(np.diff(depths[order]) <= 0.0):
        file.refuse(dimension, f"{dimension} does not change from level to level")
    steps = np.diff(depths)
    if not (np.all(steps > 0.0) or np.all(steps < 0.0)):
        file.refuse(dimension, f"{dimension} neither increases nor decreases from level to level")
    if depths[order[0]] < _SURFACE:
        file.refuse(
            dimension, f"{dimension} reaches {-depths[order[0]]:g} m above the surface; is positive up or down?"
        )
    return np.maximum(depths[order], 0.0) if depths[order[0]] < 0.0 < depths[order[-1]] else depths[order], order


def _upward(file: File, dimension: str, depths: Array) -> bool:
    positive = str(file.data[dimension].attrs.get("positive", "")).lower()
    if positive in ("up", "down"):
        return positive == "up"
    if file.standard_name(dimension) in ("height", "altitude"):
        return True
    return bool(np.all(depths <= 0.0)) and not bool(np.all(depths == 0.0))


def _attributes(file: File, name: str) -> dict[str, Any]:
    return dict(file.data[name].attrs) if name in file.data.variables else {}
