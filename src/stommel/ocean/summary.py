"""What an ocean covers, in numbers with units in their names."""

from collections.abc import Mapping
from math import degrees, radians
from typing import Any

import numpy as np
from numpy.typing import NDArray

from stommel.ocean import times
from stommel.ocean.chart import project
from stommel.ocean.grid import POLICIES, S_A, U_X, U_Y, UNBOUNDED_DEPTH, OceanGrid, T
from stommel.ocean.unproject import unproject
from stommel.seawater.table import DensityTable

_POLICY_NAMES = {number: name for name, number in POLICIES.items()}


def summary_of(name: str, data: OceanGrid, notes: Mapping[str, str], table: DensityTable) -> dict[str, Any]:
    """Extent, resolution, ranges and policy."""
    wet = data.levels > 0
    found = data.water[: len(data.times)][:, wet]
    speed = np.hypot(found[:, :, U_X], found[:, :, U_Y])
    rows: dict[str, Any] = {
        "name": name,
        "times": len(data.times),
        "first_time": times.text(float(data.time_range[0])),
        "last_time": times.text(float(data.time_range[1])),
        "nodes": list(data.x.shape),
        "wet_nodes": int(wet.sum()),
        "levels": len(data.depths),
        "deepest_level_m": float(data.depths[-1]),
        **extent_of(data),
        "temperature_c": [float(found[:, :, T].min()), float(found[:, :, T].max())],
        "absolute_salinity_g_kg": [float(found[:, :, S_A].min()), float(found[:, :, S_A].max())],
        "greatest_current_m_s": float(speed.max()),
        "tidal_constituents": len(data.tide_speed),
        "bottom_m": [float(data.bottom[wet].min()), float(data.bottom[wet].max())]
        if float(data.bottom.max()) < UNBOUNDED_DEPTH
        else None,
        "outside": _POLICY_NAMES[data.outside_space],
        "outside_time": _POLICY_NAMES[data.outside_time],
        "density_error_kg_m3": None if data.profile_depths.size else table.largest_error,
        "notes": dict(notes),
    }
    return rows


def extent_of(data: OceanGrid) -> dict[str, Any]:
    """Range of latitude and longitude, and the spacing of the nodes; none where the ocean is the same everywhere."""
    if data.x.size == 1:
        return {"latitude_deg": None, "longitude_deg": None, "spacing_km": None}
    latitude, longitude = node_places(data)
    # longitudes beside the middle one, so that the date line does not tear them
    middle = degrees(data.chart.longitude)
    beside = middle + (longitude - middle + 180.0) % 360.0 - 180.0
    spacing = np.hypot(np.diff(data.x, axis=1), np.diff(data.y, axis=1))
    scale = project(data.chart, radians(float(np.median(latitude))), data.chart.longitude).scale
    return {
        "latitude_deg": [float(latitude.min()), float(latitude.max())],
        "longitude_deg": [float(beside.min()), float(beside.max())],
        "spacing_km": float(np.median(spacing)) / scale / 1e3,
    }


def node_places(data: OceanGrid) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Latitude and longitude of the nodes (j, i) [deg]."""
    latitude, longitude = unproject(data.chart, data.x, data.y)
    return np.degrees(latitude), np.degrees(longitude)
