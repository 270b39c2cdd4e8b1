"""Grids and conventions that CF files of forecasts and atlases have; oracles: pyproj, and the sea that was written."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray as xr
from pyproj import CRS, Geod, Transformer

from stommel.errors import FileError
from stommel.ocean import Ocean, OutsideOceanError
from tests.ocean.conftest import Writer

START = 1583020800.0
GEOD = Geod(ellps="WGS84")
STEREO = CRS.from_proj4("+proj=stere +lat_0=90 +lat_ts=60 +lon_0=-45 +ellps=WGS84")
AZIMUTHS = (17.0, 130.0)


def map_sea(along_x: float, along_y: float) -> tuple[xr.Dataset, np.ndarray, np.ndarray]:
    """Uniform components along a map's axes; and latitude and longitude of its nodes."""
    X, Y = np.meshgrid(np.linspace(4e5, 8e5, 9), np.linspace(-2.2e6, -1.9e6, 7))
    longitude, latitude = Transformer.from_crs(STEREO.geodetic_crs, STEREO, always_xy=True).transform(
        X, Y, direction="INVERSE"
    )
    dims, full = ("time", "depth", "y", "x"), np.ones((1, 2, 7, 9))
    units = {"units": "m s-1", "grid_mapping": "crs"}
    data = xr.Dataset(
        {
            "t": (dims, 4.0 * full, {"standard_name": "sea_water_conservative_temperature", "units": "degC"}),
            "s": (dims, 35.0 * full, {"standard_name": "sea_water_absolute_salinity", "units": "g kg-1"}),
            "u": (dims, along_x * full, {"standard_name": "sea_water_x_velocity", **units}),
            "v": (dims, along_y * full, {"standard_name": "sea_water_y_velocity", **units}),
        },
        {
            "time": ("time", [0.0], {"units": "seconds since 2020-03-01"}),
            "depth": ("depth", [0.0, 100.0], {"units": "m", "positive": "down"}),
            "x": ("x", X[0], {"standard_name": "projection_x_coordinate", "units": "m"}),
            "y": ("y", Y[:, 0], {"standard_name": "projection_y_coordinate", "units": "m"}),
        },
    )
    for name in ("t", "s"):
        data[name].attrs["grid_mapping"] = "crs"
    data["crs"] = ((), 0, STEREO.to_cf())
    return data, latitude, longitude


def with_places(data: xr.Dataset, latitude: np.ndarray, longitude: np.ndarray) -> xr.Dataset:
    data["lat"] = (("y", "x"), latitude, {"standard_name": "latitude", "units": "degrees_north"})
    data["lon"] = (("y", "x"), longitude, {"standard_name": "longitude", "units": "degrees_east"})
    return data


def bearing_of_x(latitude: float, longitude: float) -> float:
    """Direction of the map's x axis, clockwise from north, by a step of 10 m on the map and pyproj's geodesic [rad]."""
    turn = Transformer.from_crs(STEREO.geodetic_crs, STEREO, always_xy=True)
    x, y = turn.transform(longitude, latitude)
    ends = turn.transform([x - 5.0, x + 5.0], [y, y], direction="INVERSE")
    return float(np.radians(GEOD.inv(ends[0][0], ends[1][0], ends[0][1], ends[1][1])[0]))


@pytest.mark.parametrize("places", [False, True])
def test_map_coordinates_with_and_without_latitude_and_longitude(tmp_path: Path, places: bool) -> None:
    data, latitude, longitude = map_sea(0.3, -0.1)
    (with_places(data, latitude, longitude) if places else data).to_netcdf(tmp_path / "map.nc")
    ocean = Ocean.open(tmp_path / "map.nc")
    assert "the map projection" in ocean.notes["currents"]
    for j, i in ((0, 0), (3, 4), (6, 8)):
        sample = ocean.at(START, latitude[j, i], longitude[j, i], 40.0)
        azimuth = bearing_of_x(latitude[j, i], longitude[j, i])
        x, y = np.array([np.sin(azimuth), np.cos(azimuth)]), np.array([-np.cos(azimuth), np.sin(azimuth)])
        expected = 0.3 * x - 0.1 * y
        assert (sample.current_east, sample.current_north) == pytest.approx(expected, abs=1e-6)


