"""The mission loop: world and vehicle, decision by decision (compiled).

Between two decisions the actuators' rates are constant and the equations of motion are integrated with a fixed step,
finer while an actuator moves or the vehicle answers it. At the surface the vehicle floats with the water.
"""

import math

import numpy as np

from stommel.control.dive_cycle import DESCENT, INFLECTION, NOTHING, RECOVERY, SURFACE, DivePlan
from stommel.control.flight_table import FlightTable, look_up
from stommel.control.guidance import metres_per_radian
from stommel.control.laws import HeadingLaw, PitchLaw, wrapped
from stommel.dynamics.acceleration import state_from_velocities
from stommel.dynamics.compilation import compiled, inlined
from stommel.dynamics.equations import net_weight, rates, state_from_array, state_into_array, static_moment
from stommel.dynamics.inertia import moving_mass_position, velocities
from stommel.dynamics.state import STATE_SIZE, Actuation
from stommel.dynamics.vectors import dot
from stommel.ocean.column import fill_column, water_at
from stommel.ocean.grid import BOTTOM, HELD, LAND, SALINITY, TIME, Column, OceanGrid
from stommel.seawater.table import DensityTable
from stommel.simulation.acting import actuate, consume
from stommel.simulation.parameters import Loop, Plant, Sensors
from stommel.simulation.sensing import attitude_of, compass, depth_sensor
from stommel.simulation.software import command, decide_phase, first_fix, guide, last_fix, reckon, surface

AFLOAT_DEPTH = 0.15
"""Depth at which a rising vehicle counts as floating [m]: its hull breaks the surface."""

LARGEST_STEP = 0.6
"""Integration step times the square of the speed [m2/s]: damping grows with V^2, and fast flight needs finer steps."""

PITCH_TIME_AFLOAT = 10.0
"""Time in which a floating vehicle follows its moving mass [s]."""

STEEPEST_AFLOAT = math.radians(60.0)
"""Steepest pitch of a floating vehicle [rad]: its ends lie on the water."""

GUIDANCE_PERIOD = 10.0
"""Between two looks at the waypoint [s]."""

RUNNING, FINISHED, OUT_OF_BATTERY, OUT_OF_OCEAN, ASHORE, NOT_FINITE = range(6)
OUTCOMES = (
    "time over",
    "mission complete",
    "battery empty",
    "left the ocean data",
    "aground",
    "the flight became unphysical",
)
"""How a mission ended."""


@inlined
def _step(vehicle, x, k, trial, actuation, column, age, h):  # type: ignore[no-untyped-def]  # compiled only
    """One classical Runge-Kutta step of the flat state `x`, in place."""
    water = water_at(column, x[2], age)
    state_into_array(rates(vehicle, state_from_array(x), actuation, water, False), k[0])
    for stage in range(1, 4):
        fraction = h if stage == 3 else 0.5 * h
        for j in range(STATE_SIZE):
            trial[j] = x[j] + fraction * k[stage - 1, j]
        water = water_at(column, trial[2], age + fraction)
        state_into_array(rates(vehicle, state_from_array(trial), actuation, water, False), k[stage])
    for j in range(STATE_SIZE):
        x[j] += h / 6.0 * (k[0, j] + 2.0 * (k[1, j] + k[2, j]) + k[3, j])


