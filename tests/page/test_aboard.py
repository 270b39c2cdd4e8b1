"""The mission aboard on the page: flown against predicted, the fence and the uncertainty on the live map, roll-back.

Oracle: differences by hand of what the preview foretold and what the vehicle reported; colours that the map draws; the
orders that the vehicle holds.
"""

import json
import math
import time
from typing import Any

import pytest

from tests.page.quay import BEFORE, FENCE, HOUR, NOW, TRACK, Quay, predicted
from tests.page.waiting import becomes, until
from tests.plans.plans import plan_with

CIRCLES = """
    window.circles = [];
    const {arc, clearRect} = CanvasRenderingContext2D.prototype;
    CanvasRenderingContext2D.prototype.clearRect = function (...all) {
        window.circles = [];
        return clearRect.apply(this, all);
    };
    CanvasRenderingContext2D.prototype.arc = function (x, y, radius, ...all) {
        window.circles.push([x, y, radius]);
        return arc.call(this, x, y, radius, ...all);
    };
"""
DASHES = """
    window.dashed = {};
    const {stroke, setLineDash, lineTo, moveTo, beginPath} = CanvasRenderingContext2D.prototype;
    const hooked = CanvasRenderingContext2D.prototype;
    hooked.beginPath = function () { this.places = []; return beginPath.call(this); };
    hooked.moveTo = function (x, y) { this.places?.push([x, y]); return moveTo.call(this, x, y); };
    hooked.lineTo = function (x, y) { this.places?.push([x, y]); return lineTo.call(this, x, y); };
    hooked.stroke = function (...all) {
        window.dashed[this.getLineDash().join()] = [String(this.strokeStyle), this.places];
        return stroke.apply(this, all);
    };
"""
FENCED, DOTTED, AIMED = "7,3,1.5,3", "2,3", "10,4"
"""Dashes of the fence, of a predicted track and of the way through the waypoints aboard."""
WAYPOINTS = ((0.52, 2.09), (0.53, 2.1))
"""Of the orders aboard, latitude and longitude [rad]."""
SIGMA = 900.0
"""Of the position [m]."""


def is_at(quay: Quay, latitude: float, longitude: float, sigma: float = SIGMA) -> None:
    """Let the vehicle say where it is."""
    quay.vehicle.say("NAVIGATION_ESTIMATE", time_boot_ms=0, sigma=sigma, fix_age=30.0)
    quay.vehicle.say("GLOBAL_POSITION_INT", time_boot_ms=0, lat=round(latitude * 1e7), lon=round(longitude * 1e7))


def surfaces(quay: Quay, number: int, latitude: float, depth: float, joules: float, late: float) -> None:
    """Let the vehicle report a dive of the mission, an hour long."""
    end = quay.begin + (number - 7) * HOUR + late
    quay.vehicle.say(
        "DIVE_SUMMARY", dive=number, time_begin_unix_ms=round(1e3 * (end - HOUR + 60.0)),
        time_end_unix_ms=round(1e3 * end), latitude_begin=round((latitude - 0.11) * 1e7), longitude_begin=1_200_000_000,
        latitude_end=round(latitude * 1e7), longitude_end=1_200_000_000, greatest_depth=depth, energy=joules,
        current_north=float("nan"), current_east=float("nan"),
    )  # fmt: skip


@pytest.fixture
def compare(page: Any, quay: Quay) -> Any:
    """The planner, where it compares with what is aboard."""
    page.goto(f"{quay.address}/#/vehicle/1/plan")
    page.get_by_role("tab", name="Aboard and compared").click()
    return page


def flown(page: Any) -> dict[str, list[str]]:
    """Flown against predicted, as people read it: lines of the mission and of each dive."""
    groups = page.get_by_role("table", name="Dives as flown, against the preview").locator("tbody")
    told = {group.get_attribute("data-group"): group.locator("tr").all_inner_texts() for group in groups.all()}
    return {name: [" ".join(line.split()).replace("\u202f", " ") for line in lines] for name, lines in told.items()}


def hour(t: float) -> str:
    return time.strftime("%m-%d %H:%M", time.gmtime(t))


