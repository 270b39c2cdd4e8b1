"""The example of the guide runs as it is printed."""

from pathlib import Path

import xarray as xr

from tests.support.command import Command
from tests.support.pages import blocks, commands, guide
from tests.support.python import run_python

GUIDE = guide("studies")


def test_example(stommel: Command, tmp_path: Path) -> None:
    mission, study = blocks(GUIDE, "toml")
    (tmp_path / "dives.toml").write_text(mission)
    (tmp_path / "drift.toml").write_text(study)
    arguments, *_ = commands(GUIDE, "study")
    done = stommel(*arguments)
    assert done.status == 0, done.err
    assert "16 runs flown" in done.out
    result = xr.load_dataset(tmp_path / "drift.nc")
    assert set(result.failure.values) == {""}
    coefficients = result.regression_coefficient.sel(output="distance_made_good_km")
    # the current carries the vehicle; the compass is a detail
    assert abs(coefficients.sel(parameter="current_north_m_s")) > abs(coefficients.sel(parameter="heading_noise_deg"))
    (script,) = blocks(GUIDE, "python")
    assert run_python("-c", script, folder=tmp_path).splitlines()[0].endswith(" km")


def test_sweep_with_draws(stommel: Command, tmp_path: Path) -> None:
    mission, _ = blocks(GUIDE, "toml")
    (study,) = blocks(GUIDE, r"\{code-block\} toml")
    (tmp_path / "dives.toml").write_text(mission)
    (tmp_path / "pitch.toml").write_text(study)
    done = stommel("study", "pitch.toml", "--plots", "pictures")
    assert done.status == 0, done.err
    assert "15 runs flown" in done.out
    rows = [
        line.split()[0] for line in done.out.splitlines() if line.split()[:1] and line.split()[0] in ("25", "35", "45")
    ]
    assert rows == ["25", "35", "45"]
    assert xr.load_dataset(tmp_path / "pitch.nc").mean_power_w.dims == ("pitch_deg", "repeat")
