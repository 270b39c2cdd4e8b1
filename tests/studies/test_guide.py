"""The example of the guide runs as it is printed."""

import os
import re
import shlex
import subprocess
import sys
from pathlib import Path

import xarray as xr

from tests.studies.conftest import start

GUIDE = (Path(__file__).parents[2] / "docs" / "guide" / "studies.md").read_text(encoding="utf-8")


def test_example(tmp_path: Path) -> None:
    mission, study = re.findall(r"```toml\n(.*?)```", GUIDE, re.S)
    (tmp_path / "dives.toml").write_text(mission)
    (tmp_path / "drift.toml").write_text(study)
    (command,) = re.findall(r"```console\n(.*?)```", GUIDE, re.S)
    program, verb, *arguments = shlex.split(command)
    assert (program, verb) == ("stommel", "study")
    process = start(tmp_path, *arguments)
    out, err = process.communicate(timeout=300)
    assert process.returncode == 0, err
    assert "16 runs flown" in out
    result = xr.load_dataset(tmp_path / "drift.nc")
    assert set(result.failure.values) == {""}
    coefficients = result.regression_coefficient.sel(output="distance_made_good_km")
    # the current carries the vehicle; the compass is a detail
    assert abs(coefficients.sel(parameter="current_north_m_s")) > abs(coefficients.sel(parameter="heading_noise_deg"))
    (script,) = re.findall(r"```python\n(.*?)```", GUIDE, re.S)
    done = subprocess.run(
        [sys.executable, "-c", script], cwd=tmp_path, env=os.environ, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stderr
    assert done.stdout.splitlines()[0].endswith(" km")
