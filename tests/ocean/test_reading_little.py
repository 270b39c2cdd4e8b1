"""Of a large file only the wanted region and times are read: memory and the numbers that are asked of the file."""

import json
import subprocess
import sys
from pathlib import Path

import netCDF4
import numpy as np
import pytest
import xarray as xr

from stommel.errors import FileError
from stommel.ocean import Ocean

TIMES, LEVELS, ROWS, COLUMNS = 40, 20, 300, 400
WHOLE_MB = 4 * 4 * TIMES * LEVELS * ROWS * COLUMNS / 1e6
"""The four fields at single precision, as they would lie in memory."""

_PROGRAM = """
import json, sys
from stommel.ocean import Ocean
import netCDF4, pyproj, gsw, stommel.ocean.reading.netcdf
from pathlib import Path
def peak():  # of this process alone: what getrusage says begins with the parent's
    lines = Path("/proc/self/status").read_text().splitlines()
    return next(int(line.split()[1]) for line in lines if line.startswith("VmHWM")) / 1e3
Ocean.analytic("gyre")  # loads the compiled functions
before = peak()
ocean = Ocean.open(sys.argv[1], bounds=(20, 23, 130, 133), between=("2020-03-05", "2020-03-06"))
water = ocean.data.nodes.water
print(json.dumps({"mb": peak() - before, "shape": water.shape, "t": water[0, 0, 0, 2, 0].item()}))
"""


@pytest.fixture(scope="module")
def large(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Write 1.5 GB of numbers, which are alike but for the time and lie in 10 MB."""
    path = tmp_path_factory.mktemp("large") / "large.nc"
    with netCDF4.Dataset(path, "w") as file:
        sizes = {"time": TIMES, "depth": LEVELS, "lat": ROWS, "lon": COLUMNS}
        axes = {
            "time": (np.arange(TIMES), {"units": "days since 2020-03-01", "standard_name": "time"}),
            "depth": (np.linspace(0.0, 1000.0, LEVELS), {"units": "m", "positive": "down"}),
            "lat": (np.linspace(10.0, 40.0, ROWS), {"units": "degrees_north"}),
            "lon": (np.linspace(120.0, 160.0, COLUMNS), {"units": "degrees_east"}),
        }
        for name, (values, attributes) in axes.items():
            file.createDimension(name, sizes[name])
            variable = file.createVariable(name, "f8", (name,))
            variable[:] = values
            variable.setncatts(attributes)
        fields = {
            "t": ("sea_water_conservative_temperature", "degC", 10.0),
            "s": ("sea_water_absolute_salinity", "g kg-1", 35.0),
            "u": ("eastward_sea_water_velocity", "m s-1", 0.1),
            "v": ("northward_sea_water_velocity", "m s-1", 0.2),
        }
        for name, (standard, units, value) in fields.items():
            variable = file.createVariable(
                name, "f4", tuple(sizes), zlib=True, complevel=1, chunksizes=(1, LEVELS, ROWS, COLUMNS // 4)
            )
            variable.setncatts({"standard_name": standard, "units": units})
            for n in range(TIMES):
                variable[n] = np.full((LEVELS, ROWS, COLUMNS), value + (0.1 * n if name == "t" else 0.0), np.float32)
    return path


def test_a_region_and_two_days_of_a_large_file(large: Path) -> None:
    """At most a tenth of what all of it would take."""
    if not Path("/proc/self/status").exists():
        pytest.skip("no /proc: the peak of memory is not known")
    done = subprocess.run([sys.executable, "-c", _PROGRAM, str(large)], capture_output=True, text=True, check=True)
    found = json.loads(done.stdout)
    assert found["shape"][0] == 2
    assert found["t"] == pytest.approx(10.0 + 0.1 * 4, abs=1e-5)
    assert found["mb"] < 0.1 * WHOLE_MB, found


def test_only_what_is_wanted_is_asked_of_the_file(large: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Numbers read in all, counted where they leave the file: the region and its margin, twice for coordinates."""
    from stommel.ocean.reading.variables import File

    count = 0
    raw = File.raw

    def counted(self: File, variable: str, values: xr.DataArray | None = None) -> np.ndarray:
        nonlocal count
        found = raw(self, variable, values)
        count += found.size
        return found

    monkeypatch.setattr(File, "raw", counted)
    ocean = Ocean.open(large, bounds=(20.0, 23.0, 130.0, 133.0), between=("2020-03-05", "2020-03-06"))
    times, rows, columns, _, levels = ocean.data.nodes.water.shape
    fields = 4 * times * rows * columns * levels
    assert fields <= count < fields + 10 * (TIMES + LEVELS + ROWS + COLUMNS)


def test_too_large_a_file_is_refused_before_it_is_read(tmp_path: Path) -> None:
    """A file of 26 GB, of which nothing is written: refused at once, with what to do."""
    path = tmp_path / "huge.nc"
    with netCDF4.Dataset(path, "w") as file:
        for name, values, attributes in (
            ("time", np.arange(400.0), {"units": "days since 2020-01-01"}),
            ("depth", np.linspace(0.0, 4000.0, 40), {"units": "m", "positive": "down"}),
            ("lat", np.linspace(10.0, 30.0, 200), {"units": "degrees_north"}),
            ("lon", np.linspace(120.0, 160.0, 400), {"units": "degrees_east"}),
        ):
            file.createDimension(name, len(values))
            variable = file.createVariable(name, "f8", (name,))
            variable[:] = values
            variable.setncatts(attributes)
        for name, standard, units in (
            ("t", "sea_water_temperature", "degC"),
            ("s", "sea_water_salinity", "1e-3"),
            ("u", "eastward_sea_water_velocity", "m s-1"),
            ("v", "northward_sea_water_velocity", "m s-1"),
        ):
            variable = file.createVariable(
                name, "f4", ("time", "depth", "lat", "lon"), zlib=True, chunksizes=(1, 40, 200, 400)
            )
            variable.setncatts({"standard_name": standard, "units": units})
    with pytest.raises(FileError, match=r"needs 25\.6 GB of memory; cut it with bounds"):
        Ocean.open(path)