def test_the_angle_variable_comes_before_the_map(tmp_path: Path) -> None:
    """An angle in degrees, stored transposed, that is not the map's: the file is believed."""
    data, latitude, longitude = map_sea(0.2, 0.0)
    data = with_places(data, latitude, longitude)
    angle = np.full(latitude.shape, 90.0)
    angle[2, 3] = 30.0
    attrs = {"standard_name": "angle_of_rotation_from_east_to_x", "units": "degree"}
    data["angle"] = (("x", "y"), angle.T, attrs)
    data.to_netcdf(tmp_path / "angle.nc")
    ocean = Ocean.open(tmp_path / "angle.nc")
    assert "the variable angle" in ocean.notes["currents"]
    sample = ocean.at(START, latitude[2, 3], longitude[2, 3])
    expected = 0.2 * np.cos(np.pi / 6), 0.2 * np.sin(np.pi / 6)
    assert (sample.current_east, sample.current_north) == pytest.approx(expected, abs=1e-6)
    sample = ocean.at(START, latitude[5, 5], longitude[5, 5])
    assert (sample.current_east, sample.current_north) == pytest.approx((0.0, 0.2), abs=1e-6)


def test_currents_that_are_east_and_north_already_are_not_turned(tmp_path: Path) -> None:
    data, latitude, longitude = map_sea(0.3, -0.1)
    data = with_places(data, latitude, longitude)
    data.u.attrs["standard_name"], data.v.attrs["standard_name"] = (
        "eastward_sea_water_velocity",
        "northward_sea_water_velocity",
    )
    data.to_netcdf(tmp_path / "east.nc")
    ocean = Ocean.open(tmp_path / "east.nc")
    sample = ocean.at(START, latitude[3, 4], longitude[3, 4])
    assert (sample.current_east, sample.current_north) == pytest.approx((0.3, -0.1), abs=1e-6)
    assert "east and north" in ocean.notes["currents"]


@pytest.mark.parametrize("places", [False, True])
def test_rotated_pole(tmp_path: Path, places: bool) -> None:
    """Oracle: PROJ's own rotated-pole projection (ob_tran), and bearings of short geodesics along it on its sphere."""
    rotated = {
        "grid_mapping_name": "rotated_latitude_longitude", "grid_north_pole_latitude": 39.25,
        "grid_north_pole_longitude": -162.0, "earth_radius": 6371229.0, "proj4": "not what PROJ can read",
    }  # fmt: skip
    proj = "+proj=ob_tran +o_proj=longlat +o_lon_p=0 +o_lat_p=39.25 +lon_0=18 +R=6371229 +to_meter=0.0174532925199433"
    turn = Transformer.from_crs(CRS.from_proj4("+proj=longlat +R=6371229"), CRS.from_proj4(proj), always_xy=True)
    data, _, _ = map_sea(0.25, 0.1)
    rlon, rlat = np.linspace(-2.0, 2.0, 9), np.linspace(3.0, 6.0, 7)
    data["x"] = ("x", rlon, {"standard_name": "grid_longitude", "units": "degrees"})
    data["y"] = ("y", rlat, {"standard_name": "grid_latitude", "units": "degrees"})
    data["crs"] = ((), 0, rotated)
    longitude, latitude = turn.transform(*np.meshgrid(rlon, rlat), direction="INVERSE")
    (with_places(data, latitude, longitude) if places else data).to_netcdf(tmp_path / "rotated.nc")
    ocean = Ocean.open(tmp_path / "rotated.nc")
    assert "the map projection" in ocean.notes["currents"]
    sphere = Geod(a=6371229.0, b=6371229.0)
    for j, i in ((0, 0), (3, 4), (6, 8)):
        ends = turn.transform([rlon[i] - 1e-4, rlon[i] + 1e-4], [rlat[j]] * 2, direction="INVERSE")
        azimuth = np.radians(sphere.inv(ends[0][0], ends[1][0], ends[0][1], ends[1][1])[0])
        expected = 0.25 * np.array([np.sin(azimuth), np.cos(azimuth)]) + 0.1 * np.array(
            [-np.cos(azimuth), np.sin(azimuth)]
        )
        sample = ocean.at(START, latitude[j, i], longitude[j, i])
        assert (sample.current_east, sample.current_north) == pytest.approx(expected, abs=1e-6)


