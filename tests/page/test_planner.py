"""The planner on the page, against a real station: draw, type, check, preview, upload, compare."""

import json
import time
from typing import Any

import pytest

from stommel.planning.vehicle_limits import vehicle_limits
from stommel.vehicle import load_vehicle
from tests.page.manned import told
from tests.page.waiting import becomes, comes_to_rest, until


@pytest.fixture
def view(page: Any, station: str) -> Any:
    """The planner with a first plan of four waypoints on its desk."""
    page.goto(f"{station}/#/vehicle/1/plan")
    page.locator("[data-place='waypoints.3']").wait_for(timeout=240_000)
    return page


def plan(view: Any) -> Any:
    """The plan as the browser keeps it."""
    until(view, lambda: view.evaluate("localStorage.getItem('stommel-draft-plan.1') !== null"))
    return json.loads(view.evaluate("localStorage.getItem('stommel-draft-plan.1')"))["plan"]


def cell(view: Any, number: int, axis: str) -> Any:
    """A field of the table."""
    return view.get_by_label(f"Waypoint {number}, {axis}", exact=True)


def test_places_are_typed_as_people_write_them(view: Any) -> None:
    """Oracle: 28 deg 42.5 min north is 28 + 42.5 / 60."""
    for typed, degrees in (("28 42.5 N", 28 + 42.5 / 60), ("28.75", 28.75), ("28°30'36\"N", 28.51)):
        cell(view, 2, "latitude").fill(typed)
        cell(view, 2, "latitude").press("Tab")
        becomes(view, lambda: plan(view)["waypoints"][1]["latitude_deg"], pytest.approx(degrees, abs=1e-9))


def test_what_is_no_latitude_is_told_kept_as_typed_and_never_sent(view: Any) -> None:
    from playwright.sync_api import expect

    before = plan(view)
    cell(view, 2, "latitude").fill("95")
    cell(view, 2, "latitude").press("Tab")
    expect(cell(view, 2, "latitude")).to_have_attribute("aria-invalid", "true")
    view.get_by_text("is no latitude").first.wait_for()
    assert plan(view) == before
    expect(view.get_by_role("button", name="Preview")).to_be_disabled()
    view.reload()
    view.locator("[data-place='waypoints.3']").wait_for()
    expect(cell(view, 2, "latitude")).to_have_value("95")


def test_waypoints_are_inserted_moved_deleted_and_had_back_by_keyboard(view: Any) -> None:
    places = plan(view)["waypoints"]
    cell(view, 1, "latitude").focus()
    view.keyboard.press("Control+Enter")
    view.locator("[data-place='waypoints.4']").wait_for()
    middle = (places[0]["latitude_deg"] + places[1]["latitude_deg"]) / 2
    becomes(view, lambda: plan(view)["waypoints"][1]["latitude_deg"], pytest.approx(middle, abs=1e-5))
    between = plan(view)["waypoints"][1]
    cell(view, 1, "latitude").focus()
    view.keyboard.press("Alt+ArrowDown")
    becomes(view, lambda: plan(view)["waypoints"][1], places[0])
    cell(view, 2, "latitude").focus()
    view.keyboard.press("Control+Delete")
    becomes(view, lambda: plan(view)["waypoints"], [between, *places[1:]])
    for _ in range(3):
        view.get_by_role("button", name="Undo").click()
    becomes(view, lambda: plan(view)["waypoints"], places)
    view.get_by_role("button", name="Redo").click()
    becomes(view, lambda: len(plan(view)["waypoints"]), 5)


