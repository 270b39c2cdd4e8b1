"""`stommel ocean` as its users run it; the examples of the guide run."""

from pathlib import Path

import pytest

from tests.ocean.conftest import regular_sea
from tests.support.command import Command
from tests.support.pages import blocks, commands, guide
from tests.support.python import run_python


def test_a_file(stommel: Command, arctic20: Path) -> None:
    found = stommel(
        "ocean", "show", arctic20, "--at", "72,10", "--time", "2016-02-02T06:00:00", "--json", "--plot", "map.png"
    )
    assert found.status == 0, found.err
    assert found.json["times"] == 5
    assert found.json["nodes"] == [51, 91]
    assert found.json["density_error_kg_m3"] < 1e-5
    assert "map projection" in found.json["notes"]["currents"]
    assert found.json["sample"]["bottom_m"] == pytest.approx(2500.0, abs=1000.0)
    assert 1020.0 < found.json["sample"]["density_kg_m3"] < 1035.0
    assert found.json["written"] == ["map.png"]


def test_terminal_fits_80_columns(stommel: Command) -> None:
    found = stommel("ocean", "show", "pool", "--at", "30.26,120.12", "--depth", "3.5")
    assert found.status == 0
    assert max(map(len, found.out.splitlines())) <= 80
    assert "bottom       3.5 m" in found.out
    listed = stommel("ocean", "list")
    assert max(map(len, listed.out.splitlines())) <= 80
    assert {"gyre", "pool", "tide"} <= set(stommel("ocean", "list", "--json").json)


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (("nowhere.nc",), ["nowhere.nc: cannot be read: No such file"]),
        (("atlantis",), ["atlantis", "neither an analytic ocean nor a file", "gyre"]),
        (("pool", "--set", "depth=4"), ["unknown parameter depth", "bottom_m"]),
        (("pool", "--set", "depth"), ["--set depth", "NAME=VALUE"]),
        (("pool", "--set", "bottom_m=deep"), ["bottom_m = 'deep'", "number"]),
        (("pool", "--at", "30"), ["--at '30'"]),
        (("pool", "--at", "95,3"), ["latitude must be between -90 and 90"]),
        (("pool", "--at", "30,120", "--depth", "4"), ["depth = 4 m", "below the bottom at 3.5 m"]),
        (("pool", "--at", "30,120", "--depth", "-4"), ["--depth = -4: must be between 0 and 11300 m"]),
        (("pool", "--time", "soon"), ["'soon'"]),
        (("pool", "--at", "nan,3"), ["--at 'nan,3'"]),
        (("pool", "--at", "30,120", "--depth", "nan"), ["--depth = nan: must be between 0 and 11300 m"]),
        (("pool", "--depth", "1e9"), ["--depth = 1e9: must be"]),
        (("still", "--time", "9999-99-99"), ["'9999-99-99'"]),
        (("gyre", "--at", "0,0"), ["outside the ocean", "latitude 28"]),
        (("gyre", "--at", "0,0", "--outside", "zero"), ["outside = 'zero'", "hold"]),
        (("gyre", "--at", "0,0", "--climatology", "pool"), ["climatology: is only used with outside"]),
        (("gyre", "--outside", "climatology", "--climatology", "no.nc"), ["no.nc: cannot be read: No such file"]),
        (("gyre", "--at", "0,0", "--plot", "map.png"), ["outside the ocean"]),
        (("east_china_sea", "--plot", "map.png", "--depth", "3000"), ["its deepest bottom is at 1200 m"]),
        (("gyre", "--plot", ""), ["--plot ''", "names no file"]),
        (("gyre", "--set", "=3"), ["--set =3", "NAME=VALUE"]),
        (("gyre", "pool"), ["an analytic ocean stands alone", "pool"]),
        (("gyre", "--bounds", "1,2,3,4"), ["--bounds: gyre is an analytic ocean"]),
        (("gyre", "--name", "temperature=t"), ["--name: gyre is an analytic ocean"]),
        (("sea.nc", "--bounds", "1,2,3"), ["--bounds '1,2,3'", "south, north, west, east"]),
        (("sea.nc", "--bounds", "1,2,3,inf"), ["--bounds '1,2,3,inf'"]),
        (("sea.nc", "--between", "2016"), ["--between '2016'", "two times"]),
        (("sea_*.nc",), ["sea_*.nc", "no file matches"]),
        (("folder/",), ["folder: cannot be read: No such file"]),
        (("..",), ["is a folder"]),
    ],
)
def test_refused(stommel: Command, arguments: tuple[str, ...], words: list[str]) -> None:
    found = stommel("ocean", "show", *arguments)
    assert found.status == 2, found
    assert found.out == ""
    assert len(found.err.splitlines()) == 1
    for word in words:
        assert word in found.err


