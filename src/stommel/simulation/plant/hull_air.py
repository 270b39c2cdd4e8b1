"""The air and the water inside the hull."""

import math
from math import inf, nan
from typing import Any, NamedTuple

import numpy as np

from stommel.compilation import inlined
from stommel.geometry.vectors import Vector
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
    rating: float
    """Depth for which the hull is made [m]; infinite if the vehicle file does not say."""
    deepest: float
    """Depth at which the hull is given up for lost [m]."""
    leak_place: Vector
    """Where the leak's water stays, in the body frame [m]; not numbers: at the lowest place."""
    ends: tuple[float, float, float]
    """Aft and forward end of the pressure hull, and its radius [m]."""
    s_0: tuple[float, float, float]
    """Static moment of the dry rigid body and the ballast mass [kg m]."""


@inlined
def fill_with_water(hull: Hull, world: np.record, t: float, step: float) -> float:
    """Let the leak run for one control step; returns how fast ballast volume is lost [m3/s]."""
    if t < hull.leak_starts or world.leaked >= hull.air_volume:
        return 0.0
    world.leaked += hull.leak_rate * step
    return hull.leak_rate


@inlined
def place_water(hull: Hull, vehicle: np.record, rho: float, leaked: float, theta: float) -> None:
    """Put the leaked water where it lies: its weight is counted at the bladder otherwise, as lost ballast volume."""
    aft, fore, radius = hull.ends
    x, y, z = hull.leak_place
    if math.isnan(x):
        x, y, z = (fore if theta < 0.0 else aft), 0.0, radius
    place = (x, y, z)
    for j in range(3):
        oil = vehicle.rho_oil * (vehicle.r_bl[j] - vehicle.r_res[j])  # that has not come back
        vehicle.s_0[j] = hull.s_0[j] + leaked * (rho * (place[j] - vehicle.r_bl[j]) + oil)


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


def hull_of(scenario: ScenarioFile, vehicle: Vehicle, record: np.record) -> Hull:
    """Air and leak of the hull, and how deep it may sink: as many times its rating as its safety factor says.

    `record` holds the parameters of the vehicle's equations of motion.
    """
    air, leak, hull = scenario.hull_air, scenario.leak, vehicle.description.hull
    deepest = rating = inf
    if hull is not None and hull.depth_rating_m is not None:
        rating = hull.depth_rating_m
        deepest = hull.circumferential_safety_factor * rating
    return Hull(
        air_pressure=air.pressure_kpa * 1e3,
        air_temperature=air.temperature_c + KELVIN,
        air_volume=air.volume_l / 1e3,
        temperature_weight=followed(AIR_PERIOD, air.settle_minutes * 60.0),
        leak_starts=leak.after_hours * 3600.0 if leak.rate_ml_min > 0.0 else inf,
        leak_rate=leak.rate_ml_min / 1e6 / 60.0,
        rating=rating,
        deepest=deepest,
        leak_place=(nan, nan, nan) if leak.position_m is None else leak.position_m,
        ends=_ends(vehicle),
        s_0=(float(record.s_0[0]), float(record.s_0[1]), float(record.s_0[2])),
    )


def _ends(vehicle: Vehicle) -> tuple[float, float, float]:
    """Aft and forward end of the pressure hull, and its radius; the origin where the file has none."""
    hull = vehicle.description.hull
    if hull is None:
        return 0.0, 0.0, 0.0
    radius = 0.5 * (hull.outer_diameter_mm or 0.0) / 1e3
    return hull.nose_position_m - hull.length_m, hull.nose_position_m, radius
