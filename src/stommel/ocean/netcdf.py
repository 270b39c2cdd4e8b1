"""An ocean from a CF NetCDF file."""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from stommel.errors import FileError, Problem
from stommel.ocean.axes import depth_dimension, read_depths, read_times, time_dimension
from stommel.ocean.build import Frame, Slot, ocean_grid
from stommel.ocean.errors import UnknownOceanError
from stommel.ocean.grid import FIELDS, OceanGrid
from stommel.ocean.horizontal import Nodes, read_nodes
from stommel.ocean.times import Time, seconds
from stommel.ocean.variables import OWN_NAMES, File
from stommel.seawater import properties

Array = NDArray[np.float64]
Bounds = tuple[float, float, float, float]

_MOST_BYTES = 4e9
"""A grid larger than this is refused: it must be cut to the mission's region."""
_DEEPEST_FIRST_LEVEL = 20.0
"""A first level deeper than this is worth a note: the water above is held [m]."""


@dataclass(frozen=True)
class _Fields:
    """Names of the variables, and whether the currents are east and north."""

    temperature: str
    salinity: str
    u: str
    v: str
    geographic: bool


@dataclass(frozen=True)
class _Part:
    """What of the file is read."""

    time: str | None
    slots: NDArray[np.intp]
    depth: str
    levels: NDArray[np.intp]
    nodes: Nodes
    j: NDArray[np.intp]
    i: NDArray[np.intp]


def read_ocean(
    path: Path,
    names: dict[str, str],
    policies: tuple[str, str],
    bounds: Bounds | None,
    between: tuple[Time, Time] | None,
) -> tuple[OceanGrid, dict[str, str]]:
    """Read the grid of a file and notes on what was found where; `Ocean.open` describes the arguments."""
    unknown = sorted(set(names) - set(OWN_NAMES))
    if unknown:
        raise UnknownOceanError(f"names: unknown key {unknown[0]}; known: {', '.join(OWN_NAMES)}")
    try:
        data = xr.open_dataset(path, engine="netcdf4", decode_cf=False)
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or str(error).splitlines()[0]
        raise FileError([Problem(str(path), "", f"cannot be read as NetCDF: {reason}")]) from error
    with data:
        return _read(File(str(path), data, names), policies, bounds, between)


def _read(
    file: File, policies: tuple[str, str], bounds: Bounds | None, between: tuple[Time, Time] | None
) -> tuple[OceanGrid, dict[str, str]]:
    fields = _fields(file)
    time, depth = time_dimension(file, fields.temperature), depth_dimension(file, fields.temperature)
    times, time_range = read_times(file, time) if time else (np.zeros(1), (-np.inf, np.inf))
    depths, order = read_depths(file, depth)
    nodes = read_nodes(file, fields.temperature, tuple(d for d in (time, depth) if d))
    slots = _slots(file, times, time_range, between)
    part = _Part(time, slots, depth, order, nodes, *_inside(file, nodes, bounds))
    if between is not None and time:
        time_range = (
            time_range[0] if slots[0] == 0 else float(times[slots[0]]),
            time_range[1] if slots[-1] == len(times) - 1 else float(times[slots[-1]]),
        )
    size = 4.0 * FIELDS * len(slots) * len(depths) * len(part.j) * len(part.i)
    if size > _MOST_BYTES:
        file.refuse(
            fields.temperature,
            f"the ocean needs {size / 1e9:.1f} GB of memory; cut it with bounds (south, north, west, east) or between",
        )
    box = np.ix_(part.j, part.i)
    frame = Frame(times[slots], time_range, depths, nodes.latitude[box], nodes.longitude[box], _bottom(file, part))
    nodes = replace(nodes, angle=nodes.angle[box])
    grid = ocean_grid(frame, _slices(file, fields, part, nodes.angle, frame), *policies)
    return grid, _notes(file, fields, frame, nodes)


def _fields(file: File) -> _Fields:
    temperature, salinity = str(file.find("temperature")), str(file.find("salinity"))
    east, north = file.find("current_east", needed=False), file.find("current_north", needed=False)
    geographic = east is not None and north is not None
    u, v = (east, north) if geographic else (file.find("current_x"), file.find("current_y"))
    found = _Fields(temperature, salinity, str(u), str(v), geographic)
    dims = file.data[temperature].dims
    for name in (salinity, found.u, found.v):
        if set(file.data[name].dims) != set(dims):
            file.refuse(
                name,
                f"{name} has the dimensions {', '.join(map(str, file.data[name].dims))}, {temperature} has "
                f"{', '.join(map(str, dims))}; all must lie on the same nodes (interpolate a staggered grid first)",
            )
    return found


def _slots(
    file: File, times: Array, time_range: tuple[float, float], between: tuple[Time, Time] | None
) -> NDArray[np.intp]:
    """Indices of the times that a mission between two times needs."""
    if between is None:
        return np.arange(len(times))
    first, last = seconds(between[0]), seconds(between[1])
    if last < first:
        raise UnknownOceanError("between: the last time must not be before the first")
    if last < time_range[0] or first > time_range[1]:
        file.refuse("time", "has no times in the wanted interval")
    start = max(int(np.searchsorted(times, first, side="right")) - 1, 0)
    return np.arange(start, min(int(np.searchsorted(times, last, side="left")) + 1, len(times)))


