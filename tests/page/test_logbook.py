"""The log book in the page: notes of people with their times, what else happened beside them, found by words."""

import time
from typing import Any

import httpx

from tests.page.past import Past
from tests.page.waiting import at_rest, passes


def opened(page: Any, past: Past) -> Any:
    """The log book."""
    page.goto(f"{past.address}/#/vehicle/1/log")
    page.get_by_role("textbox", name="Note").wait_for()
    return page


def test_a_note_is_written_and_stays(page: Any, past: Past, screenshot: Any) -> None:
    opened(page, past).get_by_role("textbox", name="Note").fill("Sea state 3, ship 2 km north.\nSwitching the antenna.")
    page.get_by_role("button", name="Write").click()
    page.locator("li.note", has_text="Sea state 3").wait_for()
    note = httpx.get(f"{past.address}/api/notes?vehicle=1&search=antenna").json()[0]
    assert note["words"] == "Sea state 3, ship 2 km north.\nSwitching the antenna."
    assert note["user"] == "local"
    screenshot("log")
    page.reload()
    page.locator("li.note", has_text="Sea state 3").wait_for()


def test_a_note_can_be_of_a_time_that_has_passed(page: Any, past: Past) -> None:
    opened(page, past).get_by_label("a time that has passed").check()
    page.get_by_label("Time, UTC").fill("2026-01-02 03:04:05")
    page.get_by_role("textbox", name="Note").fill("Launched.")
    page.get_by_role("button", name="Write").click()
    page.get_by_role("searchbox").fill("Launched.")  # it is older than all that happened since
    page.locator("li.note", has_text="Launched.").wait_for()
    assert httpx.get(f"{past.address}/api/notes?vehicle=1&search=Launched").json()[0]["t"] == 1767323045.0
    page.get_by_role("heading", name="2026-01-02").wait_for()
    link = page.locator("li.note", has_text="Launched.").get_by_role("link").get_attribute("href")
    assert "window=1767322145-1767323945" in link  # a quarter of an hour to both sides


def test_what_another_person_writes_comes_by_itself_as_text(page: Any, past: Past) -> None:
    """Cross-site scripting: words of people are shown as they are, and never run."""
    opened(page, past)
    words = "<img src=x onerror=\"document.title='taken'\"><script>document.title='taken'</script>"
    httpx.post(f"{past.address}/api/notes", json={"vehicle": 1, "words": words}).raise_for_status()
    page.locator("li.note", has_text="<img src=x").wait_for()
    passes(page, 200)
    assert page.title() != "taken"
    assert page.locator("li img").count() == 0


def test_entries_are_found_by_kind_and_words(page: Any, past: Past) -> None:
    from playwright.sync_api import expect

    for words in ("first needle", "second needle", "third straw"):
        httpx.post(f"{past.address}/api/notes", json={"vehicle": 1, "words": words}).raise_for_status()
    past.speaker.say("GLIDER_STATE", time_boot_ms=1, depth=0.0, alarms=1)
    opened(page, past).locator("li.alarm", has_text="leak").or_(page.locator("li.alarm")).first.wait_for()
    page.get_by_role("button", name="Notes", exact=True).click()
    page.locator("li.alarm").first.wait_for(state="detached")
    page.get_by_role("searchbox").fill("needle")
    page.locator("li", has_text="third straw").wait_for(state="detached")
    expect(page.locator("li.note")).to_have_count(2)
    page.get_by_role("searchbox").fill("no such words")
    page.get_by_text("Nothing in the log book is like that.").wait_for()
    past.speaker.say("GLIDER_STATE", time_boot_ms=2, depth=0.0, alarms=0)


def test_older_entries_come_page_by_page(page: Any, past: Past) -> None:
    from playwright.sync_api import expect

    with httpx.Client(timeout=60.0) as person:
        for number in range(130):
            note = {"vehicle": 1, "words": f"page {number}", "t": past.begin + number}
            person.post(f"{past.address}/api/notes", json=note).raise_for_status()
    opened(page, past).get_by_role("searchbox").fill("page")
    expect(page.locator("li.note")).to_have_count(100)
    page.get_by_role("button", name="Older entries").click()
    expect(page.locator("li.note")).to_have_count(130)
    texts = page.locator("li.note .words").all_inner_texts()
    assert texts == [f"page {number}" for number in reversed(range(130))]
    asked: list[str] = []
    page.on("request", lambda request: asked.append(request.url))
    passes(page, 1500)
    assert [url for url in asked if "/log?" in url] == [], "nothing has happened, nothing is asked for"
    expect(page.locator("li.note")).to_have_count(130)
    expect(page.get_by_role("button", name="Older entries")).to_have_count(0)


