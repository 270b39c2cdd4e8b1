"""The sea map by pointer, wheel and keys, on made-up values."""

from collections.abc import Callable
from typing import Any

import pytest

BAR = ".map .scale"


@pytest.fixture
def sea(page: Any, fake_station: str) -> Any:
    """The map view, drawn."""
    page.goto(f"{fake_station}/#/map")
    page.locator(".map .vehicle").wait_for()
    page.wait_for_timeout(500)
    return page


def place(page: Any) -> tuple[float, float]:
    """Where the vehicle's mark stands, pixels."""
    box = page.locator(".map .vehicle path").bounding_box()
    return box["x"], box["y"]


def test_keys_move_and_zoom_the_map(sea: Any) -> None:
    chart = sea.get_by_role("application", name="Map of all vehicles")
    chart.focus()
    before, bar = place(sea), sea.locator(BAR).inner_text()
    for _ in range(3):
        sea.keyboard.press("ArrowLeft")
        sea.wait_for_timeout(100)
    after = place(sea)
    assert after[0] - before[0] == pytest.approx(180.0, abs=3.0)  # 60 pixels a press; the glider itself flies on
    assert after[1] == pytest.approx(before[1], abs=3.0)
    for _ in range(4):
        sea.keyboard.press("+")
    assert sea.locator(BAR).inner_text() != bar
    sea.keyboard.press("0")
    assert place(sea)[0] == pytest.approx(before[0], abs=6.0)
    assert sea.locator(BAR).inner_text() == bar


def test_the_place_below_the_wheel_stays(sea: Any) -> None:
    before = place(sea)
    box = sea.locator(".map .vehicle path").bounding_box()
    sea.mouse.move(box["x"] + box["width"] / 2, box["y"] + box["height"] / 2)
    for _ in range(3):
        sea.mouse.wheel(0, -200)
    assert place(sea) == (pytest.approx(before[0], abs=8.0), pytest.approx(before[1], abs=8.0))


def test_dragging_moves_the_map_with_the_pointer(sea: Any) -> None:
    before = place(sea)
    sea.mouse.move(300, 600)
    sea.mouse.down()
    sea.mouse.move(340, 560, steps=4)
    sea.mouse.move(420, 640, steps=4)
    sea.mouse.up()
    after = place(sea)
    assert (after[0] - before[0], after[1] - before[1]) == (pytest.approx(120, abs=6), pytest.approx(40, abs=6))


def test_enter_on_a_vehicle_opens_it(sea: Any) -> None:
    sea.locator(".map .vehicle").focus()
    sea.keyboard.press("Enter")
    sea.wait_for_function("location.hash === '#/vehicle/1'")


def test_the_coast_comes_once_and_is_drawn(page: Any, fake_station: str, screenshot: Callable[[str], Any]) -> None:
    """The land lies in a file of its own, fetched by the first map only; far out it covers a part of the map."""
    fetched: list[str] = []
    page.on("request", lambda request: fetched.append(request.url) if "land-50m" in request.url else None)
    page.goto(f"{fake_station}/#/map")
    page.locator(".map .vehicle").wait_for()
    page.get_by_role("application", name="Map of all vehicles").focus()
    for _ in range(14):
        page.keyboard.press("-")
    page.wait_for_timeout(1000)
    screenshot("map-wide")
    shares = page.evaluate(
        """() => {
          const canvas = document.querySelector('.map canvas');
          const pixels = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height).data;
          const colours = {};
          for (let i = 0; i < pixels.length; i += 4) {
            const key = `${pixels[i]},${pixels[i + 1]},${pixels[i + 2]}`;
            colours[key] = (colours[key] ?? 0) + 4 / pixels.length;
          }
          return Object.values(colours).sort((a, b) => b - a).slice(0, 2);
        }"""
    )
    assert shares[0] + shares[1] > 0.8
    assert shares[1] > 0.1
    page.goto(f"{fake_station}/#/vehicle/1")
    page.locator(".map .vehicle").wait_for()
    assert len(fetched) == 1
