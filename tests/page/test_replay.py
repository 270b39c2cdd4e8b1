"""Replays in the page: what is shown at a time of the replay is what the archive has of that time."""

import math
import re
from collections.abc import Iterator
from typing import Any

import httpx
import pytest

from tests.page.past import GAP, Past, past_station, values
from tests.page.waiting import at_rest, becomes, passes, until


@pytest.fixture(scope="module")
def past(built: None, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Past]:
    """A station of their own: its silences are those that are written into it, whatever other tests say to theirs."""
    with past_station(tmp_path_factory.mktemp("replayed")) as found:
        yield found


@pytest.fixture(autouse=True)
def none_before(past: Past) -> None:
    """Each test begins without a replay; one that nobody listens to would go on for a minute."""
    for state in states(past):
        httpx.delete(f"{past.address}/api/replays/{state['replay']}")


def filled(page: Any) -> None:
    """Wait until the form has the times of the address, which it asks the station for."""
    until(page, lambda: page.get_by_role("textbox", name="From").input_value() != "")


def begun(page: Any, past: Past, speed: str = "60") -> Any:
    """A replay of the first two hours."""
    page.goto(f"{past.address}/#/vehicle/1/replay?begin={past.begin:.0f}&end={past.begin + 7200:.0f}")
    filled(page)
    page.get_by_role("spinbutton", name="Speed").fill(speed)
    filled(page)
    page.get_by_role("button", name="Start the replay").click()
    page.locator(".tile .value").first.wait_for()
    return page


def plots(page: Any) -> None:
    """The plots of a replay."""
    page.get_by_role("tab", name="Motion").click()
    page.locator("[data-panel] canvas").first.wait_for()


def states(past: Past) -> list[dict[str, Any]]:
    """Replays that go on."""
    found: list[dict[str, Any]] = httpx.get(f"{past.address}/api/replays").json()
    return found


def depth_told(page: Any) -> float:
    """Depth on the tile."""
    said = page.locator(".tile", has_text="depth").first.locator(".value").inner_text()
    return float(re.sub(r"[^\d.\-]", "", said.replace("\u2212", "-")))


def depth_at(past: Past, t: float) -> float:
    """Depth that the archive has, the newest until a time."""
    query = f"channels=depth_m&begin={t - 10}&end={t}&method=raw"
    return float(httpx.get(f"{past.address}/api/vehicles/1/series?{query}").json()["channels"]["depth_m"]["value"][-1])


def test_a_replay_shows_what_the_archive_has_of_that_time(page: Any, past: Past, screenshot: Any) -> None:
    begun(page, past, "300")
    until(page, lambda: states(past)[0]["at"] > past.begin + 600.0)
    screenshot("replay")
    page.get_by_role("button", name="Pause").click()
    page.get_by_role("button", name="Go on").wait_for()
    (state,) = states(past)
    assert state["paused"]
    assert past.begin < state["at"] < past.begin + 7200
    becomes(page, lambda: depth_told(page), pytest.approx(depth_at(past, state["at"]), abs=0.2))
    plots(page)
    until(page, lambda: newest_drawn(page) > state["at"] - 30.0)
    screenshot("replay-plots")
    passes(page, 700)
    assert states(past)[0]["at"] == state["at"], "while it is paused its time stands still"
    assert newest_drawn(page) <= state["at"] + 1e-3, "nothing is shown that had not happened yet"


def newest_drawn(page: Any) -> float:
    """Time of the newest depth that is drawn."""
    drawn = page.evaluate("document.querySelector('[data-panel=path]').drawn?.data ?? [[], []]")
    return max((at for at, value in zip(*drawn, strict=False) if value is not None), default=-math.inf)


def test_a_replay_jumps_and_changes_its_speed(page: Any, past: Past) -> None:
    begun(page, past, "1")
    slider = page.get_by_label("Place in the replay")
    slider.evaluate(f"""(input) => {{
        input.value = {past.begin + 3600};
        input.dispatchEvent(new Event('input', {{ bubbles: true }}));
        input.dispatchEvent(new Event('change', {{ bubbles: true }}));
    }}""")
    until(page, lambda: states(past)[0]["at"] >= past.begin + 3600)
    at = states(past)[0]["at"]
    assert at <= past.begin + 3660
    until(page, lambda: abs(depth_told(page) - depth_at(past, states(past)[0]["at"])) <= 2.0)
    page.get_by_role("combobox", name="Speed").select_option("200")
    becomes(page, lambda: states(past)[0]["speed"], 200.0)
    until(page, lambda: states(past)[0]["at"] > at + 100.0)


