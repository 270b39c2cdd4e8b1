"""The track on maps. Oracle: a vehicle that swam north for three days and has been silent for two.

socib/glider_toolbox#2: 0, 0 after a reboot is in the archive, and on no map.
"""

import math
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any, NamedTuple

import httpx
import pytest

from stommel.archive import Archive, Batch, DiveRow
from stommel.archive.schema import mission_history, missions
from tests.page.past import station
from tests.page.waiting import at_rest, becomes, until
from tests.support.ports import port_of_nobody

DAY = 86_400.0
METRES_TO_A_DEGREE = 111_195.0
DIVE = 4 * 3600.0
THIN = "\u202f"
"""That the page writes before units."""
REBOOT = range(1000, 1010)
CANVAS = "document.querySelector('.map canvas').toDataURL()"


class Silent(NamedTuple):
    """Where the station answers, and when the vehicle told its first and its last position."""

    address: str
    begin: float
    end: float


def samples(begin: float, end: float) -> list[tuple[str, float, float]]:
    """A position a minute: at the surface by GPS, under way an estimate that becomes worse; one reboot."""
    found = []
    for k in range(int((end - begin) / 60.0) + 1):
        into = 60.0 * k % DIVE
        latitude, longitude = (0.0, 0.0) if k in REBOOT else (30.0 + 0.3 * 60.0 * k / METRES_TO_A_DEGREE, 123.0)
        t = begin + 60.0 * k
        found += [("latitude_deg", t, latitude), ("longitude_deg", t, longitude), ("fix_age_s", t, into),
                  ("position_sigma_m", t, 8.0 + into / 30.0)]  # fmt: skip
    return found


def switched(archive: Archive, t: float) -> None:
    """The vehicle took a mission at a time."""
    with archive.writing() as connection:
        row = {"vehicle_id": 1, "t_us": int(t * 1e6), "user": "ling", "name": "north", "sha256": "", "orders": "",
               "state": "aboard"}  # fmt: skip
        number = connection.execute(missions.insert().values(row).returning(missions.c.id)).scalar_one()
        told = {"mission_id": number, "t_us": int(t * 1e6), "user": "ling", "state": "aboard"}
        connection.execute(mission_history.insert().values(told))


@pytest.fixture(scope="module")
def silent(built: None, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Silent]:
    folder = tmp_path_factory.mktemp("silent")
    end = 60.0 * math.floor((time.time() - 2.0 * DAY) / 60.0)
    begin = end - 3.0 * DAY
    database = f"sqlite:///{folder / 'archive.sqlite'}"
    with Archive.open(database) as archive:
        archive.know(1, "Donghai", "zju")
        dives = [
            DiveRow(1 + k, begin + k * DIVE, begin + (k + 1) * DIVE, 30.0 + 0.01 * k, 123.0, 30.01 + 0.01 * k, 123.0,
                    200.0, 0.3, 0.4, 1e4)
            for k in range(3)
        ]  # fmt: skip
        archive.store(1, Batch(samples=samples(begin, end), dives=dives))
        switched(archive, begin + DAY)
    with port_of_nobody() as port, station(folder, database, f"tcp:127.0.0.1:{port}") as address:
        yield Silent(address, begin, end)


def minutes(t: float) -> str:
    """A time as the page writes it."""
    return time.strftime("%Y-%m-%d %H:%M", time.gmtime(t))


def bar_m(page: Any) -> float:
    """Metres to a pixel, by the map's scale."""
    number, unit = page.locator(".map .scale").inner_text().split()
    width = page.locator(".map .scale").bounding_box()["width"]
    return float(number) * (1000.0 if unit == "km" else 1.0) / float(width)


@pytest.mark.parametrize("view", ["map", "vehicle/1", "vehicle/1/plan"])
def test_maps_say_over_which_time_the_track_goes(
    page: Any, silent: Silent, view: str, screenshot: Callable[[str], Path]
) -> None:
    """All of it lies back more than two days: it is shown all the same, as much as is wanted."""
    page.goto(f"{silent.address}/#/{view}")

    def words() -> str:
        return str(page.locator(".map .note").inner_text()).replace(THIN, " ")

    spans = page.get_by_role("group", name="Track shown")
    ends = f"to {minutes(silent.end)} UTC"
    becomes(page, words, f"track of {minutes(silent.begin + DAY)} {ends} (2 d 0 h)")
    screenshot(f"track-{view.rpartition('/')[2]}")
    metres = bar_m(page)
    spans.get_by_role("button", name="1 d").click()
    becomes(page, words, f"track of {minutes(silent.end - DAY)} {ends} (24 h 00 min)")
    if view != "vehicle/1/plan":  # it fits itself to the plan
        until(page, lambda: bar_m(page) < 0.7 * metres)
    spans.get_by_role("button", name="All").click()
    left_out = f", {len(REBOOT)} impossible positions left out"
    becomes(page, words, f"track of {minutes(silent.begin)} {ends} (3 d 0 h){left_out}")
    if view != "vehicle/1/plan":
        until(page, lambda: metres < bar_m(page) < 1.8 * metres)  # not as far as 0, 0