def test_dives_stand_beside_those_of_the_preview_as_they_come(compare: Any, quay: Quay, screenshot: Any) -> None:
    """By hand: 0.01 degrees of latitude are 1.1 km; dive 8 of the vehicle is the first of this mission."""
    end = quay.begin + HOUR
    first = [
        "Dive 1 ended at 29°54.600′N 120°00.000′E, 1.1 km from the predicted place, 0 m off the predicted track",
        f"flown {hour(end + 120.0)} 61 min 12.2 km 97.0 m 11.5 kJ",
        f"predicted {hour(end)} 60 min 11.1 km 100.0 m 10.0 kJ",
        "difference +2 min +60 s +1.1 km −3.0 m +1.5 kJ",
    ]
    one = ["Mission so far dive 1", "flown 61 min 12.2 km 11.5 kJ", "predicted 60 min 11.1 km 10.0 kJ",
           "difference +60 s +1.1 km +1.5 kJ"]  # fmt: skip
    becomes(compare, lambda: flown(compare), {"so far": one, "dive 1": first})
    surfaces(quay, 9, 30.0, 104.0, 9_000.0, -300.0)
    second = [
        "Dive 2 ended at 30°00.000′N 120°00.000′E, 0 m from the predicted place, 0 m off the predicted track",
        f"flown {hour(end + HOUR - 300.0)} 59 min 12.2 km 104.0 m 9.0 kJ",
        f"predicted {hour(end + HOUR)} 60 min 11.1 km 100.0 m 10.0 kJ",
        "difference −5 min −60 s +1.1 km +4.0 m −1.0 kJ",
    ]
    both = ["Mission so far dives 1 to 2", "flown 1 h 54 min 24.4 km 20.5 kJ", "predicted 2 h 00 min 22.2 km 20.0 kJ",
            "difference −6 min +2.2 km +0.5 kJ"]  # fmt: skip
    becomes(compare, lambda: flown(compare), {"so far": both, "dive 2": second, "dive 1": first})
    screenshot("flown-against-predicted")


def test_the_predicted_track_is_drawn_where_somebody_wants_it(page: Any, quay: Quay, screenshot: Any) -> None:
    """Straight north, as the preview foretold. The choice holds for all maps, and for the page loaded anew."""
    page.add_init_script(DASHES)
    track = [(place["lat"], place["lon"]) for place in TRACK]
    page.goto(f"{quay.address}/#/vehicle/1")
    page.locator(".map .waypoint").nth(1).wait_for()
    choice = page.get_by_role("button", name="Predicted")
    assert choice.get_attribute("aria-pressed") == "false"
    assert DOTTED not in page.evaluate("window.dashed")
    choice.click()
    page.get_by_text("dotted: predicted before the upload").wait_for()
    becomes(page, lambda: is_drawn(page, DOTTED, *track), True)
    screenshot("predicted-vehicle")
    page.goto(f"{quay.address}/#/map")
    page.reload()
    page.locator(".map .waypoint").nth(1).wait_for()
    becomes(page, lambda: is_drawn(page, DOTTED, *track), True)
    assert choice.get_attribute("aria-pressed") == "true"
    choice.click()
    page.get_by_text("dotted: predicted before the upload").wait_for(state="detached")


def test_the_planner_tells_the_predicted_track_of_the_mission_aboard(page: Any, quay: Quay, serious: Any) -> None:
    """In the colour of that mission, which is not that of the plan on the desk and its preview."""
    page.add_init_script(DASHES)
    page.goto(f"{quay.address}/#/vehicle/1/plan")
    page.get_by_text("predicted, mission aboard", exact=True).wait_for()
    until(page, lambda: {DOTTED, AIMED} <= set(page.evaluate("window.dashed")))
    colours = {dashes: colour for dashes, (colour, _) in page.evaluate("window.dashed").items()}
    assert colours[DOTTED] == colours[AIMED]
    assert page.get_by_text("predicted, plan on the desk", exact=True).count() == 0
    assert serious() == []


def test_the_fence_and_the_uncertainty_are_drawn_where_they_are(page: Any, quay: Quay, screenshot: Any) -> None:
    """The circle holds 95 % of a place whose error has the told standard deviation along each direction."""
    page.add_init_script(CIRCLES)
    page.add_init_script(DASHES)
    is_at(quay, 30.1, 120.1)
    for view in ("map", "vehicle/1"):
        page.goto(f"{quay.address}/#/{view}")
        page.locator(".map .vehicle").wait_for()
        page.locator(".map .waypoint").nth(1).wait_for()
        becomes(page, lambda: is_drawn(page, FENCED, *FENCE, FENCE[0]), True)
        screenshot(f"fence-{view.replace('/', '-')}")
        for _ in range(3):
            page.get_by_role("button", name="Nearer").click()
        becomes(page, lambda: has_circle(page, math.sqrt(-2.0 * math.log(0.05)) * SIGMA), True)
        screenshot(f"uncertainty-{view.replace('/', '-')}")


def mark(page: Any, kind: str, number: int = 0) -> tuple[float, float]:
    """Where a mark of the map stands, pixels."""
    x, y = (
        page.locator(f".map .{kind}")
        .nth(number)
        .evaluate("mark => { const {e, f} = mark.transform.baseVal[0].matrix; return [e, f]; }")
    )
    return x, y


def mercator(latitude: float, longitude: float) -> tuple[float, float]:
    """East and north of a place on a sea chart [rad]."""
    return math.radians(longitude), math.asinh(math.tan(math.radians(latitude)))


def is_drawn(page: Any, dashes: str, *places: tuple[float, float]) -> bool:
    """Whether a line leads through these places, by the marks of two waypoints and Mercator's projection."""
    (x, y), (far_x, _) = mark(page, "waypoint", 0), mark(page, "waypoint", 1)
    (east, north), (far_east, _) = (mercator(*map(math.degrees, place)) for place in WAYPOINTS)
    scale = (far_x - x) / (far_east - east)
    wanted = [
        (x + scale * (place[0] - east), y - scale * (place[1] - north))
        for place in (mercator(*corner) for corner in places)
    ]
    _, drawn = page.evaluate("window.dashed").get(dashes, ("", []))
    return len(drawn) == len(wanted) and all(math.dist(*both) < 1.0 for both in zip(drawn, wanted, strict=True))


