"""How the vehicle moves in one control step: flying, floating on the water, touching the bottom (compiled).

Within a step the actuators' rates are constant and the equations of motion are integrated with a fixed step, finer
while an actuator moves or the vehicle answers it. At the surface the vehicle floats with the water.
"""

import math

from stommel.compilation import inlined
from stommel.dynamics.acceleration import state_from_velocities
from stommel.dynamics.equations import net_weight, rates_by, state_from_array, state_into_array, static_moment
from stommel.dynamics.inertia import factors_at, moving_mass_position
from stommel.dynamics.state import DEPTH, R_PX, STATE_SIZE, V_B, X_EAST, X_NORTH, Actuation
from stommel.geometry.attitude import attitude_of, wrapped
from stommel.machinery.hull.floating import emerged_moment
from stommel.ocean.kernel.column import water_at
from stommel.ocean.kernel.grid import BOTTOM, TIME
from stommel.simulation.plant.hull_air import fill_with_water, place_water

AFLOAT_DEPTH = 0.15
"""Depth at which a rising vehicle counts as floating [m]: its hull breaks the surface."""

LARGEST_STEADY, LARGEST_MOVING = 1.8, 1.25
"""Integration step times the rate at which rotation is damped, which grows with speed; stable is up to 2.78."""

PITCH_TIME_AFLOAT = 10.0
"""Time in which a floating vehicle follows its moving mass [s]."""

STEEPEST_AFLOAT = math.radians(60.0)
"""Steepest pitch of a floating vehicle [rad]: its ends lie on the water."""


@inlined
def _step(vehicle, x, k, trial, actuation, column, age, h):  # type: ignore[no-untyped-def]  # compiled only
    """One classical Runge-Kutta step of the flat state `x`, in place."""
    moves = actuation.r_px_dot != 0.0 or actuation.u_b != 0.0
    factors = factors_at(vehicle, x[R_PX], x[V_B], actuation, False)
    for stage in range(4):
        fraction = 0.0 if stage == 0 else h if stage == 3 else 0.5 * h
        for j in range(STATE_SIZE):
            trial[j] = x[j] + fraction * k[stage - 1, j] if stage > 0 else x[j]
        if moves and stage > 0:
            factors = factors_at(vehicle, trial[R_PX], trial[V_B], actuation, False)
        water = water_at(column, trial[DEPTH], age + fraction)
        state_into_array(rates_by(factors, vehicle, state_from_array(trial), actuation, water, False), k[stage])
    for j in range(STATE_SIZE):
        x[j] += h / 6.0 * (k[0, j] + 2.0 * (k[1, j] + k[2, j]) + k[3, j])


@inlined
def _float(vehicle, form, x, column, age, mu, step):  # type: ignore[no-untyped-def]  # compiled only
    """Rest on the water, moving with it, wings level, by the end that stands out."""
    x[DEPTH] = 0.0
    state = state_from_array(x)
    water = water_at(column, 0.0, age)
    actuation = Actuation(0.0, 0.0, 0.0, 0.0, mu, 0.0)
    attitude = attitude_of(state.Q)
    half = 0.5 * attitude.psi
    # heading kept; the pitch follows the moving mass to where it balances
    s = static_moment(vehicle, water, moving_mass_position(vehicle, state.r_px, mu), state.V_b)
    s_1 = s[0] + water.rho * emerged_moment(form, attitude.theta, surplus_volume(vehicle, water, state.V_b))
    balanced = max(-STEEPEST_AFLOAT, min(STEEPEST_AFLOAT, math.atan(-s_1 / s[2])))
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
def surplus_volume(vehicle, water, V_b):  # type: ignore[no-untyped-def]  # compiled only
    """Volume of a floating vehicle that stands out of the water [m3]."""
    return max(0.0, -net_weight(vehicle, water, V_b) / (water.rho * vehicle.g))


