"""Two pilots at two browsers: who holds command is seen by both, taken over with a reason, and no word is lost.

Oracle: what the station itself tells of holder and limits afterwards.
"""

from collections.abc import Iterator
from typing import Any, NamedTuple

import pytest

from tests.page.conftest import Screenshot
from tests.page.manned import kind, sign_in
from tests.page.waiting import PATIENCE_S


class Pilots(NamedTuple):
    """Ling and Max, each at a browser of their own."""

    ling: Any
    max: Any


@pytest.fixture
def pilots(page: Any, browser: Any, manned: str) -> Iterator[Pilots]:
    context = browser.new_context(viewport={"width": 1440, "height": 900}, reduced_motion="reduce")
    context.add_init_script("localStorage.setItem('stommel-tour', 'done')")
    other = context.new_page()
    other.set_default_timeout(1e3 * PATIENCE_S)
    thrown: list[str] = []
    other.on("pageerror", lambda error: thrown.append(str(error)))
    sign_in(page, manned, "ling", "vehicle/1/commands")
    sign_in(other, manned, "max", "vehicle/1/commands")
    given_up(page, other)  # who held it in the test before
    yield Pilots(page, other)
    given_up(page, other)
    context.close()
    assert not thrown


def given_up(*pages: Any) -> None:
    for page in pages:
        page.evaluate("fetch('./api/vehicles/1/holder', {method: 'DELETE'}).then(() => null)")


def asked(page: Any, path: str) -> Any:
    """What the station answers to whoever sits at a page."""
    return page.evaluate("(path) => fetch(`./api${path}`).then((answer) => answer.json())", path)


def holds(page: Any, name: str) -> None:
    """Wait until a page says who holds command."""
    page.locator(f"[data-holder='{name}']").first.wait_for()


def test_command_is_handed_over_and_taken_over_before_the_eyes_of_both(pilots: Pilots, screenshot: Screenshot) -> None:
    from playwright.sync_api import expect

    ling, other = pilots
    ling.get_by_role("button", name="Take command").click()
    holds(ling, "ling")
    holds(other, "ling")
    other.get_by_text("ling holds command").first.wait_for()

    kind(other, "radio-time").click()
    other.get_by_label("time, s").fill("333")
    other.get_by_text("ling holds command. Take over first, above.").wait_for()
    give = other.get_by_role("button", name="Give “radio-time”")
    expect(give).to_be_disabled()
    expect(other.get_by_role("button", name="Abort", exact=True)).to_be_enabled()  # abort needs no hold

    ling.get_by_role("button", name="Hand over").click()
    holds(other, "")
    other.get_by_role("button", name="Take command").click()
    holds(ling, "max")
    ling.get_by_text("max holds command").first.wait_for()
    expect(other.get_by_label("time, s")).to_have_value("333")  # nothing typed is lost

    ling.goto(ling.url.replace("/commands", "/parameters"))
    holds(ling, "max")
    other.goto(other.url.replace("/commands", "/plots"))  # who holds command looks elsewhere
    ling.get_by_role("button", name="Take over…").click()
    dialog = ling.get_by_role("dialog")
    take = dialog.get_by_role("button", name="Take over")
    expect(take).to_be_disabled()  # only with a reason
    dialog.get_by_label("Reason").fill("change <b>of</b> watch")
    take.click()
    holds(ling, "ling")
    other.get_by_text("ling took over command of vehicle 1 from you: change <b>of</b> watch").wait_for()
    hold = asked(ling, "/vehicles/1/holder")["holder"]
    assert (hold["user"], hold["taken_from"], hold["reason"]) == ("ling", "max", "change <b>of</b> watch")
    other.screenshot(path=screenshot("two-pilots-taken-over").with_name("two-pilots-told.png"))


def test_a_command_between_two_pilots_goes_to_who_holds(pilots: Pilots) -> None:
    """Somebody gives a command as another takes the vehicle: the station refuses and says who holds it."""
    ling, other = pilots
    kind(other, "radio-time").click()
    other.get_by_label("time, s").fill("334")
    answer = ling.evaluate("fetch('./api/vehicles/1/holder', {method: 'POST', headers: {'content-type': "
                           "'application/json'}, body: '{}'}).then((answer) => answer.status)")  # fmt: skip
    assert answer == 200
    refused = other.evaluate(
        "fetch('./api/vehicles/1/commands', {method: 'POST', headers: {'content-type': 'application/json'}, body: "
        "JSON.stringify({name: 'radio-time', parameters: {time: 334}})}).then(async (answer) => "
        "[answer.status, (await answer.json()).detail.reason])"
    )
    assert refused[0] == 409
    assert "ling" in refused[1]
    holds(other, "ling")
    assert not [row for row in asked(ling, "/vehicles/1/commands") if row["parameters"] == {"time": 334.0}]


def test_both_change_one_limit_at_once(pilots: Pilots, screenshot: Screenshot) -> None:
    """The later one stands, both see the same, and who was about to put another in its place was told."""
    ling, other = pilots
    for page in pilots:
        page.goto(page.url.replace("/commands", "/alarms"))
    ling.evaluate("fetch('./api/vehicles/1/limits/roll_deg', {method: 'PUT', headers: {'content-type': "
                  "'application/json'}, body: JSON.stringify({high: 20, severity: 'notice'})})")  # fmt: skip
    for page in pilots:
        page.locator("tr", has_text="roll, right side down").click()
        page.get_by_role("dialog").get_by_label("Greatest value").wait_for()
    other.get_by_role("dialog").get_by_label("Greatest value").fill("35")
    ling.get_by_role("dialog").get_by_label("Greatest value").fill("25")
    ling.get_by_role("dialog").get_by_role("button", name="Set", exact=True).click()
    other.get_by_text("ling has just set this limit: greatest 25°. “Set” puts yours in its place.").wait_for()
    assert other.get_by_role("dialog").get_by_label("Greatest value").input_value() == "35"
    other.screenshot(path=screenshot("two-pilots-one-limit").with_name("two-pilots-limit-told.png"))
    other.get_by_role("dialog").get_by_role("button", name="Set", exact=True).click()
    for page in pilots:
        page.locator("tr", has_text="roll, right side down").get_by_text("35°").wait_for()
    limit = next(one for one in asked(ling, "/vehicles/1/limits") if one["channel"] == "roll_deg")
    assert (limit["high"], limit["severity"]) == (35.0, "notice")
