"""What an ocean covers, in numbers with units in their names."""

from collections.abc import Mapping
from math import cos, degrees, radians
from typing import Any

import numpy as np
from numpy.typing import NDArray

from stommel.geometry.longitudes import wrapped_deg
from stommel.ocean import times
from stommel.ocean.kernel.chart import project
from stommel.ocean.kernel.grid import CLIMATOLOGY, CT, S_A, U_X, U_Y, UNBOUNDED_DEPTH, Nodes, OceanGrid, T
from stommel.ocean.kernel.outside import POLICY_NAMES
from stommel.ocean.kernel.unproject import unproject
from stommel.seawater.table import DensityTable, Range

_DEEPEST = 11900.0
"""Deepest pressure of a density table [dbar]."""
_ROOM = 10.0
"""Around an ocean, that its climatology should cover [deg]."""


def summary_of(name: str, data: OceanGrid, notes: Mapping[str, str], table: DensityTable) -> dict[str, Any]:
    """Extent, resolution, ranges and policy."""
    nodes = data.nodes
    wet = nodes.levels > 0
    found = [_span(nodes, field) for field in (T, S_A)]
    rows: dict[str, Any] = {
        "name": name,
        "times": len(nodes.times) - int(np.isfinite(nodes.period)),
        "first_time": times.text(float(nodes.time_range[0])),
        "last_time": times.text(float(nodes.time_range[1])),
        "every_year": bool(np.isfinite(nodes.period)),
        "nodes": list(nodes.x.shape),
        "wet_nodes": int(wet.sum()),
        "levels": len(nodes.depths),
        "deepest_level_m": float(nodes.depths[-1]),
        **extent_of(data),
        "temperature_c": list(found[0]),
        "absolute_salinity_g_kg": list(found[1]),
        "greatest_current_m_s": max(
            float(np.hypot(slot[wet][:, U_X], slot[wet][:, U_Y]).max()) for slot in nodes.water[: len(nodes.times)]
        ),
        "tidal_constituents": len(nodes.tide_speed),
        "bottom_m": [float(nodes.bottom[wet].min()), float(nodes.bottom[wet].max())]
        if float(nodes.bottom.max()) < UNBOUNDED_DEPTH
        else None,
        "outside": POLICY_NAMES[data.outside_space],
        "outside_time": POLICY_NAMES[data.outside_time],
        "density_error_kg_m3": None if nodes.profile_depths.size else table.largest_error,
        "notes": dict(notes),
    }
    return rows


def _span(nodes: Nodes, field: int) -> tuple[float, float]:
    """Least and greatest of a field where there is water; one time after the other, for the memory's sake."""
    wet = nodes.levels > 0
    low = min(float(slot[wet, field].min()) for slot in nodes.water)
    return low, max(float(slot[wet, field].max()) for slot in nodes.water)


def ranges_of(data: OceanGrid) -> tuple[Range, Range, Range]:
    """Ranges of Absolute Salinity [g/kg], Conservative Temperature [deg C] and sea pressure [dbar] of an ocean.

    What is behind it counts, where a policy asks for it.
    """
    parts = [data.nodes]
    if CLIMATOLOGY in (data.outside_space, data.outside_time):
        parts.append(data.behind)
    salt, heat = ([_span(nodes, field) for nodes in parts] for field in (S_A, CT))
    deepest = max(max(float(nodes.depths[-1]), float(nodes.bottom.max())) for nodes in parts)
    return (
        (max(min(low for low, _ in salt) - 0.01, 0.0), min(max(high for _, high in salt) + 0.01, 42.0)),
        (max(min(low for low, _ in heat) - 0.01, -5.0), min(max(high for _, high in heat) + 0.01, 42.0)),
        (0.0, 1.05 * min(deepest, _DEEPEST / 1.05) + 10.0),
    )


def around(data: OceanGrid) -> tuple[float, float, float, float] | None:
    """South, north, west, east of an ocean with room around it [deg]; none where it is the same everywhere."""
    extent = extent_of(data)
    if extent["latitude_deg"] is None:
        return None
    (south, north), (west, east) = extent["latitude_deg"], extent["longitude_deg"]
    east += 360.0 if east < west else 0.0
    south, north = max(south - _ROOM, -90.0), min(north + _ROOM, 90.0)
    # meridians converge
    room = _ROOM / max(cos(radians(max(abs(south), abs(north)))), 1e-3)
    if east - west + 2.0 * room >= 360.0:
        return south, north, -180.0, 180.0
    return south, north, west - room, east + room


def extent_of(data: OceanGrid) -> dict[str, Any]:
    """Range of latitude and longitude, and the spacing of the nodes; none where the ocean is the same everywhere.

    Across the date line the west is the greater, as in the boxes of GeoJSON (RFC 7946, section 5.2).
    """
    nodes = data.nodes
    if nodes.x.size == 1:
        return {"latitude_deg": None, "longitude_deg": None, "spacing_km": None}
    latitude, longitude = node_places(data)
    # beside the middle one, so that the date line does not tear them
    middle = degrees(nodes.chart.longitude)
    beside = middle + (longitude - middle + 180.0) % 360.0 - 180.0
    spacing = np.hypot(np.diff(nodes.x, axis=1), np.diff(nodes.y, axis=1))
    scale = project(nodes.chart, radians(float(np.median(latitude))), nodes.chart.longitude).scale
    return {
        "latitude_deg": [float(latitude.min()), float(latitude.max())],
        "longitude_deg": [wrapped_deg(float(beside.min())), wrapped_deg(float(beside.max()))],
        "spacing_km": float(np.median(spacing)) / scale / 1e3,
    }


def node_places(data: OceanGrid) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Latitude and longitude of the nodes (j, i) [deg]."""
    latitude, longitude = unproject(data.nodes.chart, data.nodes.x, data.nodes.y)
    return np.degrees(latitude), np.degrees(longitude)
