"""Curvilinear grids that go around the Earth, and grids with holes in their coordinates.

Oracle: water that is a smooth function of place, asked for on both sides of the seam.
"""

from pathlib import Path

import numpy as np
import pytest
import xarray as xr

from stommel.errors import FileError, StommelError
from stommel.ocean import Ocean
from tests.ocean.conftest import Writer
from tests.ocean.test_damaged_files import refused

START = "2020-03-01T00:00:00Z"


def water_at(latitude: np.ndarray, longitude: np.ndarray) -> np.ndarray:
    return 12.0 + 0.05 * latitude + 2.0 * np.cos(np.radians(longitude)) + np.sin(np.radians(longitude))


def sea(latitude: np.ndarray, longitude: np.ndarray) -> xr.Dataset:
    """A sea on the places of a grid (j, i), wet everywhere."""
    temperature = np.broadcast_to(water_at(latitude, longitude), (1, 2, *latitude.shape)).copy()
    dims = ("time", "depth", "j", "i")

    def variable(values: np.ndarray, standard: str, units: str) -> tuple:
        return dims, values, {"standard_name": standard, "units": units}

    return xr.Dataset(
        {
            "t": variable(temperature, "sea_water_temperature", "degC"),
            "s": variable(0.0 * temperature + 35.0, "sea_water_salinity", "1e-3"),
            "u": variable(0.0 * temperature + 0.1, "eastward_sea_water_velocity", "m s-1"),
            "v": variable(0.0 * temperature, "northward_sea_water_velocity", "m s-1"),
            "lat": (("j", "i"), latitude, {"standard_name": "latitude", "units": "degrees_north"}),
            "lon": (("j", "i"), longitude, {"standard_name": "longitude", "units": "degrees_east"}),
        },
        {
            "time": ("time", [0.0], {"standard_name": "time", "units": "hours since 2020-03-01"}),
            "depth": ("depth", [0.0, 100.0], {"standard_name": "depth", "units": "m", "positive": "down"}),
        },
    )


def ring(first: float, overlap: int, south: float = -60.0, north: float = 80.0) -> tuple[np.ndarray, np.ndarray]:
    """A curvilinear grid all around: meridians that bend, the first columns again at the end."""
    columns = np.arange(72 + overlap)
    longitude = first + 5.0 * columns[None, :] + 3.0 * np.sin(np.radians(3.0 * np.linspace(south, north, 40)))[:, None]
    latitude = np.linspace(south, north, 40)[:, None] + 1.5 * np.cos(np.radians(4.0 * 5.0 * columns))[None, :]
    return latitude, (longitude + 180.0) % 360.0 - 180.0


@pytest.mark.parametrize("overlap", [0, 1, 2])
@pytest.mark.parametrize("first", [-180.0, 0.0, 73.0])
@pytest.mark.parametrize("middle", [-180.0, 0.0, 73.0, 120.0])
def test_a_region_across_the_seam_of_a_bent_grid(tmp_path: Path, first: float, overlap: int, middle: float) -> None:
    sea(*ring(first, overlap)).to_netcdf(tmp_path / "sea.nc")
    ocean = Ocean.open(tmp_path / "sea.nc", bounds=(20.0, 40.0, middle - 12.0, middle + 12.0))
    assert ocean.data.nodes.x.shape[1] < 12
    for beside in (-11.0, -4.0, -0.1, 0.0, 0.1, 3.0, 11.0):
        found = ocean.at(START, 30.0, middle + beside, 0.0).temperature
        assert found == pytest.approx(float(water_at(np.array(30.0), np.array(middle + beside))), abs=0.03)


@pytest.mark.parametrize("overlap", [0, 1, 2])
@pytest.mark.parametrize("bent", [False, True])
@pytest.mark.parametrize("bounded", [False, True])
def test_a_polar_sea_has_no_gap_at_its_seam(tmp_path: Path, overlap: int, bent: bool, bounded: bool) -> None:
    latitude, longitude = ring(0.0, overlap, 60.0, 85.0)
    data = sea(latitude, longitude)
    if not bent:
        data = data.drop_vars(["lat", "lon"]).rename(j="lat", i="lon")
        data["lat"] = ("lat", np.linspace(60.0, 85.0, 40), {"units": "degrees_north"})
        data["lon"] = ("lon", 5.0 * np.arange(72 + overlap) % 360.0, {"units": "degrees_east"})
        values = water_at(data.lat.values[:, None], data.lon.values[None, :])
        data["t"] = (data.t.dims, np.broadcast_to(values, data.t.shape).copy(), data.t.attrs)
    data.to_netcdf(tmp_path / "sea.nc")
    ocean = Ocean.open(tmp_path / "sea.nc", bounds=(64.0, 84.0, -180.0, 180.0) if bounded else None)
    for longitude_deg in np.arange(-10.0, 365.0, 2.5):
        found = ocean.at(START, 74.0, longitude_deg, 0.0)
        assert not found.held
        assert found.temperature == pytest.approx(float(water_at(np.array(74.0), longitude_deg)), abs=0.03)


