"""Oracle: the vehicle that comes out flies with the masses, centres and inertia of its parts."""

import numpy as np
import pytest

from stommel.analysis import trim
from stommel.design.budget import BudgetError, applied_text, budget_study
from stommel.dynamics.packing import pack
from stommel.vehicle import PAPER, builtin_text, load_vehicle, vehicle_from_text

ZJU = load_vehicle("zju")
TEXT = builtin_text("zju")


def test_rigid_body_is_the_parts() -> None:
    study = budget_study(ZJU)
    new = vehicle_from_text(applied_text(study, TEXT), "new.toml")
    body = new.description.rigid_body
    assert body.mass_kg == pytest.approx(45.0)
    np.testing.assert_allclose(body.centre_of_mass_m, study.budget.rigid_body.centre, atol=1e-9)
    np.testing.assert_allclose(body.inertia_kg_m2, study.budget.rigid_body.inertia, atol=1e-8)
    assert new.provenance_of("rigid_body.mass_kg").text == "sum of [[parts]], by stommel budget"
    # nothing is left to differ but what parts cannot mend
    assert {w.name for w in budget_study(new).warnings} == {"moving_mass_leaves_bay"}


def test_the_dynamics_take_it() -> None:
    study = budget_study(ZJU)
    new = vehicle_from_text(applied_text(study, TEXT), "new.toml")
    record = pack(new, PAPER)
    np.testing.assert_allclose(record.s_0, 45 * study.budget.rigid_body.centre + 5 * np.array([-0.5, 0, 0]), atol=1e-7)
    flight = trim(new, speed_m_s=0.4, pitch_deg=-35.0)
    neutral, lever = 0.25, 45 * study.budget.rigid_body.centre[2] / 10
    hydrodynamic = trim(ZJU, speed_m_s=0.4, pitch_deg=-35.0).r_px - neutral - 45 * 0.05 / 10 * np.tan(np.radians(35))
    assert flight.r_px == pytest.approx(neutral + lever * np.tan(np.radians(35)) + hydrodynamic, abs=1e-6)


def test_all_else_and_the_comments_stay() -> None:
    new = applied_text(budget_study(ZJU), TEXT)
    old_lines, new_lines = TEXT.splitlines(), new.splitlines()
    gone = [line for line in old_lines if line not in new_lines]
    assert len(gone) <= 6
    assert [line for line in new_lines if line.startswith("#")] == [line for line in old_lines if line.startswith("#")]


def test_a_published_sum_that_leaves_something_stays_the_sum() -> None:
    text = TEXT.replace("value = [4, 12, 11]", "value = [4, 22, 22]", 1)
    assert text != TEXT
    vehicle = vehicle_from_text(text, "roomy.toml")
    new = vehicle_from_text(applied_text(budget_study(vehicle), text), "new.toml").description
    total = np.array(new.rigid_body.inertia_kg_m2) + np.array(new.added_inertia.inertia_kg_m2)
    np.testing.assert_allclose(total, np.diag([4.0, 22.0, 22.0]), atol=1e-8)


def test_a_given_added_inertia_is_kept() -> None:
    text = TEXT.replace("value = [0, 0, 0], derived", "value = [0.1, 9, 9], derived", 1)
    vehicle = vehicle_from_text(text, "given.toml")
    new = vehicle_from_text(applied_text(budget_study(vehicle), text), "new.toml").description
    np.testing.assert_allclose(new.added_inertia.inertia_kg_m2, np.diag([0.1, 9.0, 9.0]))


def test_a_budget_that_does_not_float_is_not_applied() -> None:
    heavy = ZJU.with_value("parts.0.mass_kg", 12.0)
    with pytest.raises(BudgetError, match="does not float is not applied"):
        applied_text(budget_study(heavy), TEXT)


def test_a_budget_that_does_not_sink_is_not_applied() -> None:
    """1.5 kg of lead out of 60 kg where the engine has 250 ml below neutral."""
    light = ZJU.with_value("parts.23.mass_kg", ZJU.value("parts.23.mass_kg") - 1.5)
    assert ZJU.description.parts[23].trim_weight
    with pytest.raises(BudgetError, match="does not sink is not applied"):
        applied_text(budget_study(light), TEXT)


def test_a_budget_that_would_not_return_from_the_depth_is_not_applied() -> None:
    """220 g too heavy: 250 ml lift it at the surface, but at 2 MPa 60 l at 5e-10 1/Pa have lost 59 ml."""
    heavy = ZJU.with_value("parts.23.mass_kg", ZJU.value("parts.23.mass_kg") + 0.22)
    (found,) = [warning for warning in budget_study(heavy).warnings if warning.name == "does_not_rise"]
    assert "lost 58.9 ml" in found.message
    with pytest.raises(BudgetError, match="does not rise is not applied"):
        applied_text(budget_study(heavy), TEXT)
    (within,) = [ZJU.with_value("parts.23.mass_kg", ZJU.value("parts.23.mass_kg") + 0.18)]
    assert applied_text(budget_study(within), TEXT)
