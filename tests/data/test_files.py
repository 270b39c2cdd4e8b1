"""Oracles: the same samples read back by xarray and by csv; what CF 1.10 asks of a trajectory."""

import csv
import io
from pathlib import Path

import numpy as np
import pytest
import xarray as xr

from stommel.data.derived import with_derived
from stommel.data.files import as_trajectory, csv_lines, write_csv, write_netcdf
from stommel.data.profiles import with_profiles
from stommel.data.variables import BY_NAME

BEGIN = 1_782_864_000.0


@pytest.fixture(scope="module")
def trajectory() -> xr.Dataset:
    """A dive to 50 m and back in water of two temperatures; one sample has no conductivity."""
    p = np.concatenate([np.linspace(0.0, 50.0, 60), np.linspace(50.0, 0.0, 60)])
    conductivity = np.full(p.size, 4.5)
    conductivity[7] = np.nan
    columns = {
        "pressure": p, "temperature": np.where(p < 25.0, 25.0, 15.0), "conductivity": conductivity,
        "latitude": np.linspace(28.0, 28.1, p.size), "longitude": np.full(p.size, 126.0),
    }  # fmt: skip
    samples = xr.Dataset({name: ("obs", values, BY_NAME[name].attributes) for name, values in columns.items()})
    samples = samples.assign(time=("obs", BEGIN + 4.0 * np.arange(p.size)))
    return as_trajectory(with_derived(with_profiles(samples)), "vehicle-1", {"title": "A dive"})


def test_netcdf_reads_back_the_same(trajectory: xr.Dataset, tmp_path: Path) -> None:
    write_netcdf(trajectory, tmp_path / "dive.nc")
    with xr.open_dataset(tmp_path / "dive.nc", decode_times=False) as found:
        for name, variable in trajectory.variables.items():
            if variable.dtype.kind == "f":
                assert found[name].values == pytest.approx(variable.values, nan_ok=True), name
    with xr.open_dataset(tmp_path / "dive.nc") as found:
        assert found["time"].values[0] == np.datetime64("2026-07-01T00:00:00")


def test_it_is_a_trajectory_of_cf(trajectory: xr.Dataset) -> None:
    """CF 1.10, chapter 9: featureType, cf_role, coordinates; each variable says what its numbers mean."""
    assert trajectory.attrs["featureType"] == "trajectory"
    assert trajectory["trajectory"].attrs["cf_role"] == "trajectory_id"
    assert {"time", "depth", "latitude", "longitude"} <= set(trajectory.coords)
    for name, variable in trajectory.variables.items():
        if variable.ndim:
            assert {"units", "flag_meanings", "long_name"} & set(variable.attrs), name


def test_csv_has_units_and_an_empty_cell_where_nothing_is_known(trajectory: xr.Dataset, tmp_path: Path) -> None:
    write_csv(trajectory, tmp_path / "dive.csv")
    text = (tmp_path / "dive.csv").read_text(encoding="utf-8")
    assert text == "".join(csv_lines(trajectory))
    rows = list(csv.DictReader(io.StringIO(text)))
    assert len(rows) == 120
    assert rows[0]["time [UTC]"] == "2026-07-01T00:00:00.000Z"
    assert float(rows[3]["pressure [dbar]"]) == pytest.approx(trajectory["pressure"].values[3])
    assert rows[7]["conductivity [S m-1]"] == rows[7]["absolute_salinity [g kg-1]"] == ""
    assert rows[7]["temperature [degree_Celsius]"] == "25"
