"""Alarms as somebody hears and sees them who watches a fleet, also after the page was away."""

import re
import sqlite3
from typing import Any

import httpx
import pytest

from tests.page.past import Past
from tests.page.played_station import NOW, PlayedStation
from tests.page.waiting import at_rest, becomes, until

COUNT_TONES = """
    localStorage.setItem('stommel-sound', 'on');
    window.tones = 0;
    const start = OscillatorNode.prototype.start;
    OscillatorNode.prototype.start = function (...when) { window.tones += 1; return start.apply(this, when); };
"""
LEAK = {
    "id": 7, "vehicle": 1, "key": "vehicle:leak", "words": "Leak", "severity": "critical", "raised": NOW - 300.0,
    "acknowledged": None, "acknowledged_by": None,
}  # fmt: skip
SEEN = {"acknowledged": NOW, "acknowledged_by": "ana"}
FULL = LEAK | {"id": 8, "vehicle": None, "key": "archive_failing", "words": "The archive does not take what comes"}


def tones(page: Any) -> int:
    """How many tones were begun; a critical alarm has four."""
    found: int = page.evaluate("window.tones")
    return found


def bell(page: Any, words: str) -> Any:
    """The bell, when it says so."""
    return page.get_by_role("button", name=re.compile(f"^Alarms: {words}$"))


def test_an_alarm_that_was_raised_while_nobody_looked_is_heard(page: Any, fake_station: str) -> None:
    """It sounds when the page opens, and again until somebody has seen it, be it while the socket was lost."""
    page.add_init_script(COUNT_TONES)
    page.clock.install()
    station = PlayedStation(page)
    station.alarms[1] = [LEAK]
    page.goto(f"{fake_station}/#/fleet")
    bell(page, "1 open, 1 not acknowledged").wait_for()
    becomes(page, lambda: tones(page), 4)
    page.clock.fast_forward(21_000)
    becomes(page, lambda: tones(page), 8)
    station.alarms[1] = [LEAK | SEEN]
    station.sockets[-1].close()
    until(page, lambda: page.clock.run_for(500) or len(station.sockets) == 2)
    bell(page, "1 open").wait_for()
    page.clock.fast_forward(21_000)
    page.clock.fast_forward(21_000)
    assert tones(page) == 8, "it was acknowledged while the page was away"
    station.alarms[1] = [LEAK | SEEN, LEAK | {"id": 9, "key": "vehicle:no rise", "words": "No rise"}]
    station.sum_up(1)
    becomes(page, lambda: tones(page), 12)


def test_an_alarm_of_the_station_counts_once_and_stands_beside_the_vehicles(
    page: Any, fake_station: str, screenshot: Any
) -> None:
    """It is in the summary of each vehicle, and one may be told later than the other."""
    station = PlayedStation(page)
    station.alarms = {1: [LEAK, FULL], 2: [FULL]}
    page.goto(f"{fake_station}/#/fleet")
    bell(page, "2 open, 2 not acknowledged").click()
    entries = page.locator(".sheet .alarm")
    assert entries.count() == 2
    entries.filter(has_text="Leak").get_by_text(re.compile(r"ZJU glider, for \d+")).wait_for()
    entries.filter(has_text="archive").get_by_text(re.compile(r"the station, for [45]\smin")).wait_for()
    screenshot("alarms-bell")
    page.keyboard.press("Escape")
    page.get_by_role("region", name="Alarms of the station").get_by_text("nobody has seen it").wait_for()
    assert page.get_by_role("article").get_by_text("The archive does not take").count() == 0
    station.alarms[1] = [LEAK, FULL | SEEN]
    station.sum_up(1)
    bell(page, "2 open, 1 not acknowledged").wait_for()


def test_lists_are_asked_for_again_when_events_were_lost(page: Any, fake_station: str) -> None:
    """The station says {"type": "gap", "id": "", "lost": n} to a page that was too slow for its events."""
    rows: list[dict[str, Any]] = []
    page.route(
        re.compile(r"/api/alarms\?.*open=true"), lambda route: route.fulfill(json=rows)
    )  # other questions for alarms are answered by the stand-in: there are none
    station = PlayedStation(page)
    page.goto(f"{fake_station}/#/all-alarms")
    page.get_by_text("No alarm is open, and every past one was acknowledged.").wait_for()
    rows.append(LEAK | {"cleared": None, "note": None, "value": None})
    station.say({"type": "gap", "id": "", "lost": 3})
    page.get_by_role("row", name="Leak").wait_for()


