"""Dives, profiles, sections, T-S diagram and downloads, against an archive whose water is known in closed form."""

import csv
import io
import math
import re
from pathlib import Path
from typing import Any

import gsw
import pytest
import xarray as xr
from pyproj import Geod

from tests.page.past import DIVE, EARTH_M, Past, values
from tests.page.waiting import at_rest, comes_to_rest, until


def opened(page: Any, past: Past, show: str) -> Any:
    """The view of the data."""
    page.goto(f"{past.address}/#/vehicle/1/data?show={show}")
    return page


def whole_dives(past: Past) -> int:
    """Dives that were flown whole."""
    return int(past.end / DIVE) - math.ceil(past.begin / DIVE)


def test_dives_stand_in_the_table_and_on_the_map(page: Any, past: Past, screenshot: Any) -> None:
    from playwright.sync_api import expect

    opened(page, past, "dives").wait_for_selector("tbody tr td.number")
    rows = page.locator("tbody tr")
    expect(rows).to_have_count(whole_dives(past))
    first = rows.first.inner_text()
    assert "200" in first  # deepest
    north = values("latitude_deg", DIVE * (past.end // DIVE - 1.0))
    north_end = north + 0.25 * DIVE / EARTH_M
    assert f"{Geod(ellps='WGS84').inv(123.0, north, 123.0, north_end)[2]:.0f}\u202fm" in first
    assert f"30°{60.0 * (north - 30.0):06.3f}′N 123°00.000′E" in first
    assert f"30°{60.0 * (north_end - 30.0):06.3f}′N 123°00.000′E" in first
    assert "0.22" in first
    assert "063°" in first  # current: hypot(0.1, 0.2) towards atan2(0.2, 0.1)
    rows.first.click()
    window = page.locator("footer").get_by_role("link", name="Plots").get_attribute("href")
    begin, end = map(float, re.findall(r"window=([\d.]+)-([\d.]+)", window)[0])
    assert (begin % DIVE, end - begin) == (0.0, DIVE)
    at_rest(page)
    screenshot("data-dives")


def test_profiles_are_shown_over_depth_with_values_at_the_pointer(page: Any, past: Past, screenshot: Any) -> None:
    from playwright.sync_api import expect

    opened(page, past, "profiles").wait_for_selector("figure canvas")
    rows = page.locator("tbody tr")
    assert rows.count() == pytest.approx(2 * whole_dives(past), abs=2)
    rows.nth(1).click()
    page.get_by_role("button", name="In-situ temperature").click()
    expect(page.locator("figure .sheet")).to_have_count(4)
    at_rest(page)
    box = comes_to_rest(page, page.locator("figure .sheet").first.bounding_box)
    page.mouse.move(box["x"] + box["width"] / 2, box["y"] + 0.4 * box["height"])
    expect(page.locator("figure").last.locator("figcaption span")).to_have_count(2)
    said = page.locator(".profiles output").inner_text()
    depth = float(re.search(r" at ([\d.]+) m, ", said).group(1))  # type: ignore[union-attr]
    warm = 24.0 - 14.0 / (1.0 + math.exp(-(depth - 45.0) / 12.0))
    for text in page.locator("figure").last.locator("figcaption span").all_inner_texts():
        assert float(text) == pytest.approx(warm, abs=1.5), "the nearest sample is within 5 m"
    screenshot("data-profiles")


@pytest.mark.parametrize("page", [{"color_scheme": "dark"}], indirect=True)
def test_a_section_tells_the_value_under_the_pointer(page: Any, past: Past, screenshot: Any) -> None:
    opened(page, past, "section").wait_for_selector(".sheet canvas")
    page.get_by_label("Variable").select_option("temperature")
    page.get_by_label("In-situ temperature over depth").wait_for()
    at_rest(page)
    box = comes_to_rest(page, page.locator(".sheet").bounding_box)
    page.mouse.move(box["x"] + 0.8 * box["width"], box["y"] + 0.6 * box["height"])
    output, form = page.locator(".section output"), re.compile(r"([\d.]+) °C at ([\d.]+) m")
    until(page, lambda: form.match(output.inner_text()))
    value, depth = (float(found) for found in form.match(output.inner_text()).groups())  # type: ignore[union-attr]
    warm = 24.0 - 14.0 / (1.0 + math.exp(-(depth - 45.0) / 12.0))
    assert value == pytest.approx(warm, abs=0.8)
    screenshot("data-section-dark")
    page.mouse.click(box["x"] + 0.8 * box["width"], box["y"] + 0.6 * box["height"])
    page.wait_for_selector("figure canvas")


def test_a_ts_diagram_has_samples_and_lines_of_equal_density(page: Any, past: Past, screenshot: Any) -> None:
    with page.expect_response("**/ts?*") as answered:
        opened(page, past, "ts").wait_for_selector(".sheet canvas")
    answer = answered.value.json()
    assert answer["samples"] > 1000
    for line in answer["lines"]:
        salinity, temperature = line["absolute_salinity"][0], line["conservative_temperature"][0]
        assert gsw.sigma0(salinity, temperature) == pytest.approx(line["level"], abs=0.01)  # TEOS-10
    at_rest(page)
    screenshot("data-ts")


@pytest.mark.parametrize(("words", "ending"), [("CSV", "csv"), ("CF NetCDF", "nc")])
def test_what_is_downloaded_is_what_was_sampled(page: Any, past: Past, tmp_path: Path, words: str, ending: str) -> None:
    opened(page, past, "dives").wait_for_selector("tbody tr td.number")
    with page.expect_download() as started:
        page.get_by_role("link", name=words).click()
    file = tmp_path / f"download.{ending}"
    started.value.save_as(file)
    assert started.value.suggested_filename.endswith(ending)
    samples = whole_dives(past) * 360
    if ending == "nc":
        with xr.open_dataset(file) as found:
            assert found.attrs["Conventions"].startswith("CF-1")
            warm, depth = found["temperature"].values.tolist(), found["depth"].values.tolist()
    else:
        text = [line for line in file.read_text().splitlines() if not line.startswith("#")]
        rows = list(csv.DictReader(io.StringIO("\n".join(text))))
        named = {name.split(" ")[0].split("[")[0]: name for name in rows[0]}
        warm = [float(row[named["temperature"]]) for row in rows]
        depth = [float(row[named["depth"]]) for row in rows]
    assert len(warm) == samples
    for value, at in zip(warm, depth, strict=True):
        assert value == pytest.approx(24.0 - 14.0 / (1.0 + math.exp(-(at - 45.0) / 12.0)), abs=0.2)


def test_a_stretch_of_time_bounds_everything(page: Any, past: Past) -> None:
    opened(page, past, "dives").wait_for_selector("tbody tr td.number")
    page.get_by_role("button", name="all that was sampled").click()
    first = math.ceil(past.begin / DIVE) * DIVE
    at_rest(page)
    with page.expect_response("**/dives?*") as answered:
        page.get_by_label("To, UTC").fill(page.get_by_label("From, UTC").input_value())
        page.get_by_label("To, UTC").press("Tab")
    assert [dive["t_begin"] for dive in answered.value.json()] == [first]
    page.get_by_label("To, UTC").fill("yesterday")
    page.get_by_label("To, UTC").press("Tab")
    wrong = page.get_by_label("To, UTC")
    until(page, lambda: wrong.evaluate("one => one.validationMessage").startswith("A time is written as"))


@pytest.mark.parametrize("show", ["dives", "profiles", "section", "ts"])
def test_nobody_is_kept_from_the_data(page: Any, past: Past, serious: Any, show: str) -> None:
    """axe-core: no serious finding."""
    opened(page, past, show).locator("td.number, .sheet canvas").first.wait_for()
    at_rest(page)
    assert serious() == []
