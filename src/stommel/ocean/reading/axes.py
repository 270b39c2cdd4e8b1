"""Time and depth of a CF file."""

import warnings
from dataclasses import dataclass
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from stommel.ocean import times as clock
from stommel.ocean.reading.variables import File

Array = NDArray[np.float64]

TIME_AND_DEPTH = ("time", "depth", "height", "altitude", "depth_below_geoid")
"""Standard names of coordinates."""
_TERRAIN = ("sigma", "ocean_s", "s_coordinate", "ocean_double")
_TERRAIN_DIMENSIONS = ("s_rho", "s_w", "siglay", "siglev")
_DEPTH_DIMENSIONS = ("depth", "z", "lev", "level", "deptht", "st_ocean", "z_t")
_SURFACE = -10.0
"""Levels higher than this above the surface are refused [m, positive down]; a little is a moving sea surface."""


def time_dimension(file: File, variable: str) -> str | None:
    """Dimension of a variable that is time, if it has one."""
    dims = tuple(map(str, file.data[variable].dims))
    if file.names.get("time") in dims:
        return file.names["time"]
    for dimension in dims:
        attributes = _attributes(file, _coordinate(file, dimension))
        if (
            attributes.get("standard_name") == "time"
            or attributes.get("axis") == "T"
            or " since " in str(attributes.get("units", ""))
            or dimension.lower() in ("time", "ocean_time", "time_counter")
        ):
            return dimension
    return None


@dataclass(frozen=True)
class Times:
    """The times of one file."""

    seconds: Array
    """[s since 1970-01-01 UTC], increasing."""
    spoken_for: tuple[float, float]
    """First and last time that the values speak for: the bounds of the means, if the file has them."""
    of_every_year: bool
    """The file says that it is a climatology (CF, section 7.4)."""


def read_times(file: File, dimension: str) -> Times:
    """Times of a file; with bounds, means lie in their middle."""
    dimension = _coordinate(file, dimension)
    if dimension not in file.data.variables:
        file.refuse(dimension, f"{dimension} has no coordinate: its times are not in the file")
    seconds = _decoded(file, dimension, dimension)
    attributes = _attributes(file, dimension)
    bounds = str(attributes.get("bounds", ""))
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
        if edges.shape[1] == 2 and np.all(np.diff(middle) > 0.0):
            return Times(middle, (float(edges.min()), float(edges.max())), False)
        file.refuse(bounds, f"{bounds}, the bounds of {dimension}, must be pairs that increase")
    return Times(seconds, (float(seconds[0]), float(seconds[-1])), "climatology" in attributes)


def _decoded(file: File, variable: str, parent: str) -> Array:
    """Seconds since 1970 of a time variable; bounds have the units of their parent (CF, section 7.1)."""
    attributes: dict[str, Any] = {**_attributes(file, parent), **_attributes(file, variable)}
    if " since " not in str(attributes.get("units", "")):
        given = f"the units {attributes['units']!r}" if attributes.get("units") else "no units"
        file.refuse(parent, f"{parent} has {given}; must be like 'seconds since 1970-01-01 00:00:00'")
    raw = file.raw(variable)
    if str(attributes["units"]).lower().startswith("month"):
        return _months(file, parent, raw, str(attributes["units"]))
    kept = {key: attributes[key] for key in ("units", "calendar", "_FillValue") if key in attributes}
    array = xr.Variable(file.data[variable].dims, raw, kept)
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # that a calendar is unusual is said below
            decoded = xr.decode_cf(xr.Dataset({"t": array}))["t"].values
    except (ValueError, OverflowError, TypeError, KeyError):
        file.refuse(
            parent,
            f"{parent} cannot be read as times with the units {attributes['units']!r} and the calendar "
            f"{attributes.get('calendar', 'standard')!r}",
        )
    if not np.issubdtype(decoded.dtype, np.datetime64):
        calendar = attributes.get("calendar", "standard")
        file.refuse(
            parent,
            f"{parent} has the calendar {calendar!r}, or dates that no calendar of the present has; must be standard, "
            "gregorian or proleptic_gregorian",
        )
    if np.isnat(decoded).any():
        file.refuse(parent, f"{parent} lacks some of its times")
    found: Array = (decoded - np.datetime64(0, "s")) / np.timedelta64(1, "us") * 1e-6
    return found


