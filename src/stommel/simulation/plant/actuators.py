"""What the actuators do with their commands within one control step (compiled)."""

import math
from typing import NamedTuple

import numpy as np

from stommel.compilation import inlined
from stommel.control.commands import Commands
from stommel.geometry.interpolation import interpolated
from stommel.simulation.plant.parameters import PITCH_DRIVE, PUMP, STEERING, Engine, MassDrive, Plant, SteeringDrive

OIL_RESOLUTION = 1e-7
"""Difference of ballast volume that the oil measurement can tell [m3]."""

STEEPEST = 1.5
"""Pitch beyond which the slope of the mass's rails counts as this steep [rad]."""


class Rates(NamedTuple):
    """What the actuators do during one control step."""

    r_px_dot: float
    u_b: float
    steering: float
    """Angle at the middle of the step [rad]."""
    steering_rate: float


@inlined
def _towards(value: float, goal: float, speed: float, step: float) -> float:
    """Rate that takes `value` towards `goal` within a step, no faster than `speed`."""
    return min(speed, max(-speed, (goal - value) / step))


@inlined
def actuate(
    plant: Plant,
    world: np.record,
    commands: Commands,
    r_px: float,
    V_b: float,
    pressure: float,
    theta: float,
    t: float,
    step: float,
) -> Rates:
    """Rates of moving mass, oil and steering in one control step, and the energy of their work.

    Limit switches end the travel, the worm gear holds the mass when its drive is off, the pump loses flow with pressure
    and stalls, the valve lets oil in. `theta` is the true pitch [rad]: the drive bears the slope that is.
    """
    if abs(commands.V_b - world.V_b_wanted) > OIL_RESOLUTION:
        world.V_b_wanted, world.moved_at = commands.V_b, t
    r_px_dot = _move_mass(plant.mass, world, commands, r_px, theta, step)
    u_b = _move_oil(plant.engine, world, commands.V_b, V_b, pressure, step)
    return _steer(plant.steering, world, commands.steering, r_px_dot, u_b, step)


@inlined
def _move_mass(drive: MassDrive, world: np.record, commands: Commands, r_px: float, theta: float, step: float) -> float:
    """Speed of the moving mass [m/s]."""
    goal = min(drive.high, max(drive.low, commands.r_px))
    moving = abs(goal - r_px) > (0.25 * commands.hold_mass if world.mass_moving else commands.hold_mass)
    world.mass_moving = int(moving)
    if not moving:
        return 0.0
    slope = math.tan(max(-STEEPEST, min(STEEPEST, theta)))
    uphill = slope if goal > r_px else -slope
    r_px_dot = _towards(r_px, goal, interpolated(uphill, drive.slope, drive.speed), step)
    world.energy[PITCH_DRIVE] += abs(r_px_dot) * step * interpolated(uphill, drive.slope, drive.j_m)
    return r_px_dot


@inlined
def _move_oil(engine: Engine, world: np.record, wanted: float, V_b: float, pressure: float, step: float) -> float:
    """Rate of the ballast volume [m3/s]."""
    missing = min(engine.high, max(engine.low, wanted)) - V_b
    u_b = 0.0
    if missing > OIL_RESOLUTION:
        u_b = min(missing / step, interpolated(pressure, engine.pressure, engine.pump_flow))
        world.energy[PUMP] += u_b * step * interpolated(pressure, engine.pressure, engine.pump_j_m3)
    elif missing < -OIL_RESOLUTION:
        u_b = max(missing / step, -interpolated(pressure, engine.pressure, engine.valve_flow))
        world.energy[PUMP] -= u_b * step * interpolated(pressure, engine.pressure, engine.valve_j_m3)
    world.pumping, world.valve_open = int(u_b > 0.0), int(u_b < 0.0)
    return u_b


@inlined
def _steer(drive: SteeringDrive, world: np.record, wanted: float, r_px_dot: float, u_b: float, step: float) -> Rates:
    goal = min(drive.limit, max(-drive.limit, wanted))
    rate = _towards(world.steering, goal, drive.speed, step)
    middle = world.steering + 0.5 * rate * step
    world.steering += rate * step
    world.steering_moving = int(rate != 0.0)
    world.energy[STEERING] += abs(rate) * step * drive.j_rad
    return Rates(r_px_dot, u_b, middle, rate)