def test_an_empty_note_is_not_written(page: Any, past: Past) -> None:
    opened(page, past).get_by_role("button", name="Write").click()
    page.get_by_text("Write something first.").wait_for()


def test_nobody_is_kept_from_the_log_book(page: Any, past: Past, serious: Any) -> None:
    """axe-core: no serious finding."""
    at_rest(opened(page, past))
    assert serious() == []


def test_hand_overs_limits_and_notes_about_all_stand_beside_the_rest(page: Any, past: Past, screenshot: Any) -> None:
    """What a change of watch asks for: who took command, who changed which limit, what was written for everybody."""
    with httpx.Client(base_url=f"{past.address}/api", timeout=60.0) as person:
        person.post("/vehicles/1/holder", json={}).raise_for_status()
        person.delete("/vehicles/1/holder").raise_for_status()
        opened(page, past)
        page.locator("li.hold", has_text="Gave up command").first.wait_for()
        person.put("/vehicles/1/limits/roll_deg", json={"high": 33.0}).raise_for_status()
        page.locator("li.limit", has_text="at most 33").wait_for()  # by itself
        person.delete("/vehicles/1/limits/roll_deg").raise_for_status()
    page.get_by_label("all vehicles").check()
    page.get_by_role("textbox", name="Note").fill("Typhoon on Thursday.")
    page.get_by_role("button", name="Write").click()
    note = page.locator("li.note", has_text="Typhoon on Thursday.")
    note.get_by_text("station", exact=True).wait_for()
    assert httpx.get(f"{past.address}/api/notes?search=Typhoon").json()[0]["vehicle"] is None
    at_rest(page)
    screenshot("log-whole")
    page.get_by_role("button", name="Hand-overs").click()
    note.wait_for(state="detached")
    page.locator("li.hold").first.wait_for()


def test_a_note_is_begun_from_the_time_that_plots_show(page: Any, past: Past) -> None:
    page.goto(f"{past.address}/#/vehicle/1/plots?window={past.begin:.0f}-{past.begin + 1800.0:.0f}")
    page.get_by_role("link", name="Note", exact=True).click()
    page.get_by_role("textbox", name="Note").fill("Began to drift here.")
    page.get_by_role("button", name="Write").click()
    page.get_by_text("The note stands in the log book.").wait_for()
    note = httpx.get(f"{past.address}/api/notes?vehicle=1&search=drift").json()[0]
    assert note["t"] == past.begin + 1800.0


def test_dives_stand_in_the_log_book_and_lead_to_their_data(
    page: Any, past: Past, screenshot: Any, serious: Any
) -> None:
    """Oracle: the dives that the station tells elsewhere."""
    from playwright.sync_api import expect

    dives = httpx.get(f"{past.address}/api/vehicles/1/dives").json()
    opened(page, past).get_by_role("button", name="Dives", exact=True).click()
    page.locator("li.note").first.wait_for(state="detached")
    entries = page.locator("li.dive")
    expect(entries).to_have_count(len(dives))
    third = entries.filter(has=page.get_by_role("link", name="Dive 3 to 200 m", exact=True))
    until = time.strftime("%H:%M:%S", time.gmtime(dives[2]["t_end"]))
    expect(third).to_contain_text(f"60\u202fmin, until {until}; from 30°")
    expect(third).to_contain_text("; 12.0\u202fkJ")
    at_rest(page)
    screenshot("log-dives")
    assert serious() == []
    third.get_by_role("link", name="Dive 3 to 200 m", exact=True).focus()
    page.keyboard.press("Enter")
    expect(page.get_by_role("table", name="Dives").locator("tbody tr")).to_have_count(1)
    expect(page.locator("footer")).to_contain_text("Dive 3")
