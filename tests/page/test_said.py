"""What the vehicle says in words: in its view as it comes, and in the log book. Oracle: what it said."""

from typing import Any

import httpx
import pytest

from tests.page.past import Past
from tests.page.waiting import becomes, passes

RAISED, TOLD = (4, "alarm: over-depth"), (6, "mission: ascent: control dives")
"""Severity and words."""


def say(past: Past, severity: int, words: str) -> None:
    past.speaker.say("STATUSTEXT", severity=severity, text=words.encode(), id=0, chunk_seq=0)


def words(page: Any) -> Any:
    """What the vehicle view shows of them, the newest first."""
    return page.get_by_role("region", name="What the vehicle said").locator("li span").all_inner_texts()


def test_the_last_words_stand_in_the_view_and_new_ones_come(page: Any, past: Past, screenshot: Any) -> None:
    page.goto(f"{past.address}/#/vehicle/1/vehicle")
    region = page.get_by_role("region", name="What the vehicle said")
    region.locator("li").first.wait_for()
    before = words(page)
    assert len(before) == 3
    say(past, *RAISED)
    becomes(page, lambda: words(page), [RAISED[1], *before[:2]])
    assert "caution" in str(region.locator("li").first.get_attribute("class"))
    say(past, *TOLD)
    becomes(page, lambda: words(page), [TOLD[1], RAISED[1], before[0]])
    screenshot("said")
    region.get_by_role("link", name="All that it said").click()
    page.locator("li.text", has_text=TOLD[1]).first.wait_for()
    assert page.get_by_role("button", name="Status texts").get_attribute("aria-pressed") == "true"
    assert page.locator("li:not(.text)", has=page.locator(".words")).count() == 0


def test_the_log_book_has_what_is_more_than_information_beside_the_rest(page: Any, past: Past, screenshot: Any) -> None:
    page.goto(f"{past.address}/#/vehicle/1/log")
    page.get_by_role("textbox", name="Note").wait_for()
    say(past, 6, "only information")
    say(past, 3, "exception: <b>of a kind</b>")
    entry = page.locator("li.text", has_text="exception: <b>of a kind</b>")
    entry.wait_for()
    entry.get_by_text("error", exact=True).wait_for()
    passes(page, 200)
    assert page.locator("li.text", has_text="only information").count() == 0
    screenshot("log-texts")
    page.get_by_role("button", name="Status texts").click()
    page.locator("li.text", has_text="only information").wait_for()


@pytest.mark.parametrize("severity", [-1, 8, "x"])
def test_a_severity_that_is_none_is_refused(past: Past, severity: object) -> None:
    assert httpx.get(f"{past.address}/api/vehicles/1/log?severity={severity}").status_code == 422
