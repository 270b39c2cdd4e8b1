"""What a pilot sees of the present: the state of the vehicle's software, a value beyond its limit, alarms that were.

Oracle: what the vehicle says, and the limits of the station.
"""

from typing import Any

import httpx

from stommel.messages.mavlink import entry_words
from stommel.station.states import EXECUTIVE
from tests.page.past import Past
from tests.page.waiting import becomes, until

BEYOND, WITHIN = 230.5, 20.0
"""Of the limit of 200 m of the vehicle file [m]."""
SHOWN = (1, 3, 6)
"""States: hold, mission, abort."""


def say(past: Past, state: int, depth: float) -> None:
    past.speaker.say("GLIDER_STATE", time_boot_ms=1, executive=state, phase=1, dive=7, depth=depth, alarms=0)


def test_the_present_state_is_lit_with_the_ways_out_of_it(page: Any, past: Past, screenshot: Any) -> None:
    """One after another, as the vehicle passes through them."""
    page.goto(f"{past.address}/#/vehicle/1")
    page.get_by_role("img", name="State of the vehicle").wait_for()
    for number in SHOWN:
        name = entry_words("GLIDER_EXECUTIVE")[number]
        say(past, number, WITHIN)
        page.get_by_role("img", name=f"State of the vehicle: {name}", exact=True).wait_for()
        becomes(page, page.locator(".node.present text").all_text_contents, [name])
        ways = {after for before, _, after in EXECUTIVE if before == name}
        assert page.locator("path.edge.out").count() == len(ways)
        page.get_by_text(f"Ways out of {name}").wait_for()
    screenshot("state-abort")
    page.get_by_text("Ways out of abort").click()
    becomes(
        page, page.locator("details dd").all_inner_texts, [words for before, words, _ in EXECUTIVE if before == "abort"]
    )
    say(past, 3, WITHIN)


def test_a_value_beyond_its_limit_is_marked_until_it_is_within_again(page: Any, past: Past, screenshot: Any) -> None:
    """Then the alarm stands in the history: how bad, what, how long, and that nobody saw it, over a reload."""
    page.goto(f"{past.address}/#/vehicle/1")
    tile = page.locator("[data-channel='Depth']")
    say(past, 3, WITHIN)
    tile.locator(".value", has_text="20.0").wait_for()
    assert "warning" not in str(tile.get_attribute("class"))
    say(past, 3, BEYOND)
    tile.get_by_text("above 200").wait_for()
    becomes(page, lambda: "warning" in str(tile.get_attribute("class")), True)
    screenshot("tile-beyond")
    until(page, lambda: [one for one in alarms(past) if one["cleared"] is None])
    say(past, 3, WITHIN)
    tile.locator(".value", has_text="20.0").wait_for()
    becomes(page, lambda: tile.get_by_text("above 200").count(), 0)
    assert "warning" not in str(tile.get_attribute("class"))
    until(page, lambda: not [one for one in alarms(past) if one["cleared"] is None])

    (newest, *_) = alarms(past)
    httpx.post(f"{past.address}/api/alarms/{newest['id']}/acknowledge", json={"note": "seen from afar"})
    page.goto(f"{past.address}/#/vehicle/1/alarms")
    history = page.get_by_role("table", name="History of alarms")
    row = history.get_by_role("row", name="seen from afar")
    for words in (newest["severity"], "Depth greater than 200 m", "local"):
        row.get_by_text(words).first.wait_for()
    raised = [one.strip() for one in history.locator("tbody .when").all_inner_texts()]
    assert raised == sorted(raised, reverse=True), "the newest first"
    screenshot("alarms-history")


def alarms(past: Past) -> list[dict[str, Any]]:
    """Alarms of the depth, the newest first."""
    rows = httpx.get(f"{past.address}/api/alarms?vehicle=1").json()
    return [one for one in rows if one["key"] == "depth_m" or "Depth" in one["words"]]
