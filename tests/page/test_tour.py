"""The first five minutes: shown by a station that is a demonstration, and every word of them can be followed."""

import re
from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

import pytest

from stommel.link.commands.table import command_named
from tests.page.manned import kind, told
from tests.page.waiting import PATIENCE_S

if TYPE_CHECKING:
    from tests.page.past import Past
    from tests.page.quay import Quay


@pytest.fixture
def newcomer(browser: Any) -> Iterator[Any]:
    """A page whose browser has seen nothing yet."""
    context = browser.new_context(viewport={"width": 1280, "height": 800})
    context.set_default_timeout(1e3 * PATIENCE_S)
    yield context.new_page()
    context.close()


def card(page: Any) -> Any:
    """The card of the first five minutes."""
    return page.get_by_role("complementary", name="The first five minutes")


def shown_by_the_help(page: Any) -> None:
    """Open it as people do at a station of real vehicles."""
    page.get_by_role("button", name="Abort", exact=True).wait_for()
    page.keyboard.press("?")
    page.get_by_role("button", name="Show the first five minutes").click()


def test_a_station_that_flies_a_simulated_glider_shows_it_by_itself(newcomer: Any, station: str) -> None:
    newcomer.goto(station)
    card(newcomer).get_by_role("button", name="Next").wait_for()


def test_the_command_that_it_names_is_there_asks_nothing_and_the_vehicle_does_it(newcomer: Any, quay: "Quay") -> None:
    """Oracle: the table of commands (the name, no confirmation, nothing to fill in) and the vehicle's last word."""
    station = quay.address
    newcomer.goto(station)
    shown_by_the_help(newcomer)
    card(newcomer).get_by_role("button", name="Next").click()
    words = card(newcomer).get_by_text("Something harmless to begin with").inner_text()
    command = command_named(re.findall("“(.+?)”", words)[0])
    assert (command.confirm, command.parameters) == ("", ())
    before = {row["id"] for row in told(station, "/vehicles/1/commands")}
    card(newcomer).get_by_role("link", name="Open the commands").click()
    kind(newcomer, command.name).click()
    newcomer.get_by_role("button", name=f"Give “{command.name}”").click()
    newcomer.screenshot(path="build/screenshots/tour.png")
    given = [row for row in _answered(newcomer, station, command.name) if row["id"] not in before]
    assert [(row["name"], row["state"]) for row in given] == [(command.name, "done")]


def _answered(page: Any, station: str, name: str) -> list[dict[str, Any]]:
    page.locator("tr[data-command][data-state='done']", has_text=name).first.wait_for()
    found: list[dict[str, Any]] = told(station, "/vehicles/1/commands")
    return found


def test_a_station_of_real_vehicles_shows_it_when_asked_only(newcomer: Any, past: "Past") -> None:
    """`demo` of station.toml is off unless the station flies a simulated glider itself."""
    assert told(past.address, "/station")["demo"] is False
    newcomer.goto(past.address)
    newcomer.get_by_role("button", name="Abort", exact=True).wait_for()  # the page is there
    assert card(newcomer).count() == 0
    shown_by_the_help(newcomer)
    card(newcomer).get_by_text("is attached to this station").wait_for()
