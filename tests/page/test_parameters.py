"""Parameters on the page, against a real station and a simulated glider."""

from typing import Any

import pytest

from tests.page.manned import told

expect = pytest.importorskip("playwright.sync_api").expect


@pytest.fixture
def view(page: Any, station: str) -> Any:
    """The parameters of the simulated glider, once it has told them."""
    page.goto(f"{station}/#/vehicle/1/parameters")
    page.locator("[data-parameter='SURFACE_TIME']").wait_for(timeout=120_000)
    return page


def parameter(station: str, name: str) -> dict[str, Any]:
    """A parameter as the station tells it."""
    answer = told(station, "/vehicles/1/parameters")
    (found,) = [each for one in answer["components"] for each in one["parameters"] if each["name"] == name]
    assert isinstance(found, dict)
    return found


def test_every_parameter_of_the_vehicle_is_listed_by_component(view: Any, station: str) -> None:
    answer = told(station, "/vehicles/1/parameters")
    names = {each["name"] for one in answer["components"] for each in one["parameters"]}
    shown = view.locator("[data-parameter]").evaluate_all("rows => rows.map(row => row.dataset.parameter)")
    assert set(shown) == names
    for component in answer["components"]:
        view.get_by_role("button", name=component["name"]).click()
        expect(view.locator("[data-parameter]")).to_have_count(len(component["parameters"]))
        assert all(each["words"] for each in component["parameters"]), "the vehicle tells what each means"


def test_values_are_shown_and_written_in_the_units_that_people_speak(view: Any, station: str) -> None:
    """Oracle: cubic metres as the vehicle has them, by hand a millionth of the millilitres typed."""
    row = parameter(station, "PUMP_FLOW")
    assert row["unit"] == "m3/s"
    view.locator("[data-parameter='PUMP_FLOW']").click()
    field = view.get_by_label("New value, ml/s")
    assert float(field.input_value()) == pytest.approx(1e6 * row["value"], rel=1e-6)
    wanted = 9.25 if abs(row["value"] - 9.25e-6) > 1e-9 else 9.5
    field.fill(str(wanted))
    view.get_by_role("button", name="Write").click()
    view.locator("[data-outcome='done']").wait_for(timeout=60_000)
    assert parameter(station, "PUMP_FLOW")["value"] == pytest.approx(1e-6 * wanted, rel=1e-6)
    expect(view.locator("[data-parameter='PUMP_FLOW']")).to_contain_text(f"{wanted} ml/s")


def test_a_search_finds_by_name_words_and_unit(view: Any, screenshot: Any) -> None:
    view.keyboard.press("/")
    view.keyboard.type("surface dive")
    expect(view.locator("[data-parameter]")).to_have_count(1)
    view.locator("[data-parameter='SURFACE_TIME']").click()
    screenshot("parameters")
    view.get_by_label("Search parameters by name, words or unit").fill("no such thing")
    view.get_by_text("No parameter fits the search.").wait_for()


def test_a_value_is_checked_before_it_is_sent_then_written_and_kept_with_who(view: Any, station: str) -> None:
    """Oracle: the parameter as the vehicle told it to the station afterwards, and its history."""
    row = parameter(station, "SURFACE_TIME")
    view.locator("[data-parameter='SURFACE_TIME']").focus()
    view.keyboard.press("Enter")
    field = view.get_by_label("New value, s")
    for typed in (f"{row['high'] + 1:.0f}", f"{row['low'] - 1:.0f}", "soon", ""):
        field.fill(typed)
        assert f"{row['low']:.0f} to {row['high']:.0f} s" in view.get_by_role("alert").inner_text()
        assert view.get_by_role("button", name="Write").is_disabled()
    wanted = 205.0 if row["value"] != 205.0 else 206.0
    field.fill(f"{wanted:.0f}")
    view.get_by_role("button", name="Write").click()
    view.locator("[data-outcome='done']").wait_for(timeout=60_000)
    assert parameter(station, "SURFACE_TIME")["value"] == wanted
    view.get_by_text("by local").first.wait_for()
    assert "changed:" in view.locator("[data-parameter='SURFACE_TIME']").inner_text()


def test_what_was_typed_outlives_a_reload(view: Any, station: str) -> None:
    view.locator("[data-parameter='SURFACE_TIME']").click()
    view.get_by_label("New value, s").fill("4321")
    view.reload()
    view.locator("[data-parameter='SURFACE_TIME']").click()
    assert view.get_by_label("New value, s").input_value() == "4321"
    assert parameter(station, "SURFACE_TIME")["value"] != 4321.0
