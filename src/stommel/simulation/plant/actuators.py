"""What the actuators do with their commands within one control step (compiled)."""

import math
from typing import NamedTuple

import numpy as np

from stommel.compilation import inlined
from stommel.simulation.plant.parameters import PITCH_DRIVE, PUMP, STEERING, Plant

OIL_RESOLUTION = 1e-7
"""Difference of ballast volume that the oil measurement can tell [m3]."""

STEEPEST = 1.5
"""Pitch beyond which the slope of the mass's rails counts as this steep [rad]."""


class Commands(NamedTuple):
    """What the software wants of the actuators, SI units and radians."""

    r_px: float
    V_b: float
    steering: float
    hold_mass: float
    """Distance from the commanded position below which the drive stays off [m]."""


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
def interpolated(x: float, grid: np.ndarray, values: np.ndarray) -> float:
    """Value at `x`, straight between the points of an ascending grid; the ends hold."""
    if x <= grid[0]:
        first: float = values[0]
        return first
    for k in range(1, len(grid)):
        if x <= grid[k]:
            share = (x - grid[k - 1]) / (grid[k] - grid[k - 1])
            between: float = values[k - 1] + share * (values[k] - values[k - 1])
            return between
    last: float = values[-1]
    return last


@inlined
def actuate(
    plant: Plant,
    world: np.record,
    commands: Commands,
    r_px: float,
    V_b: float,
    pressure: float,
    theta: float,
    step: float,
) -> Rates:
    """Rates of moving mass, oil and steering in one control step, and the energy of their work.

    Limit switches end the travel, the worm gear holds the mass when its drive is off, the pump loses flow with pressure
    and stalls, the valve lets oil in. `theta` is the pitch [rad].
    """
    goal = min(plant.mass_high, max(plant.mass_low, commands.r_px))
    moving = abs(goal - r_px) > (0.25 * commands.hold_mass if world.mass_moving else commands.hold_mass)
    world.mass_moving = int(moving)
    r_px_dot = 0.0
    if moving:
        slope = math.tan(max(-STEEPEST, min(STEEPEST, theta)))
        uphill = slope if goal > r_px else -slope
        r_px_dot = _towards(r_px, goal, interpolated(uphill, plant.slope, plant.mass_speed), step)
        world.energy[PITCH_DRIVE] += abs(r_px_dot) * step * interpolated(uphill, plant.slope, plant.mass_j_m)

    volume = min(plant.ballast_high, max(plant.ballast_low, commands.V_b))
    missing = volume - V_b
    u_b = 0.0
    if missing > OIL_RESOLUTION:
        u_b = min(missing / step, interpolated(pressure, plant.pressure, plant.pump_flow))
        world.energy[PUMP] += u_b * step * interpolated(pressure, plant.pressure, plant.pump_j_m3)
    elif missing < -OIL_RESOLUTION:
        u_b = max(missing / step, -interpolated(pressure, plant.pressure, plant.valve_flow))
        world.energy[PUMP] -= u_b * step * interpolated(pressure, plant.pressure, plant.valve_j_m3)
    world.pumping, world.valve_open = int(u_b > 0.0), int(u_b < 0.0)

    steering_goal = min(plant.steering_limit, max(-plant.steering_limit, commands.steering))
    rate = _towards(world.steering, steering_goal, plant.steering_speed, step)
    middle = world.steering + 0.5 * rate * step
    world.steering += rate * step
    world.steering_moving = int(rate != 0.0)
    world.energy[STEERING] += abs(rate) * step * plant.steering_j_rad
    return Rates(r_px_dot, u_b, middle, rate)
