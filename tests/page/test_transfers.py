"""Transfers on the page: paused, resumed, cancelled. Oracle: the bytes aboard, and what the vehicle was asked for."""

import hashlib
import re
from typing import Any

import pytest

from tests.page.played_station import PlayedStation
from tests.page.quay import FILES, LOGS, LONG, SHORT, Quay
from tests.page.waiting import becomes, passes, until


@pytest.fixture
def view(page: Any, quay: Quay) -> Any:
    """The files of the vehicle, in the folder of the missions."""
    page.goto(f"{quay.address}/#/vehicle/1/files")
    page.get_by_role("button", name="missions/").click()
    return page


def row(view: Any, path: tuple[str, str]) -> Any:
    """A transfer that is not over, or the last one."""
    return view.locator(f"[data-transfer='{'/'.join(path)}']").first


def percent(view: Any, path: tuple[str, str]) -> int:
    """How far it is, as a bar tells people who do not see it."""
    return int(row(view, path).get_by_role("progressbar").get_attribute("aria-valuenow") or 0)


def fetch(view: Any, path: tuple[str, str]) -> None:
    """Begin, and wait until something has come."""
    view.get_by_role("button", name=f"Fetch {path[-1]}").click()
    row(view, path).wait_for()


def test_a_transfer_rests_while_it_is_paused_and_goes_on_where_it_was(view: Any, quay: Quay, screenshot: Any) -> None:
    """yamcs/yamcs#956, #1153: after a resume the missing part is asked for, and only that."""
    name = "/".join(SHORT)
    fetch(view, SHORT)
    until(view, lambda: percent(view, SHORT) >= 5)
    row(view, SHORT).get_by_role("button", name=f"Pause {name}").click()
    row(view, SHORT).get_by_text("paused; goes on where it was").wait_for()
    passes(view, 500)  # what was under way may still come
    read, at = len(quay.vehicle.files.reads), percent(view, SHORT)
    assert at < 100
    screenshot("transfer-paused")
    view.reload()
    row(view, SHORT).get_by_text("paused; goes on where it was").wait_for()
    assert percent(view, SHORT) >= at
    assert len(quay.vehicle.files.reads) - read <= 1, "the vehicle is asked for nothing while it rests"
    row(view, SHORT).get_by_role("button", name=f"Resume {name}").click()
    becomes(view, lambda: row(view, SHORT).get_attribute("data-state"), "whole")
    assert row(view, SHORT).get_by_role("button").count() == 0
    ashore = view.get_by_role("region", name="Files ashore").get_by_role("row", name=name)
    ashore.get_by_text(hashlib.sha256(FILES[SHORT]).hexdigest()[:12]).wait_for()


def test_a_cancelled_transfer_is_over_and_can_be_begun_anew(view: Any, screenshot: Any) -> None:
    name = "/".join(LONG)
    fetch(view, LONG)
    row(view, LONG).get_by_role("button", name=f"Cancel {name}").click()
    becomes(view, lambda: row(view, LONG).get_attribute("data-state"), "cancelled")
    row(view, LONG).get_by_text("cancelled by a person").wait_for()
    assert row(view, LONG).get_by_role("button").count() == 0
    view.get_by_role("button", name=f"Fetch {LONG[-1]}").wait_for()
    assert view.get_by_role("region", name="Files ashore").get_by_role("row", name=name).count() == 0
    screenshot("transfer-cancelled")


def test_a_log_comes_by_itself_and_says_so(page: Any, quay: Quay, screenshot: Any) -> None:
    """Oracle: `fetch = "essential"` of the station's settings; nobody asked for the file."""
    page.goto(f"{quay.address}/#/vehicle/1/files")
    log = page.locator(f"[data-transfer='log/{LOGS[0]}'][data-state='whole']")
    log.get_by_text("fetched by itself").wait_for()
    page.get_by_role("region", name="Files ashore").get_by_role("link", name=f"log/{LOGS[0]}").wait_for()
    screenshot("log-by-itself")


def test_a_folder_that_a_diving_vehicle_did_not_tell_is_asked_for_when_it_is_heard_again(
    page: Any, fake_station: str, played: PlayedStation
) -> None:
    """It is asked once for each time that it comes up, as far as it has not told it."""
    asked: list[str] = []
    entries = [{"name": "missions", "size": 0, "is_folder": True}]

    def answer(route: Any) -> None:
        asked.append(route.request.url)
        refused = {"detail": {"reason": "vehicle 1 is not heard: it dives"}}
        told = {"folder": "", "entries": entries}
        route.fulfill(status=200 if len(asked) == 3 else 409, json=told if len(asked) == 3 else refused)

    page.route("**/api/vehicles/1/listing*", answer)
    page.goto(f"{fake_station}/#/vehicle/1/files")
    for times in (1, 2):
        page.get_by_role("button", name="Ask again").nth(1).wait_for()
        assert len(asked) == times
        played.sum_up(1, heard=False)
        page.get_by_text(re.compile("^silent")).first.wait_for()
        played.sum_up(1)
    page.get_by_role("button", name="missions/").wait_for()
    assert len(asked) == 3
    played.sum_up(1, heard=False)
    page.get_by_text(re.compile("^silent")).first.wait_for()
    played.sum_up(1)
    passes(page, 400)
    assert len(asked) == 3
