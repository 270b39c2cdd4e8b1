"""CF files made on purpose: what they hold comes out, and what is wrong with them is said in one line."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import gsw
import numpy as np
import pytest
import xarray as xr

from stommel.errors import FileError, StommelError
from stommel.ocean import LandError, Ocean, OutsideOceanError
from tests.ocean.conftest import Writer, regular_sea

START = 1583020800.0


def at(path: Path, hours: float, latitude: float, longitude: float, depth: float, **options: Any) -> Any:
    return Ocean.open(path, **options).at(START + 3600.0 * hours, latitude, longitude, depth)


def test_linear_fields_come_out_between_the_nodes(sea_file: Writer) -> None:
    """Currents are linear in time and depth; the answer is theirs, also across the date line."""
    path = sea_file()
    for longitude in (179.5, -180.0, 180.0, -179.5, 181.0):
        sample = at(path, 4.5, 12.3, longitude, 30.0)
        assert sample.current_east == pytest.approx(0.1 + 0.01 * 4.5 - 0.0002 * 30.0, abs=1e-5)
        assert sample.current_north == pytest.approx(-0.2 + 0.02 * 4.5, abs=1e-5)
        theta = 15.0 + 0.45 - 0.3 + 0.15
        S_A = float(gsw.SA_from_SP(34.0 + 0.1 * (theta - 15.0), 30.2, longitude, 12.3))
        assert sample.absolute_salinity == pytest.approx(S_A, abs=2e-4)
        assert sample.conservative_temperature == pytest.approx(float(gsw.CT_from_pt(S_A, theta)), abs=5e-4)
    # dU/dt of the file's own slope, 0.01 and 0.02 m/s an hour; the horizontal gradients of the current are zero
    assert sample.acceleration_east == pytest.approx(0.01 / 3600.0, rel=1e-2)
    assert sample.acceleration_north == pytest.approx(0.02 / 3600.0, rel=1e-2)


def test_packed_equals_unpacked(sea_file: Writer) -> None:
    packing = {"dtype": "int16", "scale_factor": 0.001, "add_offset": 15.0, "_FillValue": np.int16(-32768)}
    plain = at(sea_file(), 6.0, 12.0, 179.0, 50.0)
    packed = at(sea_file(to=packing), 6.0, 12.0, 179.0, 50.0)
    assert packed.conservative_temperature == pytest.approx(plain.conservative_temperature, abs=1e-3)
    assert packed.current_east == plain.current_east


def turned_upside_down(data: xr.Dataset) -> xr.Dataset:
    upward = data.isel(depth=slice(None, None, -1)).assign_coords(depth=-data.depth.values[::-1])
    upward.depth.attrs = {"standard_name": "height", "units": "m", "positive": "up"}
    return upward


def in_other_units(data: xr.Dataset) -> None:
    data["to"] = data.to + 273.15
    data.to.attrs = {"standard_name": "sea_water_potential_temperature", "units": "K"}
    data["uo"] = data.uo * 100.0
    data.uo.attrs = {"standard_name": "eastward_sea_water_velocity", "units": "cm/s"}


def in_another_order(data: xr.Dataset) -> xr.Dataset:
    return data.transpose("lon", "lat", "depth", "time").isel(lat=slice(None, None, -1))


def curvilinear(data: xr.Dataset) -> xr.Dataset:
    lon, lat = np.meshgrid(data.lon.values % 360.0, data.lat.values)
    data = data.rename(lat="y", lon="x").drop_vars(["y", "x"])
    data["lat"] = (("y", "x"), lat, {"standard_name": "latitude", "units": "degrees_north"})
    data["lon"] = (("y", "x"), lon, {"standard_name": "longitude", "units": "degrees_east"})
    return data


@pytest.mark.parametrize("change", [turned_upside_down, in_other_units, in_another_order, curvilinear])
def test_the_same_sea_written_another_way(sea_file: Writer, change: Callable[[xr.Dataset], Any]) -> None:
    plain, other = (at(sea_file(how), 7.0, 12.6, 179.2, 120.0) for how in (None, change))
    for name in ("conservative_temperature", "absolute_salinity", "current_east", "current_north", "bottom_depth"):
        assert getattr(other, name) == pytest.approx(getattr(plain, name), rel=2e-6), name


def test_components_along_axes_without_a_map_are_turned_by_the_nodes(sea_file: Writer) -> None:
    """A grid whose i runs north and whose j runs west: x is north, y is west."""

    def turn(data: xr.Dataset) -> xr.Dataset:
        data = data.rename(lat="i", lon="j").drop_vars(["i", "j"]).transpose("time", "depth", "j", "i")
        data = data.isel(j=slice(None, None, -1))
        lon, lat = np.meshgrid(regular_sea().lon.values[::-1] % 360.0, regular_sea().lat.values, indexing="ij")
        data["lat"] = (("j", "i"), lat, {"standard_name": "latitude", "units": "degrees_north"})
        data["lon"] = (("j", "i"), lon, {"standard_name": "longitude", "units": "degrees_east"})
        east, north = data.uo, data.vo
        data["uo"], data["vo"] = north, -east
        data.uo.attrs = {"standard_name": "sea_water_x_velocity", "units": "m s-1"}
        data.vo.attrs = {"standard_name": "sea_water_y_velocity", "units": "m s-1"}
        return data

    plain, turned = at(sea_file(), 3.0, 12.5, 179.5, 10.0), at(sea_file(turn), 3.0, 12.5, 179.5, 10.0)
    assert turned.current_east == pytest.approx(plain.current_east, abs=1e-6)
    assert turned.current_north == pytest.approx(plain.current_north, abs=1e-6)


def test_bounds_of_time_widen_the_range(sea_file: Writer) -> None:
    def bound(data: xr.Dataset) -> None:
        data.time.attrs["bounds"] = "time_bnds"
        data["time_bnds"] = (("time", "nv"), data.time.values[:, None] + np.array([-6.0, 0.0]))

    path = sea_file(bound)
    ocean = Ocean.open(path)
    assert ocean.data.nodes.time_range.tolist() == [START - 6 * 3600.0, START + 12 * 3600.0]
    assert ocean.data.nodes.times.tolist() == [START - 3 * 3600.0, START + 3 * 3600.0, START + 9 * 3600.0]
    # the mean of the first interval speaks for its beginning too, and no longer
    assert at(path, -6.0, 12.0, 179.0, 0.0).current_east == pytest.approx(0.1, abs=1e-6)
    with pytest.raises(OutsideOceanError):
        at(path, -6.1, 12.0, 179.0, 0.0)


def test_land_and_the_levels_below_the_bottom(sea_file: Writer) -> None:
    path = sea_file()
    with pytest.raises(LandError):
        at(path, 0.0, 10.0, 177.0, 0.0)
    # the node whose third level is missing carries its second on down to the bottom
    sample = at(path, 0.0, 14.0, -178.0, 110.0)
    assert sample.bottom_depth == pytest.approx(120.0)
    assert sample.current_east == pytest.approx(0.1 - 0.0002 * 50.0, abs=1e-6)
    # beside the land, only the nodes with water count
    assert at(path, 0.0, 11.9, 177.5, 0.0).current_east == pytest.approx(0.1, abs=2e-5)


def test_bounds_and_times_cut_the_file(sea_file: Writer) -> None:
    path = sea_file()
    part = Ocean.open(path, bounds=(12.4, 13.5, 179.4, -178.5), between=(START + 3600.0, START + 5 * 3600.0))
    assert len(part.data.nodes.times) == 2
    assert part.data.x.shape == (3, 4)
    whole = Ocean.open(path)
    for place in ((12.5, 179.5, 20.0), (13.4, -178.6, 60.0)):
        a, b = (o.at(START + 2 * 3600.0, *place) for o in (part, whole))
        assert a.conservative_temperature == pytest.approx(b.conservative_temperature, abs=2e-6)
    with pytest.raises(OutsideOceanError):
        part.at(START + 11 * 3600.0, 12.5, 179.5)


def test_an_interval_after_the_file_needs_a_policy(sea_file: Writer) -> None:
    path, later = sea_file(), ("2020-04-01", "2020-04-02")
    with pytest.raises(FileError, match="it has 2020-03-01T00:00:00Z to 2020-03-01T12:00:00Z"):
        Ocean.open(path, between=later)
    held = Ocean.open(path, between=later, outside_time="hold")
    assert len(held.data.nodes.times) == 1
    assert held.at(later[0], 12.5, 179.5, 20.0).current_east == pytest.approx(0.1 + 0.12 - 0.004, abs=1e-6)


def test_names_override_standard_names(sea_file: Writer) -> None:
    def hide(data: xr.Dataset) -> None:
        del data.to.attrs["standard_name"]

    path = sea_file(hide)
    with pytest.raises(FileError, match="no variable for temperature"):
        Ocean.open(path)
    ocean = Ocean.open(path, names={"temperature": "to"})
    assert "taken as potential temperature" in ocean.notes["temperature"]


def without_units(name: str) -> Callable[[xr.Dataset], None]:
    def change(data: xr.Dataset) -> None:
        data[name].attrs.pop("units")

    return change


def backwards(data: xr.Dataset) -> xr.Dataset:
    return data.isel(time=[0, 2, 1])


def staggered(data: xr.Dataset) -> xr.Dataset:
    return data.assign(
        uo=data.uo.isel(lon=slice(1, None)).rename(lon="lon_u").drop_vars("lon_u").assign_attrs(data.uo.attrs)
    )


def sigma(data: xr.Dataset) -> xr.Dataset:
    data = data.rename(depth="s_rho").drop_vars("s_rho")
    data["s_rho"] = ("s_rho", [-1.0, -0.5, 0.0], {"standard_name": "ocean_s_coordinate_g1"})
    return data


def unmarked_fill(data: xr.Dataset) -> None:
    data["to"] = data.to.fillna(-999.0).assign_attrs(data.to.attrs)


def other_unit(data: xr.Dataset) -> None:
    data.uo.attrs["units"] = "knots"


def odd_calendar(data: xr.Dataset) -> None:
    data.time.attrs["calendar"] = "360_day"


def no_salinity(data: xr.Dataset) -> xr.Dataset:
    return data.drop_vars("so")


def all_land(data: xr.Dataset) -> None:
    data["to"] = (data.to * np.nan).assign_attrs(data.to.attrs)


def never_both(data: xr.Dataset) -> None:
    data["to"] = data.to.where(data.lat < 12.0).assign_attrs(data.to.attrs)
    data["so"] = data.so.where(data.lat >= 12.0).assign_attrs(data.so.attrs)


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (without_units("to"), ["to has no units", "degc"]),
        (without_units("uo"), ["uo has no units", "m s-1"]),
        (without_units("time"), ["time has no units", "seconds since"]),
        (without_units("depth"), ["depth has no units"]),
        (backwards, ["time does not increase", "2020-03-01T12:00:00Z", "2020-03-01T06:00:00Z"]),
        (staggered, ["uo has the dimensions", "staggered"]),
        (sigma, ["s_rho follows the terrain"]),
        (unmarked_fill, ["to has the value -999", "_FillValue"]),
        (other_unit, ["uo has the units 'knots'", "m s-1"]),
        (odd_calendar, ["calendar '360_day'"]),
        (no_salinity, ["no variable for salinity", "sea_water_salinity"]),
        (all_land, ["to has no number at 2020-03-01T00:00:00Z"]),
        (never_both, ["no place with temperature, salinity and currents"]),
    ],
)
def test_what_is_wrong_with_a_file_is_said(
    sea_file: Writer, change: Callable[[xr.Dataset], Any], words: list[str]
) -> None:
    with pytest.raises(StommelError) as refused:
        Ocean.open(sea_file(change))
    assert len(str(refused.value).splitlines()) == 1
    for word in words:
        assert word in str(refused.value)


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ({"outside": "zero"}, ["outside = 'zero'", "error, hold, climatology"]),
        ({"names": {"temp": "to"}}, ["unknown key temp", "temperature"]),
        ({"names": {"temperature": "nope"}}, ["no such variable", "uo"]),
        ({"bounds": (40.0, 50.0, 0.0, 10.0)}, ["no node within"]),
        ({"bounds": (50.0, 40.0, 0.0, 10.0)}, ["south 50"]),
        ({"between": ("2031-01-01", "2031-02-01")}, ["no times in the wanted interval"]),
        ({"between": ("soon", "later")}, ["'soon'"]),
    ],
)
def test_wrong_options_are_refused(sea_file: Writer, options: dict[str, Any], words: list[str]) -> None:
    with pytest.raises(StommelError) as refused:
        Ocean.open(sea_file(), **options)
    for word in words:
        assert word in str(refused.value)


def test_what_is_no_netcdf_file(tmp_path: Path) -> None:
    (tmp_path / "text.nc").write_text("not NetCDF")
    for name, why in (("text.nc", "cannot be read as NetCDF"), ("missing.nc", "cannot be read: No such file")):
        with pytest.raises(FileError, match=why):
            Ocean.open(tmp_path / name)
