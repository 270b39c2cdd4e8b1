"""The mission loop: world and vehicle, decision by decision (compiled)."""

import math
from typing import NamedTuple

import numpy as np

from stommel.compilation import compiled, inlined
from stommel.control.dive_cycle import (
    INFLECTION,
    MISSION_COMPLETE,
    NOTHING,
    OUTSIDE_DATA,
    RECOVERY,
    SURFACE,
    DivePlan,
    Readings,
)
from stommel.control.flight_table import FlightTable, look_up
from stommel.dynamics.equations import state_from_array
from stommel.dynamics.state import STATE_SIZE
from stommel.geometry.attitude import attitude_of
from stommel.geometry.earth import metres_per_radian
from stommel.ocean.kernel.column import fill_column, water_at
from stommel.ocean.kernel.grid import BOTTOM, HELD, LAND, TIME, Column, OceanGrid
from stommel.seawater.table import DensityTable
from stommel.simulation.memory import CELL, Log
from stommel.simulation.plant.actuators import actuate
from stommel.simulation.plant.hull_air import antenna_emerges, hold_air
from stommel.simulation.plant.motion import advance
from stommel.simulation.plant.parameters import Loop, Plant
from stommel.simulation.plant.power import consume, measured_power
from stommel.simulation.plant.sensing import (
    altimeter,
    compass,
    depth_sensor,
    feel_temperature,
    fix,
    late,
    measured_internal_pressure,
)
from stommel.simulation.plant.sensors import Alarms, Hull, Sensors, Waves
from stommel.simulation.results.rows import write_event, write_row, write_sample, write_surfacing
from stommel.simulation.software import (
    Laws,
    command,
    decide_phase,
    follow_heading,
    guide,
    leave_surface,
    receive,
    reckon,
    surface,
    watch,
)

GUIDANCE_PERIOD = 10.0
"""Between two looks at the waypoint [s]."""

RUNNING, FINISHED, OUT_OF_BATTERY, OUT_OF_OCEAN, ASHORE, NOT_FINITE, ABORTED, LOST = range(8)
OUTCOMES = (
    "time over",
    "mission complete",
    "battery empty",
    "left the ocean data",
    "aground",
    "the flight became unphysical",
    "aborted, waiting at the surface",
    "lost: deeper than the hull bears",
)
"""How a mission ended."""


class Equipment(NamedTuple):
    """The vehicle and what is in it."""

    vehicle: np.record
    """`stommel.dynamics.parameters`."""
    plant: Plant
    sensors: Sensors
    hull: Hull


class Orders(NamedTuple):
    """What the vehicle's software is told."""

    dives: DivePlan
    laws: Laws
    table: FlightTable
    waypoints: np.ndarray
    """Latitude and longitude [rad] (n x 2)."""
    radius: float
    """Distance at which a waypoint is reached [m]."""
    lookahead: float
    """How far ahead on the line to aim [m]."""
    alarms: Alarms


class Sea(NamedTuple):
    """The water to fly in."""

    grid: OceanGrid
    density: DensityTable
    waves: Waves


@inlined
def _receive(sea, equipment, x, software, world, noise, t, step):  # type: ignore[no-untyped-def]  # compiled only
    """Listen to GPS at the surface while the antenna is dry."""
    if not world.afloat:
        return
    theta = attitude_of(state_from_array(x).Q).theta
    if not antenna_emerges(sea.waves, equipment.plant.antenna, theta, t):
        return
    software.received += step
    if software.received >= equipment.sensors.first_fix_time:
        metres = metres_per_radian(world.latitude)
        latitude, longitude = fix(equipment.sensors, world.latitude, world.longitude, metres, noise)
        receive(software, t, latitude, longitude)


@inlined
def _phase_changed(log, software, world, t, depth):  # type: ignore[no-untyped-def]  # compiled only
    """Write the event down; open and close the accounts of a dive."""
    world.moved_at = t
    # the software remembers the last reason; it is that of this change only where a dive or the mission ends
    ends = software.phase in (INFLECTION, RECOVERY)
    write_event(log, t, software, world, depth, software.event if ends else float(NOTHING))
    if software.phase == SURFACE:
        surface(software, t, world.latitude, world.longitude)
    elif software.phase != RECOVERY and software.submerged_since == t:
        fixed = software.first_fix_at >= 0.0
        write_surfacing(log, software, world, t, leave_surface(software, t))
        if fixed:
            world.current_sum_north = world.current_sum_east = world.current_time = 0.0