def test_longitudes_of_every_kind_are_the_same_sea(sea_file: Writer) -> None:
    """0 to 360 and -180 to 180, files and questions, descending latitude, levels from the deepest up."""

    def eastern(data: xr.Dataset) -> xr.Dataset:
        data = data.assign_coords(lon=("lon", data.lon.values % 360.0, data.lon.attrs))
        return data.isel(lat=slice(None, None, -1), depth=slice(None, None, -1))

    plain = Ocean.open(sea_file()).at(START, 12.3, 179.6, 70.0)
    other = Ocean.open(sea_file(eastern))
    for longitude in (179.6, -180.4, 539.6):
        sample = other.at(START, 12.3, longitude, 70.0)
        assert sample.conservative_temperature == pytest.approx(plain.conservative_temperature, abs=1e-6)
        assert sample.current_north == pytest.approx(plain.current_north, abs=1e-7)


def around_the_earth(folder: Path, first: float, *, closed: bool) -> Path:
    """Write a sea all around the Earth, its temperature the cosine of the longitude."""
    lon = first + 10.0 * np.arange(37 if closed else 36)
    lat, full = np.linspace(-60.0, 60.0, 13), np.ones((2, 13, lon.size))
    dims = ("depth", "lat", "lon")
    data = xr.Dataset(
        {
            "t": (dims, (15.0 + np.cos(np.radians(lon))) * full,
                  {"standard_name": "sea_water_conservative_temperature", "units": "degC"}),
            "s": (dims, 35.0 * full, {"standard_name": "sea_water_absolute_salinity", "units": "g kg-1"}),
            "u": (dims, 0.1 * full, {"standard_name": "eastward_sea_water_velocity", "units": "cm s-1"}),
            "v": (dims, 0.0 * full, {"standard_name": "northward_sea_water_velocity", "units": "cm s-1"}),
        },
        {
            "depth": ("depth", [0.0, 100.0], {"units": "m", "positive": "down"}),
            "lat": ("lat", lat, {"units": "degrees_north"}),
            "lon": ("lon", lon, {"units": "degrees_east"}),
        },
    )  # fmt: skip
    data.to_netcdf(folder / "earth.nc")
    return folder / "earth.nc"


@pytest.mark.parametrize("closed", [False, True])
@pytest.mark.parametrize("first", [0.0, -180.0])
def test_a_region_across_the_seam_of_a_file_around_the_earth(tmp_path: Path, first: float, closed: bool) -> None:
    path = around_the_earth(tmp_path, first, closed=closed)
    with pytest.raises(FileError, match="degrees from its centre"):
        Ocean.open(path)
    for west, east in ((-25.0, 25.0), (155.0, 205.0), (155.0, -155.0)):
        ocean = Ocean.open(path, bounds=(-20.0, 20.0, west, east))
        for longitude in (west, west + 20.0, west + 30.0, west + 47.0):
            low, high = np.floor(longitude / 10.0) * 10.0, np.ceil(longitude / 10.0 + 1e-9) * 10.0
            expected = 15.0 + np.interp(longitude, (low, high), np.cos(np.radians((low, high))))
            # between nodes 10 deg apart the plane of the search is not quite the one of the meridians
            assert ocean.at(0.0, 0.0, longitude).conservative_temperature == pytest.approx(expected, abs=2e-3)


@pytest.mark.parametrize("scalar", [False, True])
def test_a_single_place_is_the_same_everywhere(sea_file: Writer, scalar: bool) -> None:
    def mooring(data: xr.Dataset) -> xr.Dataset:
        return data.isel(lat=3 if scalar else [3], lon=2 if scalar else [2])

    whole = Ocean.open(sea_file())
    one = Ocean.open(sea_file(mooring))
    a, b = whole.at(START + 5e3, 13.0, 179.0, 80.0), one.at(START + 5e3, -40.0, 10.0, 80.0)
    assert b.conservative_temperature == pytest.approx(a.conservative_temperature, abs=1e-6)
    assert b.current_north == pytest.approx(a.current_north, abs=1e-7)
    assert b.bottom_depth == a.bottom_depth
    assert one.notes["place"] == "one place: the same everywhere"
    with pytest.raises(OutsideOceanError):
        one.at(START - 10.0, 13.0, 179.0)


