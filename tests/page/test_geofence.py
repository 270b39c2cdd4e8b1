"""The geofence on the page, against a real station: drawn by pointer, finger and keys, checked, flown against, sent."""

import json
import time
from typing import Any

import pytest

from tests.page.manned import told


@pytest.fixture
def view(page: Any, station: str) -> Any:
    """The planner with a first plan of four waypoints, whose map changes the geofence."""
    page.goto(f"{station}/#/vehicle/1/plan")
    page.locator("[data-place='waypoints.3']").wait_for(timeout=60_000)
    page.get_by_role("group", name="What the map changes").get_by_role("button", name="Geofence").click()
    return page


def plan(view: Any) -> Any:
    """The plan as the browser keeps it."""
    return json.loads(view.evaluate("localStorage.getItem('stommel-draft-plan.1')"))["plan"]


def fence(view: Any) -> list[tuple[float, float]]:
    """Corners of the plan."""
    return [(corner["latitude_deg"], corner["longitude_deg"]) for corner in plan(view).get("geofence", [])]


def edges(view: Any) -> list[tuple[float, float]]:
    """Points near the corners of the map, around everything that it shows, in order."""
    chart = view.get_by_role("application").bounding_box()
    left, right = chart["x"] + 15, chart["x"] + chart["width"] - 15
    top, bottom = chart["y"] + 8, chart["y"] + chart["height"] - 8
    return [(left, top), (right, top), (right, bottom), (left, bottom)]


def corner(view: Any, number: int) -> Any:
    """A corner on the map."""
    return view.get_by_role("button", name=f"Corner {number}:")


def right(view: Any) -> None:
    """Wait until the station finds nothing wrong."""
    view.locator("[data-problems='0']", has_text="Can be flown").wait_for()


def test_it_is_drawn_by_pointer_and_closed_at_its_first_corner(view: Any, screenshot: Any) -> None:
    for number, at in enumerate(edges(view), 1):
        view.mouse.click(*at)
        view.locator(f"[data-place='geofence.{number - 1}']").wait_for()
        if number == 2:
            view.locator("[data-problems='1']").get_by_text("at least 3").wait_for()
            assert view.get_by_role("button", name="Preview").is_disabled()
    right(view)
    screenshot("planner-fence-drawn")
    corner(view, 1).click()
    view.get_by_text("Drag a corner").wait_for()
    found = fence(view)
    assert len(found) == 4
    assert found[0][0] == pytest.approx(found[1][0], abs=0.02)
    assert found[0][1] < found[1][1]
    chart = view.get_by_role("application").bounding_box()
    view.mouse.click(chart["x"] + 100, chart["y"] + chart["height"] / 2 + 60)
    assert fence(view) == found, "what is closed is not drawn on"


def test_corners_are_dragged_inserted_and_deleted_and_each_is_one_step_back(view: Any) -> None:
    view.get_by_role("button", name="Around the plan").click()
    right(view)
    before = fence(view)
    box = corner(view, 2).bounding_box()
    for far in (6, 12):
        view.mouse.move(box["x"] + box["width"] / 2, box["y"] + box["height"] / 2)
        view.mouse.down()
        view.mouse.move(box["x"] + box["width"] / 2 - far, box["y"] + box["height"] / 2 - far, steps=4)
        view.mouse.up()
        box = corner(view, 2).bounding_box()
    moved = fence(view)
    assert moved[1][0] > before[1][0]
    assert moved[1][1] < before[1][1]
    assert [moved[k] for k in (0, 2, 3)] == [before[k] for k in (0, 2, 3)]
    view.get_by_role("button", name="Undo").click()
    assert before[1] != fence(view)[1] != moved[1], "the second drag alone is undone"
    view.get_by_role("button", name="Undo").click()
    assert fence(view) == before
    view.get_by_role("button", name="Add a corner after 4").dispatch_event("pointerdown")
    between = fence(view)
    assert len(between) == 5
    assert between[4][0] == pytest.approx(before[0][0], abs=0.01), "between the last and the first"
    assert before[0][1] < between[4][1] < before[3][1]
    corner(view, 5).focus()
    view.keyboard.press("Delete")
    assert fence(view) == before
    view.get_by_role("button", name="Clear", exact=True).click()
    assert fence(view) == []
    view.get_by_role("button", name="Undo").click()
    assert fence(view) == before