def test_waypoints_are_drawn_dragged_and_deleted_on_the_map(view: Any) -> None:
    places = plan(view)["waypoints"]
    mark = view.get_by_role("button", name="Waypoint 3:")
    box = comes_to_rest(view, mark.bounding_box)
    view.mouse.move(box["x"] + box["width"] / 2, box["y"] + box["height"] / 2)
    view.mouse.down()
    view.mouse.move(box["x"] + 60, box["y"] + 60, steps=5)
    view.mouse.up()
    until(view, lambda: plan(view)["waypoints"] != places)
    moved = comes_to_rest(view, lambda: plan(view)["waypoints"])
    assert moved[2]["latitude_deg"] < places[2]["latitude_deg"]
    assert moved[2]["longitude_deg"] > places[2]["longitude_deg"]
    assert [moved[k] for k in (0, 1, 3)] == [places[k] for k in (0, 1, 3)]
    view.get_by_role("button", name="Undo").click()
    becomes(view, lambda: plan(view)["waypoints"], places)  # one drag is one step
    chart = view.get_by_role("application").bounding_box()
    view.mouse.click(chart["x"] + chart["width"] - 120, chart["y"] + chart["height"] - 80)
    view.locator("[data-place='waypoints.4']").wait_for()
    view.get_by_role("button", name="Waypoint 5:").focus()
    view.keyboard.press("Delete")
    becomes(view, lambda: plan(view)["waypoints"], places)


def test_a_depth_that_the_vehicle_cannot_is_told_beside_its_field(view: Any) -> None:
    """Oracle: the rating of the vehicle's file."""
    from playwright.sync_api import expect

    rating = vehicle_limits(load_vehicle("zju")).depth_rating_m
    field = view.locator("[data-key='dives.depth_m']")
    field.fill(f"{rating + 1:g}")
    said = view.locator("[id$='-said']", has_text=f"{rating:g} m").first
    said.wait_for()
    expect(field).to_have_attribute("aria-invalid", "true")
    view.locator("[data-problems='1']").wait_for()
    view.locator("[data-problems] li button").click()
    expect(field).to_be_focused()
    field.fill("60")
    view.locator("[data-problems='0']").wait_for()


def test_problems_that_the_station_finds_stand_beside_their_fields(view: Any) -> None:
    """Field by field the plan is right; together it is not: the abort must lie below the dive."""
    longest = view.locator("[data-key='surface.longest_s']")
    longest.fill("61")
    view.locator("[data-problems]", has_text="thing").wait_for(timeout=240_000)
    view.get_by_text("must not be less than surface.session_s").first.wait_for()


def test_a_plan_is_saved_and_opened_as_a_file_and_a_wrong_file_changes_nothing(view: Any, tmp_path: Any) -> None:
    view.get_by_label("Name of the plan").fill("To the ridge")
    becomes(view, lambda: plan(view)["name"], "To the ridge")
    before = plan(view)
    with view.expect_download() as download:
        view.get_by_role("button", name="Save", exact=True).click()
    path = tmp_path / download.value.suggested_filename
    download.value.save_as(path)
    assert path.name == "To-the-ridge.json"
    assert json.loads(path.read_text()) == before
    wrong = tmp_path / "wrong.json"
    wrong.write_text('{"name": "x"}')
    view.get_by_label("Plan file").set_input_files(wrong)
    view.get_by_text("wrong.json is no plan").wait_for()
    assert plan(view) == before
    other = tmp_path / "other.json"
    other.write_text(json.dumps({**before, "name": "Another", "waypoints": before["waypoints"][:2]}))
    view.get_by_label("Plan file").set_input_files(other)
    view.get_by_text("other.json is on the desk").wait_for()
    becomes(view, lambda: (plan(view)["name"], len(plan(view)["waypoints"])), ("Another", 2))
    view.get_by_role("button", name="Undo").click()
    becomes(view, lambda: plan(view), before)


