"""Pictures and page of missions as they come: with drift, without samples, without energy; and what the page holds."""

import base64
import json
import re
import subprocess
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
from stommel.simulation.pictures.extracts import band
from stommel.simulation.results.dataset import dataset_of, write_netcdf
from stommel.simulation.results.summary import summary
from tests.simulation.conftest import flown
from tests.support.chromium import chromium

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
    panels = draw(drifting).axes
    assert panels
    assert all(axes.has_data() for axes in panels)
    drawn = [np.asarray(line.get_ydata(), dtype=float) for axes in panels for line in axes.lines]
    places = [np.asarray(group.get_offsets(), dtype=float) for axes in panels for group in axes.collections]
    assert any(np.isfinite(values).sum() > 10 and np.nanmax(values) > np.nanmin(values) for values in drawn + places)


@pytest.mark.parametrize("draw", FIGURES, ids=lambda draw: draw.__name__)
def test_a_mission_without_samples_or_surfacings_is_drawn(silent: xr.Dataset, draw: Any) -> None:
    assert silent.sizes["sample"] == 0
    assert silent.sizes["surfacing"] == 0
    draw(silent)


@pytest.fixture(scope="module")
def cornered() -> xr.Dataset:
    """Two waypoints reached across the date line, a third 7 km farther."""
    ocean = {"name": "uniform", "parameters": {"current_east_m_s": 0.0}}
    places = [(-17.0, -179.99), (-16.99, -179.985), (-17.05, -179.97)]
    return dataset_of(
        flown(
            ocean=ocean,
            start={"latitude_deg": -17.0, "longitude_deg": 179.998},
            waypoints=[{"latitude_deg": a, "longitude_deg": b} for a, b in places],
            guidance={"acceptance_radius_m": 200.0},
        )
    )


def line(axes: Any, label: str) -> tuple[np.ndarray, np.ndarray]:
    (found,) = (one for one in axes.get_lines() if one.get_label() == label)
    return np.asarray(found.get_xdata(), float), np.asarray(found.get_ydata(), float)


def test_map_draws_track_plan_and_radius_across_the_date_line(cornered: xr.Dataset) -> None:
    axes = map_figure(cornered).axes[0]
    assert cornered["waypoint_reached"].values.tolist() == [1, 1, 0]
    east, north = line(axes, "way over ground")
    assert np.array_equal(north, cornered["latitude"].values)
    assert np.ptp(east) < 0.1  # no jump of 360 deg
    assert np.allclose((east - cornered["longitude"].values + 180.0) % 360.0, 180.0)
    east, north = line(axes, "planned legs")
    assert north.tolist() == [-17.0, -17.0, -16.99, -17.05]
    assert east % 360.0 == pytest.approx([179.998, 180.01, 180.015, 180.03])
    for label, state in (("start", 0), ("end", -1)):
        east, north = line(axes, label)
        assert north[0] == cornered["latitude"].values[state]
        assert east[0] % 360.0 == pytest.approx(cornered["longitude"].values[state] % 360.0)
    circles = [one for one in axes.get_lines() if len(one.get_xdata()) == 73]
    assert len(circles) == 3
    for circle, (latitude, longitude) in zip(
        circles, [(-17.0, 180.01), (-16.99, 180.015), (-17.05, 180.03)], strict=True
    ):
        x, y = (np.asarray(values, float) for values in circle.get_data())
        away = np.hypot((x % 360.0 - longitude) * 106.4526e3, (y - latitude) * 110.6633e3)  # a degree at 17 S, WGS 84
        assert away == pytest.approx(np.full(73, 200.0), rel=1e-3)


def test_map_hugs_the_track_and_points_at_what_is_far(cornered: xr.Dataset) -> None:
    axes = map_figure(cornered).axes[0]
    south, north = axes.get_ylim()
    shown = cornered["latitude"].values
    assert south <= shown.min()
    assert north >= shown.max()
    assert south > -17.05  # not as far as the waypoint that lies 7 km away
    assert (north - south) < 3.0 * np.ptp(shown)
    km = float(cornered["waypoint_distance"][2]) / 1e3
    assert f"to waypoint 3, {km:.1f} km" in [text.get_text() for text in axes.texts]
    assert [text.get_text() for text in axes.texts if text.get_text().isdigit()] == ["1", "2"]


