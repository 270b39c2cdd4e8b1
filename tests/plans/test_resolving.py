"""What the station fills in."""

from datetime import UTC, datetime
from typing import Any

import pytest

from stommel.plans.plan import StationPlan
from stommel.plans.problems import PlanError, plan_from
from stommel.plans.resolving import resolved
from tests.plans.plans import plan_with

NOW = datetime(2026, 7, 3, 6, tzinfo=UTC)


def asked(model: str | None = "zju", current: tuple[float, float] | None = None, **changes: Any) -> StationPlan:
    plan = plan_from(plan_with(**changes))
    return resolved(plan, now=NOW.timestamp(), vehicles=["slocum", "zju"], model=model, current=current)


def test_a_plan_without_a_time_begins_now() -> None:
    assert asked(start_time=None).start_time == NOW
    assert asked().start_time == datetime(2026, 7, 1, tzinfo=UTC)


def test_the_current_of_the_last_dive_is_put_in() -> None:
    water = asked(water={"current": "last_dive"}, current=(0.3, -0.1)).water
    assert (water.current, water.east_m_s, water.north_m_s) == ("given", 0.3, -0.1)


def test_without_such_a_dive_that_is_said() -> None:
    with pytest.raises(PlanError) as raised:
        asked(water={"current": "last_dive"})
    (problem,) = raised.value.problems
    assert (problem.key, problem.value, problem.allowed) == ("water.current", "last_dive", "ocean, still, given")


def test_a_plan_for_another_vehicle_is_refused() -> None:
    with pytest.raises(PlanError, match="must be 'zju'"):
        asked(vehicle="slocum")
    assert asked(model=None, vehicle="slocum").vehicle == "slocum"


def test_no_file_of_the_station_is_read_for_a_stranger() -> None:
    """A name that the station does not know is never opened."""
    with pytest.raises(PlanError, match="one that this station knows: slocum, zju"):
        asked(model=None, vehicle="/etc/passwd")