def test_the_end_is_reached_and_begun_again(page: Any, past: Past) -> None:
    begun(page, past, "1000")
    again = page.get_by_role("button", name="From the beginning")
    again.wait_for(timeout=240_000)
    page.get_by_text("This is the end of the replay").wait_for()
    becomes(page, lambda: states(past)[0]["at"], math.floor(past.begin) + 7200)
    page.get_by_role("combobox", name="Speed").select_option("1")
    becomes(page, lambda: states(past)[0]["speed"], 1.0)
    again.click()
    page.get_by_role("button", name="Pause").wait_for()
    assert states(past)[0]["at"] < past.begin + 7000


def test_live_values_are_untouched_by_a_replay_at_full_speed(page: Any, past: Past) -> None:
    """yamcs/yamcs#911: a replay at full speed kills no connection; live views go on beside it."""
    lost: list[Any] = []
    page.on("websocket", lambda socket: socket.on("close", lambda _: lost.append(socket.url)))
    begun(page, past, "1000")
    other = page.context.new_page()
    other.goto(f"{past.address}/#/vehicle/1/plots?window=live-600")
    other.locator("[data-panel] canvas").first.wait_for()
    for k in range(10):
        past.speaker.say("ATTITUDE", time_boot_ms=0, pitch=math.radians(70.0 + k), roll=0.0, yaw=1.0)
        page.wait_for_timeout(200)

    def shown() -> set[float]:
        row = other.evaluate("document.querySelector('[data-panel=attitude]').drawn?.data[1] ?? []")
        return {round(value, 3) for value in row if value}

    until(other, lambda: shown() >= {70.0 + k for k in range(10)})
    assert lost == []
    other.close()


def test_leaving_the_view_ends_the_replay(page: Any, past: Past) -> None:
    begun(page, past, "1")
    assert len(states(past)) == 1
    page.goto(f"{past.address}/#/vehicle/1/log")
    page.get_by_role("textbox", name="Note").wait_for()
    becomes(page, lambda: states(past), [])


def test_a_stretch_that_cannot_be_is_refused(page: Any, past: Past) -> None:
    from playwright.sync_api import expect

    page.goto(f"{past.address}/#/vehicle/1/replay?begin={past.begin + 60:.0f}&end={past.begin:.0f}")
    expect(page.get_by_role("textbox", name="From")).not_to_have_value("")
    filled(page)
    page.get_by_role("button", name="Start the replay").click()
    page.get_by_text("The end must be after the beginning.").wait_for()


@pytest.mark.parametrize("page", [{"color_scheme": "dark", "viewport": {"width": 1024, "height": 768}}], indirect=True)
def test_nobody_is_kept_from_replays(page: Any, past: Past, serious: Any, screenshot: Any) -> None:
    """axe-core: no serious finding, before and while it runs."""
    page.goto(f"{past.address}/#/vehicle/1/replay")
    page.get_by_role("button", name="Start the replay").wait_for()
    at_rest(page)
    assert serious() == []
    at_rest(begun(page, past))
    screenshot("replay-tablet-dark")
    assert serious() == []
    plots(page)
    assert serious() == []


def test_the_whole_vehicle_is_shown_as_it_was_and_is_marked_as_the_past(page: Any, past: Past) -> None:
    """Issue: live or any time in the past. Oracle: the closed form by which the past was made, and its first hours."""
    begun(page, past, "1")
    banner = page.get_by_role("toolbar", name="Replay")
    banner.get_by_text("Past", exact=True).wait_for()
    banner.get_by_text("no command goes out from here").wait_for()
    (state,) = states(past)
    assert state["summary"]["position"]["latitude"] == pytest.approx(values("latitude_deg", state["at"]), abs=1e-3)
    for name in ("At a glance", "Values", "Map", "Attitude", "Inside", "State"):
        page.get_by_role("region", name=name, exact=True).wait_for()
    page.get_by_role("img", name=re.compile("^Phase of the dive: (descent|ascent)")).wait_for()
    page.get_by_role("application", name=re.compile("^The glider: pitch ")).wait_for()
    said = page.get_by_role("application", name=re.compile("^The glider")).get_attribute("aria-label")
    pitch = float(re.search(r"pitch ([\d\u2212.]+)", said).group(1).replace("\u2212", "-"))
    assert pitch == pytest.approx(values("pitch_deg", states(past)[0]["at"]), abs=3.0)
    assert page.locator("main a").count() == 0, "no way out of the past but its end"
    assert page.locator("main").get_by_role("button", name=re.compile("Abort|Send|Dive")).count() == 0


def test_what_the_vehicle_had_said_by_then_stands_there(page: Any, past: Past) -> None:
    """Oracle: what the archive has until the moment of the replay."""
    page.goto(f"{past.address}/#/vehicle/1/replay?begin={past.begin + 5400:.0f}&end={past.begin + 9000:.0f}")
    filled(page)
    page.get_by_role("spinbutton", name="Speed").fill("1")
    page.get_by_role("button", name="Start the replay").click()
    shown = page.get_by_role("region", name="What the vehicle said").locator("li span")
    shown.first.wait_for()
    at = states(past)[0]["at"]
    said = httpx.get(f"{past.address}/api/vehicles/1/texts?end={at}&limit=3").json()
    assert len(said) >= 2
    becomes(page, shown.all_inner_texts, [one["words"] for one in reversed(said)])


