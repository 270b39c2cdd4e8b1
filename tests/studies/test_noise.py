"""Seeds of a study's runs: each its own noise, or all the same; oracle: runs that differ by nothing else."""

from pathlib import Path

import numpy as np
import xarray as xr

from tests.studies.conftest import Write, run

TWICE = 'kind = "sweep"\nruns = 3\noutputs = ["reckoning_error_m_mean", "deepest_m"]\nseed = 7\n'
PITCH = '[[parameters]]\nkey = "mission.dives.pitch_deg"\nvalues = [35, 35.0001]\n'


def flown(folder: Path, study: Path) -> xr.Dataset:
    assert run(folder, study, "--workers", 1, "--output", "r.nc")["failed"] == []
    return xr.load_dataset(folder / "r.nc")


def test_every_run_has_a_seed_and_noise_of_its_own(folder: Path, write: Write) -> None:
    found = flown(folder, write(TWICE + PITCH))
    assert len(np.unique(found.seed)) == found.seed.size == 6
    assert len(np.unique(found.reckoning_error_m_mean)) == 6


def test_same_noise_is_one_seed_for_all_runs(folder: Path, write: Write) -> None:
    """Repeated runs are then the same to the last digit, and other values differ by these alone."""
    found = flown(folder, write("same_noise = true\n" + TWICE + PITCH))
    assert len(np.unique(found.seed)) == 1
    assert (found.reckoning_error_m_mean == found.reckoning_error_m_mean.isel(repeat=0)).all()
    assert (found.deepest_m == found.deepest_m.isel(repeat=0)).all()
    # a ten-thousandth of a degree does not turn the vehicle: what is left of the noise would
    apart = np.ptp(found.deepest_m.values)
    assert 0.0 < apart < 0.05
