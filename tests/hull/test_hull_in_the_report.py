"""The design report says what `stommel hull` says, and names a hull that is too thin."""

import pytest

from stommel.design.study import design_study
from stommel.report import report_html
from stommel.vehicle import Vehicle, load_vehicle, vehicle_from_text
from stommel.vehicle.loading import builtin_text


def section(vehicle: Vehicle) -> str:
    html = report_html(design_study(vehicle))
    start = html.index('<section id="hull">')
    return html[start : html.index("</section>", start)]


@pytest.fixture(scope="module")
def thin() -> str:
    text = builtin_text("zju").replace("wall_mm = { value = 4.2", "wall_mm = { value = 3")
    return section(vehicle_from_text(text, "zju.toml"))


def test_a_wall_thinner_than_its_criterion_is_named(thin: str) -> None:
    assert "wall too thin" in thin
    assert "3 mm is less than the 4.18 mm" in thin


def test_materials_criteria_and_table_4(thin: str) -> None:
    assert "von Mises, n lobes" in thin
    assert "borosilicate glass" in thin
    assert "1.08e+05 MPa gives 4.15 mm and 255.04 MPa as printed" in thin
    assert "<svg" in thin


def test_a_vehicle_without_a_hull_says_so() -> None:
    assert "no table [hull]" in section(load_vehicle("rogue"))
