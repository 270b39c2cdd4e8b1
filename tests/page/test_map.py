"""The sea map by pointer, wheel and keys, on made-up values."""

import math
from collections.abc import Callable
from functools import partial
from typing import Any

import pytest

from tests.page.waiting import all_asked, at_rest, becomes, passes, until

BAR = ".map .scale"


@pytest.fixture
def sea(page: Any, fake_station: str) -> Any:
    """The map view, drawn with the mission of the vehicle, to which it fits itself."""
    page.goto(f"{fake_station}/#/map")
    page.locator(".map .vehicle").wait_for()
    page.locator(".map .waypoint").nth(2).wait_for()
    return page


def place(page: Any, number: int = 2) -> tuple[float, float]:
    """Where the middle of a waypoint's mark stands, pixels; the glider would fly on while the test looks."""
    box = page.locator(".map .waypoint .face").nth(number - 1).bounding_box()
    return box["x"] + box["width"] / 2, box["y"] + box["height"] / 2


def beside(at: tuple[float, float], x: float = 0.0, y: float = 0.0) -> tuple[object, object]:
    """So many pixels from there; marks are drawn to a tenth of a pixel."""
    return pytest.approx(at[0] + x, abs=0.5), pytest.approx(at[1] + y, abs=0.5)


def apart(page: Any) -> float:
    """Pixels between the first two waypoints, which tell how near the map is."""
    return math.dist(place(page, 1), place(page, 2))


def test_keys_move_and_zoom_the_map(sea: Any) -> None:
    sea.get_by_role("application", name="Map of all vehicles").focus()
    before, far, bar = place(sea), apart(sea), sea.locator(BAR).inner_text()
    for presses in (1, 2, 3):
        sea.keyboard.press("ArrowLeft")
        becomes(sea, lambda: place(sea), beside(before, x=60.0 * presses))
    for presses in (1, 2, 3, 4):
        sea.keyboard.press("+")
        becomes(sea, lambda: apart(sea) / far, pytest.approx(1.5**presses, rel=0.01))
    until(sea, lambda: sea.locator(BAR).inner_text() != bar)
    sea.keyboard.press("0")
    becomes(sea, lambda: place(sea), beside(before))
    becomes(sea, lambda: sea.locator(BAR).inner_text(), bar)


def test_the_place_below_the_wheel_stays(sea: Any) -> None:
    before, far = place(sea), apart(sea)
    sea.mouse.move(*before)
    for turns in (1, 2, 3):
        sea.mouse.wheel(0, -200)
        becomes(sea, lambda: apart(sea) / far, pytest.approx(math.exp(0.5 * turns), rel=0.01))
    off = math.exp(1.5) - 1.0  # the pointer stands on a whole pixel, at most one beside, which is so much more now
    becomes(sea, lambda: place(sea), (pytest.approx(before[0], abs=off), pytest.approx(before[1], abs=off)))


def test_dragging_moves_the_map_with_the_pointer(sea: Any) -> None:
    before = place(sea)
    sea.mouse.move(300, 600)
    sea.mouse.down()
    sea.mouse.move(340, 560, steps=4)
    sea.mouse.move(420, 640, steps=4)
    sea.mouse.up()
    becomes(sea, lambda: place(sea), beside(before, x=120.0, y=40.0))


def test_enter_on_a_vehicle_opens_it(sea: Any) -> None:
    sea.locator(".map .vehicle").focus()
    sea.keyboard.press("Enter")
    sea.wait_for_function("location.hash === '#/vehicle/1'")


def test_missions_and_geofences_of_several_vehicles_are_told_apart(
    page: Any, fake_station: str, screenshot: Callable[[str], Any]
) -> None:
    """Oracle: two missions of two waypoints and a fence each, made up here; each has its letter and its colour."""
    for vehicle, west in ((1, 126.1), (2, 126.6)):
        corners = [(30.5, west), (30.5, west + 0.4), (30.9, west + 0.4), (30.8, west)]
        told = {
            "name": "square",
            "waypoints": [{"latitude": 30.6 + 0.1 * k, "longitude": west + 0.2, "radius_m": 500.0} for k in (0, 1)],
            "geofence": [{"latitude": latitude, "longitude": longitude} for latitude, longitude in corners],
        }
        page.route(f"**/api/vehicles/{vehicle}/mission*", answering(told))
    page.goto(f"{fake_station}/#/map")
    page.locator(".map .waypoint").nth(3).wait_for()
    page.locator(".map .area").nth(1).wait_for()
    at_rest(page)
    screenshot("map-of-two-missions")
    assert page.locator(".map .waypoint text").all_text_contents() == ["A1", "A2", "B1", "B2"]
    assert page.locator(".map .area").all_text_contents() == ["geofence of ZJU glider", "geofence of Sea-Wing 12"]
    assert page.locator(".map .vehicle text").text_content() == "A ZJU glider"
    strokes = page.locator(".map .waypoint .face").evaluate_all("all => all.map((one) => getComputedStyle(one).stroke)")
    assert strokes[0] == strokes[1]
    assert strokes[2] == strokes[3]
    assert strokes[0] != strokes[2]
    fills = page.locator(".map .area").evaluate_all("all => all.map((one) => getComputedStyle(one).fill)")
    assert fills == [strokes[0], strokes[2]]
    for colour in fills:
        becomes(page, partial(has_colour, page, colour), wanted=True)


def answering(told: dict[str, Any]) -> Callable[[Any], None]:
    """In place of the station."""
    return lambda route: route.fulfill(json=told)


def has_colour(page: Any, colour: str) -> bool:
    """Whether the canvas has many pixels of a colour, as rgb(r, g, b)."""
    found: bool = page.evaluate(
        """(colour) => {
          const wanted = colour.match(/[0-9.]+/g).map(Number);
          const canvas = document.querySelector('.map canvas');
          const pixels = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height).data;
          let count = 0;
          for (let i = 0; i < pixels.length; i += 4) {
            if ([0, 1, 2].every((k) => Math.abs(pixels[i + k] - wanted[k]) < 12)) count += 1;
          }
          return count > 200;
        }""",
        colour,
    )
    return found


def test_the_coast_comes_once_and_is_drawn(page: Any, fake_station: str, screenshot: Callable[[str], Any]) -> None:
    """The land lies in a file of its own, fetched by the first map only; far out it covers a part of the map."""
    fetched: list[str] = []
    page.on("request", lambda request: fetched.append(request.url) if "land-50m" in request.url else None)
    page.goto(f"{fake_station}/#/map")
    page.locator(".map .vehicle").wait_for()
    page.get_by_role("application", name="Map of all vehicles").focus()
    for _ in range(14):
        page.keyboard.press("-")
    until(page, lambda: shares(page)[1] > 0.1)
    screenshot("map-wide")
    assert sum(shares(page)) > 0.8
    page.goto(f"{fake_station}/#/vehicle/1")
    page.locator(".map .vehicle").wait_for()
    passes(page, 0)
    all_asked(page)
    assert len(fetched) == 1


def shares(page: Any) -> list[float]:
    """Shares of the map that the two commonest colours cover."""
    found: list[float] = page.evaluate(
        """() => {
          const canvas = document.querySelector('.map canvas');
          const pixels = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height).data;
          const colours = {};
          for (let i = 0; i < pixels.length; i += 4) {
            const key = `${pixels[i]},${pixels[i + 1]},${pixels[i + 2]}`;
            colours[key] = (colours[key] ?? 0) + 4 / pixels.length;
          }
          return [...Object.values(colours), 0].sort((a, b) => b - a).slice(0, 2);
        }"""
    )
    return found
