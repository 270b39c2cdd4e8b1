"""The mission loop: world and vehicle, decision by decision (compiled)."""

import math
from typing import NamedTuple

import numpy as np

from stommel.compilation import compiled, inlined
from stommel.control.commands import ABORTED, COMPLETE, Commands
from stommel.control.decision import decision
from stommel.control.dive_cycle import INFLECTION, NOTHING, RECOVERY, SURFACE
from stommel.control.orders import Orders
from stommel.control.readings import Readings
from stommel.dynamics.equations import state_from_array
from stommel.dynamics.state import DEPTH, R_PX, STATE_SIZE, V_B
from stommel.geometry.attitude import attitude_of
from stommel.geometry.earth import metres_per_radian, to_waypoint
from stommel.geometry.vectors import Vector
from stommel.machinery.hull.floating import water_line
from stommel.ocean.kernel.column import fill_column, water_at
from stommel.ocean.kernel.grid import BOTTOM, HELD, LAND, TIME, Column, OceanGrid
from stommel.seawater.table import DensityTable
from stommel.seawater.water import Water
from stommel.simulation.log import CELL, OUTSIDE_DATA, RATING_PASSED, Log
from stommel.simulation.plant.actuators import actuate
from stommel.simulation.plant.driven import Drives, Wear, drive
from stommel.simulation.plant.hull_air import AIR_PERIOD, Hull, hold_air
from stommel.simulation.plant.motion import advance, surplus_volume
from stommel.simulation.plant.parameters import Plant
from stommel.simulation.plant.power import consume
from stommel.simulation.plant.sensing import feel_temperature, felt_field, listen, oil_volume, sense
from stommel.simulation.plant.sensors import Sensors
from stommel.simulation.plant.waves import Waves, antenna_emerges
from stommel.simulation.timing import Loop
from stommel.simulation.writing import write_event, write_row, write_sample, write_surfacing

RUNNING, FINISHED, OUT_OF_BATTERY, OUT_OF_OCEAN, ASHORE, NOT_FINITE, ABORTED_MISSION, LOST = range(8)
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


class Sea(NamedTuple):
    """The water to fly in."""

    grid: OceanGrid
    density: DensityTable
    waves: Waves


@inlined
def _look_around(sea, loop, column, x, memory, world, log, tick):  # type: ignore[no-untyped-def]  # compiled only
    """Look up the ocean around the vehicle, once in a while; returns RUNNING or how the mission ended."""
    step = loop.control_step
    if tick % max(1, round(loop.column_period / step)) != 0:
        return RUNNING
    t = tick * step
    cell = log.counts[CELL]
    status = fill_column(sea.grid, sea.density, loop.start + t, world.latitude, world.longitude, cell, column)
    if status > HELD:
        return ASHORE if status == LAND else OUT_OF_OCEAN
    if status == HELD and not world.outside:
        write_event(log, t, memory, world, x[DEPTH], float(OUTSIDE_DATA))
    world.outside = int(status == HELD)
    return RUNNING


@inlined
def _water_here(loop: Loop, column: Column, x: np.ndarray, t: float) -> Water:
    return water_at(column, x[DEPTH], loop.start + t - column.place[TIME])


@inlined
def _sense(equipment, loop, column, x, world, water, noise, tick):  # type: ignore[no-untyped-def]  # compiled only
    """Let the slow parts of the world follow the water, and read the sensors."""
    feel_temperature(equipment.sensors, world, water.T)
    if tick % max(1, round(AIR_PERIOD / loop.control_step)) == 0:
        world.metres_north, world.metres_east = metres_per_radian(world.latitude)
        hold_air(equipment.hull, world, water.T, x[V_B])
    return sense(equipment.sensors, world, x, column.place[BOTTOM], tick, noise)


@inlined
def _note(log, memory, world, before, t, depth):  # type: ignore[no-untyped-def]  # compiled only
    """Write down a change of phase, and what a stay at the surface told."""
    if memory.phase == before:
        return
    # the software remembers the last reason; it is that of this change only where a dive or the mission ends
    ends = memory.phase in (INFLECTION, RECOVERY)
    write_event(log, t, memory, world, depth, memory.event if ends else float(NOTHING))
    if memory.phase == SURFACE:
        north, east = to_waypoint(memory.latitude, memory.longitude, world.latitude, world.longitude)
        world.reckoning_error = math.hypot(north, east)
    elif memory.phase != RECOVERY and before == SURFACE:
        write_surfacing(log, memory, world, t)
        if memory.first_fix_at >= 0.0:
            world.current_sum_north = world.current_sum_east = world.current_time = 0.0


