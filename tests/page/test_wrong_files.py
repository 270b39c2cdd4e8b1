"""Files that are not what they should be, through the page: a sentence that says what is wrong, and nothing is kept.

Oracle: what the station has afterwards; names of files are shown as they are, and do nothing.
"""

import json
import re
from pathlib import Path
from typing import Any

import httpx
import pytest

from tests.page.conftest import Screenshot
from tests.page.past import Past
from tests.page.waiting import all_asked, passes, until

PNG = b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR" + bytes(400)
PLACE = {"type": "Point", "coordinates": [123.0, 30.0]}
HOSTILE = "<img src=x onerror=alert(1)>"


def picked(name: str, content: bytes) -> Any:
    """A file that a person picks."""
    return {"name": name, "mimeType": "application/octet-stream", "buffer": content}


@pytest.fixture
def charts(page: Any, past: Past) -> Any:
    """The dialog of the chart layers."""
    page.on("dialog", lambda shown: pytest.fail(f"a script of a file's name ran: {shown.message}"))
    page.goto(f"{past.address}/#/map")
    page.get_by_role("button", name="Chart layers").click()
    dialog = page.get_by_role("dialog")
    dialog.get_by_label("File").wait_for()
    return dialog


def layers(past: Past) -> list[str]:
    return [one["name"] for one in httpx.get(f"{past.address}/api/layers").json()]


@pytest.mark.parametrize(
    ("name", "content", "words"),
    [
        ("chart.geojson", PNG, "This file is an image, whatever its name says. Name it .png or .jpg"),
        ("cut.geojson", json.dumps(PLACE).encode()[:-9], "breaks off or has a mistake in it"),
        ("notes.geojson", b"dear diary", "This file is no GeoJSON."),
        ("empty.geojson", b"", "This file is empty."),
        ("table.json", b'{"depth": [1, 2, 3]}', "geojson: has no type; allowed: a FeatureCollection"),
        ("far.geojson", b'{"type": "Point", "coordinates": [500, 30]}', "-180"),
        ("chart.png", b"dear diary", "PNG or JPEG"),
    ],
    ids=["a-png", "cut-off", "a-text", "empty", "another-json", "off-the-globe", "a-text-named-png"],
)
def test_a_chart_that_is_none(
    charts: Any, past: Past, name: str, content: bytes, words: str, screenshot: Screenshot
) -> None:
    charts.get_by_label("File").set_input_files(picked(name, content))
    if name.endswith(".png"):
        for side, value in (("West", "122"), ("South", "30"), ("East", "123"), ("North", "31")):
            charts.get_by_label(side).fill(value)
    charts.get_by_role("button", name="Add to the map").click()
    alert = charts.get_by_role("alert").first
    until(charts.page, lambda: words in alert.inner_text())
    assert "undefined" not in alert.inner_text()
    screenshot(f"wrong-chart-{name}")
    assert layers(past) == []


def test_a_chart_of_100_mb_is_refused_before_it_is_sent(charts: Any, past: Past, tmp_path: Path) -> None:
    large = tmp_path / "world.geojson"
    with large.open("wb") as file:
        file.truncate(100_000_000)
    sent: list[str] = []
    charts.page.on("request", lambda request: sent.append(request.method))
    charts.get_by_label("File").set_input_files(large)
    charts.get_by_role("button", name="Add to the map").click()
    charts.get_by_text("This file has 100").wait_for()
    assert "at most 4.2" in charts.get_by_role("alert").first.inner_text()
    passes(charts.page, 200)
    all_asked(charts.page)
    assert "POST" not in sent


def test_a_chart_that_is_larger_than_the_station_takes_is_told_whatever_the_page_knows(charts: Any, past: Past) -> None:
    """The page's own bound apart: the answer of the station comes through, though it does not read on."""
    told = charts.page.evaluate(
        "fetch('./api/layers', {method: 'POST', headers: {'content-type': 'application/json'}, body: "
        "JSON.stringify({name: 'x', geojson: {type: 'Point', x: 'x'.repeat(6e6)}})})"
        ".then(async (answer) => [answer.status, (await answer.json()).detail.reason])"
    )
    assert told == [413, "the body is too large; at most 4096 kB are taken here"]