def _inside(file: File, nodes: Nodes, bounds: Bounds | None) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """Rows and columns of the nodes within the bounds, and one more on each side; columns in order from the west."""
    rows, columns = nodes.latitude.shape
    if bounds is None:
        return np.arange(rows), np.arange(columns)
    south, north, west, east = bounds
    width = (east - west) % 360.0 if (east - west) % 360.0 else 360.0
    if not -90.0 <= south < north <= 90.0:
        raise UnknownOceanError(f"bounds: south {south:g}, north {north:g} deg: must increase within -90 to 90")
    beside = np.radians((np.degrees(nodes.longitude) - west + 180.0 - 0.5 * width) % 360.0 - 180.0 + 0.5 * width)
    within = (nodes.latitude >= np.radians(south)) & (nodes.latitude <= np.radians(north))
    within &= (beside >= 0.0) & (beside <= np.radians(width))
    if not within.any():
        file.refuse("bounds", f"has no node within latitude {south:g} to {north:g}, longitude {west:g} to {east:g}")
    j = _span(np.flatnonzero(within.any(axis=1)), rows)
    separable = bool(np.all(np.ptp(nodes.longitude, axis=0) == 0.0))
    if not separable:
        return j, _span(np.flatnonzero(within.any(axis=0)), columns)
    # meridians: the region may lie across the file's first and last column
    order = np.argsort(beside[0], kind="stable")
    return j, order[_span(np.flatnonzero(within.any(axis=0)[order]), columns)]


def _span(found: NDArray[np.intp], count: int) -> NDArray[np.intp]:
    return np.arange(max(int(found[0]) - 1, 0), min(int(found[-1]) + 2, count))


def _bottom(file: File, part: _Part) -> Array | None:
    name = file.find("bottom", needed=False)
    if name is None:
        return None
    array = file.data[name]
    if part.time is not None and part.time in array.dims:
        array = array.isel({part.time: 0})
    if set(array.dims) != {part.nodes.rows, part.nodes.columns}:
        file.refuse(name, f"{name} has the dimensions {', '.join(map(str, array.dims))}; must lie on the nodes")
    array = array.transpose(part.nodes.rows, part.nodes.columns)
    array = array.isel({part.nodes.rows: part.j, part.nodes.columns: part.i})
    bottom = file.numbers(name, "length", array)
    return -bottom if np.nanmax(bottom) <= 0.0 else bottom


def _slices(file: File, fields: _Fields, part: _Part, angle: Array, frame: Frame) -> Iterator[Slot]:
    """Read one time after the other, and convert to Absolute Salinity and Conservative Temperature."""
    latitude, longitude = np.degrees(frame.latitude), np.degrees(frame.longitude)
    p = properties.pressure_from_depth(frame.depths[:, None, None], latitude)
    for slot in part.slots:
        raw = {
            name: file.numbers(name, quantity, _slice(file.data[name], part, int(slot)))
            for name, quantity in (
                (fields.temperature, "temperature"),
                (fields.salinity, "salinity"),
                (fields.u, "velocity"),
                (fields.v, "velocity"),
            )
        }
        S_A = raw[fields.salinity]
        if file.standard_name(fields.salinity) != "sea_water_absolute_salinity":
            S_A = properties.absolute_salinity(S_A, p, longitude, latitude)
        T, CT = _temperatures(file.standard_name(fields.temperature), raw[fields.temperature], S_A, p)
        east, north = raw[fields.u], raw[fields.v]
        if not fields.geographic:
            east, north = to_east_and_north(east, north, angle)
        yield Slot(T, S_A, CT, east, north)


def to_east_and_north(u: Array, v: Array, angle: Array) -> tuple[Array, Array]:
    """Turn components along a grid's axes by the angle from east to its x axis [rad]."""
    return u * np.cos(angle) - v * np.sin(angle), u * np.sin(angle) + v * np.cos(angle)


def _slice(array: xr.DataArray, part: _Part, slot: int) -> xr.DataArray:
    if part.time is not None:
        array = array.isel({part.time: slot})
    array = array.transpose(part.depth, part.nodes.rows, part.nodes.columns)
    return array.isel({part.depth: part.levels, part.nodes.rows: part.j, part.nodes.columns: part.i})


def _temperatures(standard_name: str, given: Array, S_A: Array, p: Array) -> tuple[Array, Array]:
    """In-situ and Conservative Temperature of whichever the file has."""
    if standard_name == "sea_water_temperature":
        return given, properties.conservative_temperature(given, S_A, p)
    if standard_name == "sea_water_conservative_temperature":
        return properties.in_situ_temperature(given, S_A, p), given
    CT = properties.conservative_from_potential(given, S_A)
    return properties.in_situ_temperature(CT, S_A, p), CT


def _notes(file: File, fields: _Fields, frame: Frame, nodes: Nodes) -> dict[str, str]:
    temperature, salinity = (file.standard_name(name) for name in (fields.temperature, fields.salinity))
    notes = {
        "temperature": f"{fields.temperature}: {temperature or 'taken as potential temperature (no standard_name)'}",
        "salinity": f"{fields.salinity}: {salinity or 'taken as practical salinity (no standard_name)'}",
        "currents": f"{fields.u}, {fields.v}: "
        + ("east and north" if fields.geographic else f"along the grid's axes, turned by {nodes.how}"),
        "bottom": f"{file.find('bottom', needed=False)}"
        if frame.bottom is not None
        else "the deepest level with water",
    }
    if frame.depths[0] > _DEEPEST_FIRST_LEVEL:
        notes["surface"] = f"the first level, {frame.depths[0]:g} m, is held up to the surface"
    return notes
