"""What is shown says of when it is, and looks old when it is. Oracle: the times that the station tells."""

import json
import re
from typing import Any

import httpx
import pytest

from tests.page import fake_glider as glider
from tests.page.past import Past
from tests.page.played_station import NOW, PlayedStation
from tests.page.waiting import becomes, until

HOURS = 5
FRESH = NOW + 86_400.0
"""Told by a vehicle whose clock is ahead: it does not grow old while a slow machine looks."""
LONG_AGO = NOW - HOURS * 3600.0
ATTITUDE = ("pitch_deg", "roll_deg", "heading_deg")


def as_of(page: Any, title: str) -> list[str]:
    """What the head of a panel says of the age of what it shows."""
    panel = page.locator("section.panel", has=page.get_by_role("heading", name=re.compile(f"^{title}")))
    found: list[str] = panel.locator(".as-of").all_inner_texts()
    return found


def fact(page: Any, label: str) -> Any:
    return page.locator(".fact", has=page.get_by_text(label, exact=True)).locator(".under")


def test_attitude_dive_and_state_of_a_silent_vehicle_say_of_when_they_are(
    page: Any, played: PlayedStation, screenshot: Any
) -> None:
    """Field report 133 of openmct-yamcs for what is no tile: an attitude of hours ago looked like one of now."""
    for key in (*ATTITUDE, "depth_m", "state"):
        played.tell(key, FRESH, 3.0)
    played.tell("ballast_ml", FRESH, 200.0)
    played.tell("moving_mass_mm", LONG_AGO, 12.0)
    inside = page.locator("li", has_text="Moving mass")
    inside.get_by_text(re.compile(f"^old, {HOURS}.h")).wait_for()
    assert [as_of(page, title) for title in ("Attitude", "Dive", "State")] == [[], [], []]
    assert page.locator("li.old", has_text="Oil outside").count() == 0
    for key in (*ATTITUDE, "depth_m", "state"):
        played.tell(key, LONG_AGO, 3.0)
    for title in ("Attitude", "Dive", "State"):
        until(page, lambda title=title: re.search(rf"^as of {HOURS}.h", "".join(as_of(page, title))))
    screenshot("ages")


def test_facts_say_of_which_dive_and_when_they_are(page: Any, played: PlayedStation) -> None:
    """The current of an older dive stands for the last one that has none: it says which, and is marked."""
    summary = glider.summary(1, NOW, 20.0)
    summary |= {
        "dive": 9, "heard": True, "told": {"state": FRESH, "waypoint_distance_m": NOW - 5400.0},
        "speed_made_good": {"m_s": 0.3, "course_deg": 90.0, "dive": 8, "t": NOW - 3000.0},
        "current": {"north_m_s": 0.1, "east_m_s": 0.0, "dive": 5, "t": LONG_AGO},
    }  # fmt: skip
    told = json.dumps({"type": "summary", "vehicle": 1, "summary": summary})
    played.sockets[-1].send(told)
    current = fact(page, "Current")
    current.get_by_text(re.compile("dive 5")).wait_for()
    assert re.search(f"{HOURS}.h .* ago", current.inner_text())
    assert current.locator("time.old").count() == 1
    made_good = fact(page, "Speed made good")
    assert re.search(r"dive 8, [5-9]\d.min ago", made_good.inner_text())
    assert made_good.locator("time.old").count() == 0
    assert re.match(r"9\d.min ago; there", fact(page, "To waypoint 2").inner_text())
    assert page.locator(".fact time.old").count() == 1
    played.sockets[-1].send(json.dumps({"type": "summary", "vehicle": 1, "summary": summary | {"heard": False}}))
    page.locator(".fact", has_text="To waypoint").locator("time.old").wait_for()


def test_speed_and_current_of_the_archive_tell_their_dive(page: Any, past: Past) -> None:
    """Through the station. Oracle: the last dive that was written into the archive."""
    dive = httpx.get(f"{past.address}/api/vehicles/1/dives").json()[-1]
    summary = httpx.get(f"{past.address}/api/vehicles/1").json()
    for name in ("speed_made_good", "current"):
        assert (summary[name]["dive"], summary[name]["t"]) == (dive["dive"], pytest.approx(dive["t_end"]))
    page.goto(f"{past.address}/#/vehicle/1")
    becomes(page, lambda: f"dive {dive['dive']}, " in fact(page, "Current").inner_text(), True)
    becomes(page, lambda: f"dive {dive['dive']}, " in fact(page, "Speed made good").inner_text(), True)


def test_a_tile_shows_its_limits_before_they_are_broken(page: Any, played: PlayedStation, screenshot: Any) -> None:
    """Oracle: the stand-in's limits: depth at most 200 m, voltage at least 24 V."""
    depth = page.locator('[data-channel="Depth"]')
    for value, said in ((50.0, "≤\u202f200"), (195.0, "near ≤\u202f200"), (201.0, "above 200.0")):
        played.tell("depth_m", FRESH, value)
        played.tell("voltage_v", FRESH, 28.0)
        becomes(page, lambda: depth.locator(".foot > :first-child").inner_text(), said)
        assert ("caution" in str(depth.get_attribute("class"))) == (value > 200.0)
        if said.startswith("near"):
            screenshot("limits")
    voltage = page.locator('[data-channel="Voltage of the battery"]')
    assert voltage.locator(".limits").inner_text() == "≥\u202f24"
