"""The Dataset and its file: CF names, whole or not at all."""

import json
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
import xarray as xr

from stommel.errors import OutputError
from stommel.simulation.flight import Flown
from stommel.simulation.results.dataset import dataset_of, write_netcdf
from tests.simulation.conftest import made


@pytest.fixture(scope="module")
def dataset(quarter_day: Flown) -> xr.Dataset:
    return dataset_of(quarter_day)


def test_every_variable_has_a_name_and_a_unit(dataset: xr.Dataset) -> None:
    for name, variable in dataset.variables.items():
        assert variable.attrs.get("long_name"), name
        if np.issubdtype(variable.dtype, np.floating):
            assert variable.attrs.get("units"), name


def test_file_reads_back(dataset: xr.Dataset, tmp_path: Path) -> None:
    path = tmp_path / "new folder" / "mission.nc"
    write_netcdf(dataset, path)
    with xr.open_dataset(path) as found:
        assert found.sizes == dataset.sizes
        np.testing.assert_array_equal(found["time"].values, dataset["time"].values)
        np.testing.assert_array_equal(found["latitude"].values, dataset["latitude"].values)
        np.testing.assert_allclose(found["depth"].values, dataset["depth"].values, rtol=1e-6)
        assert found["phase"].attrs["flag_meanings"].split()[1] == "descent"
        assert found.attrs["Conventions"] == "CF-1.10"
    assert [p.name for p in path.parent.iterdir()] == ["mission.nc"]


def test_mission_can_be_flown_again_from_its_file(dataset: xr.Dataset, quarter_day: Flown) -> None:
    assert made(json.loads(dataset.attrs["mission"])).scenario == quarter_day.mission.scenario


def test_unwritable_folder_leaves_nothing(dataset: xr.Dataset, tmp_path: Path) -> None:
    blocked = tmp_path / "file"
    blocked.write_text("")
    with pytest.raises(OutputError, match=r"mission\.nc: cannot be written"):
        write_netcdf(dataset, blocked / "mission.nc")
    assert list(tmp_path.iterdir()) == [blocked]


FULL_DISK = """
import resource, signal, sys
from pathlib import Path
import numpy as np, xarray as xr
from stommel.errors import OutputError
from stommel.simulation.results.dataset import write_netcdf
signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
data = xr.Dataset({"depth": ("time", np.random.default_rng(0).normal(size=200_000), {"units": "m"})})
write_netcdf(data, sys.argv[1])  # loads everything that is written to when it is first loaded
Path(sys.argv[1]).unlink()
resource.setrlimit(resource.RLIMIT_FSIZE, (100_000, 100_000))
try:
    write_netcdf(data, sys.argv[1])
except OutputError as error:
    print(error)
"""


def test_full_disk_leaves_nothing(tmp_path: Path) -> None:
    """A limit on the size of files fails the same calls as a full disk does."""
    path = tmp_path / "mission.nc"
    found = subprocess.run([sys.executable, "-c", FULL_DISK, path], capture_output=True, text=True, check=True)
    assert "mission.nc: cannot be written: File too large" in found.stdout
    assert list(tmp_path.iterdir()) == []


MEMORY = """
from pathlib import Path
from stommel.simulation.flight import fly_mission
from stommel.simulation.scenario.loading import load_mission
from stommel.simulation.results.dataset import dataset_of, write_netcdf
from stommel.simulation.scenario.shipped import mission_path
import sys
flown = fly_mission(load_mission(mission_path("still_20_days")))
assert flown.outcome == "time over", flown.outcome
write_netcdf(dataset_of(flown), sys.argv[1])
# not getrusage: Linux carries the peak of the process that started this one over into it
peak = next(line for line in Path("/proc/self/status").read_text().splitlines() if line.startswith("VmHWM"))
print(int(peak.split()[1]) / 1024)
"""


def test_memory_of_twenty_days(tmp_path: Path) -> None:
    """Flown, described and written in less than 500 MB once the machine code is kept: the least of three runs."""
    peaks = []
    for _ in range(3):
        found = subprocess.run([sys.executable, "-c", MEMORY, tmp_path / "m.nc"], capture_output=True, text=True,
                               check=True)  # fmt: skip
        peaks.append(float(found.stdout))
    assert min(peaks) < 500.0
