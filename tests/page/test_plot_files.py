"""Files of what the plots show. Oracle: the samples that the archive was given, not the page's own points."""

import csv
from pathlib import Path
from typing import Any

import pytest
import xarray as xr

from tests.page.past import Past, values
from tests.page.waiting import at_rest


@pytest.fixture
def window(page: Any, past: Past) -> tuple[float, float]:
    """Plots of some motion in the past; the menu of downloads is open."""
    begin, end = past.begin + 600.0, past.begin + 4200.0
    query = f"show=own&channels=depth_m,pitch_deg&window={begin}-{end}"
    page.goto(f"{past.address}/#/vehicle/1/plots?{query}")
    page.wait_for_selector("[data-panel] canvas")
    at_rest(page)
    page.get_by_role("button", name="Download what is shown").click()
    return begin, end


def downloaded(page: Any, name: str, folder: Path) -> Path:
    """The file behind a link of the open menu."""
    with page.expect_download() as found:
        page.get_by_role("link", name=name, exact=True).click()
    path = folder / found.value.suggested_filename
    found.value.save_as(path)
    return path


def test_every_sample_of_what_is_shown_is_downloaded_as_csv(
    page: Any, window: tuple[float, float], tmp_path: Path, screenshot: Any, serious: Any
) -> None:
    page.get_by_text("What is drawn: 2 channels, 3\u202f602 samples").wait_for()
    assert serious() == []
    screenshot("plots-download")
    path = downloaded(page, "CSV", tmp_path)
    assert path.name == "vehicle-1-telemetry.csv"
    rows = list(csv.DictReader(path.read_text(encoding="utf-8").splitlines()))
    begin, end = window
    wanted = [begin + 2.0 * k for k in range(int((end - begin) / 2.0) + 1)]  # as tests.page.past has filled it
    for key in ("depth_m", "pitch_deg"):
        assert [float(row["value"]) for row in rows if row["channel"] == key] == [values(key, t) for t in wanted]
    assert {row["channel"] for row in rows} == {"depth_m", "pitch_deg"}


def test_all_channels_of_what_is_shown_are_downloaded_as_netcdf(
    page: Any, window: tuple[float, float], tmp_path: Path
) -> None:
    page.get_by_label("All channels of this vehicle").check()
    path = downloaded(page, "CF NetCDF", tmp_path)
    with xr.open_dataset(path, decode_times=False) as found:
        time = found["time"].values.tolist()
        assert (time[0], time[-1]) == window
        assert found["heading_deg"].values.tolist() == [values("heading_deg", t) for t in time]
        assert found["latitude"].values[0] == pytest.approx(values("latitude_deg", time[0]), abs=1e-4)