@inlined
def _float(vehicle, x, column, age, mu, step):  # type: ignore[no-untyped-def]  # compiled only
    """Rest on the water, moving with it, wings level."""
    x[2] = 0.0
    state = state_from_array(x)
    water = water_at(column, 0.0, age)
    actuation = Actuation(0.0, 0.0, 0.0, 0.0, mu, 0.0)
    attitude = attitude_of(state.Q)
    half = 0.5 * attitude.psi
    # heading kept; the pitch follows the moving mass to where it balances
    s = static_moment(vehicle, water, moving_mass_position(vehicle, state.r_px, mu), state.V_b)
    balanced = max(-STEEPEST_AFLOAT, min(STEEPEST_AFLOAT, math.atan(-s[0] / s[2])))
    theta = attitude.theta + min(1.0, step / PITCH_TIME_AFLOAT) * (balanced - attitude.theta)
    half_pitch = 0.5 * theta
    Q = (
        math.cos(half_pitch) * math.cos(half),
        -math.sin(half_pitch) * math.sin(half),
        math.sin(half_pitch) * math.cos(half),
        math.cos(half_pitch) * math.sin(half),
    )
    v_level = water.U[0] * math.cos(attitude.psi) + water.U[1] * math.sin(attitude.psi)
    v_across = -water.U[0] * math.sin(attitude.psi) + water.U[1] * math.cos(attitude.psi)
    v = (v_level * math.cos(theta), v_across, v_level * math.sin(theta))
    rest = state_from_velocities(vehicle, v, (0.0, 0.0, 0.0), state.X, Q, state.r_px, state.V_b, actuation, water)
    state_into_array(rest, x)


@inlined
def _advance(  # type: ignore[no-untyped-def]  # compiled only
    vehicle, x, k, trial, software, world, rates_now, plant, loop, column, t
):
    """Move the world by one control step."""
    step, age = loop.control_step, loop.start + t - column.place[TIME]
    by_mass = plant.steers_by_mass != 0.0
    delta_r = 0.0 if by_mass else rates_now.steering
    mu = rates_now.steering if by_mass else 0.0
    mu_dot = rates_now.steering_rate if by_mass else 0.0
    world.afloat = int(_floats(vehicle, x, column, age, software))
    before_north, before_east = x[0], x[1]
    if world.afloat:
        x[13] += rates_now.r_px_dot * step
        x[15] += rates_now.u_b * step
        _float(vehicle, x, column, age, mu, step)
        U = water_at(column, 0.0, age).U
        x[0] += U[0] * step
        x[1] += U[1] * step
    else:
        if rates_now.r_px_dot != 0.0 or rates_now.u_b != 0.0 or mu_dot != 0.0:
            world.moved_at = t
        n = loop.moving_steps if t - world.moved_at < loop.settle_time else loop.steady_steps
        n = max(n, int(step * world.speed * world.speed / LARGEST_STEP) + 1)
        h = step / n
        for i in range(n):
            mu_here = mu + mu_dot * (i + 0.5 - 0.5 * n) * h
            actuation = Actuation(rates_now.r_px_dot, 0.0, rates_now.u_b, delta_r, mu_here, mu_dot)
            _step(vehicle, x, k, trial, actuation, column, age + i * h, h)
        _contact(x, column)
        water = water_at(column, x[2], age)
        eta = velocities(vehicle, state_from_array(x), Actuation(0.0, 0.0, 0.0, delta_r, mu, 0.0), water, False)
        world.speed = math.sqrt(dot(eta.v_r, eta.v_r))
        U = water.U
        world.current_sum_north += U[0] * step
        world.current_sum_east += U[1] * step
        world.current_time += step
    m_north, m_east = metres_per_radian(world.latitude)
    world.latitude += (x[0] - before_north) / m_north
    world.longitude = wrapped(world.longitude + (x[1] - before_east) / m_east)


@inlined
def _floats(vehicle, x, column, age, software):  # type: ignore[no-untyped-def]  # compiled only
    """Whether the vehicle lies on the water: it is buoyant, and has come up, or waits there."""
    limit = AFLOAT_DEPTH if software.phase in (SURFACE, RECOVERY) else 0.0
    return x[2] <= limit and net_weight(vehicle, water_at(column, x[2], age), x[15]) < 0.0


@inlined
def _contact(x, column):  # type: ignore[no-untyped-def]  # compiled only
    """Neither out of the water nor into the ground: stop there."""
    x[2] = max(x[2], 0.0)
    if x[2] > column.place[BOTTOM]:
        x[2] = column.place[BOTTOM]
        for j in range(7, 13):
            x[j] = 0.0


