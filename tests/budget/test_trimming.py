"""Oracle: equilibrium. With what is to be added the vehicle is neutral and level, and what is added fits."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from stommel.design.budget import BudgetError, Trimming, budget_study, mass_budget
from stommel.design.budget.trimming import trimming
from stommel.vehicle import Vehicle, builtin_text, load_vehicle, vehicle_from_text

ZJU = load_vehicle("zju")
BAYS = {bay.name: bay for bay in ZJU.description.bays}
PARTS = [part.name for part in ZJU.description.parts]


def key(name: str, field: str) -> str:
    return f"parts.{PARTS.index(name)}.{field}"


def residual(vehicle: Vehicle, trimmed: Trimming) -> np.ndarray:
    """Weight less buoyancy [kg] and its moments along and across [kg m] of the vehicle with everything added."""
    parts, rho = vehicle.description.parts, trimmed.rho
    rows = [(p.mass_kg - rho * p.volume_m3, p.position_m) for p in parts]
    rows += [(b.mass - rho * b.displaced, b.position) for b in trimmed.added]
    return np.array([sum(w for w, _ in rows), sum(w * r[0] for w, r in rows), sum(w * r[1] for w, r in rows)])


@settings(deadline=None, max_examples=60)
@given(
    rho=st.floats(990.0, 1030.0),
    ctd=st.floats(0.5, 4.0),
    radio=st.just(0.0) | st.floats(0.001, 1.5),
    aside=st.floats(-0.03, 0.03),
)
def test_trimmed_is_neutral_and_level(rho: float, ctd: float, radio: float, aside: float) -> None:
    vehicle = ZJU.with_value(key("CTD", "mass_kg"), ctd).with_value(
        key("GPS receiver and radio modem", "mass_kg"), radio
    )
    vehicle = vehicle.with_value(key("GPS receiver and radio modem", "position_m.1"), aside)
    trimmed = trimming(vehicle, mass_budget(vehicle), rho)
    assert trimmed is not None
    left = residual(vehicle, trimmed)
    assert abs(left[0]) < 5e-3  # blocks below a gram are left out, foam displaces five times its mass
    assert np.abs(left[1:]).max() < 5e-3
    for body in trimmed.added:
        bay = BAYS[body.bay]
        assert bay.to_m - 1e-9 <= body.position[0] <= bay.from_m + 1e-9
        assert bay.flooded == (body.material == "foam")
        assert (body.mass < 0.0) == (body.material == "removed")
        assert np.hypot(body.position[1], body.position[2]) < 0.105
    assert trimmed.mass == pytest.approx(mass_budget(vehicle).total.mass + trimmed.added_mass)


def without_trim_weights() -> Vehicle:
    text = builtin_text("zju").replace("trim_weight = true\n", "")
    return vehicle_from_text(text, "fixed.toml")


def test_lighter_water_than_trimmed_for_takes_trim_weight_out() -> None:
    trimmed = budget_study(ZJU, 995.0).trimming
    assert trimmed is not None
    assert trimmed.surplus == pytest.approx(-0.3, abs=1e-9)
    assert {body.part for body in trimmed.added} == {"trim weight, front", "trim weight, middle"}
    assert trimmed.added_mass == pytest.approx(-0.3, abs=1e-9)


def test_lighter_water_takes_foam_where_no_trim_weight_can_go() -> None:
    trimmed = budget_study(without_trim_weights(), 995.0).trimming
    assert trimmed is not None
    assert {body.material for body in trimmed.added} == {"foam"}
    lift = sum(body.displaced * 995.0 - body.mass for body in trimmed.added)
    assert lift == pytest.approx(0.3, abs=1e-6)


def test_foam_is_put_high_and_lead_low() -> None:
    """At 0.8 of the radius inside, 84 mm from the axis; z is down, so that both steady the vehicle."""
    foam, lead = (budget_study(without_trim_weights(), rho).trimming for rho in (995.0, 1025.0))
    for trimmed, material, sign in ((foam, "foam", -1.0), (lead, "lead", 1.0)):
        assert trimmed is not None
        assert {body.material for body in trimmed.added} == {material}
        for body in trimmed.added:
            assert np.hypot(body.position[1], body.position[2]) == pytest.approx(0.084)
            assert sign * body.position[2] > 0.07


@pytest.mark.parametrize("rho", [995.0, 1025.0])
def test_stability_is_of_all_masses_and_volumes(rho: float) -> None:
    """Centre of mass below centre of buoyancy, summed anew over the parts and what is added."""
    vehicle = without_trim_weights()
    trimmed = budget_study(vehicle, rho).trimming
    assert trimmed is not None
    rows = [(p.mass_kg, p.volume_m3, p.position_m[2]) for p in vehicle.description.parts]
    rows += [(b.mass, b.mass / 200.0 if b.material == "foam" else 0.0, b.position[2]) for b in trimmed.added]
    centre = sum(m * z for m, _, z in rows) / sum(m for m, _, _ in rows)
    buoyancy = sum(V * z for _, V, z in rows) / sum(V for _, V, _ in rows)
    assert trimmed.stability_arm == pytest.approx(centre - buoyancy, abs=1e-9)


def test_denser_water_takes_one_trim_weight() -> None:
    trimmed = budget_study(ZJU, 1025.0).trimming
    assert trimmed is not None
    (lead,) = trimmed.added
    assert lead.material == "lead"
    assert lead.mass == pytest.approx(0.060 * 25.0, rel=1e-9)
    assert lead.position[0] == pytest.approx(0.0, abs=1e-4)
    assert trimmed.stability_arm > 0.0161


def test_a_budget_that_does_not_float_is_named_and_says_what_it_needs() -> None:
    study = budget_study(ZJU.with_value(key("battery package", "mass_kg"), 9.6))
    names = {warning.name: warning.message for warning in study.warnings}
    assert not study.floats
    assert "0.750 kg too much" in names["does_not_float"]
    assert "mass_differs" in names
    assert "over_specification" in names
    assert study.trimming is not None
    assert study.trimming.added_mass == pytest.approx(-1.0)
    assert {body.material for body in study.trimming.added} == {"removed"}


def test_a_vehicle_far_too_heavy_has_no_place_for_its_foam() -> None:
    study = budget_study(ZJU.with_value(key("battery package", "mass_kg"), 40.0))
    assert study.trimming is None
    assert study.reserve is None
    assert {"does_not_float", "no_place_to_trim"} <= {warning.name for warning in study.warnings}


def test_a_budget_that_does_not_sink_and_one_that_turns_over() -> None:
    light = budget_study(ZJU.with_value(key("trim weight, middle", "mass_kg"), 2.0))
    assert "does_not_sink" in {warning.name for warning in light.warnings}
    high = ZJU.with_value(key("trim weight, middle", "position_m.2"), -0.079)
    high = high.with_value(key("trim weight, front", "position_m.2"), -0.094)
    assert "top_heavy" in {warning.name for warning in budget_study(high).warnings}


def test_impossible_requests() -> None:
    with pytest.raises(BudgetError, match="foam density = 1100"):
        budget_study(ZJU, foam_density_kg_m3=1100.0)
    with pytest.raises(BudgetError, match="density = 800 kg/m3"):
        budget_study(ZJU, 800.0)
    with pytest.raises(BudgetError, match="density = nan"):
        budget_study(ZJU, float("nan"))
    with pytest.raises(BudgetError, match="1027:1010"):
        budget_study(ZJU, (1027.0, 1010.0))
    with pytest.raises(BudgetError, match=r"slocum\.toml: has no table \[\[parts\]\]"):
        budget_study(load_vehicle("slocum"))
