"""Waves over the antenna, and the air and water inside the hull (compiled)."""

import math
from typing import Any

import numpy as np

from stommel.compilation import inlined
from stommel.geometry.vectors import Vector
from stommel.simulation.plant.sensors import Hull, Waves

KELVIN = 273.15


@inlined
def antenna_emerges(waves: Waves, antenna: Vector, theta: float, t: float) -> bool:
    """Whether the antenna of a vehicle that floats with wings level at pitch `theta` is out of the water now.

    The centre of buoyancy lies on the calm surface; waves that the vehicle does not follow wash over the antenna. One
    whose place is not known always emerges.
    """
    if math.isnan(antenna[0]):
        return True
    height = antenna[0] * math.sin(theta) - antenna[2] * math.cos(theta)
    for i in range(len(waves.omega)):
        height -= waves.amplitude[i] * math.cos(waves.omega[i] * t + waves.phase[i])
    return height > 0.0


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
