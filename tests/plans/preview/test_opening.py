"""Orders opened as a plan. Oracle: the plan that they were made of, and their own bytes when they are made again."""

from typing import Any

import pytest

from stommel.control.orders_file import parse_orders
from stommel.errors import FileError
from stommel.plans.preview.opening import opened
from stommel.plans.preview.ordering import orders_for
from stommel.plans.problems import plan_from
from tests.plans.plans import PLAN, plan_with

AROUND = {key: PLAN[key] for key in ("vehicle", "start", "start_time", "water")}

EVERYTHING: dict[str, Any] = {
    "dives": {
        "depth_m": 65, "pitch_deg": 31.7, "ballast_ml": 100, "per_surfacing": 3, "turn_depth_m": 12,
        "least_altitude_m": 8, "drift_hours": 0.5,
    },
    "surface": {
        "session_s": 200, "longest_s": 900, "every_hours": 7, "pitch_deg": -38.5, "ballast_ml": 240, "depth_m": 0.8,
    },
    "guidance": {"acceptance_radius_m": 321, "lookahead_m": 1234.5, "repeat": True},
    "abort": {
        "depth_m": 71, "dive_hours": 3.3, "battery_share": 0.3, "leak": False, "internal_pressure_kpa": 90,
    },
    "pitch_control": {"gain_mm_per_deg": 3.3, "dead_band_deg": 0.7, "period_s": 100, "tolerance_mm": 0.4},
    "heading_control": {"response_s": 25, "dead_band_deg": 1.5, "limit_deg": 12},
    "drift_control": {
        "gain_ml_s_m": 55, "return_minutes": 9, "fastest_m_s": 0.04, "dead_band_m": 2, "period_s": 50,
    },
    "sampling": {"phases": ["descent", "ascent"], "every_s": 4.5},
    "duration_days": 2.5,
}  # fmt: skip
"""A value of its own for everything that orders hold."""


def flat(table: dict[str, Any], above: str = "") -> dict[str, Any]:
    found: dict[str, Any] = {}
    for key, value in table.items():
        found |= flat(value, f"{above}{key}.") if isinstance(value, dict) else {f"{above}{key}": value}
    return found


def test_everything_comes_back() -> None:
    text = orders_for(plan_from(plan_with(**EVERYTHING)))
    found = opened(text, AROUND)
    assert found.remarks == ()
    told = flat(found.plan)
    for key, value in flat(EVERYTHING).items():
        assert told[key] == (pytest.approx(value, rel=1e-6) if isinstance(value, float | int) else value), key
    assert told["waypoints"] == PLAN["waypoints"]


def test_made_again_they_are_the_same_bytes() -> None:
    text = orders_for(plan_from(plan_with(**EVERYTHING)))
    assert orders_for(plan_from(opened(text, AROUND).plan)) == text


def test_orders_by_a_speed_settle_after_one_round() -> None:
    """A speed makes different ballast down and up; the plan that is opened says so, and stays as it is from then on."""
    first = opened(orders_for(plan_from(PLAN)), AROUND)
    assert any("dives.speed_m_s" in words for words in first.remarks)
    text = orders_for(plan_from(first.plan))
    second = opened(text, AROUND)
    assert second.plan == first.plan
    assert orders_for(plan_from(second.plan)) == text
    one, two = (parse_orders(each, "orders")[0].dives for each in (text, orders_for(plan_from(PLAN))))
    assert one.depth == two.depth
    assert one.V_b_dive == pytest.approx(two.V_b_dive, abs=6e-6), "by 6 ml at most in this water"


def test_what_is_usual_is_left_out() -> None:
    dives = {"depth_m": 70, "pitch_deg": 30, "ballast_ml": 40}
    plan = opened(orders_for(plan_from(plan_with(dives=dives))), AROUND).plan
    assert "pitch_deg" not in plan["surface"]
    assert "ballast_ml" not in plan["surface"]
    assert "depth_m" not in plan["abort"]
    assert "gain_mm_per_deg" not in plan["pitch_control"]


def test_orders_of_another_vehicle_are_refused() -> None:
    text = orders_for(plan_from(PLAN)).replace('vehicle_sha256 = "', 'vehicle_sha256 = "0000')
    with pytest.raises(FileError, match="vehicle_sha256"):
        opened(text, AROUND)
    other = text.replace('vehicle_sha256 = "0000', 'vehicle_sha256 = "')
    changed = other.replace(parse_orders(other, "o")[1].vehicle_sha256, "0" * 64)
    with pytest.raises(FileError, match="for another vehicle"):
        opened(changed, AROUND)


@pytest.mark.parametrize("text", ["", "no orders", "format = 1", "[dives]\ndepth_m = 3"])
def test_what_is_no_orders_file_is_told(text: str) -> None:
    with pytest.raises(FileError):
        opened(text, AROUND)