def test_it_is_drawn_by_keyboard_alone(view: Any) -> None:
    """Enter sets a corner in the middle of the map, arrows move map and corner, Enter on the first closes."""
    chart = view.get_by_role("application")
    chart.focus()
    for key in ("ArrowLeft", "ArrowUp", "ArrowRight"):
        view.keyboard.press("Enter")
        view.keyboard.press(key)
    assert len(fence(view)) == 3
    before = fence(view)
    corner(view, 2).focus()
    view.keyboard.press("ArrowUp")
    assert fence(view)[1][0] > before[1][0]
    corner(view, 1).focus()
    view.keyboard.press("Enter")
    view.get_by_text("Drag a corner").wait_for()
    chart.focus()
    view.keyboard.press("Enter")
    assert len(fence(view)) == 3
    view.keyboard.press("Escape")
    view.get_by_role("button", name="Waypoint 1:").wait_for()


@pytest.mark.parametrize(
    "page", [{"viewport": {"width": 820, "height": 1180}, "has_touch": True, "is_mobile": True}], indirect=True
)
def test_it_is_drawn_by_finger_on_a_tablet(view: Any, screenshot: Any) -> None:
    for at in edges(view):
        view.touchscreen.tap(*at)
    assert len(fence(view)) == 4
    box = corner(view, 3).bounding_box()
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    touch = view.context.new_cdp_session(view)
    for what, points in (
        ("touchStart", [{"x": x, "y": y}]), ("touchMove", [{"x": x - 15, "y": y - 15}]),
        ("touchMove", [{"x": x - 40, "y": y - 30}]), ("touchEnd", []),
    ):  # fmt: skip
        touch.send("Input.dispatchTouchEvent", {"type": what, "touchPoints": points})
    moved = fence(view)
    assert len(moved) == 4
    view.get_by_role("button", name="Undo").click()
    assert fence(view)[2][0] < moved[2][0]
    assert fence(view)[2][1] > moved[2][1]
    view.get_by_role("button", name="Close the area").first.tap()
    view.get_by_text("Drag a corner").wait_for()
    screenshot("planner-fence-tablet")


def test_what_is_wrong_is_told_at_once_beside_what_it_is(view: Any) -> None:
    first, second, third, fourth = edges(view)
    for at in (first, third, second, fourth):
        view.mouse.click(*at)
    view.get_by_text("the side from corner 1 to 2 crosses that from corner 3 to 4").first.wait_for()
    view.locator("[data-problems] li button").first.click()
    assert view.locator("[data-section='geofence']").evaluate("one => one.open")
    view.get_by_role("button", name="Around the plan").click()
    right(view)
    place = plan(view)["waypoints"][1]
    field = view.get_by_label("Waypoint 2, latitude", exact=True)
    field.fill(f"{place['latitude_deg'] + 3:.3f}")
    field.press("Tab")
    view.locator("[data-problems]").get_by_text("must lie within the geofence").wait_for()
    assert view.locator("[data-place='waypoints.1'] input[aria-invalid='true']").count() == 1


def test_corners_are_typed_and_a_wrong_one_stays_with_its_row(view: Any) -> None:
    view.get_by_role("button", name="Around the plan").click()
    right(view)
    before = fence(view)
    field = view.get_by_label("Corner 2, latitude", exact=True)
    field.fill("28 95 N")
    field.press("Tab")
    view.get_by_text("is no latitude").first.wait_for()
    assert fence(view) == before
    view.get_by_role("button", name="Delete corner 1").click()
    assert view.get_by_label("Corner 1, latitude", exact=True).input_value() == "28 95 N"
    view.get_by_label("Corner 1, latitude", exact=True).fill("29 30 N")
    view.get_by_label("Corner 1, latitude", exact=True).press("Tab")
    assert fence(view)[0][0] == 29.5
    view.get_by_label("Corner 1, latitude", exact=True).press("Control+Enter")
    assert len(fence(view)) == 4