@inlined
def advance(  # type: ignore[no-untyped-def]  # compiled only
    equipment, x, k, trial, world, done, loop, column, t
):
    """Move the world by one control step."""
    vehicle, step, age = equipment.vehicle, loop.control_step, loop.start + t - column.place[TIME]
    by_mass = equipment.plant.steering.by_mass != 0.0
    delta_r = 0.0 if by_mass else done.steering
    mu = done.steering if by_mass else 0.0
    mu_dot = done.steering_rate if by_mass else 0.0
    u_b = done.u_b - fill_with_water(equipment.hull, world, t, step)
    if world.leaked > 0.0:
        water = water_at(column, x[DEPTH], age)
        place_water(equipment.hull, vehicle, water.rho, world.leaked, attitude_of(state_from_array(x).Q).theta)
    world.afloat = int(_floats(vehicle, x, column, age, world.rising != 0))
    before_north, before_east, before_depth = x[X_NORTH], x[X_EAST], x[DEPTH]
    if world.afloat:
        x[R_PX] += done.r_px_dot * step
        x[V_B] += u_b * step
        _float(vehicle, equipment.plant.form, x, column, age, mu, step)
        U = water_at(column, 0.0, age).U
        x[X_NORTH] += U[0] * step
        x[X_EAST] += U[1] * step
    elif _lies_on_the_bottom(vehicle, x, column, age):
        x[R_PX] += done.r_px_dot * step
        x[V_B] += u_b * step
        _rest_on_the_bottom(vehicle, x, water_at(column, x[DEPTH], age))
    else:
        if done.r_px_dot != 0.0 or done.u_b != 0.0 or mu_dot != 0.0:
            world.moved_at = t
        damped = step * loop.damping * world.speed * world.speed
        if t - world.moved_at < loop.settle_time:
            n = max(loop.moving_steps, int(damped / LARGEST_MOVING) + 1)
        else:
            n = max(loop.steady_steps, int(damped / LARGEST_STEADY) + 1)
        h = step / n
        for i in range(n):
            mu_here = mu + mu_dot * (i + 0.5 - 0.5 * n) * h
            actuation = Actuation(done.r_px_dot, 0.0, u_b, delta_r, mu_here, mu_dot)
            _step(vehicle, x, k, trial, actuation, column, age + i * h, h)
        _contact(vehicle, x, column, age + step)
        U = water_at(column, x[DEPTH], age).U
        north, east = (x[X_NORTH] - before_north) / step - U[0], (x[X_EAST] - before_east) / step - U[1]
        sinking = (x[DEPTH] - before_depth) / step
        world.speed = math.sqrt(north * north + east * east + sinking * sinking)
        world.current_sum_north += U[0] * step
        world.current_sum_east += U[1] * step
        world.current_time += step
        world.rising = int(sinking < 0.0)
    world.latitude += (x[X_NORTH] - before_north) / world.metres_north
    world.longitude = wrapped(world.longitude + (x[X_EAST] - before_east) / world.metres_east)


@inlined
def _floats(vehicle, x, column, age, rising):  # type: ignore[no-untyped-def]  # compiled only
    """Whether the vehicle lies on the water: it is buoyant, and comes up or is there."""
    limit = AFLOAT_DEPTH if rising else 0.0
    return x[DEPTH] <= limit and net_weight(vehicle, water_at(column, x[DEPTH], age), x[V_B]) < 0.0


@inlined
def _lies_on_the_bottom(vehicle, x, column, age):  # type: ignore[no-untyped-def]  # compiled only
    """Whether the vehicle rests on the ground, heavier than its water."""
    return x[DEPTH] >= column.place[BOTTOM] and net_weight(vehicle, water_at(column, x[DEPTH], age), x[V_B]) > 0.0


@inlined
def _rest_on_the_bottom(vehicle, x, water):  # type: ignore[no-untyped-def]  # compiled only
    """Stop over the ground, not in the water, which flows by."""
    state, none = state_from_array(x), Actuation(0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    still = (0.0, 0.0, 0.0)
    state_into_array(
        state_from_velocities(vehicle, still, still, state.X, state.Q, state.r_px, state.V_b, none, water), x
    )


@inlined
def _contact(vehicle, x, column, age):  # type: ignore[no-untyped-def]  # compiled only
    """Neither out of the water nor into the ground: stop there."""
    x[DEPTH] = max(x[DEPTH], 0.0)
    if x[DEPTH] > column.place[BOTTOM]:
        x[DEPTH] = column.place[BOTTOM]
        _rest_on_the_bottom(vehicle, x, water_at(column, x[DEPTH], age))
