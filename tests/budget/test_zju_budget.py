"""Oracle: Table 3 and section 3.1 of the paper; what the budget cannot meet is named."""

from math import radians, tan

import numpy as np
import pytest

from stommel.design.budget import BudgetStudy, budget_study
from stommel.vehicle import load_vehicle, stated_numbers

ZJU = load_vehicle("zju")


@pytest.fixture(scope="module")
def study() -> BudgetStudy:
    return budget_study(ZJU)


def test_masses_are_the_papers(study: BudgetStudy) -> None:
    budget = study.budget
    assert budget.total.mass == pytest.approx(60.0, abs=1e-9)
    assert budget.rigid_body.mass == pytest.approx(45.0, abs=1e-9)
    assert budget.moving.mass == pytest.approx(10.0, abs=1e-9)
    assert budget.ballast.mass == pytest.approx(5.0, abs=1e-9)
    assert sum(bay.mass.mass for bay in budget.bays) == pytest.approx(60.0, abs=1e-9)
    assert (
        sum(part.mass_kg for part in ZJU.description.parts if part.name.startswith("hull section")) == 20.5
    )  # Table 4


def test_it_is_neutral_and_level_in_its_reference_water(study: BudgetStudy) -> None:
    assert study.budget.neutral_density == pytest.approx(1000.0, abs=1e-6)
    assert np.abs(study.budget.centre_of_buoyancy).max() < 1e-6
    assert study.trimming is not None
    assert study.trimming.added == ()
    assert study.floats


def test_moving_mass_and_ballast_lie_where_section_3_1_says(study: BudgetStudy) -> None:
    np.testing.assert_allclose(study.budget.moving.centre, [0.25, 0.0, 0.0], atol=1e-6)
    np.testing.assert_allclose(study.budget.ballast.centre, [-0.5, 0.0, 0.0], atol=1e-6)
    np.testing.assert_allclose(study.budget.rigid_body.centre[:2], [0.0, 0.0], atol=1e-6)


def test_static_moment_about_x_is_balanced(study: BudgetStudy) -> None:
    """Level at neutral, as in the paper: 10 kg at 0.25 m against 5 kg at -0.5 m."""
    assert study.budget.total.mass * study.budget.total.centre[0] == pytest.approx(0.0, abs=1e-6)


def test_what_the_published_numbers_do_not_allow_is_named(study: BudgetStudy) -> None:
    found = {warning.name: warning.message for warning in study.warnings}
    assert set(found) == {"centre_of_mass_differs", "inertia_exceeds_file", "moving_mass_leaves_bay"}
    assert study.highest_lever is not None
    assert study.budget.rigid_body.centre[2] < study.highest_lever < 0.05
    travel = 45 * 0.05 / 10 * tan(radians(35)) * 1e3
    assert f"instead of {travel:.0f} mm" in found["centre_of_mass_differs"]
    # published sum of rigid body and water: 4, 12, 11
    assert np.diag(study.inertia.file_sum) == pytest.approx([4.0, 12.0, 11.0])
    assert study.inertia.budget[0, 0] < 4.0
    assert study.inertia.budget[1, 1] < 12.0
    assert not study.inertia.possible


def test_every_part_says_why(study: BudgetStudy) -> None:
    origins = [origin.kind for key, _, origin in stated_numbers(ZJU) if key.startswith("parts.")]
    assert set(origins) == {"assumption"}
