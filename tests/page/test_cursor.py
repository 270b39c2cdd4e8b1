"""What plots, profiles, sections and T-S diagrams show is read off by keys as by pointer.

Oracles: the closed forms of what the vehicle sent; pyproj's geodesics through the places of its profiles; axe-core.
"""

import calendar
import math
import re
import time
from typing import Any

import httpx
import pytest
from pyproj import Geod

from tests.page.past import STEP, Past, values
from tests.page.waiting import at_rest, becomes, passes, until

READING = re.compile(r"(\S+) °C at ([\d.]+) m, .*profile (\d+)")


def slider(page: Any, name: str) -> Any:
    """What takes the focus on a plot."""
    found = page.get_by_role("slider", name=name, exact=True)
    found.wait_for()
    at_rest(page)
    return found


def said(one: Any) -> str:
    """What is said of where its cursor is."""
    return str(one.get_attribute("aria-valuetext"))


def press(page: Any, *keys: str) -> None:
    for key in keys:
        page.keyboard.press(key)


def plots(page: Any, past: Past, window: str) -> Any:
    """The path among the plots of a window."""
    page.goto(f"{past.address}/#/vehicle/1/plots?show=motion&window={window}")
    page.wait_for_selector("[data-panel=path] canvas")
    return slider(page, "Values of Path")


def time_of(one: Any) -> float:
    """The time at the cursor of a plot; not a number while there is none."""
    found = re.match(r"(\S+ \S+) UTC: ", said(one))
    return calendar.timegm(time.strptime(found[1], "%Y-%m-%d %H:%M:%S")) if found else math.nan


def number_of(page: Any, panel: str, name: str) -> float:
    """What stands beside a panel."""
    found = page.get_by_role("region", name=panel, exact=True).get_by_role("button", name=name)
    return float(re.sub(r"[^\d.-]", "", found.locator("output").inner_text().replace("\u2212", "-")) or "nan")


def window(page: Any) -> tuple[float, float]:
    """What the path shows."""
    begin, end = page.evaluate("(({drawn}) => [drawn.begin, drawn.end])(document.querySelector('[data-panel=path]'))")
    return begin, end


def test_plots_are_read_sample_by_sample_and_all_panels_follow(
    page: Any, past: Past, serious: Any, screenshot: Any
) -> None:
    begin, end = past.begin + 600.0, past.begin + 1200.0
    path = plots(page, past, f"{begin}-{end}")
    path.focus()
    becomes(page, lambda: time_of(path), end)  # the newest in the window
    press(page, "ArrowLeft", "ArrowLeft", "ArrowLeft", "ArrowRight")
    t = end - 2.0 * STEP
    becomes(page, lambda: time_of(path), t)
    assert f"depth {values('depth_m', t):.1f}" in said(path)
    becomes(page, lambda: number_of(page, "Path", "depth"), pytest.approx(values("depth_m", t), abs=0.051))
    becomes(page, lambda: number_of(page, "Attitude", "pitch"), pytest.approx(values("pitch_deg", t), abs=0.051))
    places = page.locator(".u-cursor-x").evaluate_all("all => all.map((one) => one.getBoundingClientRect().x)")
    area = page.locator("[data-panel=path] .u-over").bounding_box()
    assert places == pytest.approx(4 * [area["x"] + area["width"] * (t - begin) / (end - begin)], abs=1.5)
    screenshot("cursor-plots")
    assert serious() == []
    press(page, "Shift+ArrowLeft")
    becomes(page, lambda: time_of(path), t - 15.0 * STEP)  # a twentieth of 301 samples
    press(page, "PageUp", "Home")
    becomes(page, lambda: time_of(path), begin)
    press(page, "Escape")
    until(page, lambda: math.isnan(time_of(path)))
    assert not path.evaluate("one => one === document.activeElement")