def test_a_silence_is_told_and_jumped_over(page: Any, past: Past, screenshot: Any) -> None:
    """Oracle: the half hour in which nothing was received."""
    gap = [past.begin + hours * 3600.0 for hours in GAP]
    page.goto(f"{past.address}/#/vehicle/1/replay?begin={gap[0] - 60:.0f}&end={gap[1] + 600:.0f}")
    page.get_by_role("spinbutton", name="Speed").fill("200")
    filled(page)
    page.get_by_role("button", name="Start the replay").click()
    page.get_by_text("Nothing was received from").wait_for()
    screenshot("replay-silence")
    page.get_by_role("combobox", name="Speed").select_option("5")
    assert states(past)[0]["silence"]["end"] == pytest.approx(gap[1], abs=2.5)
    page.get_by_role("button", name="Jump over it").click()
    until(page, lambda: states(past)[0]["at"] > gap[1])
    page.get_by_text("Nothing was received from").wait_for(state="detached")
    page.get_by_label("Place in the replay").focus()
    page.keyboard.press("Home")
    page.get_by_label("Jump over silence").check()
    page.get_by_role("combobox", name="Speed").select_option("200")
    until(page, lambda: states(past)[0]["at"] > gap[1])


def test_a_stretch_with_nothing_in_it_is_refused_with_what_is_around_it(page: Any, past: Past) -> None:
    begin = past.begin + GAP[0] * 3600.0 + 300.0
    page.goto(f"{past.address}/#/vehicle/1/replay?begin={begin:.0f}&end={begin + 300:.0f}")
    filled(page)
    page.get_by_role("button", name="Start the replay").click()
    page.get_by_role("alert").get_by_text("nothing was received of vehicle 1 in this stretch of time").wait_for()
    page.get_by_role("alert").get_by_text("the next at").wait_for()


def test_two_tabs_have_replays_of_their_own(page: Any, past: Past) -> None:
    begun(page, past, "1")
    other = page.context.new_page()
    other.goto(f"{past.address}/#/vehicle/1/replay?begin={past.begin + 7200:.0f}&end={past.begin + 10_800:.0f}")
    filled(other)
    other.get_by_role("button", name="Start the replay").click()
    other.locator(".tile .value").first.wait_for()
    until(page, lambda: len(states(past)) == 2)
    times = [tab.get_by_label("Time of the replay").inner_text() for tab in (page, other)]
    assert times[0] != times[1]
    other.get_by_role("button", name="End the replay").click()
    until(page, lambda: len(states(past)) == 1)
    before = states(past)[0]["at"]
    until(page, lambda: states(past)[0]["at"] > before)
    other.close()


def test_the_log_book_of_a_replay_knows_of_a_dive_what_was_known_then(page: Any, past: Past, screenshot: Any) -> None:
    """Oracle: the dives of the archive; of one that goes on nobody knows how deep it will be."""
    from playwright.sync_api import expect

    dives = [dive for dive in httpx.get(f"{past.address}/api/vehicles/1/dives").json() if dive["t_end"]]
    first, second = dives[:2]
    begun(page, past, "1")
    page.get_by_role("button", name="Pause").click()
    page.get_by_role("button", name="Go on").wait_for()
    page.get_by_role("tab", name="Log book").click()
    page.get_by_role("button", name="Dives", exact=True).click()
    (state,) = states(past)

    def told_at(t: float) -> None:
        httpx.put(f"{past.address}/api/replays/{state['replay']}", json={"at": t}).raise_for_status()

    entries = page.locator("li.dive")
    told_at(second["t_begin"] + 60.0)
    expect(entries).to_have_count(2)
    expect(entries.filter(has_text="Dive 2")).to_contain_text("under way")
    expect(entries.filter(has_text="Dive 2")).not_to_contain_text("200 m")
    expect(entries.filter(has_text="Dive 1 to 200 m")).to_contain_text("kJ")
    screenshot("replay-log")
    told_at(first["t_begin"] + 60.0)
    expect(entries).to_have_count(1)
    expect(entries).to_contain_text("under way")


def test_a_dive_comes_into_the_log_book_when_it_has_ended(page: Any, past: Past) -> None:
    """Here, where a further dive is in nobody's way."""
    page.goto(f"{past.address}/#/vehicle/1/log?kinds=dive")
    page.locator("li.dive").first.wait_for()
    t = round((past.begin - 86_400.0) * 1e3)
    past.speaker.say(
        "DIVE_SUMMARY", time_begin_unix_ms=t, time_end_unix_ms=t + 600_000, dive=77, greatest_depth=33.0, energy=9000.0
    )
    page.locator("li.dive", has_text="Dive 77 to 33 m").wait_for()