def test_a_preview_tells_what_the_simulator_found_and_grows_old_with_the_plan(view: Any, screenshot: Any) -> None:
    """Issue: predicted track, time, energy and dives from the simulator before upload. Oracle: the job's result."""
    jobs: list[dict[str, Any]] = []
    view.on("response", lambda answer: jobs.append(answer.json()) if "/api/jobs/" in answer.url and answer.ok else None)
    with view.expect_response("**/api/plans/preview"):
        view.get_by_role("button", name="Preview").click()
    view.get_by_text("Way over ground").wait_for(timeout=400_000)
    result = next(job["result"] for job in reversed(jobs) if job["state"] == "done")
    shown = view.get_by_label("Preview by the simulator").inner_text()
    assert str(result["dive_count"]) in shown
    assert f"{100 * result['battery_left_share']:.0f} %" in shown
    assert f"{result['energy_j'] / 3600:.0f} Wh" in shown
    screenshot("planner")
    view.get_by_text("Waypoints and dives, one by one").click()
    waypoints = view.get_by_role("table", name="When each waypoint is reached").locator("tbody tr")
    becomes(view, waypoints.count, len(result["waypoints"]))
    for row, told_of in zip(waypoints.all_inner_texts(), result["waypoints"], strict=True):
        reached = told_of["reached_utc"]
        assert ("not reached" in row) != told_of["reached"]
        assert reached is None or reached[11:16] in row
    dives = view.get_by_role("table", name="Predicted dives").locator("tbody tr")
    assert dives.count() == min(200, len(result["dives"]))
    assert f"{result['dives'][0]['greatest_depth_m']:.0f}" in dives.first.inner_text()
    screenshot("planner-foreseen")
    view.locator("[data-key='dives.depth_m']").fill("50")
    view.get_by_text("Of the plan before its last changes").wait_for()


def test_a_preview_is_cancelled(view: Any) -> None:
    view.locator("[data-section='']").locator("summary").click()
    view.locator("[data-key='duration_days']").fill("300")
    view.get_by_role("button", name="Preview").click()
    cancel = view.get_by_label("Preview by the simulator").get_by_role("button", name="Cancel")
    cancel.wait_for()
    with view.expect_response(lambda answer: "/api/jobs/" in answer.url and answer.request.method == "DELETE") as over:
        cancel.click()
    assert over.value.ok
    cancel.wait_for(state="detached")


def test_a_plan_is_uploaded_and_followed_until_the_vehicle_has_switched(
    view: Any, station: str, screenshot: Any
) -> None:
    """Oracle: the mission that the vehicle itself says it holds; what the preview told, which outlives the page."""
    jobs: list[dict[str, Any]] = []
    view.on("response", lambda answer: jobs.append(answer.json()) if "/api/jobs/" in answer.url and answer.ok else None)
    name = "Uploaded by a test"
    view.get_by_label("Name of the plan").fill(name)
    view.get_by_role("button", name="Upload…").click()
    dialog = view.get_by_role("dialog", name="Upload")
    dialog.get_by_text("was not previewed").wait_for()
    dialog.get_by_role("button", name="Do not upload").click()
    view.get_by_role("button", name="Preview").click()
    view.get_by_text("predicted, plan on the desk", exact=True).wait_for(timeout=400_000)
    view.get_by_role("button", name="Upload…").click()
    dialog.get_by_role("button", name="Upload", exact=True).wait_for()
    ends = time.monotonic() + 240.0
    while dialog.count() and time.monotonic() < ends:  # a busy machine makes orders slowly: the dialog says so
        dialog.get_by_role("button", name="Upload", exact=True).click()
        dialog.get_by_role("alert").or_(view.get_by_text("is on its way to")).first.wait_for(timeout=240_000)
    view.locator("[data-mission][data-state='aboard']", has_text=name).wait_for(timeout=400_000)
    assert told(station, "/vehicles/1/mission")["name"] == name
    view.get_by_text("No difference").wait_for(timeout=240_000)
    view.get_by_text("predicted, mission aboard", exact=True).wait_for()
    screenshot("planner-aboard")
    view.evaluate("localStorage.removeItem('stommel-draft-plan.1')")
    view.reload()
    view.get_by_text("predicted, mission aboard", exact=True).wait_for()
    kept = told(station, "/vehicles/1/mission/comparison")
    result = next(job["result"] for job in reversed(jobs) if job["state"] == "done")
    assert [row["predicted"] for row in kept["dives"] if row["predicted"]] == result["dives"]
    assert kept["prediction"]["track"][-1] == result["track"][-1]
    view.get_by_role("tab", name="Plan").click()
    view.locator("[data-key='dives.pitch_deg']").fill("25")
    view.get_by_role("tab", name="Aboard and compared").click()
    view.get_by_role("row", name="Dives, pitch").wait_for()
