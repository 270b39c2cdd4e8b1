"""Lists that end say so, or go on. Oracle: answers that are made up, longer than a view shows."""

from typing import Any
from urllib.parse import parse_qs, urlsplit

import httpx
import pytest

from tests.page.past import Past

expect = pytest.importorskip("playwright.sync_api").expect
T = 1_782_864_000.0


def answers(page: Any, path: str, rows: list[dict[str, Any]]) -> None:
    """Let the station answer a path with as many of some rows as the page asks for."""

    def some(route: Any) -> None:
        limit = int(parse_qs(urlsplit(route.request.url).query)["limit"][0])
        route.fulfill(json=rows[:limit])

    page.route(f"**/api/vehicles/1/{path}?*", some)


def test_older_transfers_are_shown_when_asked_for_with_who_and_when(page: Any, past: Past, screenshot: Any) -> None:
    transfer = {
        "vehicle": 1, "direction": "download", "user": "ada", "t": T, "state": "whole", "is_over": True, "size": 5,
        "is_paused": False, "reason": "", "done": 5, "sha256": None, "rate": None, "seconds_left": None,
        "loss_share": None,
    }  # fmt: skip
    answers(page, "transfers", [transfer | {"id": 1200 - k, "path": f"log/{k}"} for k in range(1200)])
    page.goto(f"{past.address}/#/vehicle/1/files")
    rows = page.locator("[data-transfer]")
    expect(rows).to_have_count(20)
    expect(rows.first).to_contain_text("ada, 2026-07-01 00:00 UTC")
    screenshot("files-transfers")
    older = page.get_by_role("button", name="Older")
    for shown in (80, 320, 1000):
        older.click()
        expect(rows).to_have_count(shown)
    page.get_by_text("These are the last 1000; older ones are not listed.").wait_for()


def test_older_missions_and_the_steps_of_each_are_shown(page: Any, past: Past, screenshot: Any) -> None:
    mission = {
        "vehicle": 1, "name": "survey", "user": "ada", "t": T, "state": "aboard", "words": "", "sha256": "0" * 64,
    }  # fmt: skip
    answers(page, "missions", [mission | {"id": 700 - k} for k in range(700)])
    steps = [
        {"t": T, "user": "ada", "state": "waiting", "words": ""},
        {"t": T + 60.0, "user": None, "state": "aboard", "words": "at the surface"},
    ]
    whole = mission | {"id": 700, "orders": "", "plan": None, "history": steps}
    page.route("**/api/vehicles/1/missions/700", lambda route: route.fulfill(json=whole))
    page.goto(f"{past.address}/#/vehicle/1/plan")
    page.get_by_role("tab", name="Aboard and compared").or_(page.get_by_text("Aboard and compared")).first.click()
    rows = page.locator("[data-mission]")
    expect(rows).to_have_count(100)
    page.get_by_role("button", name="Steps of survey").first.click()
    told = page.get_by_role("list", name="Steps").get_by_role("listitem")
    expect(told).to_have_text(
        [
            "2026-07-01 00:00:00 UTC: waits for the vehicle, ada",
            "2026-07-01 00:01:00 UTC: the vehicle has switched to it; at the surface",
        ]
    )
    screenshot("planner-steps")
    page.get_by_role("button", name="Older").click()
    expect(rows).to_have_count(500)
    page.get_by_text("These are the last 500; older ones are not listed.").wait_for()


def test_frames_can_be_filtered_by_every_message_that_the_archive_has(page: Any, past: Past) -> None:
    """One message came before all the frames that a page of the list holds."""
    past.speaker.say("GLIDER_STATE", time_boot_ms=1, depth=1.0)
    for k in range(120):
        past.speaker.say("ATTITUDE", time_boot_ms=k)
    page.goto(f"{past.address}/#/vehicle/1/link")
    select = page.get_by_role("combobox", name="Message")
    expect(select).to_contain_text("GLIDER_STATE")
    expect(select).to_contain_text("ATTITUDE")
    told = httpx.get(f"{past.address}/api/vehicles/1/messages", timeout=60.0).json()
    expect(select.get_by_role("option")).to_have_text(["all messages", *told])
    select.select_option("GLIDER_STATE")
    expect(page.get_by_role("region", name="Raw frames").locator("tbody tr").first).to_contain_text("GLIDER_STATE")


@pytest.mark.parametrize(
    "page", [{"viewport": {"width": width, "height": 768}} for width in (1024, 1440)], indirect=True
)
def test_a_long_history_of_alarms_lies_over_nothing(page: Any, past: Past, screenshot: Any) -> None:
    """On a tablet and on a desk: what stands below and beside it can be reached. Oracle: boxes of the page."""
    alarm = {
        "vehicle": 1, "key": "limit:depth_m:high", "words": "Depth greater than 200 m", "severity": "critical",
        "acknowledged": T, "acknowledged_by": "ada", "value": 230.0, "note": None,
    }  # fmt: skip

    rows = [alarm | {"id": 200 - k, "raised": T - 3600.0 * k, "cleared": T - 3600.0 * k + 60.0} for k in range(100)]

    def history(route: Any) -> None:
        asked = parse_qs(urlsplit(route.request.url).query)
        route.fulfill(json=rows if asked.get("acknowledged") == ["true"] else [])

    page.route("**/api/alarms?*", history)
    page.goto(f"{past.address}/#/vehicle/1/alarms")
    panel = page.get_by_role("region", name="History", exact=True)
    expect(panel.locator("tbody tr")).to_have_count(100)
    screenshot(f"alarms-long-{page.viewport_size['width']}")
    whole, older = panel.bounding_box(), page.get_by_role("button", name="Older alarms").bounding_box()
    assert older["y"] + older["height"] <= whole["y"] + whole["height"]
    page.get_by_role("button", name="Add a limit").click()
    page.get_by_label("Least value").wait_for()
