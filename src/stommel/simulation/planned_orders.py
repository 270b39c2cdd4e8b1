"""The orders that a mission file makes, for simulator and vehicle alike."""

from stommel.control.orders import Orders
from stommel.planning.ballasting import water_of
from stommel.planning.orders import orders_of
from stommel.simulation.plant.building import plant_of
from stommel.simulation.scenario.mission import Mission


def planned_orders(mission: Mission) -> Orders:
    """What the simulator flies the mission by.

    Raises
    ------
    StommelError
        The vehicle cannot fly the dives that the plan asks for.
    """
    plant = plant_of(mission.vehicle, water_of(mission.deployment).mean_temperature_c)
    return orders_of(mission.deployment, mission.scenario.integration.control_step_s, plant.battery.energy)
