"""The design report says what `stommel hull` says, and names a hull that is too thin."""

from collections.abc import Callable

import pytest

from stommel.design.study import design_study
from stommel.vehicle import vehicle_from_text
from stommel.vehicle.loading import builtin_text
from tests.support.reports import report_without_pictures


def section(html: str) -> str:
    start = html.index('<section id="hull">')
    return html[start : html.index("</section>", start)]


@pytest.fixture
def thin() -> str:
    text = builtin_text("zju").replace("wall_mm = { value = 4.2", "wall_mm = { value = 3")
    return section(report_without_pictures(design_study(vehicle_from_text(text, "zju.toml"))))


def test_a_wall_thinner_than_its_criterion_is_named(thin: str) -> None:
    assert "wall too thin" in thin
    assert "3 mm is less than the 4.18 mm" in thin


def test_materials_criteria_and_table_4(report_of: Callable[[str], str]) -> None:
    shown = section(report_of("zju"))
    assert "von Mises, n lobes" in shown
    assert "borosilicate glass" in shown
    assert "1.08e+05 MPa gives 4.15 mm and 255.04 MPa as printed" in shown
    assert "<svg" in shown


def test_a_vehicle_without_a_hull_says_so(report_of: Callable[[str], str]) -> None:
    assert "no table [hull]" in section(report_of("rogue"))