def _months(file: File, variable: str, raw: NDArray[Any], units: str) -> Array:
    """Seconds of `months since` a date, as climatologies have them: whole months by the calendar, the rest by share."""
    try:
        first = np.datetime64(units.partition(" since ")[2].split(maxsplit=1)[0], "M")
        whole = np.floor(raw.astype(np.float64))
        begin = (first + whole.astype(np.int64)).astype("datetime64[s]").astype(np.float64)
        end = (first + whole.astype(np.int64) + 1).astype("datetime64[s]").astype(np.float64)
    except (ValueError, IndexError, OverflowError, TypeError):
        file.refuse(variable, f"{variable} has the units {units!r}; must be like 'months since 1970-01-01'")
    found: Array = begin + (raw - whole) * (end - begin)
    return found


def depth_dimension(file: File, variable: str) -> str:
    """Dimension of a variable that is vertical."""
    dims = tuple(map(str, file.data[variable].dims))
    if file.names.get("depth") in dims:
        return file.names["depth"]
    for dimension in dims:
        attributes = _attributes(file, _coordinate(file, dimension))
        standard = str(attributes.get("standard_name", ""))
        terrain = any(word in standard or word in dimension.lower() for word in _TERRAIN)
        if terrain or dimension.lower() in _TERRAIN_DIMENSIONS or "formula_terms" in attributes:
            file.refuse(
                dimension,
                f"{dimension} follows the terrain ({standard or 'sigma or s levels'}); interpolate the file to depth "
                "levels first, with xroms or the model's own tools",
            )
        if standard in ("depth", "height", "altitude", "depth_below_geoid") or "positive" in attributes:
            return dimension
        if attributes.get("axis") == "Z" or dimension.lower() in _DEPTH_DIMENSIONS:
            return dimension
    raise file.refusal(
        variable, f"{variable} has no vertical dimension among {', '.join(dims) or 'none'}; say which with depth = ..."
    )


def read_depths(file: File, dimension: str) -> tuple[Array, NDArray[np.intp]]:
    """Depths [m, positive down], increasing, and the order of the file's levels that makes them so."""
    dimension = _coordinate(file, dimension)
    if dimension not in file.data.variables:
        file.refuse(dimension, f"{dimension} has no coordinate: the depths of its levels are not in the file")
    depths = file.numbers(dimension, "length")
    if depths.ndim != 1 or depths.size == 0:
        file.refuse(dimension, f"{dimension} must have one depth for each level, has the shape {depths.shape}")
    if _upward(file, dimension, depths):
        depths = -depths
    order = np.argsort(depths)
    if not np.all(np.isfinite(depths)):
        file.refuse(dimension, f"{dimension} lacks some of its depths")
    if np.any(np.diff(depths[order]) <= 0.0):
        file.refuse(
            dimension, f"{dimension} has {depths[order][np.diff(depths[order], append=np.inf) <= 0.0][0]:g} m twice"
        )
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


def _coordinate(file: File, dimension: str) -> str:
    """Variable with the values of a dimension: that of its name, or one over it that says it is time or depth."""
    if dimension in file.data.variables:
        return dimension
    for name, variable in file.data.variables.items():
        standard = variable.attrs.get("standard_name")
        if variable.dims == (dimension,) and standard in ("time", "depth", "height", "altitude"):
            return str(name)
    return dimension


def _attributes(file: File, name: str) -> dict[str, Any]:
    return dict(file.data[name].attrs) if name in file.data.variables else {}
