"""Who takes how much from the battery, and what that does to its voltage (compiled)."""

import math

import numpy as np

from stommel.compilation import inlined
from stommel.control.dive_cycle import DESCENT, DRIFT
from stommel.simulation.plant.actuators import interpolated
from stommel.simulation.plant.parameters import ALWAYS, CLIMB, DIVE, DRIFTING, MOVING, SURFACED, UNDERWATER, Plant
from stommel.simulation.plant.sensors import Sensors


@inlined
def consume(
    plant: Plant, world: np.record, at_surface: bool, phase: int, since_surfacing: float, t: float, step: float
) -> None:
    """Add the energy of one control step to each consumer's account [J]; voltage and current of the battery follow.

    The work of the actuators in this step is in the accounts already.
    """
    moving = world.pumping or world.valve_open or world.mass_moving or world.steering_moving
    leg = DIVE if phase == DESCENT else DRIFTING if phase == DRIFT else CLIMB
    if at_surface:
        for i in range(len(plant.call_consumer)):
            time_on = max(0.0, min(step, plant.call_seconds[i] - since_surfacing))
            world.energy[plant.call_consumer[i]] += plant.call_power[i] * time_on
    total = 0.0
    for i in range(len(world.energy)):
        power = plant.power[i, ALWAYS]
        if at_surface:
            power += plant.power[i, SURFACED]
        else:
            power += plant.power[i, UNDERWATER] + plant.power[i, leg]
        if moving:
            power += plant.power[i, MOVING]
        world.energy[i] += power * step
        total += world.energy[i]
    load(plant, world, (total - world.energy_total) / step, total + plant.self_discharge * t)
    world.energy_total = total


@inlined
def load(plant: Plant, world: np.record, power: float, used: float) -> None:
    """Voltage and current of the battery at a power [W], after some of its energy is used [J]."""
    open_voltage = interpolated(1.0 - used / plant.whole_energy, plant.charge, plant.open_voltage)
    # V = E - R I and P = V I; beyond the power that the battery can give, the voltage halves
    root = max(0.0, open_voltage * open_voltage - 4.0 * plant.resistance * power)
    world.voltage = 0.5 * (open_voltage + math.sqrt(root))
    world.current = power / world.voltage


@inlined
def measured_power(sensors: Sensors, world: np.record) -> float:
    """Power out of the battery by the sensors of voltage and current, without their noise, which averages out [W]."""
    power: float = (world.voltage + sensors.voltage_bias) * (world.current + sensors.current_bias)
    return power
