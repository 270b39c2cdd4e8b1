"""Pictures and page of missions as they come: with drift, without samples, without energy; and what the page holds."""

import base64
import json
import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray as xr

from stommel.control.dive_cycle import PHASES
from stommel.simulation.pictures import (
    actuators_figure,
    ctd_figure,
    energy_figure,
    interactive_page,
    map_figure,
    sawtooth_figure,
    trial_figure,
)
from stommel.simulation.results.dataset import dataset_of, write_netcdf
from tests.simulation.conftest import flown

FIGURES = (actuators_figure, ctd_figure, energy_figure, map_figure, sawtooth_figure, trial_figure)


@pytest.fixture(scope="module")
def drifting() -> xr.Dataset:
    dives = {"depth_m": 60.0, "pitch_deg": 35.0, "speed_m_s": 0.35, "drift_hours": 0.5}
    return dataset_of(flown(dives=dives, duration_days=0.1))


@pytest.fixture(scope="module")
def silent() -> xr.Dataset:
    """No sample, and the time is over before the first surfacing."""
    return dataset_of(flown(sampling={"phases": []}, duration_days=0.002))


def page_data(dataset: xr.Dataset) -> dict[str, Any]:
    found = re.search(r'<script id="data"[^>]*>(.*?)</script>', interactive_page(dataset), re.S)
    assert found is not None
    data: dict[str, Any] = json.loads(found.group(1))
    return data


def numbers(text: str) -> np.ndarray:
    return np.frombuffer(base64.b64decode(text), dtype="<f4")


@pytest.mark.parametrize("draw", FIGURES, ids=lambda draw: draw.__name__)
def test_a_mission_that_drifts_is_drawn(drifting: xr.Dataset, draw: Any) -> None:
    assert PHASES.index("drift") in drifting["phase"].values
    assert len(draw(drifting).axes) >= 1


@pytest.mark.parametrize("draw", FIGURES, ids=lambda draw: draw.__name__)
def test_a_mission_without_samples_or_surfacings_is_drawn(silent: xr.Dataset, draw: Any) -> None:
    assert silent.sizes["sample"] == 0
    assert silent.sizes["surfacing"] == 0
    draw(silent)


def test_drift_is_marked_on_the_path(drifting: xr.Dataset) -> None:
    (path, drift) = sawtooth_figure(drifting).axes[0].get_lines()[:2]
    depth, marked = np.asarray(path.get_ydata(), float), np.asarray(drift.get_ydata(), float)
    hanging = drifting["phase"].values == PHASES.index("drift")
    assert np.array_equal(np.isfinite(marked), hanging)
    assert np.array_equal(marked[hanging], depth[hanging])


def test_sections_show_every_sample(drifting: xr.Dataset) -> None:
    dots = ctd_figure(drifting).axes[0].collections[0]
    assert np.array_equal(dots.get_array(), drifting["sample_temperature"].values)


def test_page_holds_the_samples_at_their_times(drifting: xr.Dataset) -> None:
    data = page_data(drifting)
    (panel,) = (panel for panel in data["panels"] if panel["title"].startswith("Practical salinity"))
    shown, times = numbers(panel["curves"][0]["values"]), numbers(panel["time"])
    assert len(shown) == len(times)
    known = np.isfinite(shown)
    assert np.allclose(shown[known], drifting["sample_practical_salinity"].values, atol=1e-5)
    assert known.sum() < len(shown)  # broken where the CTD was off
    assert np.all(np.diff(times) >= 0.0)
    assert len(data["shades"]) == len(data["phases"])


def test_page_leaves_out_what_there_is_none_of(silent: xr.Dataset) -> None:
    assert not any("CTD" in panel["title"] for panel in page_data(silent)["panels"])


def test_file_without_samples_is_read_by_other_software(silent: xr.Dataset, tmp_path: Path) -> None:
    write_netcdf(silent, tmp_path / "m.nc")
    with xr.open_dataset(tmp_path / "m.nc", engine="netcdf4") as read:
        assert np.array_equal(read["depth"].values, silent["depth"].values)
        assert "sample" not in read.sizes