def test_it_may_lie_across_the_date_line_but_not_around_the_earth(view: Any, tmp_path: Any, screenshot: Any) -> None:
    """Oracle: the plan of the desk, moved to the date line."""
    places = [
        {"latitude_deg": 10.0 + 0.02 * k, "longitude_deg": lon} for k, lon in enumerate((179.98, -179.99, 179.99))
    ]
    other = {key: value for key, value in plan(view).items() if key != "neutral_density_kg_m3"}
    path = tmp_path / "line.json"
    path.write_text(json.dumps({**other, "start": places[0], "waypoints": places[1:], "water": {"ocean": "uniform"}}))
    view.get_by_label("Plan file").set_input_files(path)
    view.get_by_text("line.json is on the desk").wait_for()
    view.get_by_role("button", name="Around the plan").click()
    assert {round(abs(longitude)) for _, longitude in fence(view)} == {180}
    assert len({longitude > 0 for _, longitude in fence(view)}) == 2
    right(view)
    screenshot("planner-date-line")
    view.get_by_label("Corner 2, longitude", exact=True).fill("60 E")
    view.get_by_label("Corner 2, longitude", exact=True).press("Tab")
    view.get_by_label("Corner 3, longitude", exact=True).fill("60 W")
    view.get_by_label("Corner 3, longitude", exact=True).press("Tab")
    view.locator("[data-problems]").get_by_text("less than 180 deg of longitude wide").wait_for()


def test_the_predicted_track_is_held_against_it(view: Any, screenshot: Any) -> None:
    """Oracle: a fence with no room for the drift of a dive: the track must leave it, and the map says where."""
    whole = plan(view)
    places = [whole["start"], *whole["waypoints"]]
    view.get_by_role("button", name="Around the plan").click()
    right(view)
    south = min(place["latitude_deg"] for place in places) - 0.0004
    west = min(place["longitude_deg"] for place in places) - 0.0004
    for number, axis, value in ((1, "latitude", south), (4, "latitude", south), (1, "longitude", west)):
        view.get_by_label(f"Corner {number}, {axis}", exact=True).fill(f"{value:.5f}")
        view.get_by_label(f"Corner {number}, {axis}", exact=True).press("Tab")
    view.get_by_label("Corner 2, longitude", exact=True).fill(f"{west:.5f}")
    view.get_by_label("Corner 2, longitude", exact=True).press("Tab")
    right(view)
    jobs: list[dict[str, Any]] = []
    view.on("response", lambda answer: jobs.append(answer.json()) if "/api/jobs/" in answer.url and answer.ok else None)
    view.get_by_role("button", name="Preview").click()
    view.get_by_text("the predicted track leaves the geofence after").wait_for(timeout=180_000)
    left = next(job["result"] for job in reversed(jobs) if job["state"] == "done")["left_geofence"]
    assert left["lat"] < south or left["lon"] < west
    screenshot("planner-fence-left")


def test_it_goes_with_the_mission_and_the_map_of_the_vehicle_has_it(view: Any, station: str) -> None:
    """Oracle: what the station tells of the mission aboard, and the page's own plan."""
    name = "Within a fence"
    view.get_by_label("Name of the plan").fill(name)
    view.get_by_role("button", name="Around the plan").click()
    right(view)
    corners = fence(view)
    view.get_by_role("button", name="Upload…").click()
    dialog = view.get_by_role("dialog", name="Upload")
    until = time.monotonic() + 120.0
    while dialog.count() and time.monotonic() < until:
        dialog.get_by_role("button", name="Upload", exact=True).click()
        dialog.get_by_role("alert").or_(view.get_by_text("is on its way to")).first.wait_for(timeout=60_000)
    view.locator("[data-mission][data-state='aboard']", has_text=name).wait_for(timeout=240_000)
    aboard = told(station, "/vehicles/1/mission")
    assert [(place["latitude"], place["longitude"]) for place in aboard["geofence"]] == corners
    assert told(station, "/vehicles/1/mission/comparison")["left_geofence"] is None
    kept = told(station, f"/vehicles/1/missions/{aboard['mission']['id']}")["plan"]["geofence"]
    assert [(place["latitude_deg"], place["longitude_deg"]) for place in kept] == corners
    view.get_by_text("Within its geofence").wait_for(timeout=30_000)
