"""One ocean in several files: one stretch of time after the other, one quantity each, or both; and what cannot fit."""

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
import xarray as xr

from stommel.errors import FileError
from stommel.ocean import Ocean
from tests.ocean.conftest import regular_sea

START = 1583020800.0
NAMES = ("conservative_temperature", "absolute_salinity", "current_east", "current_north", "bottom_depth")


def written(folder: Path, parts: dict[str, xr.Dataset]) -> Path:
    for name, data in parts.items():
        data.to_netcdf(folder / f"{name}.nc")
    return folder


def same(folder: Path, ocean: Ocean, within: float = 1e-6) -> None:
    regular_sea().to_netcdf(folder / "whole")
    whole = Ocean.open(folder / "whole")
    for place in ((4.0, 12.5, 179.5, 20.0), (11.0, 13.4, -178.6, 60.0), (0.0, 11.2, 179.0, 199.0)):
        a, b = (o.at(START + 3600.0 * place[0], *place[1:]) for o in (whole, ocean))
        for name in NAMES:
            assert getattr(b, name) == pytest.approx(getattr(a, name), rel=within, abs=within), name


def test_one_stretch_of_time_each_in_any_order(tmp_path: Path) -> None:
    """The second file packs its temperatures in its own way, and counts its time from another day."""
    data = regular_sea()
    late = data.isel(time=[2])
    late["time"] = ("time", [-12.0], data.time.attrs | {"units": "hours since 2020-03-02"})
    data.isel(time=[0, 1]).to_netcdf(tmp_path / "sea_1.nc")
    packing = {"dtype": "int16", "scale_factor": 0.001, "add_offset": 10.0, "_FillValue": np.int16(-32768)}
    late.to_netcdf(tmp_path / "sea_0.nc", encoding={"to": packing})
    for source in (str(tmp_path / "sea_*.nc"), [tmp_path / "sea_1.nc", tmp_path / "sea_0.nc"]):
        ocean = Ocean.open(source)
        assert len(ocean.data.nodes.times) == 3
        assert ocean.notes["files"] == "2 files joined"
        same(tmp_path, ocean, within=1e-3)


def test_one_quantity_each(tmp_path: Path) -> None:
    """As the files of large forecast centres: temperature, salinity, currents and a static file with the bottom."""
    data = regular_sea()
    static = data[["deptho"]]
    up = data[["so"]].isel(depth=slice(None, None, -1), lat=slice(None, None, -1))
    up = up.rename(lat="latitude").assign_coords(lon=up.lon % 360.0)
    up.lon.attrs = data.lon.attrs
    written(tmp_path, {"t": data[["to"]], "s": up, "uv": data[["uo", "vo"]], "static": static})
    up.isel(latitude=slice(None, None, -1)).to_netcdf(tmp_path / "s.nc")
    same(tmp_path, Ocean.open([tmp_path / f"{name}.nc" for name in ("uv", "static", "s", "t")]))


def test_relative_names_are_sought_in_the_folder_first(tmp_path: Path) -> None:
    data = regular_sea()
    written(tmp_path, {"a": data[["to", "so", "deptho"]], "b": data[["uo", "vo"]]})
    assert Ocean.open(["a.nc", "b.nc"], folder=tmp_path).name == f"{tmp_path / 'a.nc'} and 1 more"
    assert len(Ocean.open("?.nc", folder=tmp_path).data.nodes.times) == 3


def overlapping(data: xr.Dataset) -> dict[str, xr.Dataset]:
    return {"a": data.isel(time=[0, 1]), "b": data.isel(time=[1, 2])}


def other_times(data: xr.Dataset) -> dict[str, xr.Dataset]:
    return {"a": data[["to", "so"]], "b": data[["uo", "vo"]].isel(time=[0, 1])}


def other_levels(data: xr.Dataset) -> dict[str, xr.Dataset]:
    return {"a": data[["to", "so"]], "b": data[["uo", "vo"]].isel(depth=[0, 1])}


def other_nodes(data: xr.Dataset) -> dict[str, xr.Dataset]:
    moved = data[["uo", "vo"]]
    return {"a": data[["to", "so"]], "b": moved.assign_coords(lon=("lon", moved.lon.values + 0.5, moved.lon.attrs))}


def without_salinity(data: xr.Dataset) -> dict[str, xr.Dataset]:
    return {"a": data[["to"]], "b": data[["uo", "vo"]]}


@pytest.mark.parametrize(
    ("parts", "words"),
    [
        (overlapping, ["b.nc", "to at 2020-03-01T06:00:00Z is in", "a.nc too"]),
        (other_times, ["b.nc", "must have the same times", "2020-03-01T12:00:00Z"]),
        (other_levels, ["b.nc", "2 levels to 50 m", "3 to 200 m"]),
        (other_nodes, ["b.nc", "does not lie on the nodes of to of"]),
        (without_salinity, ["no variable for salinity"]),
    ],
)
def test_files_that_do_not_fit_together(
    tmp_path: Path, parts: Callable[[xr.Dataset], dict[str, xr.Dataset]], words: list[str]
) -> None:
    written(tmp_path, parts(regular_sea()))
    with pytest.raises(FileError) as refused:
        Ocean.open(str(tmp_path / "*.nc"))
    assert len(str(refused.value).splitlines()) == 1
    for word in words:
        assert word in str(refused.value)


def test_sources_that_name_nothing(tmp_path: Path) -> None:
    for source, words in (([], "no file is named"), (str(tmp_path / "*.nc"), "no file matches this pattern")):
        with pytest.raises(FileError, match=words):
            Ocean.open(source)
    written(tmp_path, {"a": regular_sea()})
    with pytest.raises(FileError, match="named twice"):
        Ocean.open([tmp_path / "a.nc", tmp_path / "a.nc"])
