"""Elasticities that follow from the balance, and targets that are reached when the file says so."""

import pytest

from stommel.design.endurance import EnergyStudy, Sensitivity, endurance
from stommel.vehicle import Vehicle


def of(study: EnergyStudy, key: str) -> Sensitivity:
    return next(one for one in study.sensitivities if one.assumption.key == key)


def test_usable_energy_is_endurance(study: EnergyStudy) -> None:
    assert of(study, "battery.usable_fraction").elasticity == pytest.approx(1.0, abs=1e-9)


def test_capacity_carries_its_self_discharge(study: EnergyStudy) -> None:
    share = study.result.as_row()["share"]["self-discharge"]
    assert of(study, "battery.capacity_ah").elasticity == pytest.approx(1.0 - share, abs=1e-4)


@pytest.mark.parametrize(
    ("key", "parts"),
    [
        ("consumers.0.power_w", ["coordination controller"]),
        ("consumers.4.power_w", ["CTD Sea-Bird GPCTD"]),
        ("works.pitch", ["pitch drive"]),
        # the heat of the battery's resistance grows with the square of the pump's energy
        (
            "works.pump",
            [
                "buoyancy engine: inflating at depth",
                "buoyancy engine: raising the antenna",
                "valve",
                *2 * ["battery: heat of its own resistance"],
            ],
        ),
    ],
)
def test_a_power_weighs_as_much_as_its_share(study: EnergyStudy, key: str, parts: list[str]) -> None:
    shares = study.result.as_row()["share"]
    # d ln t / d ln p = -share; a central difference of 1 % is right to 1e-4
    assert of(study, key).elasticity == pytest.approx(-sum(shares[part] for part in parts), abs=2e-4)


def test_every_number_of_the_energy_tables_is_tried(zju: Vehicle, study: EnergyStudy) -> None:
    tried = {one.assumption.key for one in study.sensitivities}
    stated = {
        key
        for key in zju.provenance
        if key.split(".")[0] in {"battery", "energy", "consumers"} and isinstance(zju_value(zju, key), int | float)
    }
    # it bounds the search, not the dive
    assert stated - tried == {"energy.slowest_speed_m_s"}


def zju_value(vehicle: Vehicle, key: str) -> object:
    here: object = vehicle.document
    for part in key.split("."):
        here = here[int(part)] if isinstance(here, list) else here[part]  # type: ignore[index]  # a table
    return here


@pytest.mark.parametrize("key", ["consumers.0.power_w", "energy.regulator_efficiency", "battery.capacity_ah"])
def test_ends_of_the_span_are_what_the_changed_file_gives(zju: Vehicle, study: EnergyStudy, key: str) -> None:
    one = of(study, key)
    for value, days in ((one.low, one.days_at_low), (one.high, one.days_at_high)):
        assert endurance(zju.with_value(key, value)).days == pytest.approx(days, rel=1e-12)


def test_flight_is_trimmed_anew(zju: Vehicle, study: EnergyStudy) -> None:
    one = of(study, "dive.speed_m_s")
    assert endurance(zju, speed_m_s=one.low).days == pytest.approx(one.days_at_low, rel=1e-12)
    drag = of(study, "hydrodynamics.drag_kg_m")
    assert endurance(zju.with_value("hydrodynamics.drag_kg_m", drag.low)).days == pytest.approx(
        drag.days_at_low, rel=1e-9
    )


def test_the_value_that_alone_would_do_does(zju: Vehicle, study: EnergyStudy) -> None:
    assert study.gap is not None
    assert study.gap.alone
    for one in study.gap.alone:
        assert one.needed is not None
        assert endurance(zju.with_value(one.assumption.key, one.needed)).days == pytest.approx(20.0, rel=1e-5)


def test_the_gap_is_a_power(study: EnergyStudy) -> None:
    gap, result = study.gap, study.result
    assert gap is not None
    lost = result.stored.self_discharge_w
    assert result.stored.usable_j / (gap.allowed_power_w + lost) == pytest.approx(20 * 86400, rel=1e-12)
    assert gap.missing_power_w == pytest.approx(result.mean_power_w - gap.allowed_power_w)
    days = [result.days, *(step.days for step in gap.steps)]
    assert days == sorted(days)


def test_a_met_target_leaves_no_gap(zju: Vehicle) -> None:
    from stommel.design.endurance import energy_study

    found = energy_study(zju.with_value("battery.capacity_ah", 90.0))
    assert found.gap is None
    assert found.result.days > 20.0
    assert all(one.needed is None for one in found.sensitivities)