def test_the_window_goes_on_under_the_cursor_and_is_zoomed_about_it(page: Any, past: Past) -> None:
    begin, end = past.begin + 600.0, past.begin + 1200.0
    path = plots(page, past, f"{begin}-{end}")
    path.focus()
    press(page, "Home", "ArrowLeft")
    until(page, lambda: window(page) == (begin - 450.0, end - 450.0))
    at_rest(page)
    assert time_of(path) == begin
    press(page, "ArrowLeft")
    becomes(page, lambda: time_of(path), begin - STEP)
    press(page, "+")
    share = (begin - STEP - (begin - 450.0)) / 600.0
    until(page, lambda: window(page)[1] - window(page)[0] == pytest.approx(420.0))
    assert begin - STEP - window(page)[0] == pytest.approx(share * 420.0, abs=1.0)
    assert time_of(path) == begin - STEP


def test_a_plot_that_follows_leaves_the_cursor_to_the_keys(page: Any, past: Past) -> None:
    """A pointer that rests on the plot takes it back when it moves, and not before."""
    path = plots(page, past, "live-86400")
    box = page.locator("[data-panel=path] .u-over").bounding_box()
    middle = box["y"] + box["height"] / 2.0
    page.mouse.move(box["x"] + 0.9 * box["width"], middle)
    until(page, lambda: not math.isnan(time_of(path)))
    path.focus()
    press(page, "Home")
    until(page, lambda: time_of(path) <= past.begin + 60.0)
    first, shown = time_of(path), window(page)
    until(page, lambda: window(page)[0] > shown[0] + 0.5)
    assert time_of(path) == first
    page.mouse.move(box["x"] + 0.95 * box["width"], middle)
    until(page, lambda: time_of(path) > past.begin + 3600.0)


def data(page: Any, past: Past, show: str) -> None:
    page.goto(f"{past.address}/#/vehicle/1/data?show={show}")
    page.locator(".sheet canvas").first.wait_for()


def reading(one: Any) -> tuple[float, float, int]:
    """Temperature, depth and profile at the cursor."""
    return numbers(said(one))


def numbers(words: str) -> tuple[float, float, int]:
    found = READING.search(words)
    assert found, words
    return float(found[1].rpartition(" ")[2]), float(found[2]), int(found[3])


def warm(depth: float) -> Any:
    """Temperature of the water; depth and pressure of the samples differ a little."""
    return pytest.approx(24.0 - 14.0 / (1.0 + math.exp(-(depth - 45.0) / 12.0)), abs=0.4)


def at_the_ring(page: Any, sheet: Any) -> None:
    """Leave the keys, and put the pointer where the cursor was."""
    box = sheet.locator("circle:not(.rim)").bounding_box()
    press(page, "Escape")
    sheet.locator("circle").first.wait_for(state="detached")
    page.mouse.move(box["x"] + box["width"] / 2.0, box["y"] + box["height"] / 2.0)


def test_profiles_are_read_along_the_depth_and_from_one_to_another(
    page: Any, past: Past, serious: Any, screenshot: Any
) -> None:
    data(page, past, "profiles")
    page.locator("tbody tr").nth(1).click()
    page.get_by_role("button", name="In-situ temperature").click()
    one = slider(page, "In-situ temperature over depth")
    one.focus()
    until(page, lambda: READING.search(said(one)))
    value, top, newest = reading(one)
    assert (value, top < 5.0) == (warm(top), True)
    press(page, "PageDown", "PageDown", "PageDown", "ArrowDown")
    until(page, lambda: reading(one)[1] > 10.0)
    value, depth, profile = reading(one)
    assert (value, profile) == (warm(depth), newest)
    press(page, "ArrowUp")
    until(page, lambda: top < reading(one)[1] < depth)
    press(page, "ArrowLeft")
    until(page, lambda: reading(one)[2] == newest - 1)
    assert reading(one)[1] == pytest.approx(depth, abs=3.0)
    assert page.locator("figure circle:not(.rim)").count() == 4  # on all sheets
    screenshot("cursor-profiles")
    assert serious() == []
    words = said(one)
    output = page.locator(".profiles output")
    assert output.inner_text() == words
    at_the_ring(page, page.locator("figure .sheet").last)
    until(page, lambda: READING.search(output.inner_text()))
    value, below, _ = numbers(output.inner_text())  # of either profile: their lines lie on each other
    assert (value, below) == (warm(below), pytest.approx(numbers(words)[1], abs=3.0))