@pytest.mark.parametrize(
    ("standard_name", "units", "offset"),
    [
        ("sea_water_temperature", "degree_C", 0.0),
        ("sea_water_potential_temperature", "K", 273.15),
        ("sea_water_conservative_temperature", "degrees_Celsius", 0.0),
    ],
)
def test_every_temperature_is_the_one_that_its_name_says(
    sea_file: Writer, standard_name: str, units: str, offset: float
) -> None:
    """Oracle: gsw, from the node's number at 200 m, where the three differ by some hundredths of a degree."""
    import gsw

    def renamed(data: xr.Dataset) -> None:
        data["to"] = (data.to + offset).assign_attrs(standard_name=standard_name, units=units)

    sample = Ocean.open(sea_file(renamed)).at(START, 12.0, 179.0, 200.0)
    given, p = 15.0 - 2.0, float(gsw.p_from_z(-200.0, 12.0))
    S_A = float(gsw.SA_from_SP(34.0 - 0.2, p, 179.0, 12.0))
    expected = {
        "sea_water_temperature": gsw.CT_from_t(S_A, given, p),
        "sea_water_potential_temperature": gsw.CT_from_pt(S_A, given),
        "sea_water_conservative_temperature": given,
    }
    assert sample.conservative_temperature == pytest.approx(float(expected[standard_name]), abs=2e-5)


@pytest.mark.parametrize(
    ("attributes", "factor"),
    [
        ({"standard_name": "sea_water_absolute_salinity", "units": "g kg-1"}, 1.0),
        ({"standard_name": "sea_water_absolute_salinity", "units": "kg kg-1"}, 1e-3),
        ({"standard_name": "sea_water_practical_salinity", "units": "1"}, 1.0),
        ({"standard_name": "sea_water_salinity", "units": "psu"}, 1.0),
    ],
)
def test_every_salinity_is_the_one_that_its_name_says(
    sea_file: Writer, attributes: dict[str, Any], factor: float
) -> None:
    import gsw

    def renamed(data: xr.Dataset) -> None:
        data["so"] = data.so * factor
        data.so.attrs = attributes

    sample = Ocean.open(sea_file(renamed)).at(START, 12.0, 179.0, 0.0)
    absolute = "absolute" in attributes["standard_name"]
    expected = 34.0 if absolute else float(gsw.SA_from_SP(34.0, 0.0, 179.0, 12.0))
    assert sample.absolute_salinity == pytest.approx(expected, abs=1e-5)


def test_a_bottom_above_the_surface_is_unknown(sea_file: Writer) -> None:
    """An elevation, negative in the sea, is a depth; where a depth says land and there is water, the levels speak."""

    def elevation(data: xr.Dataset) -> None:
        data["deptho"] = (-data.deptho).assign_attrs(data.deptho.attrs)

    def holes(data: xr.Dataset) -> None:
        data.deptho.values[3, 3] = -2.0

    assert Ocean.open(sea_file(elevation)).bottom_depth(13.0, 179.0) == pytest.approx(400.0)
    assert Ocean.open(sea_file(holes)).bottom_depth(13.0, -180.0) == pytest.approx(200.0)


def test_coordinates_that_do_not_have_the_name_of_their_dimension(sea_file: Writer) -> None:
    def renamed(data: xr.Dataset) -> xr.Dataset:
        attrs = {name: data[name].attrs for name in ("time", "depth")}
        data = data.rename(time="n", depth="k").reset_index(["n", "k"]).drop_vars(["n", "k"])
        data["when"] = ("n", [0.0, 6.0, 12.0], attrs["time"])
        data["z"] = ("k", [0.0, 50.0, 200.0], attrs["depth"])
        return data

    a, b = (Ocean.open(sea_file(how)).at(START + 4e3, 12.5, 179.5, 60.0) for how in (None, renamed))
    assert b == a


def test_a_size_of_one_is_no_dimension(sea_file: Writer) -> None:
    a, b = (
        Ocean.open(sea_file(how)).at(START + 4e3, 12.5, 179.5, 60.0)
        for how in (None, lambda data: data.expand_dims({"member": 1}))
    )
    assert b == a
