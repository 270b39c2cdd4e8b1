"""Orders of a plan. Oracle: those of a mission file that says the same, and the limits aboard."""

import tomllib
from pathlib import Path
from typing import Any

import pytest

from stommel.control.orders_file import parse_orders
from stommel.control.vehicle_limits import refusals
from stommel.planning.vehicle_limits import vehicle_limits
from stommel.plans.preview.ordering import Ordered, ordered, orders_for
from stommel.plans.problems import plan_from
from stommel.simulation.planned_orders import planned_orders
from stommel.simulation.scenario.loading import mission_from
from stommel.vehicle import load_vehicle
from stommel.vehicle.fingerprint import untrimmed_fingerprint
from tests.plans.plans import PLAN, place, plan_with


def made(**changes: Any) -> Ordered:
    return ordered(plan_from(plan_with(**changes)))


def keys(found: Ordered) -> set[str]:
    return {problem.key for problem in found.problems}


def test_they_are_those_of_the_mission_file_that_says_the_same() -> None:
    document = {key: value for key, value in PLAN.items() if key not in ("water",)} | {
        "ocean": {"name": "east_china_sea"}
    }
    mission = mission_from(document, "mission.toml", Path())
    theirs = planned_orders(mission)
    text = orders_for(plan_from(PLAN))
    ours, header = parse_orders(text, "orders")
    assert ours.dives == theirs.dives
    assert ours.laws == theirs.laws
    assert ours.alarms == theirs.alarms
    assert (ours.waypoints == theirs.waypoints).all()
    assert header.vehicle_sha256 == untrimmed_fingerprint(load_vehicle("zju"))
    assert header.expires_hours == 24.0


def test_the_vehicle_would_take_them() -> None:
    """Oracle: the check that the vehicle's own software makes of whatever comes by radio."""
    orders, header = parse_orders(orders_for(plan_from(PLAN)), "orders")
    assert refusals(orders, header, vehicle_limits(load_vehicle("zju")), "orders") == []


def test_a_whole_plan_of_mistakes_is_told_at_once() -> None:
    found = made(
        dives={"depth_m": 300, "pitch_deg": 30, "speed_m_s": 0.5},
        surface={"ballast_ml": 400},
        waypoints=[place(28.67, 126.13), place(50.0, -30.0)],
        geofence=[place(28.0, 126.0), place(29.0, 126.0), place(29.0, 127.0), place(28.0, 127.0)],
    )
    assert found.orders is None
    assert keys(found) == {"dives.depth_m", "surface.ballast_ml", "waypoints.1"}
    told = {problem.key: problem for problem in found.problems}
    assert told["dives.depth_m"].value == "300"
    assert told["dives.depth_m"].allowed == "at most 200 m"


@pytest.mark.parametrize(
    ("change", "key"),
    [
        ({"dives": {"depth_m": 150, "pitch_deg": 30, "speed_m_s": 0.5}}, "dives.depth_m"),  # below the bottom
        ({"dives": {"depth_m": 70, "pitch_deg": 30, "ballast_ml": 200}}, "dives"),  # beyond the engine in this water
        ({"heading_control": {"limit_deg": 70}}, "heading_control.limit_deg"),
        ({"abort": {"depth_m": 60}}, "abort.depth_m"),
        ({"abort": {"depth_m": 230}}, "abort.depth_m"),
        ({"abort": {"internal_pressure_kpa": 120}}, "abort.internal_pressure_kpa"),
        ({"start": place(0.0, -30.0)}, "start"),  # outside the ocean
        ({"neutral_density_kg_m3": 1040}, "dives"),  # so light that it cannot dive
    ],
)
def test_what_vehicle_and_water_refuse_is_named_by_its_key_in_the_plan(change: dict[str, Any], key: str) -> None:
    assert keys(made(**change)) == {key}


def test_the_bottom_along_the_way_is_told_of() -> None:
    """Oracle: the sea: from the trough at 1200 m up to the shelf at 100 m."""
    trough, shelf = place(27.95, 127.5), place(28.7, 126.1)
    found = made(start=trough, waypoints=[shelf], dives={"depth_m": 180, "pitch_deg": 30, "least_speed_m_s": 0.3})
    assert found.problems == ()
    assert any(words.startswith("waypoints.0: on the way there the bottom rises to") for words in found.warnings)
    assert not any("bottom rises" in words for words in made().warnings)


def test_a_way_that_is_too_long_for_battery_and_time_is_told_of() -> None:
    sea = {"start": place(18.0, 115.0), "water": {"ocean": "south_china_sea"}, "duration_days": 20}
    far = made(**sea, waypoints=[place(28.0, 115.0)]).warnings
    assert sum("takes about" in words for words in far) == 2
    near = made(**sea, waypoints=[place(18.2, 115.0)]).warnings
    assert not any("takes about" in words for words in near)


def test_orders_hold_how_often_the_ctd_measures_where_the_plan_says_it() -> None:
    """Oracle: the plan; left out, orders leave it to the vehicle's own configuration."""
    assert tomllib.loads(made(sampling={"every_s": 5}).orders or "")["sample_every_s"] == 5.0
    orders = tomllib.loads(made(sampling={"phases": ["ascent"]}).orders or "")
    assert orders["sampled_phases"] == ["ascent"]
    assert "sample_every_s" not in orders


@pytest.mark.parametrize("every", [0.05, 3601.0])
def test_an_interval_that_the_ctd_cannot_be_told_is_refused_by_its_key(every: float) -> None:
    """Oracle: the database of messages: `sample_interval` of Switch is from 0.1 to 3600 s."""
    found = made(sampling={"every_s": every})
    assert keys(found) == {"sampling.every_s"}
    assert "0.1 and 3600 s" in found.problems[0].reason + found.problems[0].allowed


def test_a_vehicle_that_was_trimmed_already_is_not_trimmed_anew() -> None:
    """Oracle: the header of the orders: its density is that of the water in which the vehicle is neutral."""
    _, first = parse_orders(made().orders or "", "orders")
    deeper = {"depth_m": 60, "pitch_deg": 30, "speed_m_s": 0.5}
    _, anew = parse_orders(made(dives=deeper).orders or "", "orders")
    _, kept = parse_orders(made(dives=deeper, neutral_density_kg_m3=first.density_kg_m3).orders or "", "orders")
    assert anew.density_kg_m3 != first.density_kg_m3
    assert kept.density_kg_m3 == first.density_kg_m3