def test_a_section_is_read_cell_by_cell_over_time_and_distance(
    page: Any, past: Past, serious: Any, screenshot: Any
) -> None:
    data(page, past, "section")
    page.get_by_label("Variable").select_option("temperature")
    slider(page, "In-situ temperature over depth and time")
    page.get_by_label("Across").select_option(label="distance along the track")
    one = slider(page, "In-situ temperature over depth and distance")
    one.focus()
    until(page, lambda: READING.search(said(one)))
    newest = reading(one)[2]
    press(page, "PageDown", "PageDown", "PageDown", "ArrowDown", "ArrowUp", "ArrowLeft")
    until(page, lambda: reading(one)[2] == newest - 1)
    value, depth, _ = reading(one)
    assert (value, depth > 20.0) == (warm(depth), True)
    answer = httpx.get(f"{past.address}/api/vehicles/1/section", params={"variable": "temperature"}).json()
    places = [(row["longitude"], row["latitude"]) for row in answer["profiles"]][:-1]
    km = float(re.search(r"([\d.]+) km along the track", said(one)).group(1))  # type: ignore[union-attr]
    assert km == pytest.approx(Geod(ellps="WGS84").line_length(*zip(*places, strict=True)) / 1e3, abs=0.06)
    screenshot("cursor-section")
    assert serious() == []
    words, output = said(one), page.locator(".section output")
    assert output.inner_text() == words
    at_the_ring(page, page.locator(".sheet"))
    becomes(page, output.inner_text, words)
    one.focus()
    press(page, "Home", "Enter")
    until(page, lambda: page.locator("tbody tr", has_text="shown").count())
    assert page.locator("tbody tr", has_text="shown").first.inner_text().split()[0] == "1"


def test_a_section_tells_what_was_left_out(page: Any, past: Past) -> None:
    def thinned(route: Any) -> None:
        answer = route.fetch()
        route.fulfill(response=answer, json={**answer.json(), "stride": 4})

    page.route("**/section?*", thinned)
    data(page, past, "section")
    at_rest(page)
    words = page.locator(".section output").inner_text()
    assert re.fullmatch(r"\d+ profiles, every 4th shown; each cell the mean of 1 to \d+ samples", words)


@pytest.mark.parametrize("page", [{"color_scheme": "dark"}], indirect=True)
def test_a_ts_diagram_is_read_along_the_samples_of_a_profile(
    page: Any, past: Past, serious: Any, screenshot: Any
) -> None:
    data(page, past, "ts")
    one = slider(page, "Conservative temperature against absolute salinity")
    one.focus()
    until(page, lambda: READING.search(said(one)))
    _, top, newest = reading(one)
    press(page, "PageDown", "PageDown", "PageDown", "PageDown", "ArrowDown", "ArrowLeft")
    until(page, lambda: reading(one)[2] == newest - 1)
    value, depth, _ = reading(one)
    assert (value, depth > top + 10.0) == (warm(depth), True)  # conservative is within 0.1 of in-situ temperature
    screenshot("cursor-ts-dark")
    assert serious() == []
    words, output = said(one), page.locator(".diagram output")
    assert output.inner_text() == words
    press(page, "Enter")
    page.get_by_role("button", name=f"Profile {newest - 1} only: show all").wait_for()
    at_the_ring(page, page.locator(".sheet"))
    passes(page, 100)
    until(page, lambda: output.inner_text().startswith(words.split(",")[0]))


def test_the_help_names_the_keys(page: Any, past: Past, screenshot: Any) -> None:
    page.goto(f"{past.address}/#/vehicle/1/plots")
    at_rest(page)
    press(page, "?")
    page.get_by_role("heading", name="In plots and data").wait_for()
    screenshot("help")
