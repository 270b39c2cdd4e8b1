"""Alarms in the page: raised by what a vehicle says, heard, acknowledged by a person; limits as people set them."""

from typing import Any

import httpx
import pytest

from tests.page.past import Past
from tests.page.waiting import at_rest, becomes, until

NEEDS = "Alarms that need somebody"
PAST = "History of alarms"


def opened(page: Any, past: Past) -> Any:
    """The view of the alarms."""
    page.goto(f"{past.address}/#/vehicle/1/alarms")
    page.get_by_role("region", name="Limits of channels").wait_for()
    return page


def limits(past: Past) -> dict[str, dict[str, Any]]:
    """Limits as the station has them."""
    return {limit["channel"]: limit for limit in httpx.get(f"{past.address}/api/vehicles/1/limits").json()}


def test_an_alarm_comes_by_itself_sounds_and_is_acknowledged(page: Any, past: Past, screenshot: Any) -> None:
    page.add_init_script("""
        window.tones = 0;
        const start = OscillatorNode.prototype.start;
        OscillatorNode.prototype.start = function (...when) { window.tones += 1; return start.apply(this, when); };
    """)
    opened(page, past)
    page.get_by_role("switch", name="Sound").check()
    before = becomes(page, lambda: page.evaluate("window.tones"), 1)  # the switch lets one hear that there is a sound
    past.speaker.say("GLIDER_STATE", time_boot_ms=1, depth=230.5, alarms=0)
    row = page.get_by_role("region", name=NEEDS).get_by_role("row", name="Depth greater than 200 m")
    row.wait_for()
    until(page, lambda: page.evaluate("window.tones") >= before + 2)
    screenshot("alarms-open")

    row.get_by_role("button", name="Acknowledge").click()
    page.get_by_role("textbox", name="Note").fill("Sensor drifts.\nWatching it.")
    page.get_by_role("dialog").get_by_role("button", name="Acknowledge").click()
    page.get_by_role("region", name=NEEDS).get_by_text("Sensor drifts.").wait_for()
    told = next(
        one for one in httpx.get(f"{past.address}/api/alarms?vehicle=1").json() if "Depth greater than" in one["words"]
    )
    assert (told["acknowledged_by"], told["note"], told["cleared"]) == ("local", "Sensor drifts.\nWatching it.", None)

    past.speaker.say("GLIDER_STATE", time_boot_ms=2, depth=20.0, alarms=0)
    page.get_by_role("region", name=PAST).get_by_role("row", name="Depth greater than 200 m").first.wait_for()
    screenshot("alarms-over")


def test_the_sound_switch_is_remembered(page: Any, past: Past) -> None:
    from playwright.sync_api import expect

    opened(page, past)
    switch = page.get_by_role("switch", name="Sound")
    expect(switch).not_to_be_checked()
    switch.check()
    page.reload()
    expect(switch).to_be_checked()
    switch.uncheck()
    page.reload()
    expect(switch).not_to_be_checked()


def test_a_limit_is_set_changed_drawn_and_removed(page: Any, past: Past) -> None:
    opened(page, past).get_by_role("button", name="Add a limit").click()
    page.get_by_label("Channel", exact=True).select_option("heading_deg")
    page.get_by_label("Least value").fill("91")
    page.get_by_label("Greatest value").fill("99.5")
    page.get_by_label("Hysteresis").fill("1.5")
    page.get_by_label("Delay").fill("30")
    page.get_by_label("Severity").select_option("notice")
    page.get_by_role("button", name="Set").click()
    row = page.get_by_role("region", name="Limits of channels").get_by_role("row", name="heading")
    row.wait_for()
    told = {key: limits(past)["heading_deg"][key] for key in ("low", "high", "hysteresis", "delay_s", "severity")}
    assert told == {"low": 91.0, "high": 99.5, "hysteresis": 1.5, "delay_s": 30.0, "severity": "notice"}

    row.get_by_text("local, 2").wait_for()  # who set it, and the day

    row.click()
    page.get_by_label("Least value").fill("")
    page.get_by_role("button", name="Set").click()
    page.get_by_role("dialog").wait_for(state="hidden")
    assert limits(past)["heading_deg"]["low"] is None

    row.click()
    page.get_by_role("button", name="Remove").click()
    page.get_by_role("dialog").wait_for(state="hidden")
    assert "heading_deg" not in limits(past)


@pytest.mark.parametrize(
    ("low", "high", "hysteresis", "words"),
    [
        ("", "", "0", "Give the least value, the greatest, or both."),
        ("5", "5", "0", "Must be more than the least value."),
        ("5", "6", "-1", "Must be 0 or more."),
        ("5", "6", "3", "hysteresis"),  # the server's own sentence
    ],
)
def test_a_limit_that_cannot_be_is_refused_in_the_form(
    page: Any, past: Past, low: str, high: str, hysteresis: str, words: str
) -> None:
    before = limits(past)
    opened(page, past).get_by_role("button", name="Add a limit").click()
    page.locator("form#limit").evaluate("form => form.noValidate = true")
    page.get_by_label("Least value").fill(low)
    page.get_by_label("Greatest value").fill(high)
    page.get_by_label("Hysteresis").fill(hysteresis)
    page.get_by_role("button", name="Set").click()
    page.get_by_role("alert").filter(has_text=words).first.wait_for()
    assert limits(past) == before


@pytest.mark.parametrize("page", [{"color_scheme": "dark", "viewport": {"width": 1024, "height": 768}}], indirect=True)
def test_nobody_is_kept_from_the_alarms(page: Any, past: Past, serious: Any, screenshot: Any) -> None:
    """axe-core: no serious finding, in the list and in a form."""
    at_rest(opened(page, past))
    screenshot("alarms-tablet-dark")
    assert serious() == []
    page.get_by_role("button", name="Add a limit").click()
    page.get_by_role("dialog").wait_for()
    assert serious() == []