@inlined
def salinity_at(column: Column, z: float) -> float:
    """Absolute Salinity at depth `z` of a filled column [g/kg]."""
    values = column.values
    position = max(z, 0.0) / column.dz
    n = min(int(position), values.shape[0] - 2)
    share = min(position - n, 1.0)
    S: float = values[n, SALINITY] + share * (values[n + 1, SALINITY] - values[n, SALINITY])
    return S


@inlined
def _row(  # type: ignore[no-untyped-def]  # compiled only
    out, i, t, age, x, vehicle, software, world, mu, attitude_measured, depth_measured, column, plant
):
    """Write one row of the record (`STATE_COLUMNS`)."""
    state = state_from_array(x)
    water = water_at(column, x[2], age)
    actuation = Actuation(0.0, 0.0, 0.0, 0.0, mu, 0.0)
    eta = velocities(vehicle, state, actuation, water, False)
    true = attitude_of(state.Q)
    row = out[i]
    row[0], row[1], row[2], row[3] = t, world.latitude, world.longitude, x[2]
    row[4], row[5], row[6] = true.phi, true.theta, true.psi
    row[7], row[8], row[9] = eta.v_r
    row[10], row[11], row[12] = eta.omega
    row[13], row[14] = x[13], x[15]
    row[15] = 0.0 if plant.steers_by_mass != 0.0 else world.steering
    row[16] = world.steering if plant.steers_by_mass != 0.0 else 0.0
    row[17] = software.phase
    row[18], row[19], row[20] = attitude_measured.theta, attitude_measured.psi, depth_measured
    row[21], row[22] = water.rho, water.T
    row[23] = salinity_at(column, x[2])
    row[24], row[25] = water.U[0], water.U[1]
    row[26] = column.place[BOTTOM]
    row[27], row[28] = software.latitude, software.longitude
    for j in range(len(world.energy)):
        row[29 + j] = world.energy[j]


