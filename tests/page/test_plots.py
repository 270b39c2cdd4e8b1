"""The plots: what they show is what the archive has, in every window and through every change of it."""

import math
import random
import re
import time
from typing import Any

import httpx
import pytest

from tests.page.past import GAP, Past
from tests.page.waiting import PATIENCE_S, becomes, passes, until

DRAWN = """
    () => [...document.querySelectorAll('[data-panel]')].map((place) => place.drawn && {
        begin: place.drawn.begin, end: place.drawn.end, channels: place.drawn.channels,
        data: place.drawn.data.map((row) => row.map((value) => value === undefined ? 'none' : value)),
    })
"""


class Plots:
    """The view of the plots, and every question that it asks the archive."""

    def __init__(self, page: Any, past: Past) -> None:
        self.page, self.past = page, past
        self.asked: list[str] = []
        page.on("request", lambda request: self.asked.append(request.url) if "/series?" in request.url else None)

    def open(self, window: str, show: str = "motion") -> None:
        """Go to a window."""
        self.page.goto(f"{self.past.address}/#/vehicle/1/plots?show={show}&window={window}")
        self.page.wait_for_selector("[data-panel] canvas")
        self.rest()

    def rest(self) -> None:
        """Wait until nothing is asked any more and all is drawn; a new window rests 250 ms before it asks."""
        ends = time.monotonic() + PATIENCE_S
        while True:
            before = len(self.asked)
            passes(self.page, 260)
            busy = self.page.locator(".busy.on").count()
            if before and before == len(self.asked) and not busy and all(self.page.evaluate(DRAWN)):
                return
            assert time.monotonic() < ends, "the plots do not come to rest"

    def drawn(self) -> list[dict[str, Any]]:
        """What each panel draws, its window and its channels."""
        found: list[dict[str, Any]] = self.page.evaluate(DRAWN)
        return found

    def window(self) -> tuple[float, float]:
        """The window that all panels show."""
        windows = {(panel["begin"], panel["end"]) for panel in self.drawn()}
        assert len(windows) == 1, "panels show different windows"
        return windows.pop()

    def assert_is_the_archive(self) -> None:
        """Each trace that is drawn is the archive's own answer for the window that is shown: not a point more."""
        begin, end = self.window()
        answer = httpx.get(self.asked[-1], timeout=30.0).json()
        assert (answer["begin"], answer["end"]) == (pytest.approx(begin, abs=1e-3), pytest.approx(end, abs=1e-3))
        for panel in self.drawn():
            t, *rows = panel["data"]
            for key, row in zip(panel["channels"], rows, strict=True):
                points = [(at, value) for at, value in zip(t, row, strict=False) if value != "none"]
                wanted = answer["channels"][key]
                assert points == list(zip(wanted["t"], wanted["value"], strict=True))


@pytest.fixture
def plots(page: Any, past: Past) -> Plots:
    """The plots of the vehicle with a past."""
    return Plots(page, past)


def test_motion_is_drawn_as_in_the_papers_fig_17(plots: Plots, past: Past, screenshot: Any) -> None:
    plots.open(f"{past.begin}-{past.end}")
    titles = plots.page.locator("[data-panel]").evaluate_all("all => all.map((one) => one.dataset.panel)")
    assert titles == ["bladder", "attitude", "heading", "path"]
    plots.assert_is_the_archive()
    screenshot("plots-light")
    plots.page.emulate_media(color_scheme="dark")
    passes(plots.page, 200)
    screenshot("plots-dark")


def test_points_shown_are_the_archives_answer_for_the_window_shown(plots: Plots, past: Past) -> None:
    """nasa/openmct#4777, #6831: never joined over a gap, never of another window, through any change of window."""
    chance = random.Random(23)
    plots.open(f"{past.begin}-{past.end}")
    area = plots.page.locator("[data-panel=path] .u-over")
    box = area.bounding_box()

    def drag() -> None:
        left, right = sorted(chance.sample(range(20, int(box["width"]) - 20), 2))
        plots.page.mouse.move(box["x"] + left, box["y"] + 30)
        plots.page.mouse.down()
        plots.page.mouse.move(box["x"] + max(right, left + 30), box["y"] + 40, steps=3)
        plots.page.mouse.up()

    def wheel() -> None:
        plots.page.mouse.move(box["x"] + chance.randrange(20, int(box["width"]) - 20), box["y"] + 30)
        for _ in range(chance.randrange(1, 6)):
            plots.page.mouse.wheel(0, chance.choice((-240, 240)))

    def pan() -> None:
        plots.page.mouse.move(box["x"] + 100, box["y"] + 30)
        plots.page.mouse.wheel(chance.choice((-400, 400)), 0)

    def live_and_back() -> None:
        plots.page.keyboard.press("End")
        plots.page.wait_for_timeout(chance.choice((0, 50, 400)))
        plots.page.get_by_role("button", name="The window before").click()

    def keys() -> None:
        plots.page.keyboard.press(chance.choice(("ArrowLeft", "ArrowRight", "+", "-", "Backspace")))

    deeds = [drag, wheel, pan, live_and_back, keys]
    for _ in range(15):
        for deed in chance.choices(deeds, k=chance.randrange(1, 4)):
            deed()
        if "live" in plots.page.url:
            plots.page.keyboard.press("Home")
        plots.rest()
        plots.assert_is_the_archive()


