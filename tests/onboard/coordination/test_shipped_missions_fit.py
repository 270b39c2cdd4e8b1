"""Oracle: the vehicle files. What a shipped mission orders, its vehicle can do."""

import pytest

from stommel.control.orders_file import OrdersHeader
from stommel.control.vehicle_limits import refusals
from stommel.planning.vehicle_limits import vehicle_limits
from stommel.simulation.planned_orders import planned_orders
from stommel.simulation.scenario.loading import load_mission
from stommel.simulation.scenario.shipped import mission_path, shipped_missions
from stommel.vehicle import load_vehicle


@pytest.mark.parametrize("name", shipped_missions())
def test_a_shipped_mission_is_taken_by_its_vehicle(name: str) -> None:
    mission = load_mission(mission_path(name))
    limits = vehicle_limits(mission.vehicle)
    header = OrdersHeader(name, name, mission.vehicle.name, limits.vehicle_sha256, "full", 1000.0, "0")
    assert refusals(planned_orders(mission), header, limits, name) == []


def test_the_limits_are_those_of_the_file() -> None:
    """Oracle: zju.toml, read by eye."""
    limits = vehicle_limits(load_vehicle("zju"))
    assert (limits.ballast_ml, limits.depth_rating_m) == ((-250.0, 250.0), 200.0)
    assert limits.steering_deg == 60.0
