"""Files that are cut short, damaged, empty or no files: one clear line, and never zeros instead of the numbers."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import netCDF4
import numpy as np
import pytest
import xarray as xr

from stommel.errors import FileError
from stommel.ocean import Ocean
from stommel.ocean.reading.classic import expected_length
from tests.ocean.conftest import Writer, regular_sea


def refused(path: Path, *words: str, **options: Any) -> None:
    with pytest.raises(FileError) as error:
        Ocean.open(path, **options)
    text = str(error.value)
    assert len(text.splitlines()) == 1
    for word in (str(path), *words):
        assert word in text


@pytest.mark.parametrize("share", [0.0, 0.1, 0.5, 0.9, 0.999])
def test_a_file_that_was_cut_short(sea_file: Writer, share: float) -> None:
    path = sea_file()
    path.write_bytes(path.read_bytes()[: int(share * path.stat().st_size)])
    refused(path, "cannot be read as NetCDF")


@pytest.mark.parametrize("kind", ["NETCDF3_CLASSIC", "NETCDF3_64BIT_OFFSET", "NETCDF3_64BIT_DATA"])
@pytest.mark.parametrize("unlimited", [False, True])
def test_a_classic_file_that_was_cut_short(tmp_path: Path, kind: Any, unlimited: bool) -> None:
    """The library reads zeros there. Oracle: the length of the whole file, to its last number."""
    path = tmp_path / "sea.nc"
    regular_sea().to_netcdf(path, format=kind, engine="netcdf4", unlimited_dims=["time"] if unlimited else [])
    whole = path.read_bytes()
    assert Ocean.open(path).data.nodes.water.shape[0] == 3
    for lost in (8, 100, 1000, 5000, len(whole) - 50):
        path.write_bytes(whole[:-lost])
        refused(path, "was cut short", f"{len(whole) - lost} bytes")


def test_length_of_a_classic_file_with_one_variable_of_odd_records(tmp_path: Path) -> None:
    """A single variable with records has no filling between them."""
    with netCDF4.Dataset(tmp_path / "odd.nc", "w", format="NETCDF3_CLASSIC") as file:
        file.createDimension("time", None)
        file.createDimension("x", 3)
        file.createVariable("a", "i1", ("time", "x"))[:] = np.ones((5, 3))
    length = (tmp_path / "odd.nc").stat().st_size
    assert length - 4 < (expected_length(tmp_path / "odd.nc") or 0) <= length


def test_a_damaged_piece_is_found_when_it_is_read(tmp_path: Path) -> None:
    data = regular_sea().isel(lon=slice(0, 4)).interp(lat=np.linspace(10, 14, 200), lon=np.linspace(177, 179, 50))
    for name, attrs in ((n, regular_sea()[n].attrs) for n in ("to", "so", "uo", "vo", "lat", "lon")):
        data[name].attrs = attrs
    noise = np.random.default_rng(1).uniform(0.0, 1e-3, data.to.shape)
    data["to"] = (data.to + noise).fillna(15.0).assign_attrs(regular_sea().to.attrs)
    path = tmp_path / "sea.nc"
    data.drop_vars("deptho").to_netcdf(path, engine="netcdf4", encoding={"to": {"zlib": True, "fletcher32": True}})
    content = bytearray(path.read_bytes())
    middle = content.find(b"x\x9c") + 2000
    content[middle : middle + 2000] = bytes(2000)
    path.write_bytes(content)
    with xr.open_dataset(path, decode_cf=False):
        pass  # it opens: the damage is in the numbers
    refused(path, "to cannot be read", "damaged")


def test_a_folder_a_text_and_nothing(tmp_path: Path) -> None:
    refused(tmp_path, "is a folder; name its files")
    (tmp_path / "text.nc").write_text("time,depth\n0,1\n")
    refused(tmp_path / "text.nc", "cannot be read as NetCDF")
    refused(tmp_path / "missing.nc", "cannot be read: No such file or directory")


def set_values(name: str, values: Any) -> Callable[[xr.Dataset], None]:
    def change(data: xr.Dataset) -> None:
        data[name] = (data[name].dims, np.broadcast_to(values, data[name].shape).copy(), data[name].attrs)

    return change


def set_attribute(name: str, key: str, value: Any) -> Callable[[xr.Dataset], None]:
    def change(data: xr.Dataset) -> None:
        data[name].attrs[key] = value

    return change


def cut(**parts: Any) -> Callable[[xr.Dataset], xr.Dataset]:
    return lambda data: data.isel(parts)


def dropped(name: str) -> Callable[[xr.Dataset], xr.Dataset]:
    return lambda data: data.drop_vars(name)


def bounds_that_stand_still(data: xr.Dataset) -> None:
    data.time.attrs["bounds"] = "time_bnds"
    data["time_bnds"] = (("time", "nv"), np.zeros((3, 2)))


def an_ensemble(data: xr.Dataset) -> xr.Dataset:
    return data.expand_dims({"member": 2})


def a_mesh(data: xr.Dataset) -> xr.Dataset:
    return data.stack(node=("lat", "lon")).reset_index("node").rename(lat="node_lat", lon="node_lon")


def a_bottom_on_levels(data: xr.Dataset) -> None:
    data["deptho"] = data.deptho.expand_dims(lev=2).assign_attrs(data.deptho.attrs)


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (cut(time=slice(0, 0)), ["time has no times"]),
        (cut(lat=slice(0, 0)), ["0 x 6 nodes"]),
        (cut(depth=slice(0, 0)), ["one depth for each level"]),
        (cut(lat=[3]), ["1 x 6 nodes", "at least 2 x 2"]),
        (cut(depth=[0, 2, 1]), ["neither increases nor decreases"]),
        (cut(depth=0), ["no vertical dimension"]),
        (dropped("time"), ["time has no coordinate"]),
        (dropped("depth"), ["depth has no coordinate"]),
        (dropped("lat"), ["neither latitude and longitude"]),
        (set_values("so", np.nan), ["so has no number at 2020-03-01T00:00:00Z"]),
        (set_values("deptho", np.nan), ["deptho has no number"]),
        (set_values("time", [0.0, np.nan, 12.0]), ["time lacks some of its times"]),
        (set_values("time", [0.0, 6.0, 6.0]), ["time does not increase"]),
        (set_values("time", [1e18, 2e18, 3e18]), ["cannot be read as times"]),
        (set_values("lat", [10.0, 11.0, np.nan, 13.0, 14.0]), ["latitude and longitude must be given"]),
        (set_values("lat", [10.0, 11.0, 12.0, 13.0, 140.0]), ["140 deg"]),
        (set_values("lat", [10.0, 11.0, 11.0, 13.0, 14.0]), ["11 is followed by 11 deg at index 1"]),
        (set_values("depth", [0.0, np.nan, 200.0]), ["depth lacks some"]),
        (set_values("depth", [0.0, 50.0, 50.0]), ["depth has 50 m twice"]),
        (set_attribute("time", "units", "hours since yesterday"), ["cannot be read as times", "yesterday"]),
        (set_attribute("time", "units", "months since yesterday"), ["months since 1970-01-01"]),
        (set_attribute("time", "calendar", "noleap"), ["calendar 'noleap'", "gregorian"]),
        (set_attribute("depth", "units", "dbar"), ["'dbar'"]),
        (set_attribute("depth", "positive", "up"), ["above the surface"]),
        (set_attribute("to", "scale_factor", "two"), ["cannot be unpacked"]),
        (bounds_that_stand_still, ["bounds of time"]),
        (an_ensemble, ["member, lat, lon"]),
        (a_mesh, ["unstructured grids"]),
        (a_bottom_on_levels, ["deptho has the dimensions lev, lat, lon"]),
    ],
)
def test_what_no_ocean_can_be_made_of(sea_file: Writer, change: Callable[[xr.Dataset], Any], words: list[str]) -> None:
    refused(sea_file(change), *words)


def test_names_of_dimensions_that_are_not_there(sea_file: Writer) -> None:
    for what in ("time", "depth"):
        refused(sea_file(), f"{what} = 'nope'", "no such dimension", names={what: "nope"})