def test_a_gap_is_drawn_as_a_gap(plots: Plots, past: Past) -> None:
    """nasa/openmct#4777: between the last sample before a silence and the first after it there is no line."""
    plots.open(f"{past.begin}-{past.end}")
    t, depth = plots.drawn()[3]["data"]
    silence = [past.begin + 3600.0 * hours for hours in GAP]
    before = max(k for k, at in enumerate(t) if at <= silence[0] and isinstance(depth[k], float))
    after = min(k for k, at in enumerate(t) if at >= silence[1] and isinstance(depth[k], float))
    assert None in depth[before + 1 : after]


def test_a_late_answer_to_an_older_window_is_thrown_away(plots: Plots, past: Past) -> None:
    """nasa/openmct#6831: the answer for the first window comes after that for the second; the second is shown."""
    held: list[Any] = []
    first = f"{past.begin + 600}-{past.begin + 1200}"

    def slow(route: Any) -> None:
        if not held and f"begin={past.begin + 600:.0f}" in route.request.url:
            held.append(route)
        else:
            route.continue_()

    plots.page.route("**/series?*", slow)
    plots.page.goto(f"{past.address}/#/vehicle/1/plots?window={first}")
    plots.page.wait_for_selector("[data-panel] canvas")
    until(plots.page, lambda: held)
    for _ in range(3):
        plots.page.keyboard.press("ArrowRight")
    plots.rest()
    held[0].fulfill(response=held[0].fetch())
    passes(plots.page, 200)
    assert plots.window()[0] == pytest.approx(past.begin + 600 + 3 * 60, abs=0.01)
    plots.assert_is_the_archive()


def test_live_plots_follow_and_show_only_what_the_archive_has(plots: Plots, past: Past) -> None:
    """What comes over the live socket stands in the plot at once, and every point is one of the archive's."""
    plots.open("live-600")
    first = plots.window()
    for k in range(15):
        past.speaker.say("ATTITUDE", time_boot_ms=1000 * k, pitch=math.radians(k), roll=0.0, yaw=1.0)
        time.sleep(0.2)
    until(plots.page, lambda: pitches(plots) >= {float(k) for k in range(15)})
    until(plots.page, lambda: plots.window()[0] > first[0] + 2.0)
    until(plots.page, lambda: abs(plots.window()[1] - time.time()) < 5.0)
    panel = plots.drawn()[1]
    begin, end = panel["begin"], panel["end"]
    assert end - begin == pytest.approx(600.0)
    shown = [(t, v) for t, v in zip(*panel["data"][:2], strict=False) if isinstance(v, int | float)]
    query = f"channels=pitch_deg&begin={begin - 60}&end={end + 60}&method=raw"
    raw = httpx.get(f"{past.address}/api/vehicles/1/series?{query}").json()["channels"]["pitch_deg"]
    kept = dict(zip(raw["t"], raw["value"], strict=True))
    for t, value in shown:
        at = min(kept, key=lambda one: abs(one - t))
        assert (at, kept[at]) == (pytest.approx(t, abs=2e-6, rel=0.0), value), "the archive has no such point"


def pitches(plots: Plots) -> set[float]:
    """Values of the pitch that are drawn."""
    return {round(v, 3) for v in plots.drawn()[1]["data"][1] if isinstance(v, int | float)}


def test_a_lost_socket_leaves_no_hole(plots: Plots, past: Past) -> None:
    """akhenry/openmct-yamcs#133: what came while the socket was away is there after it came back."""
    plots.page.route_web_socket("**/api/live", _breaks_once)
    plots.open("live-600")
    for k in range(20):
        past.speaker.say("ATTITUDE", time_boot_ms=0, pitch=math.radians(30.0 + k), roll=0.0, yaw=1.0)
        plots.page.wait_for_timeout(200)
    until(plots.page, lambda: _breaks_once.__dict__["opened"] >= 2)
    until(plots.page, lambda: pitches(plots) >= {30.0 + k for k in range(20)})


def _breaks_once(socket: Any) -> None:
    """Passes everything on; the first socket is closed at its twentieth message."""
    server = socket.connect_to_server()
    state = _breaks_once.__dict__
    state["opened"] = state.get("opened", 0) + 1
    is_first, count = state["opened"] == 1, [0]

    def pass_on(message: str | bytes) -> None:
        count[0] += 1
        if is_first and count[0] == 20:
            socket.close(code=1001)
        else:
            socket.send(message)

    server.on_message(pass_on)