def test_land_and_time_outside_a_file(stommel: Command, arctic20: Path) -> None:
    for arguments, word in (
        (("--at", "78.5,17"), "is on land"),
        (("--at", "72,10", "--time", "2020-01-01"), "outside the ocean"),
    ):
        found = stommel("ocean", "show", arctic20, *arguments)
        assert (found.status, found.out) == (2, "")
        assert word in found.err


def test_several_files_a_region_and_a_climatology(stommel: Command, tmp_path: Path) -> None:
    data = regular_sea()
    data.isel(time=[0, 1]).to_netcdf(tmp_path / "sea_1.nc")
    data.isel(time=[2]).to_netcdf(tmp_path / "sea_2.nc")
    found = stommel(
        "ocean", "show", "sea_1.nc", "sea_2.nc", "--bounds", "11,14,178,182",
        "--between", "2020-03-01,2020-03-01T12:00", "--outside", "climatology", "--climatology", "two_layer",
        "--at", "30,178", "--depth", "100", "--json",
    )  # fmt: skip
    assert found.status == 0, found.err
    assert found.json["times"] == 3
    assert found.json["nodes"] == [5, 6]
    assert found.json["outside"] == "climatology"
    assert found.json["sample"]["held"] is True
    assert found.json["sample"]["temperature_c"] == pytest.approx(10.0, abs=0.05)
    assert 1450.0 < found.json["sample"]["sound_speed_m_s"] < 1520.0
    assert -2.0 < found.json["sample"]["freezing_temperature_c"] < -1.8
    assert found.json["notes"]["climatology"].startswith("two_layer, reached 50 km and 24 h")


def test_a_profile(stommel: Command, tmp_path: Path) -> None:
    (tmp_path / "cast.csv").write_text("Z,temperature_c,salinity_psu\n0,28,33.8\n200,15,34.6\n")
    found = stommel(
        "ocean",
        "show",
        "cast.csv",
        "--name",
        "depth_m=Z",
        "--set",
        "bottom_m=900",
        "--at",
        "28,126",
        "--plot",
        "cast.png",
    )
    assert found.status == 0, found.err
    assert "everywhere the same" in found.out
    assert (tmp_path / "cast.png").stat().st_size > 10_000


def test_a_plot_that_cannot_be_written(stommel: Command, tmp_path: Path) -> None:
    (tmp_path / "file").write_text("in the way")
    found = stommel("ocean", "show", "two_layer", "--plot", "file/map.svg")
    assert found.status == 2
    assert "cannot be written" in found.err
    assert [path.name for path in tmp_path.iterdir()] == ["file"]


def test_examples_of_the_guide_run(stommel: Command, tmp_path: Path, arctic20: Path) -> None:
    (tmp_path / "arctic20.nc").symlink_to(arctic20)
    (tmp_path / "profile.csv").write_text("depth_m,temperature_c,salinity_psu\n0,28,33.8\n200,15,34.6\n")
    text = guide("ocean")
    calls = commands(text, "ocean")
    assert len(calls) == 3
    for arguments in calls:
        found = stommel(*arguments)
        assert found.status == 0, found.err
    assert "kg/m3" in run_python("-c", "\n".join(blocks(text, "python")), folder=tmp_path)


def test_the_front_door_stays_light() -> None:
    heavy = {"xarray", "netCDF4", "gsw", "pyproj", "dask", "pandas", "numba", "numpy"}
    code = f"import sys, stommel, stommel.cli.app, stommel.cli.ocean; print(sorted({heavy} & set(sys.modules)))"
    assert run_python("-c", code).strip() == "[]"
