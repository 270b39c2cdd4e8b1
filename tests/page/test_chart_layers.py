"""Chart layers and alerts, as an admin sets them on the page. Oracle: what the station tells of them afterwards."""

import io
import json
from pathlib import Path
from typing import Any

import httpx
from PIL import Image

from tests.page.past import Past
from tests.page.waiting import at_rest

REEF = {"type": "Polygon", "coordinates": [[[123.01, 30.01], [123.03, 30.015], [123.02, 30.03], [123.01, 30.01]]]}


def layers(past: Past) -> list[dict[str, Any]]:
    """As the station has them."""
    found: list[dict[str, Any]] = httpx.get(f"{past.address}/api/layers").json()
    return found


def test_a_chart_of_geojson_and_one_of_an_image_are_added_and_removed(
    page: Any, past: Past, screenshot: Any, tmp_path: Path
) -> None:
    (tmp_path / "reef.geojson").write_text(json.dumps(REEF))
    (tmp_path / "broken.geojson").write_text("{")
    drawn = io.BytesIO()
    Image.new("RGB", (40, 20), (90, 120, 160)).save(drawn, "PNG")
    (tmp_path / "chart.png").write_bytes(drawn.getvalue())

    page.goto(f"{past.address}/#/map")
    page.get_by_role("button", name="Chart layers").click()
    dialog = page.get_by_role("dialog")
    dialog.get_by_label("File").set_input_files(tmp_path / "broken.geojson")
    dialog.get_by_role("button", name="Add to the map").click()
    dialog.get_by_text("This file begins as GeoJSON and breaks off").wait_for()
    dialog.get_by_label("File").set_input_files(tmp_path / "reef.geojson")
    dialog.get_by_label("Name").fill("Reef")
    dialog.get_by_role("button", name="Add to the map").click()
    page.get_by_role("button", name="Reef", exact=True).wait_for()
    assert [(one["name"], one["kind"], one["content"]) for one in layers(past)] == [("Reef", "geojson", REEF)]

    page.get_by_role("button", name="Chart layers").click()
    dialog.get_by_label("File").set_input_files(tmp_path / "chart.png")
    for side, value in (("West", "122.95"), ("South", "30.01"), ("East", "122.9"), ("North", "30.035")):
        dialog.get_by_label(side).fill(value)
    dialog.get_by_role("button", name="Add to the map").click()
    dialog.get_by_text("must be less than east").wait_for()
    dialog.get_by_label("East").fill("122.99")
    screenshot("chart-layers")
    dialog.get_by_role("button", name="Add to the map").click()
    page.get_by_role("button", name="chart", exact=True).wait_for()
    assert layers(past)[1]["bounds"] == [122.95, 30.01, 122.99, 30.035]
    at_rest(page)
    screenshot("map-with-chart-layers")

    page.get_by_role("button", name="Chart layers").click()
    for name in ("Reef", "chart"):
        dialog.get_by_role("button", name=f"Remove {name}").click()
        dialog.get_by_role("button", name=f"Remove {name}").wait_for(state="detached")
    assert layers(past) == []


def test_the_page_says_that_nobody_who_is_away_is_told(page: Any, past: Past, screenshot: Any) -> None:
    page.goto(f"{past.address}/#/vehicle/1/alarms")
    ways = page.get_by_role("region", name="Alerts to people who are away")
    ways.get_by_text("Nobody is told.").wait_for()
    assert ways.get_by_role("button", name="Send a test").count() == 0
    screenshot("alarms-and-alerts")