def test_values_stand_at_the_cursor_in_all_plots(plots: Plots, past: Past) -> None:
    plots.open(f"{past.begin}-{past.begin + 3600}")
    box = plots.page.locator("[data-panel=attitude] .u-over").bounding_box()
    plots.page.mouse.move(box["x"] + box["width"] / 2, box["y"] + 20)
    begin, end = plots.window()
    t = begin + (end - begin) / 2
    for index, key in ((0, "ballast_ml"), (1, "pitch_deg"), (3, "depth_m")):
        panel = plots.drawn()[index]
        row = panel["data"][1 + panel["channels"].index(key)]
        pairs = [(at, v) for at, v in zip(panel["data"][0], row, strict=False) if isinstance(v, int | float)]
        wanted = min(pairs, key=lambda pair: abs(pair[0] - t))[1]
        said = plots.page.locator("section.panel").nth(index).locator("output").nth(panel["channels"].index(key))
        becomes(plots.page, lambda: number_of(said.inner_text()), pytest.approx(wanted, abs=2.0))  # noqa: B023
    lines = plots.page.locator(".u-cursor-x").evaluate_all("all => all.map((one) => one.style.transform)")
    assert len(lines) == 4
    assert len({re.search(r"-?\d+", line).group() for line in lines if line}) == 1  # type: ignore[union-attr]


def number_of(said: str) -> float | None:
    """The number in what stands beside a plot; None as long as there is none."""
    digits = re.sub(r"[^\d.\-]", "", said.replace("\u2212", "-"))
    return float(digits) if digits.strip("-.") else None


def test_own_choice_is_kept_in_the_address(plots: Plots, past: Past, screenshot: Any) -> None:
    plots.open(f"{past.begin}-{past.end}", "own&channels=depth_m")
    plots.page.get_by_label("Find a channel").fill("phase")
    plots.page.get_by_text("phase of the dive").first.click()
    plots.rest()
    until(plots.page, lambda: "depth_m%2Cphase" in plots.page.url)
    plots.page.reload()
    plots.page.wait_for_selector("[data-panel] canvas")
    plots.rest()
    assert [panel["channels"] for panel in plots.drawn()] == [["depth_m"], ["phase"]]
    plots.assert_is_the_archive()
    screenshot("plots-own")


def test_an_archive_that_cannot_answer_is_said_and_the_plot_stays(plots: Plots, past: Past) -> None:
    plots.open(f"{past.begin}-{past.begin + 3600}")
    refusal = {"detail": {"reason": "The archive is busy; try again."}}
    plots.page.route("**/series?*", lambda route: route.fulfill(status=503, json=refusal))
    plots.page.keyboard.press("ArrowRight")
    plots.page.wait_for_selector("text=The archive is busy; try again.")
    plots.page.unroute("**/series?*")
    plots.page.keyboard.press("ArrowRight")
    plots.rest()
    plots.assert_is_the_archive()
    plots.page.get_by_text("The archive is busy").wait_for(state="detached")


@pytest.mark.parametrize("page", [{"viewport": {"width": 1024, "height": 768}, "has_touch": True}], indirect=True)
def test_a_tablet_moves_the_window_by_finger(plots: Plots, past: Past, screenshot: Any) -> None:
    plots.open(f"{past.begin}-{past.begin + 3600}")
    before = plots.window()
    plots.page.locator("[data-panel=path] .u-over").evaluate("""(area) => {
        const box = area.getBoundingClientRect();
        const say = (kind, x) => area.dispatchEvent(new PointerEvent(kind, {
            pointerId: 7, pointerType: 'touch', clientX: x, clientY: box.top + 20, bubbles: true, cancelable: true }));
        area.setPointerCapture = () => {};
        say('pointerdown', box.left + 400); say('pointermove', box.left + 300); say('pointerup', box.left + 300);
    }""")
    plots.rest()
    assert plots.window()[0] > before[0] + 200
    plots.assert_is_the_archive()
    screenshot("plots-tablet")


def test_nobody_is_kept_from_the_plots(plots: Plots, past: Past, serious: Any) -> None:
    """axe-core: no serious finding."""
    plots.open(f"{past.begin}-{past.end}", "own&channels=depth_m,pitch_deg")
    assert serious() == []


def test_a_limit_that_somebody_sets_is_drawn_at_once(plots: Plots) -> None:
    """In a window of the past, in which nothing else changes what is drawn."""
    past = plots.past
    plots.open(f"{past.begin}-{past.begin + 3600}")
    pitch = next(k for k, panel in enumerate(plots.drawn()) if "pitch_deg" in panel["channels"])
    picture = "(k) => document.querySelectorAll('[data-panel]')[k].querySelector('canvas').toDataURL()"

    def looks() -> str:
        return str(plots.page.evaluate(picture, pitch))

    address = f"{past.address}/api/vehicles/1/limits/roll_deg"
    without = looks()
    httpx.put(address, json={"high": 12.0, "severity": "notice"}).raise_for_status()
    try:
        until(plots.page, lambda: looks() != without)
    finally:
        httpx.delete(address).raise_for_status()
    until(plots.page, lambda: looks() == without)