def test_map_draws_the_currents_that_were_found(cornered: xr.Dataset) -> None:
    axes = map_figure(cornered).axes[0]
    (found,) = (one for one in axes.collections if one.get_gid() == "found")
    every = -(-cornered.sizes["surfacing"] // 16)
    assert np.array_equal(found.U, cornered["depth_averaged_current_east"].values[::every])
    assert np.array_equal(found.V, cornered["depth_averaged_current_north"].values[::every])
    (true,) = (one for one in axes.collections if one.get_gid() == "true mean")
    assert np.array_equal(true.U, cornered["true_current_east"].values[::every])


def test_degrees_are_marked_by_their_side(cornered: xr.Dataset) -> None:
    axes = map_figure(cornered).axes[0]
    east, north = axes.xaxis.get_major_formatter(), axes.yaxis.get_major_formatter()
    assert [east(x, 0)[-2:] for x in (179.5, 180.5, -179.5)] == ["°E", "°W", "°W"]
    assert float(east(180.5, 0)[:-2]) == 179.5
    assert north(-17.0, 0).startswith("17.0")
    assert north(-17.0, 0).endswith("°S")
    assert north(0.0, 0).endswith("°")


def test_energy_and_summary_agree_on_every_part_and_the_total(cornered: xr.Dataset) -> None:
    result = flown(duration_days=0.1)
    spent = summary(result)["energy_wh"]
    assert spent["self_discharge"] > 0.0
    axes = energy_figure(dataset_of(result)).axes[0]
    assert f"{sum(spent.values()):.2f} Wh in all" in axes.get_title(loc="left")
    below = 0.0
    for area in axes.collections:
        name = str(area.get_label()).split(",")[0].replace(" ", "_")
        top = max(y for x, y in area.get_paths()[0].vertices if x == area.get_paths()[0].vertices[:, 0].max())
        assert top - below == pytest.approx(spent[name], abs=1e-6 * sum(spent.values()) + 1e-9)
        below = top
    assert below == pytest.approx(sum(spent.values()))


def test_voltage_of_many_dives_is_a_band_that_holds_every_value(drifting: xr.Dataset) -> None:
    time = np.linspace(0.0, 1e5, 20_001)
    curve = 25.0 - 1e-5 * time + 0.2 * np.sin(2.0 * np.pi * time / 500.0)  # 200 dives
    middle, low, high = band(time, curve, 200)
    assert len(middle) == 100
    assert low == pytest.approx(25.0 - 1e-5 * middle - 0.2, abs=6e-3)  # smooth: no stripes
    assert high == pytest.approx(25.0 - 1e-5 * middle + 0.2, abs=6e-3)


def test_times_are_dates_in_utc(drifting: xr.Dataset) -> None:
    from matplotlib.dates import num2date

    axes = sawtooth_figure(drifting).axes[0]
    first, last = (num2date(x) for x in axes.get_xlim())
    assert str(first.replace(tzinfo=None, microsecond=0)) == "2026-07-01 00:00:00"
    span = drifting["time"].values[-1] - drifting["time"].values[0]
    assert (last - first).total_seconds() == pytest.approx(float(span / np.timedelta64(1, "s")), abs=1e-3)
    assert axes.get_xlabel().startswith("UTC, 2026-07-01 00:00 to 2026-07-01 0")


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


def test_page_opens_on_the_whole_mission(cornered: xr.Dataset) -> None:
    data, html = page_data(cornered), interactive_page(cornered)
    assert "let view = [0, last]" in html
    assert f'<p id="verdict">{cornered.attrs["verdict"]}</p>' in html
    titles = [panel["title"] for panel in data["panels"]]
    assert titles[:3] == ["Depth", "Energy from the battery", "Distance to the waypoint"]
    energy = data["panels"][1]["curves"]
    assert energy[0]["name"] == "in all"
    parts = sum(numbers(curve["values"])[-1] for curve in energy[1:])
    assert numbers(energy[0]["values"])[-1] == pytest.approx(parts, rel=1e-5)
    begins = (cornered["event_time"].values - cornered["time"].values[0]) / np.timedelta64(1, "s")
    descents = cornered["event_phase"].values == PHASES.index("descent")
    plain = cornered["event_reason"].values == 0
    assert numbers(data["dives"]) == pytest.approx(begins[descents & plain])


def test_page_tells_of_every_waypoint(cornered: xr.Dataset) -> None:
    data, html = page_data(cornered), interactive_page(cornered)
    assert data["waypoints"]["reached"] == [1, 1, 0]
    assert data["radius"] == pytest.approx(0.2)
    # a degree of longitude and latitude at 17 S, WGS 84 [km], from 179.998 E
    assert numbers(data["waypoints"]["east"]) == pytest.approx(106.4526 * np.array([0.012, 0.017, 0.032]), rel=2e-3)
    assert numbers(data["waypoints"]["north"])[1:] == pytest.approx(110.6633 * np.array([0.01, -0.05]), rel=2e-3)
    names = ("waypoint_reached_after", "waypoint_closest_approach", "waypoint_distance")
    columns = zip(*(cornered[name].values for name in names), strict=True)
    for number, (after, nearest, away) in enumerate(columns, 1):
        when, to_go = "no", f"{away / 1e3:.1f} km"
        if np.isfinite(after):
            moment = cornered["time"].values[0] + np.timedelta64(round(after), "s")
            when, to_go = str(moment)[:16].replace("T", " "), "–"
        near = f"{nearest:.0f} m" if nearest < 3000.0 else f"{nearest / 1e3:.1f} km"
        assert f"<td>{number}</td><td>{when}</td><td>{near}</td><td>{to_go}</td>" in html


def test_page_tells_the_outcome_in_numbers() -> None:
    result = flown(duration_days=0.1)
    row, html = summary(result), interactive_page(dataset_of(result))
    used = sum(row["energy_wh"].values())
    assert f"<td>{used:.2f} of {row['battery_wh']:.1f} Wh used, {row['battery_left_share']:.0%} left</td>" in html
    assert f"<td>{row['dives']}, deepest {row['deepest_m']:.1f} m</td>" in html
    over, made = (row[f"distance_{way}_km"] for way in ("over_ground", "made_good"))
    assert f"<td>{1e3 * over:.0f} m over ground, {1e3 * made:.0f} m made good</td>" in html
    assert "<td>2026-07-01 00:00 to 2026-07-01 02:23, 144 minutes</td>" in html


def test_what_is_far_is_told_from_the_end_not_from_the_nearest_approach(cornered: xr.Dataset) -> None:
    changed = cornered.assign(waypoint_closest_approach=cornered["waypoint_closest_approach"] - 150.0)
    html = interactive_page(changed)
    nearest, away = (float(changed[name][2]) / 1e3 for name in ("waypoint_closest_approach", "waypoint_distance"))
    assert f"<td>{nearest:.1f} km</td><td>{away:.1f} km</td>" in html


@pytest.mark.skipif(chromium() is None, reason="needs Chromium")
def test_page_draws_itself_in_a_browser(cornered: xr.Dataset, tmp_path: Path) -> None:
    """The script runs to its end: curves, map and the phases' names are made by it."""
    page = tmp_path / "mission.html"
    page.write_text(interactive_page(cornered), encoding="utf-8")
    done = subprocess.run(
        [chromium(), "--headless", "--no-sandbox", "--disable-gpu", f"--user-data-dir={tmp_path / 'profile'}",
         "--virtual-time-budget=2000", "--dump-dom", page.as_uri()],
        capture_output=True, text=True, check=True, timeout=120,
    )  # fmt: skip
    assert done.stdout.count("<canvas") == len(page_data(cornered)["panels"]) + 1
    assert '<span id="unit">km</span>' in done.stdout
    assert re.search(r'<p id="bands" hidden="">', done.stdout)  # a few dives are curves
    assert re.search(r'<canvas id="map"[^>]*width="[1-9]', done.stdout)  # drawn to its size
    assert "descent" in done.stdout.split('id="phases"')[1].split("</p>")[0]


def test_page_leaves_out_what_there_is_none_of(silent: xr.Dataset) -> None:
    assert not any("CTD" in panel["title"] for panel in page_data(silent)["panels"])


def test_file_without_samples_is_read_by_other_software(silent: xr.Dataset, tmp_path: Path) -> None:
    write_netcdf(silent, tmp_path / "m.nc")
    with xr.open_dataset(tmp_path / "m.nc", engine="netcdf4") as read:
        assert np.array_equal(read["depth"].values, silent["depth"].values)
        assert "sample" not in read.sizes
