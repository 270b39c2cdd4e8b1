"""What the actuators do when the vehicle's own electronics drives them, well or worn (compiled).

The mission loop gives set points to actuators that obey them (`stommel.simulation.plant.actuators`). Here a
motion-control node closes the loops: it says for which share of a step each motor runs, and feels where things stand.
"""

import math
from typing import NamedTuple

import numpy as np

from stommel.compilation import inlined
from stommel.geometry.interpolation import interpolated
from stommel.simulation.plant.actuators import STEEPEST, Rates
from stommel.simulation.plant.parameters import PITCH_DRIVE, PUMP, STEERING, Engine, MassDrive, Plant, SteeringDrive

MECHANICAL_STOP = 0.004
"""Way of the moving mass beyond a limit switch that does not stop it [m]; an assumption."""


class Drives(NamedTuple):
    """What the power stages and switches do through one step; shares of the step, motors both ways."""

    pump: float
    """0 to 1."""
    valve: float
    """0 to 1."""
    mass: float
    """Forward positive, -1 to 1."""
    steering: float
    """-1 to 1."""
    brake: bool
    """Whether the steering is held."""
    drop_weight: bool
    """Whether the drop weight is let go."""
    loads: int
    """Groups of consumers that are on, bits of `stommel.control.commands`."""
    sampling: bool
    """Whether the payload measures."""
    radio: bool
    """Whether GPS and radio have power."""
    ended: int
    """`stommel.control.commands.GOING_ON`, or why the software has nothing left to do."""


class Wear(NamedTuple):
    """What is broken of the machinery."""

    pump: float
    """Share of its flow that the pump still has."""
    valve: float
    """Share of a step for which the valve is open whatever it is told; not a number: it obeys."""
    creep: float
    """Oil that runs back into the hull past the pump and the valve [m3/s]."""
    mass: float
    """Share of its speed that the pitch drive still has; zero: it is jammed."""
    switches: float
    """1: the limit switches stop the mass; 0: only the ends of its rails do."""
    steering: float
    """Share of its speed that the steering still has."""


AS_NEW = Wear(1.0, math.nan, 0.0, 1.0, 1.0, 1.0)


@inlined
def drive(
    plant: Plant,
    world: np.record,
    wear: Wear,
    drives: Drives,
    r_px: float,
    V_b: float,
    pressure: float,
    theta: float,
    step: float,
) -> Rates:
    """Rates of moving mass, oil and steering in one step, and the energy of their work."""
    r_px_dot = _drive_mass(plant.mass, world, wear, drives.mass, r_px, theta, step)
    u_b = _drive_oil(plant.engine, world, wear, drives, V_b, pressure, step)
    if drives.drop_weight and world.dropped == 0.0:
        world.dropping = 1
    return _drive_steering(plant.steering, world, wear, drives, r_px_dot, u_b, step)


@inlined
def _drive_mass(
    mass: MassDrive, world: np.record, wear: Wear, share: float, r_px: float, theta: float, step: float
) -> float:
    """Speed of the moving mass [m/s]: the worm gear holds it when its motor stands."""
    world.mass_moving = int(share != 0.0)
    if share == 0.0:
        return 0.0
    beyond = 0.0 if wear.switches != 0.0 else MECHANICAL_STOP
    slope = math.tan(max(-STEEPEST, min(STEEPEST, theta)))
    uphill = slope if share > 0.0 else -slope
    speed = interpolated(uphill, mass.slope, mass.speed)
    world.energy[PITCH_DRIVE] += abs(share) * speed * step * interpolated(uphill, mass.slope, mass.j_m)
    r_px_dot = share * speed * wear.mass
    least, most = (mass.low - beyond - r_px) / step, (mass.high + beyond - r_px) / step
    return min(max(0.0, most), r_px_dot) if share > 0.0 else max(min(0.0, least), r_px_dot)


@inlined
def _drive_oil(
    engine: Engine, world: np.record, wear: Wear, drives: Drives, V_b: float, pressure: float, step: float
) -> float:
    """Rate of the ballast volume [m3/s]; the pump does not take more oil than the cylinder holds."""
    flow = interpolated(pressure, engine.pressure, engine.pump_flow)
    world.energy[PUMP] += drives.pump * flow * step * interpolated(pressure, engine.pressure, engine.pump_j_m3)
    open_share = drives.valve if math.isnan(wear.valve) else wear.valve
    inwards = open_share * interpolated(pressure, engine.pressure, engine.valve_flow)
    if drives.valve > 0.0:
        world.energy[PUMP] += inwards * step * interpolated(pressure, engine.pressure, engine.valve_j_m3)
    world.pumping, world.valve_open = int(drives.pump > 0.0), int(open_share > 0.0)
    u_b = drives.pump * flow * wear.pump - inwards - wear.creep
    return min((engine.high - V_b) / step, max((engine.low - V_b) / step, u_b))


@inlined
def _drive_steering(
    steering: SteeringDrive, world: np.record, wear: Wear, drives: Drives, r_px_dot: float, u_b: float, step: float
) -> Rates:
    share = 0.0 if drives.brake else drives.steering
    rate = share * steering.speed * wear.steering
    rate = min((steering.limit - world.steering) / step, max((-steering.limit - world.steering) / step, rate))
    middle = world.steering + 0.5 * rate * step
    world.steering += rate * step
    world.steering_moving = int(share != 0.0)
    world.energy[STEERING] += abs(share) * steering.speed * step * steering.j_rad
    return Rates(r_px_dot, u_b, middle, rate)
