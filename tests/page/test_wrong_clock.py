"""A browser whose clock is wrong by a day shows and asks for what one with a right clock does.

Oracle: the clock of this machine, which is the station's.
"""

import json
import math
import re
import time
from datetime import UTC, datetime
from typing import Any

import httpx
import pytest

from tests.page.manned import PASSWORD, sign_in
from tests.page.past import Past
from tests.page.test_plots import DRAWN
from tests.page.waiting import until

DAY = 86_400.0
WRONG = """
    const Right = Date;
    globalThis.Date = class extends Right {
        constructor(...told) { if (told.length) super(...told); else super(Right.now() + OFF); }
        static now() { return Right.now() + OFF; }
    };
"""
NEAR = 90.0
"""Seconds by which a busy machine may be late."""


@pytest.fixture(params=[-1.1 * DAY, 1.1 * DAY], ids=["slow", "fast"])
def late(page: Any, request: pytest.FixtureRequest) -> Any:
    """A page whose browser's clock is wrong."""
    page.add_init_script(WRONG.replace("OFF", str(1000.0 * request.param)))
    return page


def is_wrong(page: Any) -> bool:
    """Whether the browser has another time than this machine."""
    return bool(abs(page.evaluate("Date.now()") / 1000.0 - time.time()) > DAY)


def seconds(text: str) -> float:
    """A time that the page shows, in UTC."""
    found = re.search(r"(\d{4}-\d\d-\d\d) (\d\d:\d\d:\d\d)", text)
    assert found, text
    return datetime.fromisoformat(f"{found[1]}T{found[2]}").replace(tzinfo=UTC).timestamp()


def field(page: Any, label: str) -> float:
    return seconds(page.get_by_label(label).first.input_value())


def near_now(t: float) -> Any:
    return pytest.approx(t, abs=NEAR, rel=0.0) == time.time()


def test_times_and_ages_are_the_stations(late: Any, past: Past) -> None:
    late.goto(f"{past.address}/#/vehicle/1")
    past.speaker.say("ATTITUDE", time_boot_ms=0, pitch=0.1, roll=0.0, yaw=1.0)
    assert is_wrong(late)
    tile = late.locator("[data-channel='Heading']").first
    late.wait_for_function(
        r"(tile) => /^(old, )?(now|\d+\s*s)$/.test(tile.querySelector('.foot').textContent.trim())",
        arg=tile.element_handle(),
    )
    assert near_now(seconds(late.locator("time.clock").inner_text().replace("\n", " ")))


def test_windows_of_plots_data_and_replay_are_of_the_stations_now(late: Any, past: Past) -> None:
    late.goto(f"{past.address}/#/vehicle/1/plots?window=live-600")
    late.wait_for_selector("[data-panel] canvas")
    late.wait_for_function(f"() => ({DRAWN.strip()})()[0]?.end > 1e9")
    assert is_wrong(late)
    assert near_now(late.evaluate(DRAWN)[0]["end"])
    late.keyboard.press("Home")
    assert near_now(field(late, "To, UTC"))
    assert field(late, "To, UTC") - field(late, "From, UTC") == pytest.approx(600.0, abs=2.0)
    late.goto(f"{past.address}/#/vehicle/1/replay")
    late.get_by_role("button", name="Start the replay").wait_for()
    late.wait_for_function("() => [...document.querySelectorAll('input.utc')].filter((one) => one.value).length === 2")
    begin, end = (
        seconds(value) for value in late.locator("input.utc").evaluate_all("all => all.map((one) => one.value)")
    )
    assert near_now(end)
    assert end - begin == 3600.0


def test_what_is_asked_and_written_has_the_stations_time(late: Any, past: Past) -> None:
    """A note is of now, a plan begins when it is made: the page sends no time of its own."""
    bodies: list[dict[str, Any]] = []
    late.on("request", lambda asked: bodies.append(json.loads(asked.post_data)) if asked.post_data else None)
    late.goto(f"{past.address}/#/vehicle/1/plan")
    late.locator("[data-place]").first.wait_for()
    late.wait_for_function("() => document.querySelector('[data-place]')")
    late.get_by_label("Name of the plan").fill("By a wrong clock")
    until(late, lambda: any("plan" in body for body in bodies))
    assert all(body["plan"].get("start_time") is None for body in bodies if "plan" in body)
    late.goto(f"{past.address}/#/vehicle/1/log")
    note = late.get_by_role("textbox", name="Note")
    note.fill("seen by a wrong clock")
    note.press("Control+Enter")
    late.get_by_text("seen by a wrong clock").first.wait_for()
    written = next(
        one for one in httpx.get(f"{past.address}/api/notes").json() if one["words"] == "seen by a wrong clock"
    )
    assert near_now(written["t"])


def test_one_logs_in_and_stays(late: Any, manned: str) -> None:
    """The cookie says how long it lasts, not until when: browsers count that by their own clock."""
    sign_in(late, manned, "vera", "people")
    assert is_wrong(late)
    late.reload()
    late.get_by_text("Signed in as vera").wait_for()
    told = httpx.post(f"{manned}/api/session", json={"name": "vera", "password": PASSWORD})
    cookie = told.headers["set-cookie"].lower()
    assert "max-age=" in cookie
    assert "expires=" not in cookie
    assert math.isfinite(float(re.search(r"max-age=(\d+)", cookie)[1]))  # type: ignore[index]
