"""Parameters on the page, against a real station and a simulated glider."""

from typing import Any

import pytest

from tests.page.manned import told
from tests.page.waiting import until

expect = pytest.importorskip("playwright.sync_api").expect


@pytest.fixture
def view(page: Any, station: str) -> Any:
    """The parameters of the simulated glider, once it has told them."""
    page.goto(f"{station}/#/vehicle/1/parameters")
    page.locator("[data-parameter='SURFACE_TIME']").wait_for(timeout=240_000)
    return page


def parameter(station: str, name: str) -> dict[str, Any]:
    """A parameter as the station tells it."""
    answer = told(station, "/vehicles/1/parameters")
    (found,) = [each for one in answer["components"] for each in one["parameters"] if each["name"] == name]
    assert isinstance(found, dict)
    return found


def test_every_parameter_of_the_vehicle_is_listed_by_component(view: Any, station: str) -> None:
    def names() -> set[str]:
        answer = told(station, "/vehicles/1/parameters")
        return {each["name"] for one in answer["components"] for each in one["parameters"]}

    shown = view.locator("[data-parameter]")
    until(view, lambda: set(shown.evaluate_all("rows => rows.map(row => row.dataset.parameter)")) == names())
    for component in told(station, "/vehicles/1/parameters")["components"]:
        view.get_by_role("button", name=component["name"]).click()
        expect(shown).to_have_count(len(component["parameters"]))
        assert all(each["words"] for each in component["parameters"]), "the vehicle tells what each means"


def test_values_are_shown_and_written_in_the_units_that_people_speak(view: Any, station: str) -> None:
    """Oracle: cubic metres as the vehicle has them, by hand a millionth of the millilitres typed."""
    view.locator("[data-parameter='PUMP_FLOW']").wait_for(timeout=240_000)  # each node tells its own, one after another
    row = parameter(station, "PUMP_FLOW")
    assert row["unit"] == "m3/s"
    view.locator("[data-parameter='PUMP_FLOW']").click()
    field = view.get_by_label("New value, ml/s")
    assert float(field.input_value()) == pytest.approx(1e6 * row["value"], rel=1e-6)
    wanted = 9.25 if abs(row["value"] - 9.25e-6) > 1e-9 else 9.5
    field.fill(str(wanted))
    view.get_by_role("button", name="Write").click()
    expect(view.locator("[data-outcome='done']")).to_contain_text(
        f"{wanted} ml/s", timeout=240_000
    )  # not one of before
    assert parameter(station, "PUMP_FLOW")["value"] == pytest.approx(1e-6 * wanted, rel=1e-6)
    expect(view.locator("[data-parameter='PUMP_FLOW']")).to_contain_text(f"{wanted} ml/s")


def test_a_search_finds_by_name_words_and_unit(view: Any, screenshot: Any) -> None:
    search = view.get_by_label("Search parameters by name, words or unit")
    view.keyboard.press("/")
    expect(search).to_be_focused()
    view.keyboard.type("surface dive")
    expect(view.locator("[data-parameter]")).to_have_count(1)
    view.locator("[data-parameter='SURFACE_TIME']").click()
    screenshot("parameters")
    search.fill("no such thing")
    view.get_by_text("No parameter fits the search.").wait_for()


def test_a_value_is_checked_before_it_is_sent_then_written_and_kept_with_who(view: Any, station: str) -> None:
    """Oracle: the parameter as the vehicle told it to the station afterwards, and its history."""
    row = parameter(station, "SURFACE_TIME")
    view.locator("[data-parameter='SURFACE_TIME']").focus()
    view.keyboard.press("Enter")
    field = view.get_by_label("New value, s")
    for typed in (f"{row['high'] + 1:.0f}", f"{row['low'] - 1:.0f}", "soon", ""):
        field.fill(typed)
        expect(view.get_by_role("alert")).to_contain_text(f"{row['low']:.0f} to {row['high']:.0f} s")
        expect(view.get_by_role("button", name="Write")).to_be_disabled()
    wanted = 205.0 if row["value"] != 205.0 else 206.0
    field.fill(f"{wanted:.0f}")
    view.get_by_role("button", name="Write").click()
    expect(view.locator("[data-outcome='done']")).to_contain_text(f"{wanted:.0f} s", timeout=240_000)
    assert parameter(station, "SURFACE_TIME")["value"] == wanted
    view.get_by_text("by local").first.wait_for()
    expect(view.locator("[data-parameter='SURFACE_TIME']")).to_contain_text("changed:")


def test_what_was_typed_outlives_a_reload(view: Any, station: str) -> None:
    view.locator("[data-parameter='SURFACE_TIME']").click()
    view.get_by_label("New value, s").fill("4321")
    view.reload()
    view.locator("[data-parameter='SURFACE_TIME']").click()
    expect(view.get_by_label("New value, s")).to_have_value("4321")
    assert parameter(station, "SURFACE_TIME")["value"] != 4321.0
