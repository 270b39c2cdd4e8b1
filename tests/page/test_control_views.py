"""The views of command, planning, link and people in every theme and on a tablet: pictures, and what axe-core finds."""

from collections.abc import Callable
from typing import Any

import pytest

from tests.page.waiting import at_rest

DESK, TABLET = {"width": 1440, "height": 900}, {"width": 1024, "height": 768}
VIEWS = {
    "commands": "[data-kind='radio-time']",
    "parameters": "[data-parameter='SURFACE_TIME']",
    "plan": "[data-place='waypoints.3']",
    "link": "[data-figure='good']",
    "files": "tr[data-entry]",
    "people": "text=Audit log",
}


@pytest.mark.parametrize("view", VIEWS)
@pytest.mark.parametrize(
    "page",
    [{"color_scheme": "light", "viewport": TABLET}, {"color_scheme": "dark", "viewport": DESK}],
    indirect=True,
    ids=["light-tablet", "dark-desk"],
)
def test_nothing_serious_is_found_and_nothing_is_cut_off(
    page: Any,
    station: str,
    view: str,
    screenshot: Any,
    serious: Callable[[], list[str]],
    request: pytest.FixtureRequest,
) -> None:
    """Issue: accessible, light and dark, on a tablet. The view fits its window sideways."""
    page.goto(f"{station}/#/{view}" if view == "people" else f"{station}/#/vehicle/1/{view}")
    page.locator(VIEWS[view]).first.wait_for(timeout=240_000)
    if view == "commands":
        page.locator("[data-kind='radio-time'] > button").click()
        page.get_by_label("time, s").wait_for()
    if view == "parameters":
        page.locator("[data-parameter='SURFACE_TIME']").click()
        page.get_by_label("New value, s").wait_for()
    at_rest(page)
    screenshot(f"{view}-{request.node.callspec.id}")
    assert serious() == []
    assert (
        page.evaluate("document.getElementById('content').scrollWidth - document.getElementById('content').clientWidth")
        <= 0
    )