def test_a_chart_with_a_hostile_name_is_a_chart_with_that_name(
    charts: Any, page: Any, past: Past, screenshot: Screenshot
) -> None:
    for name in (f"{HOSTILE}.geojson", "..\\..\\x.geojson"):
        charts.get_by_label("File").set_input_files(picked(name, json.dumps(PLACE).encode()))
        until(page, charts.get_by_label("Name").input_value)
        typed = charts.get_by_label("Name").input_value()
        charts.get_by_role("button", name="Add to the map").click()
        page.get_by_role("button", name=typed, exact=True).wait_for()
        page.get_by_role("button", name="Chart layers").click()
    assert HOSTILE in layers(past)
    screenshot("hostile-chart-names")
    assert page.locator("img[src='x']").count() == 0
    for name in layers(past):
        charts.get_by_role("button", name=f"Remove {name}").click()
        charts.get_by_role("button", name=f"Remove {name}").wait_for(state="detached")
    assert layers(past) == []


@pytest.mark.parametrize(
    ("name", "content", "words"),
    [
        ("plan.json", PNG, r"is no plan: it is an image, whatever its name says"),
        ("plan.json", b'{"name": "x", ', r"is no plan: it begins as a plan and breaks off"),
        ("plan.json", b"[1, 2]", r"no plan|not a plan|neither"),
        ("active.orders.toml", b"not = [orders", r"orders|no plan|neither|expected"),
        (f"{HOSTILE}.json", b"{}", r"no plan|not a plan|neither"),
    ],
    ids=["a-png", "cut-off", "another-json", "broken-orders", "hostile-name"],
)
def test_a_plan_that_is_none(
    page: Any, past: Past, name: str, content: bytes, words: str, screenshot: Screenshot
) -> None:
    page.on("dialog", lambda shown: pytest.fail(f"a script of a file's name ran: {shown.message}"))
    page.goto(f"{past.address}/#/vehicle/1/plan")
    page.get_by_role("button", name="Open…").wait_for()
    before = page.get_by_label("Name of the plan").input_value()
    page.get_by_label("Plan file").set_input_files(picked(name, content))
    notice = page.locator(".notice.problem", has_text="The plan on the desk is as it was.").first
    notice.wait_for()
    assert re.search(words, notice.inner_text()), notice.inner_text()
    screenshot(f"wrong-plan-{'hostile' if '<' in name else re.sub('[^a-z]', '', name)}")
    assert page.locator("img[src='x']").count() == 0
    assert page.get_by_label("Name of the plan").input_value() == before, "the plan on the desk stays"


def test_files_for_a_vehicle(page: Any, past: Past, tmp_path: Path, screenshot: Screenshot) -> None:
    from playwright.sync_api import expect

    page.goto(f"{past.address}/#/vehicle/1/files")
    page.get_by_role("button", name="Send a file…").click()
    dialog = page.get_by_role("dialog", name="Send a file")
    send, path = dialog.get_by_role("button", name="Send", exact=True), dialog.get_by_label("Name aboard")
    large = tmp_path / "film.bin"
    with large.open("wb") as file:
        file.truncate(100_000_000)
    dialog.get_by_label("File of this computer").set_input_files(large)
    dialog.get_by_text("this file has 100").wait_for()
    expect(send).to_be_disabled()
    dialog.get_by_label("File of this computer").set_input_files(picked(HOSTILE, b"x"))
    until(page, lambda: path.input_value().endswith(HOSTILE))
    for wrong in ("../../x", "a/../../x", "/x", "x/", ".."):
        path.fill(wrong)
        dialog.get_by_text("no empty").wait_for()
        expect(send).to_be_disabled()
    screenshot("wrong-file-path")
    path.fill(HOSTILE)
    send.click()
    page.get_by_text(f"“{HOSTILE}” is on its way").or_(dialog.get_by_role("alert")).first.wait_for()
    screenshot("hostile-file-name")
    assert page.locator("img[src='x']").count() == 0
    for row in httpx.get(f"{past.address}/api/vehicles/1/transfers").json():
        httpx.post(f"{past.address}/api/transfers/{row['id']}/cancel")
