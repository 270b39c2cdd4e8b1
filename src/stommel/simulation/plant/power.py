"""Who takes how much from the battery, and what that does to its voltage (compiled)."""

import math

import numpy as np

from stommel.compilation import inlined
from stommel.control.commands import LOAD_CLIMB, LOAD_DIVE, LOAD_DRIFT, LOAD_SURFACE, LOAD_UNDERWATER, Commands
from stommel.geometry.interpolation import interpolated
from stommel.simulation.plant.parameters import (
    ALWAYS,
    BATTERY,
    CLIMB,
    DIVE,
    DRIFTING,
    MOVING,
    SAMPLING,
    SURFACED,
    UNDERWATER,
    Battery,
    Loads,
    Plant,
)


@inlined
def consume(plant: Plant, world: np.record, commands: Commands, t: float, step: float) -> None:
    """Add the energy of one control step to each consumer's account [J]; voltage and current of the battery follow.

    The work of the actuators in this step is in the accounts already.
    """
    _call(plant.loads, world, (commands.loads & LOAD_SURFACE) != 0, t, step)
    moving = world.pumping or world.valve_open or world.mass_moving or world.steering_moving
    total = 0.0
    for i in range(len(world.energy)):
        world.energy[i] += _power(plant.loads, i, commands, moving) * step
        total += world.energy[i]
    load(plant.battery, world, (total - world.energy_total) / step, total + plant.battery.self_discharge * t)
    heat = plant.battery.resistance * world.current * world.current * step
    world.energy[BATTERY] += heat
    world.energy_total = total + heat


@inlined
def _call(loads: Loads, world: np.record, switched_on: bool, t: float, step: float) -> None:
    """Energy of the consumers that are on for a time after they are switched on at the surface."""
    if not switched_on:
        world.calling = 0
        return
    if not world.calling:
        world.calling, world.called_at = 1, t
    for i in range(len(loads.call_consumer)):
        time_on = max(0.0, min(step, loads.call_seconds[i] - (t - world.called_at)))
        world.energy[loads.call_consumer[i]] += loads.call_power[i] * time_on


@inlined
def _power(loads: Loads, i: int, commands: Commands, moving: bool) -> float:
    """Power of consumer `i` by what is switched on [W]."""
    switched = 0.0
    if commands.loads & LOAD_SURFACE:
        switched += loads.power[i, SURFACED]
    if commands.loads & LOAD_UNDERWATER:
        switched += loads.power[i, UNDERWATER]
    if commands.loads & LOAD_DIVE:
        switched += loads.power[i, DIVE]
    if commands.loads & LOAD_CLIMB:
        switched += loads.power[i, CLIMB]
    if commands.loads & LOAD_DRIFT:
        switched += loads.power[i, DRIFTING]
    if commands.sampling:
        switched += loads.power[i, SAMPLING]
    power: float = loads.power[i, ALWAYS] + switched
    if moving:
        power += loads.power[i, MOVING]
    return power


@inlined
def load(battery: Battery, world: np.record, power: float, used: float) -> None:
    """Voltage and current of the battery at a power [W], after some of its energy is used [J]."""
    open_voltage = interpolated(1.0 - used / battery.whole_energy, battery.charge, battery.open_voltage)
    # V = E - R I and P = V I; beyond the power that the battery can give, the voltage halves
    root = max(0.0, open_voltage * open_voltage - 4.0 * battery.resistance * power)
    world.voltage = 0.5 * (open_voltage + math.sqrt(root))
    world.current = power / world.voltage