def test_why_a_vehicle_is_not_heard_is_read_without_a_pointer(page: Any, fake_station: str, screenshot: Any) -> None:
    PlayedStation(page)
    page.goto(f"{fake_station}/#/vehicle/2")
    glance = page.get_by_role("region", name="At a glance")
    glance.get_by_text("waits for the first frame on serial /dev/ttyUSB0").wait_for()
    page.goto(f"{fake_station}/#/vehicle/2/plots")
    page.get_by_role("button", name="Link: never heard").press("Enter")
    page.locator(".sheet").get_by_text("waits for the first frame on serial /dev/ttyUSB0").wait_for()
    screenshot("link-silent")


@pytest.fixture
def leaking(past: Past) -> Any:
    """A vehicle that is too deep until the test ends."""
    past.speaker.say("GLIDER_STATE", time_boot_ms=1, depth=230.5, alarms=0)
    yield past
    past.speaker.say("GLIDER_STATE", time_boot_ms=2, depth=20.0, alarms=0)


def test_an_alarm_is_acknowledged_from_every_view_and_the_overview_says_who_did(
    page: Any, leaking: Past, screenshot: Any
) -> None:
    page.goto(f"{leaking.address}/#/vehicle/1")
    row = page.get_by_role("list", name="Open alarms").locator("li", has_text="Depth greater than 200 m")
    row.get_by_text("nobody has seen it").wait_for()
    at_rest(page)
    screenshot("overview-alarm")
    page.get_by_role("button", name=re.compile("^Alarms: ")).click()
    page.get_by_role("button", name="Acknowledge Depth greater than 200 m").click()
    row.get_by_text("seen by local").wait_for()


def history(past: Past, begin: float, count: int) -> None:
    """So many alarms of a past, a second apart, each over and seen; written by hand, for no station can be so old."""
    rows = [
        (1, f"old:{k}", f"Old alarm {k}", "notice", int((begin + k) * 1e6), int((begin + k + 0.5) * 1e6), "ana")
        for k in range(count)
    ]
    database = sqlite3.connect(past.database.removeprefix("sqlite:///"), timeout=60.0)
    with database:
        database.executemany(
            "insert into alarms (vehicle_id, key, words, severity, raised_us, cleared_us, acknowledged_us,"
            " acknowledged_by) values (?1, ?2, ?3, ?4, ?5, ?6, ?6, ?7)",
            rows,
        )
    database.close()


def test_alarms_of_all_vehicles_are_seen_acknowledged_and_older_ones_read(
    page: Any, leaking: Past, screenshot: Any, serious: Any
) -> None:
    from playwright.sync_api import expect

    history(leaking, 1_700_000_000.0, 130)  # older than whatever other tests look for on a first page of this station
    page.goto(f"{leaking.address}/#/all-alarms")
    row = page.get_by_role("region", name="Alarms that need somebody").get_by_role(
        "row", name="Depth greater than 200 m"
    )
    row.get_by_role("link", name=httpx.get(f"{leaking.address}/api/vehicles").json()[0]["name"]).wait_for()
    at_rest(page)
    screenshot("alarms-all")
    assert serious() == []
    old = page.get_by_role("region", name="History of alarms").get_by_role("row", name="Old alarm")
    before = old.count()
    assert 0 < before <= 100
    page.get_by_role("button", name="Older alarms").click()
    expect(old).to_have_count(130)
    page.get_by_role("button", name="Older alarms").wait_for(state="detached")
    button = row.get_by_role("button", name="Acknowledge")
    if button.count():  # another test may have seen the same raising
        button.click()
        page.get_by_role("dialog").get_by_role("button", name="Acknowledge").click()
    row.get_by_text("local").wait_for()


def test_a_replay_shows_the_alarms_of_then(page: Any, past: Past, screenshot: Any) -> None:
    history(past, past.begin + 3600.0, 1)
    database = sqlite3.connect(past.database.removeprefix("sqlite:///"), timeout=60.0)
    with database:
        database.execute(
            "update alarms set key = 'then', words = 'Alarm of then', cleared_us = ?1, acknowledged_us = ?1"
            " where raised_us = ?2",
            (int((past.begin + 7200.0) * 1e6), int((past.begin + 3600.0) * 1e6)),
        )
    database.close()
    window = f"begin={past.begin + 3900.0:.0f}&end={past.begin + 7000.0:.0f}"
    page.goto(f"{past.address}/#/vehicle/1/replay?{window}")
    page.get_by_role("button", name="Start the replay").click()
    row = page.get_by_role("list", name="Open alarms").locator("li", has_text="Alarm of then")
    row.get_by_text("nobody has seen it").wait_for()
    screenshot("replay-alarm")
    page.get_by_role("button", name="End").first.click()
