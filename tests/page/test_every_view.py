"""Every view on the real station with a simulated glider: it opens, it is looked at, axe finds nothing serious."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from tests.page.waiting import at_rest

STATION_VIEWS = ("fleet", "map", "all-alarms", "people")
VEHICLE_VIEWS = (
    "vehicle", "plots", "data", "commands", "parameters", "plan", "link", "files", "alarms", "replay", "log",
)  # fmt: skip


def address_of(view: str) -> str:
    """Address of a view behind the #."""
    if view in STATION_VIEWS:
        return f"#/{view}"
    return "#/vehicle/1" if view == "vehicle" else f"#/vehicle/1/{view}"


@pytest.mark.parametrize("view", [*STATION_VIEWS, *VEHICLE_VIEWS])
def test_view_opens_and_has_no_serious_finding(
    view: str, page: Any, station: str, screenshot: Callable[[str], Path], serious: Callable[[], list[str]]
) -> None:
    """Issue: browser tests for every view; axe without a serious finding, in light and dark; pictures kept."""
    page.goto(f"{station}/{address_of(view)}")
    page.locator("main > *").first.wait_for()
    at_rest(page)
    screenshot(f"{view}-desktop-light")
    assert page.get_by_text("This view stopped").count() == 0
    assert serious() == []
    page.emulate_media(color_scheme="dark")
    page.set_viewport_size({"width": 1024, "height": 768})
    at_rest(page)
    screenshot(f"{view}-tablet-dark")
    assert serious() == []
    wide = "document.documentElement.scrollWidth <= document.documentElement.clientWidth"
    assert page.evaluate(wide), "the page is wider than the screen"
