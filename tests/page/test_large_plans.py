"""Plans that are large or lie where maps are awkward: 200 waypoints, two months, the pole; all seen where they are."""

import json
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

Open = Callable[..., dict[str, Any]]
NEVER = {"geofence", "neutral_density_kg_m3", "start_time"}
"""Keys of the vehicle's own water and place."""


def plan(view: Any) -> Any:
    """The plan as the browser keeps it."""
    return json.loads(view.evaluate("localStorage.getItem('stommel-draft-plan.1')"))["plan"]


def place(latitude: float, longitude: float) -> dict[str, float]:
    """A place of a plan."""
    return {"latitude_deg": round(latitude, 5), "longitude_deg": round(longitude, 5)}


@pytest.fixture
def view(page: Any, station: str) -> Any:
    """The planner with a first plan on its desk."""
    page.goto(f"{station}/#/vehicle/1/plan")
    page.locator("[data-place='waypoints.0']").wait_for(timeout=60_000)
    return page


@pytest.fixture
def opened(view: Any, tmp_path: Path) -> Open:
    """Lays a plan on the desk as a file, and waits until the station has checked it."""

    def lay(**changes: Any) -> dict[str, Any]:
        whole = {key: value for key, value in plan(view).items() if key not in NEVER} | changes
        path = tmp_path / "large.json"
        path.write_text(json.dumps(whole))
        view.get_by_label("Plan file").set_input_files(path)
        view.get_by_text("large.json is on the desk").wait_for(timeout=60_000)
        view.locator("[data-problems='0']", has_text="Can be flown").wait_for(timeout=240_000)
        found: dict[str, Any] = plan(view)
        return found

    return lay


def preview(view: Any) -> str:
    """What a preview says."""
    view.get_by_role("button", name="Preview").click()
    view.get_by_text("Way over ground").wait_for(timeout=180_000)
    said: str = view.get_by_label("Preview by the simulator").inner_text()
    return said


def is_in_view(view: Any, name: str) -> bool:
    """Whether a mark lies within the map."""
    mark, chart = view.get_by_role("button", name=name).bounding_box(), view.get_by_role("application").bounding_box()
    across = chart["x"] <= mark["x"] and mark["x"] + mark["width"] <= chart["x"] + chart["width"]
    return bool(across and chart["y"] <= mark["y"] and mark["y"] + mark["height"] <= chart["y"] + chart["height"])


def test_two_hundred_waypoints_over_two_months_are_edited_and_flown(view: Any, opened: Open, screenshot: Any) -> None:
    """A survey of ten lines. Oracles: the plan that was opened; the station takes no more than 200."""
    lines = [
        place(28.7 + 0.03 * (k // 20), 126.1 + 0.03 * (k % 20 if k // 20 % 2 == 0 else 19 - k % 20)) for k in range(200)
    ]
    way = {"acceptance_radius_m": 500, "repeat": False}
    before = opened(start=place(28.68, 126.08), waypoints=lines, duration_days=60, guidance=way)
    assert is_in_view(view, "Waypoint 1:")
    assert is_in_view(view, "Waypoint 181:")
    mark = view.get_by_role("button", name="Waypoint 110:").bounding_box()
    view.mouse.move(mark["x"] + mark["width"] / 2, mark["y"] + mark["height"] / 2)
    view.mouse.down()
    view.mouse.move(mark["x"] + 20, mark["y"] + 20, steps=3)
    view.mouse.up()
    changed = [k for k, one in enumerate(plan(view)["waypoints"]) if one != lines[k]]
    assert changed == [109]
    view.get_by_role("button", name="Undo").click()
    assert plan(view) == before
    view.get_by_role("button", name="Insert after 7", exact=True).click()
    assert len(plan(view)["waypoints"]) == 200, "no more are taken"
    screenshot("planner-200-waypoints")
    assert "of 200 waypoints reached" in preview(view)
    screenshot("planner-60-days")


@pytest.mark.parametrize("south", [False, True])
def test_a_plan_near_a_pole_is_where_it_is_and_fits_its_fence(
    south: bool, view: Any, opened: Open, screenshot: Any
) -> None:
    """At 80 deg, in the south across the date line. Oracle: 0.01 deg of latitude is 1.1 km, as everywhere."""
    sign, east = (-1.0, 179.95) if south else (1.0, 5.0)
    turned = lambda longitude: (longitude + 180.0) % 360.0 - 180.0  # noqa: E731
    places = [
        place(sign * 80.0, turned(east)),
        place(sign * 80.01, turned(east)),
        place(sign * 80.0, turned(east + 0.1)),
    ]
    water = {"ocean": "uniform", "current": "still"}
    once = {"acceptance_radius_m": 500, "repeat": False}
    opened(start=places[0], waypoints=places[1:], water=water, duration_days=1, guidance=once)
    assert is_in_view(view, "Waypoint 2:")
    leg = view.locator("[data-place='waypoints.0'] .leg").inner_text()
    assert leg.split()[0].startswith("1.1")
    assert ("180" if south else "000") in leg
    view.get_by_role("group", name="What the map changes").get_by_role("button", name="Geofence").click()
    view.get_by_role("button", name="Around the plan").click()
    view.locator("[data-problems='0']", has_text="Can be flown").wait_for(timeout=240_000)
    assert "All 2 waypoints reached" in preview(view)
    assert view.get_by_text("leaves the geofence").count() == 0
    screenshot(f"planner-pole-{'south' if south else 'north'}")


def test_the_map_goes_to_where_an_opened_plan_is(view: Any, opened: Open) -> None:
    """However it was moved before."""
    view.get_by_role("application").focus()
    for _ in range(5):
        view.keyboard.press("ArrowLeft")
    opened(start=place(10.0, 179.99), waypoints=[place(10.02, -179.98)], water={"ocean": "uniform"})
    until = time.monotonic() + 30.0
    while not is_in_view(view, "Waypoint 1:") and time.monotonic() < until:
        view.wait_for_timeout(100)
    assert is_in_view(view, "Waypoint 1:")