def has_circle(page: Any, metres: float) -> bool:
    """Whether a circle of so many metres is drawn around the vehicle, by the bar that tells the scale."""
    bar = page.locator(".map .scale")
    number, unit = bar.inner_text().split()
    scale = bar.bounding_box()["width"] / (float(number) * (1e3 if unit == "km" else 1.0))
    at = mark(page, "vehicle")
    return any(
        math.dist((x, y), at) < 1.0 and abs(radius / (metres * scale) - 1.0) < 0.05
        for x, y, radius in page.evaluate("window.circles")
    )


def test_leaving_the_fence_is_told(compare: Any, quay: Quay) -> None:
    compare.get_by_text("Within its geofence all the time").wait_for()
    is_at(quay, 30.55, 120.1, sigma=20_000.0)  # so unsure that it may be there
    surfaces(quay, 10, 30.1, 100.0, 10_000.0, 0.0)
    alert = compare.get_by_role("alert").filter(has_text="It left its geofence")
    alert.get_by_text("30°33.000′N 120°06.000′E").wait_for()


def test_the_mission_before_is_flown_again(compare: Any, quay: Quay, screenshot: Any) -> None:
    """Asked for once more, with the focus on leaving it. Oracle: the orders that the vehicle holds, byte for byte."""
    compare.get_by_text("There and back").first.wait_for()
    compare.get_by_role("button", name="Fly the one before again…").click()
    dialog = compare.get_by_role("dialog", name="fly the mission before again")
    screenshot("roll-back")
    dialog.get_by_role("button", name="Leave it").click()
    dialog.wait_for(state="detached")
    assert quay.vehicle.missions.files[-1] == NOW.encode()
    compare.get_by_role("button", name="Fly the one before again…").click()
    dialog.get_by_role("button", name="Fly the one before").click()
    until(compare, lambda: quay.vehicle.missions.files[-1] == BEFORE.encode())
    compare.locator("[data-mission][data-state='aboard']", has_text="The way before").wait_for()
    compare.locator("[data-mission][data-state='replaced']", has_text="There and back").wait_for()


def test_a_mission_keeps_its_predicted_track_though_the_station_forgot_the_preview(
    compare: Any, quay: Quay, screenshot: Any
) -> None:
    """The mission aboard has no preview, and says so. The next one's was made before a restart of the station.

    Oracle: what the preview told, which is told again to a browser that has never seen it.
    """
    compare.get_by_text("No preview was made of the mission that the vehicle holds").wait_for()
    assert compare.get_by_text("predicted, mission aboard", exact=True).count() == 0
    answer = {
        "job": "0123abcd", "state": "done", "share": 1.0, "seconds_left": None, "error": None,
        "result": {
            "verdict": "all waypoints reached", "outcome": "mission complete", "t_begin": quay.begin,
            "duration_s": 7.0 * HOUR, "energy_j": 70_000.0, "battery_left_share": 0.9, "distance_m": 33_000.0,
            "surfacings": 2, "dive_count": 2, "dives": [predicted(number, quay.begin) for number in (1, 2)],
            "waypoints": [], "track": TRACK, "series": {"t": [0.0], "depth_m": [0.0]},
            "path": {"distance_m": [], "depth_m": []}, "warnings": [],
        },
    }  # fmt: skip
    compare.route("**/api/plans/preview", lambda route: route.fulfill(status=202, json={"job": "0123abcd"}))
    compare.route("**/api/jobs/0123abcd", lambda route: route.fulfill(json=answer))
    plan = json.dumps(plan_with(name="Foretold")).encode()
    compare.get_by_label("Plan file").set_input_files(
        {"name": "foretold.json", "mimeType": "application/json", "buffer": plan}
    )
    compare.get_by_text("foretold.json is on the desk").wait_for()
    compare.get_by_role("button", name="Preview").click()
    compare.get_by_text("predicted, plan on the desk", exact=True).wait_for()
    compare.get_by_role("button", name="Upload…").click()
    dialog = compare.get_by_role("dialog", name="Upload")
    dialog.get_by_role("button", name="Upload", exact=True).click()
    dialog.wait_for(state="detached")
    compare.locator("[data-mission][data-state='aboard']", has_text="Foretold").wait_for()
    compare.get_by_text("predicted, mission aboard", exact=True).wait_for()
    compare.evaluate("localStorage.clear()")
    compare.reload()
    compare.get_by_text("predicted, mission aboard", exact=True).wait_for()
    assert compare.get_by_text("predicted, plan on the desk", exact=True).count() == 0
    compare.get_by_role("tab", name="Aboard and compared").click()
    totals = compare.get_by_text("Predicted of the whole mission:")
    becomes(
        compare,
        lambda: totals.inner_text().replace("\u202f", " ").split(": ")[1],
        "7 h 00 min, 2 dives, 33.0 km over ground, 19 Wh.",
    )
    screenshot("planner-foretold")