REEF = {"type": "Polygon", "coordinates": [[[122.9, 30.0], [123.1, 30.0], [123.1, 30.7], [122.9, 30.7], [122.9, 30.0]]]}


@pytest.mark.parametrize("view", ["vehicle/1/plan", "vehicle/1/data"])
def test_charts_and_currents_are_where_waypoints_are_drawn(
    page: Any, silent: Silent, view: str, screenshot: Callable[[str], Path]
) -> None:
    """Oracle: what the canvas holds with the chart and without it; the legend of currents stands where some are."""
    made = httpx.post(f"{silent.address}/api/layers", json={"name": "Reef", "geojson": REEF}).json()
    page.goto(f"{silent.address}/#/{view}")
    chart = page.get_by_role("button", name="Reef", exact=True)
    page.locator(".map .flow", has_text="current").wait_for()
    chart.wait_for()
    at_rest(page)
    screenshot(f"charts-{view.rpartition('/')[2]}")
    drawn = page.evaluate(CANVAS)
    chart.click()
    until(page, lambda: page.evaluate(CANVAS) != drawn)
    chart.click()
    until(page, lambda: page.evaluate(CANVAS) == drawn)
    httpx.delete(f"{silent.address}/api/layers/{made['id']}")


def test_the_track_and_currents_are_read_off_by_pointer_and_keys(
    page: Any, silent: Silent, screenshot: Callable[[str], Path], serious: Callable[[], list[str]]
) -> None:
    """Oracles: the vehicle lies at the last position, 3 d after the first, at a surfacing; 8 m come to 20 m at 95 %.

    The current of a dive is 0.3 m/s to the north and 0.4 to the east: 0.5 m/s to 053 deg.
    """
    page.goto(f"{silent.address}/#/map")
    page.get_by_role("group", name="Track shown").get_by_role("button", name="All").click()
    page.get_by_text("3\u202fd 0\u202fh").wait_for()
    at_rest(page)
    last = f"{minutes(silent.end)}:00 UTC, {north(3.0 * DAY)} 123°00.000′E, ± 20 m, fix by GPS"
    track = page.get_by_role("slider", name="Track of vehicle 1")
    told = page.locator(".map .told")
    track.focus()
    becomes(page, lambda: plain(told.inner_text()), last)
    assert plain(track.get_attribute("aria-valuetext")) == last
    page.keyboard.press("ArrowLeft")
    until(page, lambda: ", estimate" in told.inner_text())
    page.keyboard.press("Home")
    becomes(page, lambda: plain(told.inner_text()).split(",")[0], f"{minutes(silent.begin)}:00 UTC")
    screenshot("track-read-off")
    page.keyboard.press("Tab")
    becomes(page, lambda: plain(told.inner_text()), "Current of dive 3: 0.50 m/s 053°")
    page.get_by_role("application", name="Map of all vehicles").focus()
    told.wait_for(state="detached")
    box = page.locator(".map .vehicle path").bounding_box()
    page.mouse.move(box["x"] + box["width"] / 2, box["y"] + 12 + 60)
    until(page, lambda: "UTC, 30°" in told.inner_text())
    assert page.get_by_text("ring and ±: it lies within, 95 % sure").is_visible()
    assert page.locator(".map .vehicle text").text_content().startswith("vehicle 1, 2")
    assert serious() == []


def north(t: float) -> str:
    """Latitude after a time, as the page writes it."""
    degrees, rest = divmod(30.0 + 0.3 * t / METRES_TO_A_DEGREE, 1.0)
    return f"{degrees:.0f}°{60.0 * rest:06.3f}′N"


def plain(words: str | None) -> str:
    return (words or "").replace(THIN, " ")