@compiled
def fly(
    equipment: Equipment,
    orders: Orders,
    sea: Sea,
    loop: Loop,
    column: Column,
    x: np.ndarray,
    software: np.record,
    world: np.record,
    noise: np.random.Generator,
    log: Log,
    first_tick: int,
    last_tick: int,
) -> int:
    """Fly control steps `first_tick` to `last_tick`; returns RUNNING or how the mission ended.

    Ocean column, state `x`, software, world, noise and log are changed in place, so that a long mission is flown in
    pieces with progress between them, with the same result.
    """
    plan, sensors, plant, step = orders.dives, equipment.sensors, equipment.plant, loop.control_step
    k, trial = np.empty((4, STATE_SIZE)), np.empty(STATE_SIZE)
    cell = log.counts[CELL]
    every_column = max(1, round(loop.column_period / step))
    every_guidance = max(1, round(GUIDANCE_PERIOD / step))
    cruise = look_up(orders.table, plan.theta, plan.V_b_dive)[2]
    under_way = software.waypoint < len(orders.waypoints)
    for tick in range(first_tick, last_tick):
        t = tick * step
        if tick % every_column == 0:
            status = fill_column(sea.grid, sea.density, loop.start + t, world.latitude, world.longitude, cell, column)
            if status > HELD:
                return ASHORE if status == LAND else OUT_OF_OCEAN
            if status == HELD and not world.outside:
                write_event(log, t, software, world, x[2], float(OUTSIDE_DATA))
            world.outside = int(status == HELD)
        age = loop.start + t - column.place[TIME]
        water = water_at(column, x[2], age)
        # sense
        feel_temperature(sensors, world, water.T)
        now = compass(sensors, world, state_from_array(x).Q, noise)
        measured, depth = late(sensors, world, tick, now, depth_sensor(sensors, x[2], noise))
        altitude = altimeter(sensors, column.place[BOTTOM] - x[2], noise)
        follow_heading(software, measured.psi, step)
        # decide
        if tick % every_guidance == 0:
            world.metres_north, world.metres_east = metres_per_radian(world.latitude)
            under_way = guide(software, orders.waypoints, orders.radius, orders.lookahead, cruise)
            hold_air(equipment.hull, world, water.T, x[15])
            watch(software, orders.alarms, sensors, world.leaked, measured_internal_pressure(sensors, world))
        ballast, fixed = x[15] + world.leaked, software.first_fix_at >= 0.0
        readings = Readings(depth, altitude, ballast, under_way, fixed, software.alarm)
        if decide_phase(software, plan, t, readings):
            _phase_changed(log, software, world, t, x[2])
        commands = command(software, plan, orders.table, orders.laws, t, measured, depth)
        # act
        theta = attitude_of(state_from_array(x).Q).theta  # the drive bears the slope that is, not the one measured
        done = actuate(plant, world, commands, x[13], ballast, water.P, theta, step)
        at_surface = software.phase in (SURFACE, RECOVERY)
        consume(plant, world, at_surface, int(software.phase), t - software.surfaced_at, t, step)
        software.energy_used += measured_power(sensors, world) * step
        if at_surface:
            _receive(sea, equipment, x, software, world, noise, t, step)
        else:
            reckon(software, orders.table, measured, depth, ballast, t, step)
        software.depth_before = depth
        if tick % sensors.sample_every == 0 and sensors.sampled[int(software.phase)] != 0.0:
            write_sample(log, t, x, water, software, world, column)
        if tick % loop.record_every == 0:
            write_row(log, t, age, x, equipment, software, world, measured, depth, column, noise)
        advance(equipment, x, k, trial, software, world, done, loop, column, t)
        if not math.isfinite(x[2]) or not math.isfinite(x[7]):
            return NOT_FINITE
        if x[2] > equipment.hull.deepest:
            return LOST
        if world.energy_total + plant.self_discharge * t > plant.battery_energy:
            return OUT_OF_BATTERY
        if software.phase == RECOVERY and t - software.since >= plan.surface_time:
            return FINISHED if software.event == MISSION_COMPLETE else ABORTED
    return RUNNING