@inlined
def _act(equipment, loop, x, world, water, commands, t):  # type: ignore[no-untyped-def]  # compiled only
    """Let the actuators obey their set points."""
    theta = attitude_of(state_from_array(x).Q).theta
    V_b = oil_volume(x, world)
    return actuate(equipment.plant, world, commands, x[R_PX], V_b, water.P, theta, t, loop.control_step)


@inlined
def _switch(equipment, sea, loop, x, world, water, commands, noise, t):  # type: ignore[no-untyped-def]  # compiled only
    """Switch what the software commands, and listen; `commands` may be `Drives`."""
    plant, step = equipment.plant, loop.control_step
    theta = attitude_of(state_from_array(x).Q).theta
    consume(plant, world, commands, t, step)
    line = water_line(plant.form, theta, surplus_volume(equipment.vehicle, water, x[V_B]))
    dry = world.afloat != 0 and antenna_emerges(sea.waves, plant.antenna, line, theta, t)
    listen(equipment.sensors, world, commands.radio, dry, t, step, noise)


@inlined
def _write(equipment, loop, column, x, memory, world, water, readings, commands, done, noise, log, tick):  # type: ignore[no-untyped-def]  # compiled only
    t = tick * loop.control_step
    if tick % equipment.sensors.sample_every == 0 and commands.sampling:
        write_sample(log, t, x, water, memory, world, column)
    if tick % loop.record_every == 0:
        age = loop.start + t - column.place[TIME]
        write_row(log, t, age, x, equipment, done, loop.control_step, memory, world, readings, column, noise)


@inlined
def _warn_of_depth(hull, log, x, memory, world, t):  # type: ignore[no-untyped-def]  # compiled only
    """Write down that the hull's rating is passed, once until the vehicle is shallower again."""
    if x[DEPTH] > hull.rating and not world.too_deep:
        world.too_deep = 1
        write_event(log, t, memory, world, x[DEPTH], float(RATING_PASSED))
    elif x[DEPTH] < hull.rating - 1.0:
        world.too_deep = 0


@inlined
def _outcome(equipment, x, world, commands, t):  # type: ignore[no-untyped-def]  # compiled only
    """RUNNING, or how the mission ended."""
    battery = equipment.plant.battery
    if not math.isfinite(x[DEPTH]) or not math.isfinite(x[7]):
        return NOT_FINITE
    if x[DEPTH] > equipment.hull.deepest:
        return LOST
    if world.energy_total + battery.self_discharge * t > battery.energy:
        return OUT_OF_BATTERY
    if commands.ended == COMPLETE:
        return FINISHED
    return ABORTED_MISSION if commands.ended == ABORTED else RUNNING


@inlined
def _begin(equipment, sea, loop, column, x, memory, world, noise, log, tick):  # type: ignore[no-untyped-def]  # compiled only
    """Meet the water and read the sensors: RUNNING or how the mission ended, the readings and the water."""
    outcome: int = _look_around(sea, loop, column, x, memory, world, log, tick)
    water = _water_here(loop, column, x, tick * loop.control_step)
    return outcome, _sense(equipment, loop, column, x, world, water, noise, tick), water


@inlined
def _obey(  # type: ignore[no-untyped-def]  # compiled only
    equipment, sea, loop, column, x, k, trial, memory, world, noise, log, water, readings, commands, before, tick
):
    """Act, write and move by the commands; returns RUNNING or how the mission ended."""
    t = tick * loop.control_step
    _note(log, memory, world, before, t, x[DEPTH])
    done = _act(equipment, loop, x, world, water, commands, t)
    return _go_on(
        equipment, sea, loop, column, x, k, trial, memory, world, noise, log, water, readings, commands, done, tick
    )


@inlined
def _go_on(  # type: ignore[no-untyped-def]  # compiled only
    equipment, sea, loop, column, x, k, trial, memory, world, noise, log, water, readings, commands, done, tick
):
    """Switch, write and move while the actuators do what they do; returns RUNNING or how the mission ended."""
    t = tick * loop.control_step
    _switch(equipment, sea, loop, x, world, water, commands, noise, t)
    _write(equipment, loop, column, x, memory, world, water, readings, commands, done, noise, log, tick)
    advance(equipment, x, k, trial, world, done, loop, column, t)
    _warn_of_depth(equipment.hull, log, x, memory, world, t)
    return _outcome(equipment, x, world, commands, t)


