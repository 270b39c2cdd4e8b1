"""The radio is lost and regained, as a person sees it on the fleet, on the vehicle and on the link, without a click.

Oracle: what the vehicle said last, that its port is closed or silent, and that it speaks again.
"""

import re
from collections.abc import Iterator
from typing import Any

import pytest

from tests.page.past import Past
from tests.page.waiting import becomes, until

LAMP = "header.bar .lamp"
NOBODY = "no program listens there"


def says(past: Past, depth: float) -> None:
    """Let the vehicle say that it is there, and how deep."""
    past.speaker.say("HEARTBEAT", type=12, autopilot=8, system_status=4, mavlink_version=3)
    past.speaker.say("GLIDER_STATE", time_boot_ms=1, depth=depth, executive=3, phase=1, dive=7, alarms=0)


@pytest.fixture
def tabs(page: Any, past: Past) -> Iterator[dict[str, Any]]:
    """The three views at once, while the vehicle is heard."""
    says(past, 41.5)
    found = {"fleet": page, "vehicle/1": page.context.new_page(), "vehicle/1/link": page.context.new_page()}
    for view, tab in found.items():
        tab.goto(f"{past.address}/#/{view}")
    until(page, lambda: heard_everywhere(past, found))
    yield found
    for tab in list(found.values())[1:]:
        tab.close()


def heard_everywhere(past: Past, tabs: dict[str, Any]) -> bool:
    """Whether every tab says so; the vehicle says it again meanwhile, since nobody hears it else."""
    says(past, 41.5)
    return all("in contact" in tab.locator(LAMP).first.inner_text() for tab in tabs.values())


def fact(page: Any, label: str) -> str:
    """What the strip of the vehicle says."""
    words: str = page.locator("article .fact", has=page.get_by_text(label, exact=True)).locator("dd").first.inner_text()
    return words


def test_the_radio_is_lost_and_regained(tabs: dict[str, Any], past: Past, screenshot: Any) -> None:
    """Issue: lose and regain the link. jenseva/spray_pilot#39: what was known stays, with how old it is."""
    fleet, vehicle, link = tabs.values()
    place = fact(fleet, "Position")
    assert place.startswith("30°")
    depth = vehicle.locator("[data-channel='Depth']")
    depth.locator(".value", has_text="41.5").wait_for()

    past.speaker.leave()
    for tab in tabs.values():
        tab.locator(LAMP, has_text=re.compile(r"silent \d+")).first.wait_for()
        assert tab.get_by_text("The station is not reached").count() == 0, "it is the radio that is lost"
    strip = fleet.get_by_role("article", name="vehicle 1")
    strip.get_by_text(NOBODY).first.wait_for()
    assert fact(fleet, "Position") == place
    until(fleet, lambda: re.fullmatch(r"\d+\s*s ago", fact(fleet, "Last contact")))
    until(vehicle, lambda: "stale" in depth.get_attribute("class"))
    assert "41.5" in depth.inner_text()
    link.get_by_text("The line is not open").wait_for()
    link.get_by_text(NOBODY).first.wait_for()
    screenshot("radio-lost")

    past.speaker.come_back()
    link.get_by_text("vehicle 1 is silent").wait_for()
    for tab in (fleet, link):
        tab.get_by_text("nothing comes; it is under water, out of reach, or its radio is off").first.wait_for()

    says(past, 12.2)
    for tab in tabs.values():
        tab.locator(LAMP, has_text="in contact").first.wait_for()
        says(past, 12.2)
    depth.locator(".value", has_text="12.2").wait_for()
    becomes(vehicle, lambda: "stale" in depth.get_attribute("class"), False)
    strip.get_by_text("in contact").wait_for()
    assert strip.get_by_text("nothing comes").count() == 0