@compiled
def fly(
    vehicle: np.record,
    plant: Plant,
    sensors: Sensors,
    loop: Loop,
    plan: DivePlan,
    pitch_law: PitchLaw,
    heading_law: HeadingLaw,
    table: FlightTable,
    waypoints: np.ndarray,
    radius: float,
    lookahead: float,
    grid: OceanGrid,
    density: DensityTable,
    column: Column,
    x: np.ndarray,
    software: np.record,
    world: np.record,
    noise: np.random.Generator,
    first_tick: int,
    last_tick: int,
    record: np.ndarray,
    surfacings: np.ndarray,
    events: np.ndarray,
    counts: np.ndarray,
) -> int:
    """Fly control steps `first_tick` to `last_tick`; returns RUNNING or how the mission ended.

    State, software, world and noise are changed in place, so that a long mission is flown in pieces with progress
    between them, with the same result. `counts` holds how many rows of record, surfacings and events are filled, and
    the ocean cell.
    """
    k, trial = np.empty((4, STATE_SIZE)), np.empty(STATE_SIZE)
    cell = counts[3:5]
    every_column = max(1, round(loop.column_period / loop.control_step))
    every_guidance = max(1, round(GUIDANCE_PERIOD / loop.control_step))
    cruise = look_up(table, plan.theta, plan.V_b_dive)[2]
    under_way = software.waypoint < len(waypoints)
    for tick in range(first_tick, last_tick):
        t = tick * loop.control_step
        if tick % every_column == 0:
            status = fill_column(grid, density, loop.start + t, world.latitude, world.longitude, cell, column)
            if status > HELD:
                return ASHORE if status == LAND else OUT_OF_OCEAN
        state = state_from_array(x)
        # sense
        measured = compass(sensors, world, state.Q, noise)
        depth = depth_sensor(sensors, x[2], noise)
        above = column.place[BOTTOM] - x[2]
        altitude = above if above < sensors.altimeter_range else math.inf
        turning = wrapped(measured.psi - software.heading_before) / loop.control_step
        # decide
        if tick % every_guidance == 0:
            under_way = guide(software, waypoints, radius, lookahead, cruise)
        changed = decide_phase(software, plan, t, depth, altitude, x[15], under_way)
        commands = command(software, plan, table, pitch_law, heading_law, t, measured, turning)
        if changed:
            world.moved_at = t
            _event(events, counts, t, software, world, x[2])
            if software.phase == SURFACE:
                surface(software, t, world.latitude, world.longitude)
                for j in range(len(plant.surfacing_energy)):
                    world.energy[j] += plant.surfacing_energy[j]
            elif software.phase != RECOVERY and software.submerged_since == t:
                _leave_surface(software, world, sensors, noise, surfacings, counts, t)
        # act
        pressure = water_at(column, x[2]).P
        slope = math.tan(max(-1.5, min(1.5, measured.theta)))
        done = actuate(plant, world, commands, x[13], x[15], pressure, slope, loop.control_step)
        at_surface = software.phase in (SURFACE, RECOVERY)
        consume(plant, world, at_surface, software.phase == DESCENT, loop.control_step)
        if at_surface:
            if software.first_fix_at < 0.0 and world.afloat and t - software.since >= sensors.first_fix_time:
                latitude, longitude = _fix(world, sensors, noise)
                first_fix(software, t, latitude, longitude)
        else:
            reckon(software, table, measured, depth, x[15], t, loop.control_step)
        software.depth_before, software.heading_before = depth, measured.psi
        _advance(vehicle, x, k, trial, software, world, done, plant, loop, column, t)
        if tick % loop.record_every == 0:
            age = loop.start + t - column.place[TIME]
            mu = world.steering if plant.steers_by_mass != 0.0 else 0.0
            _row(record, counts[0], t, age, x, vehicle, software, world, mu, measured, depth, column, plant)
            counts[0] += 1
        if not math.isfinite(x[2]) or not math.isfinite(x[7]):
            return NOT_FINITE
        if world.energy_total + plant.self_discharge * t > plant.battery_energy:
            return OUT_OF_BATTERY
        if software.phase == RECOVERY and t - software.since >= plan.surface_time:
            return FINISHED
    return RUNNING


@inlined
def _fix(world, sensors, noise):  # type: ignore[no-untyped-def]  # compiled only
    """A position from GPS."""
    m_north, m_east = metres_per_radian(world.latitude)
    return (
        world.latitude + sensors.position_noise * noise.standard_normal() / m_north,
        world.longitude + sensors.position_noise * noise.standard_normal() / m_east,
    )


@inlined
def _event(events, counts, t, software, world, depth):  # type: ignore[no-untyped-def]  # compiled only
    if counts[2] < len(events):
        row = events[counts[2]]
        row[0], row[1], row[2], row[3], row[4] = t, software.phase, world.latitude, world.longitude, depth
        # the software remembers the last reason; it is that of this change only where a dive or the mission ends
        row[5] = software.event if software.phase in (INFLECTION, RECOVERY) else float(NOTHING)
        counts[2] += 1


@inlined
def _leave_surface(software, world, sensors, noise, surfacings, counts, t):  # type: ignore[no-untyped-def]
    """The last position before a dive; closes the account of the dive before."""
    latitude, longitude = _fix(world, sensors, noise)
    submerged = last_fix(software, t, latitude, longitude)
    if submerged > 0.0 and counts[1] < len(surfacings):
        row = surfacings[counts[1]]
        row[0], row[1], row[2] = t, latitude, longitude
        row[3], row[4] = software.current_north, software.current_east
        row[5], row[6] = world.current_sum_north / world.current_time, world.current_sum_east / world.current_time
        row[7], row[8], row[9] = software.reckoning_error, submerged, software.dives - 1.0
        counts[1] += 1
    world.current_sum_north = world.current_sum_east = world.current_time = 0.0
