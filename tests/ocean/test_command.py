"""`stommel ocean` as its users run it; the examples of the guide run."""

import re
import subprocess
import sys
from pathlib import Path

import pytest

from tests.cli.conftest import Command

GUIDE = Path(__file__).parents[2] / "docs" / "guide" / "ocean.md"


def test_a_file(stommel: Command, arctic20: Path) -> None:
    found = stommel(
        "ocean", "show", arctic20, "--at", "72,10", "--time", "2016-02-02T06:00:00", "--json", "--plot", "map"
    )
    assert found.status == 0, found.err
    assert found.json["times"] == 5
    assert found.json["nodes"] == [51, 91]
    assert found.json["density_error_kg_m3"] < 1e-5
    assert "map projection" in found.json["notes"]["currents"]
    assert found.json["sample"]["bottom_m"] == pytest.approx(2500.0, abs=1000.0)
    assert 1020.0 < found.json["sample"]["density_kg_m3"] < 1035.0
    assert [Path(name).name for name in found.json["plots"]] == ["map.png", "map.svg"]


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
        (("nowhere.nc",), ["nowhere.nc", "cannot be read as NetCDF"]),
        (("atlantis",), ["atlantis", "neither an analytic ocean nor a file", "gyre"]),
        (("pool", "--set", "depth=4"), ["unknown parameter depth", "bottom_m"]),
        (("pool", "--set", "depth"), ["--set depth", "NAME=VALUE"]),
        (("pool", "--set", "bottom_m=deep"), ["bottom_m = 'deep'", "number"]),
        (("pool", "--at", "30"), ["--at '30'"]),
        (("pool", "--at", "95,3"), ["latitude must be between -90 and 90"]),
        (("pool", "--at", "30,120", "--depth", "4"), ["depth = 4 m", "below the bottom at 3.5 m"]),
        (("pool", "--at", "30,120", "--depth", "-4"), ["above the surface"]),
        (("pool", "--time", "soon"), ["'soon'"]),
        (("gyre", "--at", "0,0"), ["outside the ocean", "latitude 28"]),
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


def test_a_plot_that_cannot_be_written(stommel: Command, tmp_path: Path) -> None:
    (tmp_path / "file").write_text("in the way")
    found = stommel("ocean", "show", "two_layer", "--plot", "file/map")
    assert found.status == 2
    assert "cannot be written" in found.err
    assert [path.name for path in tmp_path.iterdir()] == ["file"]


def test_examples_of_the_guide_run(stommel: Command, tmp_path: Path, arctic20: Path) -> None:
    (tmp_path / "arctic20.nc").symlink_to(arctic20)
    (tmp_path / "profile.csv").write_text("depth_m,temperature_c,salinity_psu\n0,28,33.8\n200,15,34.6\n")
    text = GUIDE.read_text(encoding="utf-8")
    commands = re.findall(r"^stommel (ocean .*)$", text, re.MULTILINE)
    assert len(commands) == 3
    for command in commands:
        found = stommel(*command.split())
        assert found.status == 0, found.err
    code = "\n".join(re.findall(r"```python\n(.*?)```", text, re.DOTALL))
    done = subprocess.run(
        [sys.executable, "-W", "error", "-c", code], cwd=tmp_path, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stderr
    assert "kg/m3" in done.stdout


def test_the_front_door_stays_light() -> None:
    heavy = {"xarray", "netCDF4", "gsw", "pyproj", "dask", "pandas", "numba", "numpy"}
    code = f"import sys, stommel, stommel.cli.app, stommel.cli.ocean; print(sorted({heavy} & set(sys.modules)))"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"
