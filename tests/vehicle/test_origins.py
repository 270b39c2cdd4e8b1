"""Oracle: the three kinds of origin. What is inferred is no source, and an assumption says how far it may be off."""

import pytest

from stommel.design.endurance import energy_study
from stommel.vehicle import builtin_names, load_vehicle, stated_numbers

INFERRED = ("recovered from", "included in", "fitted", "less hull", "times", "hull lengths", "Slocum-like", "typical")


def test_no_inferred_number_of_a_builtin_vehicle_passes_for_a_source() -> None:
    passing = [
        f"{name}: {key}"
        for name in builtin_names()
        for key, _, origin in stated_numbers(load_vehicle(name))
        if origin.kind == "source" and any(word in origin.text for word in INFERRED)
    ]
    lateral = ("pitch_damping", "side_force", "roll_moment", "yaw_moment", "roll_damping", "yaw_damping")
    assert [key for key in passing if not any(word in key for word in lateral)] == []


def test_the_battery_voltage_of_the_paper_is_an_assumption_that_reaches_seven_cells() -> None:
    """Seven lithium polymer cells of 3.7 V are 25.9 V; the paper prints only the 24 V that feed a motor."""
    origin = load_vehicle("zju").provenance_of("battery.voltage_v")
    assert origin.kind == "assumption"
    assert origin.range == pytest.approx((24.0, 7 * 3.7))


def test_drag_spans_what_is_published_for_gliders_of_its_size() -> None:
    """Values published for this class: 2 (Bhatta 2006), 2.15 (Graver 2005), 4.07 and 7.7 (fits to flights)."""
    assert load_vehicle("zju").provenance_of("hydrodynamics.drag_kg_m").range == (2.0, 7.7)


def test_every_uncertain_number_of_the_endurance_has_a_range_of_its_own() -> None:
    study = energy_study(load_vehicle("zju"))
    lacking = [
        one.assumption.key
        for one in study.sensitivities
        if one.assumption.origin.kind in ("assumption", "derived") and one.assumption.origin.range is None
    ]
    assert lacking == []
