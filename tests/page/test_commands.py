"""Commands on the page, against a real station: forms, confirmation, queue, cancel, history, who holds command."""

import re
from typing import Any

import pytest

from stommel.link.commands.table import command_named
from tests.page.manned import kind, sign_in, told
from tests.page.waiting import PATIENCE_S, until


@pytest.fixture
def view(page: Any, station: str) -> Any:
    """The commands of the simulated glider."""
    page.goto(f"{station}/#/vehicle/1/commands")
    kind(page, "radio-time").wait_for()
    return page


def rows(station: str) -> list[dict[str, Any]]:
    """Commands that the station has."""
    found: list[dict[str, Any]] = told(station, "/vehicles/1/commands")
    return found


def is_far_from_the_surface(station: str) -> bool:
    """Whether what waits for the next surfacing waits for longer than a test takes."""
    vehicle = told(station, "/vehicles/1")
    rises = vehicle["next_surfacing"]
    return rises is None or rises["t"] > vehicle["now"] + 400.0


def test_a_command_is_given_and_seen_answered_by_the_vehicle(view: Any, station: str, screenshot: Any) -> None:
    """Oracle: the vehicle's own parameter has the new value afterwards."""
    kind(view, "radio-time").click()
    view.get_by_label("time, s").fill("321")
    view.get_by_role("button", name="Give “radio-time”").click()
    done = view.locator("tr[data-command][data-state='done']", has_text="time 321 s")
    done.wait_for(timeout=240_000)
    assert "local" in done.inner_text()
    row = next(row for row in rows(station) if row["parameters"] == {"time": 321.0})
    assert (row["state"], row["user"]) == ("done", "local")
    done.get_by_role("button").click()
    view.get_by_text(row["id"]).wait_for()
    screenshot("commands")


def test_a_value_out_of_range_is_told_beside_its_field_and_not_given(view: Any, station: str) -> None:
    """Oracle: range and unit stand in the table of commands."""
    from playwright.sync_api import expect

    before = len(rows(station))
    parameter = command_named("radio-time").parameters[0]
    kind(view, "radio-time").click()
    for typed in ("", "59", "86401", "ten"):
        view.get_by_label("time, s").fill(typed)
        view.get_by_role("button", name="Give “radio-time”").click()
        expect(view.get_by_role("alert")).to_contain_text(parameter.allowed)
        expect(view.get_by_role("alert")).to_contain_text(typed)
    expect(view.get_by_label("time, s")).to_have_attribute("aria-invalid", "true")
    assert len(rows(station)) == before


def test_a_dangerous_command_asks_first_with_the_sentence_of_the_table(view: Any, station: str) -> None:
    from playwright.sync_api import expect

    before = len(rows(station))
    kind(view, "restart").click()
    view.get_by_role("button", name="Give “restart”").click()
    dialog = view.get_by_role("dialog")
    expect(dialog).to_contain_text(command_named("restart").confirm)
    no = dialog.get_by_role("button", name="Do not give it")
    expect(no).to_be_focused()
    no.click()
    dialog.wait_for(state="detached")
    assert len(rows(station)) == before


def test_a_waiting_command_counts_down_by_the_clock_of_the_vehicle_and_is_taken_back(
    browser: Any, station: str
) -> None:
    """Issue: browser clock wrong. The browser believes it is 2036; the countdown is the station's. Oracle: the API."""
    from playwright.sync_api import expect

    context = browser.new_context(viewport={"width": 1440, "height": 900})
    context.add_init_script(
        "localStorage.setItem('stommel-tour', 'done'); const late = 3.2e11; const now = Date.now.bind(Date);"
        "Date.now = () => now() + late;"
    )
    context.set_default_timeout(1e3 * PATIENCE_S)
    page = context.new_page()
    page.goto(f"{station}/#/vehicle/1/commands")
    kind(page, "hold").click()
    until(page, lambda: is_far_from_the_surface(station))
    page.get_by_label("When").select_option("at_next_surfacing")
    page.get_by_label("Expires after").select_option("604800")
    page.get_by_role("button", name="Give “hold”").click()
    waiting = page.locator("li[data-command]", has_text="hold")
    waiting.wait_for()
    row = next(row for row in rows(station) if row["name"] == "hold" and not row["is_last"])
    days = (row["expires"] - told(station, "/vehicles/1")["now"]) / 86_400.0
    assert 6.0 < days <= 7.0
    expect(waiting).to_contain_text(re.compile(r"expires in (6 d 2\d|7 d 0) h"))
    waiting.get_by_role("button", name="Cancel").click()
    page.locator("tr[data-command][data-state='cancelled']", has_text="hold").first.wait_for(timeout=240_000)
    found = next(each for each in rows(station) if each["id"] == row["id"])
    assert found["state"] == "cancelled"
    context.close()


def test_what_was_typed_outlives_a_lost_station_and_a_reload(view: Any, station: str) -> None:
    """Issue: nothing is lost; and the person is told that nobody knows whether it was given."""
    from playwright.sync_api import expect

    before = len(rows(station))
    kind(view, "radio-time").click()
    view.get_by_label("time, s").fill("222")
    view.route("**/api/vehicles/1/commands", lambda route: route.abort())
    view.get_by_role("button", name="Give “radio-time”").click()
    view.get_by_text("it is not known whether it took the command").wait_for()
    view.unroute("**/api/vehicles/1/commands")
    view.reload()
    expect(view.get_by_label("time, s")).to_have_value("222")
    assert len(rows(station)) == before


def test_two_pilots_one_holds_command_the_other_takes_over_with_a_reason(
    browser: Any, manned: str, screenshot: Any, page: Any
) -> None:
    """Issue: one pilot holds command of a vehicle at a time, hand-over visible."""
    from playwright.sync_api import expect

    first, second = (browser.new_context(viewport={"width": 1280, "height": 800}) for _ in range(2))
    for context in (first, second):
        context.add_init_script("localStorage.setItem('stommel-tour', 'done')")
        context.set_default_timeout(1e3 * PATIENCE_S)
    ling, max_ = first.new_page(), second.new_page()
    sign_in(ling, manned, "ling", "vehicle/1/commands")
    sign_in(max_, manned, "max", "vehicle/1/commands")
    kind(ling, "check").click()
    ling.get_by_role("button", name="Give “check”").click()
    ling.locator("li[data-command]", has_text="check").wait_for()
    ling.get_by_text("You hold command").first.wait_for()
    max_.locator("[data-holder='ling']").wait_for()
    kind(max_, "hold").click()
    max_.get_by_text("ling holds command. Take over first").wait_for()
    expect(max_.get_by_role("button", name="Give “hold”")).to_be_disabled()
    max_.get_by_role("button", name="Take over…").click()
    take = max_.get_by_role("dialog").get_by_role("button", name="Take over")
    expect(take).to_be_disabled()  # a reason has to be given
    max_.get_by_label("Reason").fill("change of watch")
    take.click()
    max_.get_by_text("You hold command").first.wait_for()
    held = ling.locator("[data-holder='max']")
    expect(held).to_contain_text("change of watch")
    kind(ling, "hold").click()
    ling.get_by_text("max holds command. Take over first").wait_for()
    max_.screenshot(path="build/screenshots/commands-taken-over.png")
    first.close()
    second.close()


def test_a_viewer_sees_and_cannot_give(page: Any, manned: str) -> None:
    from playwright.sync_api import expect

    sign_in(page, manned, "vera", "vehicle/1/commands")
    kind(page, "hold").click()
    page.get_by_text("You may look, not command").wait_for()
    expect(page.get_by_role("button", name="Give “hold”")).to_be_disabled()
