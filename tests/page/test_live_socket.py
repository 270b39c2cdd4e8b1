"""The page's live socket against a station that the test plays message by message."""

import json
import re
from typing import Any

from tests.page import fake_glider as glider
from tests.page.played_station import NOW, PlayedStation
from tests.page.waiting import until


def tile(page: Any, label: str) -> Any:
    """The tile of a channel."""
    return page.locator(f'[data-channel="{label}"]')


def test_after_a_lost_socket_every_tile_shows_its_latest_value_and_age(page: Any, played: PlayedStation) -> None:
    """akhenry/openmct-yamcs#133: a value that is sent rarely stayed stale for ever; here the station tells it again."""
    played.tell("temperature_degc", NOW - 4.0, 11.25)
    water = tile(page, "Temperature of the sea")
    water.get_by_text("11.3").wait_for()
    before = {json.dumps(sorted(m["channels"])) for m in played.asked[0] if m["type"] == "subscribe"}
    played.sockets[-1].close()
    until(page, lambda: len(played.sockets) == 2)
    until(page, lambda: {json.dumps(sorted(m["channels"])) for m in played.asked[1]} >= before)
    played.tell("temperature_degc", NOW - 3000.0, 14.5)  # of the archive: older than twice its period of 600 s
    water.get_by_text("14.5").wait_for()
    until(page, lambda: "stale" in (water.get_attribute("class") or ""))
    water.get_by_text(re.compile("^old, (49|50|51)")).wait_for()


def test_a_value_is_old_by_the_period_in_which_it_comes(page: Any, played: PlayedStation) -> None:
    """A slow line brings the depth each hour instead of every 2 s: 90 min are usual then, and old on a quick line."""
    depth = tile(page, "Depth")
    played.tell("depth_m", NOW - 5400.0, 87.25, periods={"depth_m": 3600.0})
    depth.get_by_text("87.3").wait_for()
    depth.get_by_text(re.compile(r"^9\d")).wait_for()
    assert "stale" not in str(depth.get_attribute("class"))
    played.tell("depth_m", NOW - 5400.0, 88.25, periods={"depth_m": 2.0})
    depth.get_by_text("88.3").wait_for()
    depth.get_by_text(re.compile(r"^old, 9\d")).wait_for()


def test_a_subscription_that_fails_leaves_the_others_alone(page: Any, played: PlayedStation) -> None:
    """akhenry/openmct-yamcs#220: opening one view dropped all live data."""

    def attitude() -> list[str]:
        wanted = ["pitch_deg", "roll_deg", "heading_deg"]
        return [m["id"] for m in played.asked[-1] if m.get("channels") == wanted]

    until(page, attitude)
    played.sockets[-1].send(json.dumps({"type": "error", "id": attitude()[0], "reason": "There is no such channel."}))
    played.tell("depth_m", NOW - 1.0, 87.25)
    tile(page, "Depth").get_by_text("87.3").wait_for()
    assert len(played.sockets) == 1


def test_ages_are_those_of_the_server_although_the_browsers_clock_is_wrong(page: Any, fake_station: str) -> None:
    """Issue: browser clock wrong. The oracle is what the station says; the browser believes that it is 1999."""
    page.add_init_script("const at = Date.UTC(1999, 0, 1); Date.now = () => at;")
    station = PlayedStation(page)
    page.goto(f"{fake_station}/#/vehicle/1")
    until(page, lambda: len(station.asked) == 1 and bool(station.ids("voltage_v")))
    station.tell("voltage_v", NOW - 1800.0, 27.5)
    tile(page, "Voltage of the battery").get_by_text(re.compile("^old, (29|30|31)")).wait_for()


def test_the_page_says_that_the_station_is_lost_and_tries_again(page: Any, fake_station: str) -> None:
    """The banner comes within seconds of the loss, and goes by itself."""
    sockets: list[Any] = []
    refuse = {"now": False}

    def opened(socket: Any) -> None:
        if refuse["now"]:
            socket.close()
            return
        sockets.append(socket)
        socket.send(json.dumps({"type": "hello", "now": NOW, "vehicles": [glider.summary(1, NOW, 20.0)]}))

    page.route_web_socket(re.compile("/api/live$"), opened)
    page.goto(f"{fake_station}/#/fleet")
    page.get_by_role("link", name="ZJU glider", exact=True).wait_for()
    refuse["now"] = True
    sockets[0].close()
    banner = page.get_by_text("The station is not reached")
    banner.wait_for()
    page.locator(".lamp", has_text="station lost").wait_for()
    page.get_by_role("link", name="ZJU glider", exact=True).wait_for()  # what was known stays
    refuse["now"] = False
    banner.wait_for(state="detached")
    assert len(sockets) == 2
