"""A component of the vehicle that does not answer, and "Ask the vehicle". Oracle: the vehicle's side of the link."""

from typing import Any

from stommel.link.parameters.port import MOTION_COMPONENT, ParameterState
from tests.link.parameters.vehicle import ACQUISITION, COORDINATOR, MOTION
from tests.page.quay import Quay
from tests.page.waiting import becomes


def lamp(page: Any, name: str) -> str:
    """What is said of a component."""
    words: str = page.get_by_role("button", name=name).locator(".lamp").inner_text()
    return words


def ask(page: Any) -> None:
    """Ask the vehicle once more."""
    page.get_by_role("button", name="Ask the vehicle").click()
    page.get_by_text("is asked for its parameters").first.wait_for()


def test_a_silent_component_marks_only_its_own_parameters(page: Any, quay: Quay, screenshot: Any) -> None:
    """mavlink/qgroundcontrol#4716, #6890, #15114: one dead node does not block the rest; it is had back by asking."""
    parameters = quay.vehicle.parameters
    page.goto(f"{quay.address}/#/vehicle/1/parameters")
    rows = page.locator("[data-parameter]")
    becomes(page, rows.count, len(COORDINATOR) + len(MOTION) + len(ACQUISITION))
    parameters.states[MOTION_COMPONENT] = ParameterState.SILENT
    ask(page)
    becomes(page, lambda: lamp(page, "motion node"), "does not answer")
    assert (lamp(page, "coordinator"), lamp(page, "acquisition node")) == ("known", "known")
    page.get_by_role("row", name="motion node").get_by_text("does not answer").wait_for()
    assert rows.count() == len(COORDINATOR) + len(MOTION) + len(ACQUISITION), "what it said before is still shown"
    screenshot("parameters-silent")
    parameters.states[MOTION_COMPONENT] = ParameterState.KNOWN
    ask(page)
    becomes(page, lambda: lamp(page, "motion node"), "known")
