"""What forms are made of. Oracle: the plan's own model, which takes both ends of a range and nothing beyond."""

from math import nextafter
from typing import Any

import pytest

from stommel.planning.vehicle_limits import vehicle_limits
from stommel.plans.fields import PlanField, plan_fields
from stommel.plans.problems import PlanError, plan_from
from stommel.vehicle import load_vehicle
from tests.plans.plans import plan_with

RANGED = [field for field in plan_fields() if field.low is not None and field.high is not None]


def put(key: str, value: Any) -> list[str]:
    """Keys that are out of range when a value stands there."""
    document = plan_with()
    *tables, name = key.split(".")
    table = document
    for part in tables:
        table = table.setdefault(part, {})
    table[name] = value
    try:
        plan_from(document)
    except PlanError as error:
        return [problem.key for problem in error.problems if "between" in problem.allowed]
    return []


def nearby(field: PlanField, end: float, way: float) -> float | int:
    """The next number beyond an end."""
    whole = isinstance(field.default, int) and not isinstance(field.default, bool)
    return int(end + (1 if way > end else -1)) if whole else nextafter(end, way)


@pytest.mark.parametrize("field", RANGED, ids=[field.key for field in RANGED])
def test_a_range_is_what_the_plan_takes(field: PlanField) -> None:
    assert field.low is not None
    assert field.high is not None
    whole = isinstance(field.default, int) and not isinstance(field.default, bool)
    for end in (field.low, field.high):
        assert field.key not in put(field.key, int(end) if whole else end)
    assert field.key in put(field.key, nearby(field, field.high, 1e12))
    assert field.key in put(field.key, nearby(field, field.low, -1e12))
    assert (put(field.key, 0.0) == []) or not field.or_zero


def test_every_number_has_words_and_most_have_units() -> None:
    fields = {field.key: field for field in plan_fields()}
    assert fields["dives.depth_m"].unit == "m"
    assert fields["dives.depth_m"].required
    assert fields["surface.every_hours"].default is None
    assert fields["sampling.phases"].several
    assert fields["sampling.phases"].choices == ("descent", "drift", "inflection", "ascent")
    unexplained = {field.key for field in plan_fields() if not field.words}
    assert unexplained <= {"format", "name", "start.latitude_deg", "start.longitude_deg"}


def test_a_vehicle_narrows_them() -> None:
    """Oracle: zju.toml, read by eye: 200 m, 250 ml either way, rudder to 60 degrees."""
    fields = {field.key: field for field in plan_fields(vehicle_limits(load_vehicle("zju")))}
    assert fields["dives.depth_m"].high == 200.0
    assert fields["surface.ballast_ml"].high == 250.0
    assert fields["heading_control.limit_deg"].high == 60.0
    assert fields["dives.pitch_deg"].high == 60.0
