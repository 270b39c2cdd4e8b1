"""What is always there: the bar, abort, keys, colours, help and the first five minutes."""

from typing import Any

import pytest

from tests.page.waiting import PATIENCE_S, all_asked, becomes, passes, until


@pytest.fixture
def fleet(page: Any, fake_station: str) -> Any:
    """The fleet of the made-up station."""
    page.goto(f"{fake_station}/#/fleet")
    page.get_by_role("link", name="ZJU glider", exact=True).wait_for()
    return page


def test_abort_is_one_click_and_enter_away_from_every_view(fleet: Any, fake_station: str) -> None:
    """Issue: abort always one click away, and asked for once more; the focus stands on the deed."""
    from playwright.sync_api import expect

    for view in ("fleet", "map", "vehicle/1", "vehicle/1/plots", "vehicle/1/plan", "people"):
        fleet.goto(f"{fake_station}/#/{view}")
        fleet.get_by_role("button", name="Abort", exact=True).click()
        deed = fleet.get_by_role("button", name="Abort now")
        expect(deed).to_be_focused()
        fleet.keyboard.press("Escape")
        deed.wait_for(state="detached")
    fleet.get_by_role("button", name="Abort", exact=True).click()
    expect(fleet.get_by_role("button", name="Abort now")).to_be_focused()
    with fleet.expect_request("**/api/vehicles/1/abort") as asked:
        fleet.keyboard.press("Enter")
    assert asked.value.method == "POST"
    fleet.get_by_text("is on its way").wait_for()


def test_escape_from_the_abort_dialog_aborts_nothing(fleet: Any) -> None:
    sent: list[str] = []
    fleet.on("request", lambda request: sent.append(request.url) if request.method == "POST" else None)
    fleet.get_by_role("button", name="Abort", exact=True).click()
    deed = fleet.get_by_role("button", name="Abort now")
    deed.wait_for()
    fleet.keyboard.press("Escape")
    deed.wait_for(state="detached")
    passes(fleet, 200)
    all_asked(fleet)
    assert sent == []


def test_keys_open_views_but_not_while_somebody_types(fleet: Any) -> None:
    def is_there(letter: str, view: str) -> bool:
        fleet.keyboard.press("g")  # once more where the second key came too late for the first
        fleet.keyboard.press(letter)
        passes(fleet, 0)
        return bool(fleet.evaluate("location.hash") == view)

    until(fleet, lambda: is_there("v", "#/vehicle/1"))
    until(fleet, lambda: is_there("f", "#/fleet"))
    fleet.keyboard.press("/")
    becomes(fleet, lambda: fleet.evaluate("document.activeElement.id"), "vehicle-choice")
    assert is_there("m", "#/fleet")
    fleet.locator("main").focus()
    fleet.keyboard.press("?")
    fleet.get_by_role("dialog", name="Help and keys").wait_for()


def test_the_chosen_colours_stay_and_are_there_before_the_first_paint(fleet: Any) -> None:
    dark = "getComputedStyle(document.documentElement).colorScheme"
    fleet.keyboard.press("t")
    becomes(fleet, lambda: fleet.evaluate(dark), "dark")
    fleet.reload(wait_until="commit")
    fleet.wait_for_selector("body", state="attached")
    assert fleet.evaluate("document.documentElement.dataset.theme") == "dark"


def test_the_first_five_minutes_are_shown_once(browser: Any, fake_station: str) -> None:
    context = browser.new_context()
    context.set_default_timeout(1e3 * PATIENCE_S)
    try:
        tab = context.new_page()
        tab.goto(fake_station)
        card = tab.get_by_role("complementary", name="The first five minutes")
        card.get_by_text("is a simulated glider").wait_for()
        card.get_by_role("button", name="Next").click()
        card.get_by_role("link", name="Open the commands").click()
        tab.wait_for_function("location.hash === '#/vehicle/1/commands'")
        card.get_by_role("button", name="Next").click()
        card.get_by_role("button", name="Done").click()
        tab.reload()
        tab.get_by_role("button", name="Abort", exact=True).wait_for()
        assert card.count() == 0
    finally:
        context.close()


def test_a_vehicle_that_told_nothing_is_empty_with_reasons(fleet: Any) -> None:
    """jenseva/spray_pilot#39, #88: what is missing is empty with its reason; speed and current on the first screen."""
    silent = fleet.get_by_role("article", name="Sea-Wing 12")
    for label in ("State", "Position", "Last contact", "Next surfacing", "Battery", "Speed made good", "Current"):
        fact = silent.locator(".fact", has=fleet.get_by_text(label, exact=True))
        becomes(fleet, fact.locator("dd").all_inner_texts, ["–", "nothing has come from this vehicle yet"])
    flying = fleet.get_by_role("article", name="ZJU glider", exact=True)
    until(fleet, lambda: "0.29 m/s" in flying.inner_text().replace("\u202f", " "))
    until(fleet, lambda: "mean over depth, dive" in flying.inner_text())


def test_an_unknown_address_says_so(fleet: Any, fake_station: str) -> None:
    fleet.goto(f"{fake_station}/#/nowhere")
    fleet.get_by_text("There is no such view.").wait_for()
    fleet.goto(f"{fake_station}/#/vehicle/99999")
    fleet.get_by_text("There is no such vehicle.").wait_for()
    fleet.goto(f"{fake_station}/#/vehicle/3")
    fleet.get_by_text("No vehicle 3 is attached.").wait_for()


def test_words_of_a_station_are_never_markup(page: Any, fake_station: str) -> None:
    """Cross-site scripting: a vehicle's name with a script in it is shown as it is."""
    evil = "<img src=x onerror=window.broken=1>"

    def changed(route: Any) -> None:
        answer = route.fetch()
        route.fulfill(response=answer, json={**answer.json(), "name": evil})

    page.route("**/api/station", changed)
    page.goto(f"{fake_station}/#/fleet")
    page.get_by_text(evil).first.wait_for()
    assert page.evaluate("window.broken") is None