@compiled
def begin_step(
    equipment: Equipment,
    sea: Sea,
    loop: Loop,
    column: Column,
    x: np.ndarray,
    memory: np.record,
    world: np.record,
    noise: np.random.Generator,
    log: Log,
    tick: int,
) -> tuple[int, Readings]:
    """First half of a control step: RUNNING or how the mission ended, and what the sensors say."""
    outcome, readings, _ = _begin(equipment, sea, loop, column, x, memory, world, noise, log, tick)
    return outcome, readings


@compiled
def end_step(
    equipment: Equipment,
    sea: Sea,
    loop: Loop,
    column: Column,
    x: np.ndarray,
    memory: np.record,
    world: np.record,
    noise: np.random.Generator,
    log: Log,
    readings: Readings,
    commands: Commands,
    before: float,
    tick: int,
) -> int:
    """Second half of a control step: what the vehicle does of its commands; RUNNING or how the mission ended.

    `before` is the phase that the memory held before the decision.
    """
    k, trial = np.empty((4, STATE_SIZE)), np.empty(STATE_SIZE)
    water = _water_here(loop, column, x, tick * loop.control_step)
    outcome: int = _obey(
        equipment, sea, loop, column, x, k, trial, memory, world, noise, log, water, readings, commands, before, tick
    )
    return outcome


@compiled
def driven_step(
    equipment: Equipment,
    sea: Sea,
    loop: Loop,
    column: Column,
    x: np.ndarray,
    memory: np.record,
    world: np.record,
    noise: np.random.Generator,
    log: Log,
    readings: Readings,
    drives: Drives,
    wear: Wear,
    before: float,
    tick: int,
) -> tuple[int, Readings, Vector]:
    """Move from one look at the sensors to the next, by the vehicle's own electronics, well or worn.

    The second half of control step `tick` and the first half of the one after: RUNNING or how the mission ended, what
    the sensors say then, and the field at the compass. `memory` is only written down: the software that drives keeps
    its own.
    """
    k, trial = np.empty((4, STATE_SIZE)), np.empty(STATE_SIZE)
    t = tick * loop.control_step
    water = _water_here(loop, column, x, t)
    _note(log, memory, world, before, t, x[DEPTH])
    theta = attitude_of(state_from_array(x).Q).theta
    V_b = oil_volume(x, world)
    done = drive(equipment.plant, world, wear, drives, x[R_PX], V_b, water.P, theta, loop.control_step)
    if world.dropping and world.dropped == 0.0:
        world.dropped = equipment.plant.drop_weight / water.rho
        x[V_B] += world.dropped
    outcome: int = _go_on(
        equipment, sea, loop, column, x, k, trial, memory, world, noise, log, water, readings, drives, done, tick
    )
    if outcome == RUNNING:
        outcome, readings, _ = _begin(equipment, sea, loop, column, x, memory, world, noise, log, tick + 1)
    return outcome, readings, felt_field(equipment.sensors, world, state_from_array(x).Q)


@compiled
def fly(
    equipment: Equipment,
    orders: Orders,
    sea: Sea,
    loop: Loop,
    column: Column,
    x: np.ndarray,
    memory: np.record,
    world: np.record,
    noise: np.random.Generator,
    log: Log,
    first_tick: int,
    last_tick: int,
) -> int:
    """Fly control steps `first_tick` to `last_tick`; returns RUNNING or how the mission ended.

    Ocean column, state `x`, memory, world, noise and log are changed in place, so that a long mission is flown in
    pieces with progress between them, with the same result.
    """
    k, trial = np.empty((4, STATE_SIZE)), np.empty(STATE_SIZE)
    outcome: int = RUNNING
    for tick in range(first_tick, last_tick):
        outcome, readings, water = _begin(equipment, sea, loop, column, x, memory, world, noise, log, tick)
        if outcome != RUNNING:
            return outcome
        before = memory.phase
        commands = decision(memory, orders, readings, tick * loop.control_step)
        outcome = _obey(
            equipment,
            sea,
            loop,
            column,
            x,
            k,
            trial,
            memory,
            world,
            noise,
            log,
            water,
            readings,
            commands,
            before,
            tick,
        )
        if outcome != RUNNING:
            return outcome
    return RUNNING
