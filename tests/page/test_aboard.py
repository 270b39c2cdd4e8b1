"""The mission aboard on the page: flown against predicted, the fence and the uncertainty on the live map, roll-back.

Oracle: differences by hand of what the preview foretold and what the vehicle reported; colours that the map draws; the
orders that the vehicle holds.
"""

import math
from typing import Any

import pytest

from tests.page.quay import BEFORE, FENCE, HOUR, NOW, Quay
from tests.page.waiting import becomes, until

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
    window.dashed = [];
    const {stroke, setLineDash, lineTo, moveTo, beginPath} = CanvasRenderingContext2D.prototype;
    const hooked = CanvasRenderingContext2D.prototype;
    hooked.beginPath = function () { this.places = []; return beginPath.call(this); };
    hooked.moveTo = function (x, y) { this.places?.push([x, y]); return moveTo.call(this, x, y); };
    hooked.lineTo = function (x, y) { this.places?.push([x, y]); return lineTo.call(this, x, y); };
    hooked.stroke = function (...all) {
        if (this.getLineDash().length === 4) window.dashed = [String(this.strokeStyle), this.places];
        return stroke.apply(this, all);
    };
"""
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
        time_end_unix_ms=round(1e3 * end), latitude_begin=298_000_000, longitude_begin=1_200_000_000,
        latitude_end=round(latitude * 1e7), longitude_end=1_200_000_000, greatest_depth=depth, energy=joules,
        current_north=float("nan"), current_east=float("nan"),
    )  # fmt: skip


@pytest.fixture
def compare(page: Any, quay: Quay) -> Any:
    """The planner, where it compares with what is aboard."""
    page.goto(f"{quay.address}/#/vehicle/1/plan")
    page.get_by_role("tab", name="Aboard and compared").click()
    return page


def flown(page: Any) -> list[str]:
    """Rows of flown against predicted, as people read them."""
    rows = page.get_by_role("table", name="Dives as flown, against the preview").locator("tbody tr")
    return [" ".join(row.split()).replace("\u202f", " ") for row in rows.all_inner_texts()]


def test_dives_stand_beside_those_of_the_preview_as_they_come(compare: Any, quay: Quay, screenshot: Any) -> None:
    """By hand: 0.01 degrees of latitude are 1.1 km; dive 8 of the vehicle is the first of this mission."""
    first = "1 +2 min 1.1 km −3.0 m +1.5 kJ"
    becomes(compare, lambda: flown(compare), [first])
    surfaces(quay, 9, 30.0, 104.0, 9_000.0, -300.0)
    becomes(compare, lambda: flown(compare), [first, "2 −5 min 0 m +4.0 m −1.0 kJ"])
    screenshot("flown-against-predicted")


def test_the_fence_and_the_uncertainty_are_drawn_where_they_are(page: Any, quay: Quay, screenshot: Any) -> None:
    """The circle holds 95 % of a place whose error has the told standard deviation along each direction."""
    page.add_init_script(CIRCLES)
    page.add_init_script(DASHES)
    is_at(quay, 30.1, 120.1)
    for view in ("map", "vehicle/1"):
        page.goto(f"{quay.address}/#/{view}")
        page.locator(".map .vehicle").wait_for()
        page.locator(".map .waypoint").nth(1).wait_for()
        until(page, lambda: len(page.evaluate("window.dashed")) == 2)
        becomes(page, lambda: is_fence(page), True)
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


def is_fence(page: Any) -> bool:
    """Whether what is drawn is the fence of the plan, by the marks of two waypoints and Mercator's projection."""
    (x, y), (far_x, _) = mark(page, "waypoint", 0), mark(page, "waypoint", 1)
    (east, north), (far_east, _) = (mercator(*map(math.degrees, place)) for place in WAYPOINTS)
    scale = (far_x - x) / (far_east - east)
    wanted = [
        (x + scale * (place[0] - east), y - scale * (place[1] - north))
        for place in (mercator(*corner) for corner in (*FENCE, FENCE[0]))
    ]
    drawn = page.evaluate("window.dashed[1]")
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
