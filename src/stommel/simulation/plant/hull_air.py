"""The air and the water inside the hull."""

from math import inf
from typing import Any, NamedTuple

import numpy as np

from stommel.compilation import inlined
from stommel.simulation.plant.sensors import followed
from stommel.simulation.scenario.scenario_file import ScenarioFile
from stommel.vehicle import Vehicle

KELVIN = 273.15

AIR_PERIOD = 10.0
"""Between two looks at the air [s]."""


class Hull(NamedTuple):
    """The room inside the hull: its air, and a leak."""

    air_pressure: float
    """When it was closed [Pa]."""
    air_temperature: float
    """When it was closed [K]."""
    air_volume: float
    """With the ballast volume at zero [m3]."""
    temperature_weight: float
    """Share of its difference to the water's temperature that the air follows in one control step."""
    leak_starts: float
    """Time of the mission [s]; infinite for a tight hull."""
    leak_rate: float
    """[m3/s]"""
    deepest: float
    """Depth at which the hull is given up for lost [m]."""


@inlined
def fill_with_water(hull: Hull, world: np.record, t: float, step: float) -> float:
    """Let the leak run for one control step; returns how fast ballast volume is lost [m3/s]."""
    if t < hull.leak_starts or world.leaked >= hull.air_volume:
        return 0.0
    world.leaked += hull.leak_rate * step
    return hull.leak_rate


@inlined
def hold_air(hull: Hull, world: Any, water_temperature: float, V_b: float) -> None:
    """Pressure of the air in the hull: a perfect gas that takes on the water's temperature.

    Oil that leaves the hull makes room, water that leaks in takes it: both are in the ballast volume `V_b`.
    """
    world.air_temperature += hull.temperature_weight * (water_temperature + KELVIN - world.air_temperature)
    room = max(1e-3 * hull.air_volume, hull.air_volume + V_b)
    world.internal_pressure = (
        hull.air_pressure * (hull.air_volume / room) * (world.air_temperature / hull.air_temperature)
    )


def hull_of(scenario: ScenarioFile, vehicle: Vehicle) -> Hull:
    """Air and leak of the hull, and how deep it may sink: as many times its rating as its safety factor says."""
    air, leak, hull = scenario.hull_air, scenario.leak, vehicle.description.hull
    deepest = inf
    if hull is not None and hull.depth_rating_m is not None:
        deepest = hull.circumferential_safety_factor * hull.depth_rating_m
    return Hull(
        air_pressure=air.pressure_kpa * 1e3,
        air_temperature=air.temperature_c + KELVIN,
        air_volume=air.volume_l / 1e3,
        temperature_weight=followed(AIR_PERIOD, air.settle_minutes * 60.0),
        leak_starts=leak.after_hours * 3600.0 if leak.rate_ml_min > 0.0 else inf,
        leak_rate=leak.rate_ml_min / 1e6 / 60.0,
        deepest=deepest,
    )
