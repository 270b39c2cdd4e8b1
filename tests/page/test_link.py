"""Link and files on the page, against a real station and a simulated glider."""

import hashlib
import re
from typing import Any

import pytest

from tests.page.manned import told
from tests.page.waiting import becomes, until


@pytest.fixture
def view(page: Any, station: str) -> Any:
    """The link of the simulated glider."""
    page.goto(f"{station}/#/vehicle/1/link")
    page.locator("[data-figure='good']").first.wait_for()
    return page


def test_the_tiles_say_what_the_station_counts_both_ways(view: Any, station: str, screenshot: Any) -> None:
    """Oracle: the counts before and after, from the API, hold what is shown between them."""
    before = told(station, "/vehicles/1/link")["figures"]["good"]

    def shown() -> int:
        return int(re.sub(r"\D", "", view.locator("[data-figure='good'] .value").first.inner_text()))

    until(view, lambda: shown() > before)
    assert shown() <= told(station, "/vehicles/1/link")["figures"]["good"]
    view.get_by_text("as the vehicle hears this station").wait_for(timeout=240_000)
    word = "on" if told(station, "/vehicles/1/link")["figures"]["is_signing"] else "off"
    becomes(view, view.locator("[data-figure='signing'] .value").all_inner_texts, [word, word])
    screenshot("link")


def test_raw_frames_are_filtered_and_taken_apart(view: Any, station: str) -> None:
    """Oracle: MAVLink 2: 0xfd, the length of the payload, and 12 bytes around it."""
    view.get_by_label("Message", exact=True).select_option("HEARTBEAT")
    view.get_by_role("button", name="Follow").click()
    messages = view.locator("tbody tr.pick td:nth-child(3)")
    until(view, lambda: set(messages.all_inner_texts()) == {"HEARTBEAT"})
    row = view.locator("tr.in", has_text="HEARTBEAT").first
    row.click()
    view.locator(".detail .byte").last.wait_for()
    digits = view.get_by_role("img", name="Bytes of the frame").locator(".byte").all_inner_texts()
    assert digits[0] == "fd"
    assert f"payload, {int(digits[1], 16)} bytes" in view.locator(".detail").inner_text()
    assert len(digits) in (int(digits[1], 16) + 12, int(digits[1], 16) + 25)
    frame = told(station, "/vehicles/1/frames?message=HEARTBEAT&limit=1")[0]
    for field in frame["values"]:
        assert view.get_by_role("row", name=re.compile(rf"^{field} ")).count() == 1
    assert set(messages.all_inner_texts()) == {"HEARTBEAT"}


def test_a_file_of_the_vehicle_is_fetched_whole_and_downloaded(page: Any, station: str, screenshot: Any) -> None:
    """Oracle: the SHA-256 of what the browser got, beside the one that the page shows."""
    from playwright.sync_api import expect

    page.goto(f"{station}/#/vehicle/1/files")
    page.get_by_role("button", name="missions/").click(timeout=240_000)
    row = page.locator("tr[data-entry]", has=page.get_by_role("button", name="Fetch")).first
    row.wait_for(timeout=240_000)
    name = row.get_attribute("data-entry")
    row.get_by_role("button", name="Fetch").click()
    link = page.get_by_role("link", name=f"missions/{name}")
    link.wait_for(timeout=240_000)
    page.locator(f"[data-transfer='missions/{name}'][data-state='whole']").wait_for()
    with page.expect_download() as download:
        link.click()
    digest = hashlib.sha256(download.value.path().read_bytes()).hexdigest()
    expect(page.get_by_role("row", name=f"missions/{name}")).to_contain_text(digest[:12])
    screenshot("files")


def test_a_path_that_leaves_the_vehicle_is_told_before_it_is_sent(page: Any, station: str, tmp_path: Any) -> None:
    from playwright.sync_api import expect

    file = tmp_path / "note.txt"
    file.write_text("hello")
    page.goto(f"{station}/#/vehicle/1/files")
    page.get_by_role("button", name="Send a file…").click()
    page.get_by_label("File of this computer").set_input_files(file)
    page.get_by_label("Name aboard, with its folder").fill("../note.txt")
    page.get_by_text("no empty, “.” or “..” folders").wait_for()
    expect(page.get_by_role("dialog").get_by_role("button", name="Send", exact=True)).to_be_disabled()
