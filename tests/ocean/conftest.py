"""Small CF files made on purpose."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray as xr


def regular_sea() -> xr.Dataset:
    """Latitudes 10 to 14 south to north, longitudes across the date line, three depths, three times; land in a corner.

    Every field is linear in time, depth, latitude and longitude.
    """
    time, depth = np.array([0.0, 6.0, 12.0]), np.array([0.0, 50.0, 200.0])
    lat, lon = np.linspace(10.0, 14.0, 5), np.array([177.0, 178.0, 179.0, -180.0, -179.0, -178.0])
    t, z, y, x = np.meshgrid(time, depth, lat, lon % 360.0 - 180.0, indexing="ij")
    ramp = 0.1 * t - 0.01 * z + 0.5 * (y - 12.0)
    fields = {
        "to": ("sea_water_potential_temperature", "degC", 15.0 + ramp),
        "so": ("sea_water_salinity", "1e-3", 34.0 + 0.1 * ramp),
        "uo": ("eastward_sea_water_velocity", "m s-1", 0.1 + 0.01 * t - 0.0002 * z),
        "vo": ("northward_sea_water_velocity", "m/s", -0.2 + 0.02 * t + 0.0 * x),
    }
    dims = ("time", "depth", "lat", "lon")
    data = {}
    for name, (standard, units, everywhere) in fields.items():
        values = everywhere.copy()
        values[:, :, :2, :2] = np.nan
        values[:, 2, 4, 5] = np.nan
        data[name] = (dims, values, {"standard_name": standard, "units": units})
    bottom = np.where(np.isnan(data["to"][1][0, 0]), np.nan, 400.0)
    bottom[4, 5] = 120.0
    data["deptho"] = (("lat", "lon"), bottom, {"standard_name": "sea_floor_depth_below_geoid", "units": "m"})
    coordinates = {
        "time": ("time", time, {"standard_name": "time", "units": "hours since 2020-03-01 00:00:00"}),
        "depth": ("depth", depth, {"standard_name": "depth", "units": "m", "positive": "down"}),
        "lat": ("lat", lat, {"standard_name": "latitude", "units": "degrees_north"}),
        "lon": ("lon", lon, {"standard_name": "longitude", "units": "degrees_east"}),
    }
    return xr.Dataset(data, coordinates)


Writer = Callable[..., Path]


@pytest.fixture
def sea_file(tmp_path: Path) -> Writer:
    """Write the regular sea, changed by a function, and return its path."""

    def write(change: Callable[[xr.Dataset], Any] | None = None, **encoding: Any) -> Path:
        data = regular_sea()
        changed = change(data) if change else None
        path = tmp_path / "sea.nc"
        (data if changed is None else changed).to_netcdf(path, engine="netcdf4", encoding=encoding or None)
        return path

    return write
