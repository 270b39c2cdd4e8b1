"""The plan that people edit. Oracle: the plan of a mission, whose words and ranges it has."""

import json
from datetime import UTC, datetime
from typing import Any

import pytest

from stommel.mission.plan import Plan
from stommel.plans.plan import StationPlan
from stommel.plans.problems import PlanError, plan_from
from tests.plans.plans import PLAN, place, plan_with


def test_it_is_a_plan_of_a_mission_in_the_same_words() -> None:
    """Nothing is said twice: what the vehicle is told has the ranges of the mission's plan."""
    told = {key: value for key, value in PLAN.items() if key in Plan.model_fields}
    mission, plan = Plan.model_validate(told), plan_from(PLAN)
    assert plan.model_dump(include=set(Plan.model_fields)) == mission.model_dump()


def test_its_json_comes_back_the_same() -> None:
    plan = plan_from(PLAN)
    text = plan.model_dump_json()
    assert plan_from(json.loads(text)) == plan
    assert json.loads(text)["start_time"] == "2026-07-01T00:00:00Z"
    assert plan.start_time == datetime(2026, 7, 1, tzinfo=UTC)


def test_nulls_mean_what_is_left_out() -> None:
    plan = plan_from(plan_with(surface={"every_hours": None, "ballast_ml": None}, abort={"depth_m": None}))
    assert plan.surface.every_hours is None
    assert plan.abort.depth_m is None


@pytest.mark.parametrize(
    ("change", "key", "value", "allowed"),
    [
        ({"dives": {"depth_m": 0.1, "pitch_deg": 30, "speed_m_s": 0.5}}, "dives.depth_m", "0.1", "0.5 and 12000"),
        ({"dives": {"depth_m": 70, "pitch_deg": 80, "speed_m_s": 0.5}}, "dives.pitch_deg", "80", "5 and 60"),
        ({"dives": {"depth_m": "deep", "pitch_deg": 30, "speed_m_s": 0.5}}, "dives.depth_m", "'deep'", "a number"),
        ({"dives": {"depth_m": 70, "pitch_deg": 30}}, "dives", "", ""),
        ({"duration_days": 1000}, "duration_days", "1000", "0.01 and 365"),
        ({"waypoints": [place(91.0, 0.0)]}, "waypoints.0.latitude_deg", "91.0", "-90 and 90"),
        ({"geofence": [place(28.0, 126.0), place(29.0, 126.0)]}, "geofence", "2 corners", "at least 3"),
        ({"start_time": "2026-07-01T00:00:00"}, "start_time", "", ""),
        ({"water": {"ocean": "bathtub"}}, "water.ocean", "'bathtub'", "'east_china_sea'"),
        ({"water": {"current": "still", "north_m_s": 1}}, "water.current", "", "'given'"),
        ({"vehicle": None}, "vehicle", "", ""),
        ({"oops": 1}, "oops", "", "one of"),
    ],
)
def test_what_is_wrong_names_key_value_and_what_is_allowed(
    change: dict[str, Any], key: str, value: str, allowed: str
) -> None:
    with pytest.raises(PlanError) as raised:
        plan_from(plan_with(**change))
    found = {problem.key: problem for problem in raised.value.problems}
    assert key in found
    assert value in found[key].value
    assert allowed in found[key].allowed
    assert found[key].reason.startswith(key)


def test_every_problem_is_named_at_once() -> None:
    wrong = plan_with(
        dives={"depth_m": 0, "pitch_deg": 90, "speed_m_s": 9}, duration_days=-1, start=place(100.0, 500.0), oops=1
    )
    with pytest.raises(PlanError) as raised:
        plan_from(wrong)
    assert {problem.key for problem in raised.value.problems} == {
        "oops", "dives.depth_m", "dives.pitch_deg", "dives.speed_m_s", "duration_days", "start.latitude_deg",
        "start.longitude_deg",
    }  # fmt: skip


@pytest.mark.parametrize("document", [None, [], 3, "plan", {}, {"dives": []}])
def test_what_is_no_plan_is_told(document: Any) -> None:
    with pytest.raises(PlanError):
        plan_from(document)


def test_so_many_waypoints_are_too_many() -> None:
    with pytest.raises(PlanError, match="waypoints"):
        plan_from(plan_with(waypoints=[place(28.0, 126.0)] * 201))


def test_the_oceans_are_those_there_are() -> None:
    """Oracle: the catalogue, which is not imported by the server."""
    from stommel.files.table_keys import model_at
    from stommel.ocean.analytic.catalogue import ANALYTIC
    from stommel.plans.fields import plan_fields

    assert model_at(StationPlan, "water").__name__ == "Water"
    (ocean,) = [field for field in plan_fields() if field.key == "water.ocean"]
    assert set(ocean.choices) == set(ANALYTIC)