def test_places_may_be_missing_where_bounds_leave_them_out(tmp_path: Path) -> None:
    """Models leave out the pieces of their grid that are all land, places too."""
    latitude, longitude = np.meshgrid(np.linspace(10.0, 30.0, 21), np.linspace(120.0, 150.0, 31), indexing="ij")
    latitude += 0.2 * np.sin(np.radians(10.0 * longitude))
    whole = sea(latitude, longitude)
    whole.to_netcdf(tmp_path / "whole.nc")
    holes = whole.copy(deep=True)
    for name in ("lat", "lon"):
        holes[name].values[:6, :] = np.nan
        holes[name].values[:, 20:] = 0.0 if name == "lat" else np.nan
    holes.to_netcdf(tmp_path / "holes.nc")
    bounds = (16.5, 24.0, 122.0, 138.5)
    one, other = (Ocean.open(tmp_path / name, bounds=bounds) for name in ("whole.nc", "holes.nc"))
    for place in ((17.0, 123.0), (20.0, 130.0), (23.5, 138.0)):
        assert other.at(START, *place).temperature == pytest.approx(one.at(START, *place).temperature, abs=1e-5)
        assert other.at(START, *place).current_east == pytest.approx(0.1, abs=1e-6)
    refused(tmp_path / "holes.nc", "must be given at every node", "of 651 lack them", "bounds")
    holes.lat.values[10, 10] = np.nan
    holes.to_netcdf(tmp_path / "hole.nc")
    refused(tmp_path / "hole.nc", "must be given at every node", "; 1 of ", bounds=bounds)


def test_a_line_of_places_may_have_holes_beyond_the_bounds(tmp_path: Path) -> None:
    data = sea(*np.meshgrid(np.linspace(10.0, 30.0, 21), np.linspace(120.0, 150.0, 31), indexing="ij"))
    data = data.assign(lat=("j", data.lat.values[:, 0], data.lat.attrs), lon=("i", data.lon.values[0], data.lon.attrs))
    data.lat.values[-2:] = np.nan
    data.lon.values[0] = np.nan
    data.to_netcdf(tmp_path / "sea.nc")
    found = Ocean.open(tmp_path / "sea.nc", bounds=(15.0, 25.0, 125.0, 135.0)).at(START, 20.0, 130.0)
    assert found.temperature == pytest.approx(float(water_at(np.array(20.0), np.array(130.0))), abs=1e-3)
    with pytest.raises(FileError, match="must be given at every node"):
        Ocean.open(tmp_path / "sea.nc")


def test_currents_along_the_axes_of_a_grid_with_holes(tmp_path: Path) -> None:
    """The angle beside a hole is that of the other side."""
    i, j = np.meshgrid(np.arange(12.0), np.arange(10.0))
    turn = np.radians(30.0)
    latitude = 0.1 * (i * np.sin(turn) + j * np.cos(turn))
    longitude = 150.0 + 0.1 * (i * np.cos(turn) - j * np.sin(turn))
    data = sea(latitude, longitude)
    data.u.attrs["standard_name"], data.v.attrs["standard_name"] = "sea_water_x_velocity", "sea_water_y_velocity"
    data.lat.values[:, 9:], data.lon.values[:, 9:] = np.nan, np.nan
    data.to_netcdf(tmp_path / "sea.nc")
    ocean = Ocean.open(tmp_path / "sea.nc", bounds=(-0.5, 2.0, 149.0, 151.5))
    found = ocean.at(START, float(latitude[5, 8]), float(longitude[5, 8]) - 1e-6)
    assert found.current_north / found.current_east == pytest.approx(np.tan(turn), rel=1e-2)


def test_an_extent_across_the_date_line_has_one_convention(sea_file: Writer) -> None:
    """West is the greater then, as in the boxes of GeoJSON; no longitude is beyond 180."""
    ocean = Ocean.open(sea_file())
    assert ocean.summary()["longitude_deg"] == pytest.approx([177.0, -178.0])
    with pytest.raises(StommelError, match="longitude 177 to -178"):
        ocean.at(START, 12.0, 150.0)
    second = Ocean.open(sea_file(), outside="climatology", climatology=str(sea_file()))
    assert second.at(START, 12.0, -179.5).temperature == pytest.approx(ocean.at(START, 12.0, -179.5).temperature)
