"""One decision of the vehicle's software: from readings to commands (compiled, or plain Python).

`decide` is what the compiled mission loop inlines, what the flight software calls once a second, and what the tests
call. It reads nothing but `Readings`, remembers everything in `memory` (`stommel.control.memory`) and answers with
`Commands`.
"""

import math

import numpy as np

from stommel.compilation import compiled, inlined
from stommel.control.commands import ABORTED, COMPLETE, GOING_ON, Commands
from stommel.control.dead_reckoning import leave_surface, reckon, surface, take_fix
from stommel.control.dive_cycle import (
    ABORT_BATTERY,
    ABORT_LEAK,
    ABORT_PRESSURE,
    ASCENT,
    DESCENT,
    DRIFT,
    MISSION_COMPLETE,
    NOTHING,
    RECOVERY,
    SURFACE,
    DivePlan,
    DiveState,
    Situation,
    next_dive_state,
    wanted_ballast,
    wanted_loads,
    wanted_pitch,
)
from stommel.control.flight_table import FlightTable, look_up, look_up_turning
from stommel.control.guidance import course_to_steer
from stommel.control.laws import HeadingLaw, PitchLaw, drift_correction, pitch_correction, steering_command
from stommel.control.orders import Alarms, Orders
from stommel.control.readings import Readings
from stommel.geometry.attitude import wrapped
from stommel.geometry.earth import metres_per_radian, to_waypoint

TURNING_FILTER = 0.2
"""Weight of a new difference of heading in the heading rate, per decision of one second: a rudder that follows the
compass's noise wears and costs energy."""


@inlined
def decision(memory: np.record, orders: Orders, readings: Readings, t: float) -> Commands:
    """`decide` as a building block of compiled code."""
    memory.energy_used += readings.voltage * readings.current * orders.step
    if readings.fixed:
        take_fix(memory, readings.fix_time, readings.fix_latitude, readings.fix_longitude)
    follow_heading(memory, readings.psi, orders.step)
    if memory.until_guidance == 0:
        memory.until_guidance = orders.guidance_every
        memory.under_way = int(guide(memory, orders))
        watch(memory, orders.alarms, readings)
    memory.until_guidance -= 1
    advance_cycle(memory, orders.dives, readings, t)
    commands = command(memory, orders, readings, t)
    if not commands.radio:
        reckon(memory, orders.table, readings, t, orders.step)
    memory.depth_before = readings.depth
    return commands


@compiled
def decide(memory: np.record, orders: Orders, readings: Readings, t: float) -> Commands:
    """Decide once: what the machinery shall do until the next decision, one `orders.step` later.

    Parameters
    ----------
    memory
        From `stommel.control.memory.new_memory`; changed in place.
    orders
        What the software was told; never changed.
    readings
        What the sensors say now.
    t
        Time of the mission [s].
    """
    return decision(memory, orders, readings, t)


@inlined
def watch(memory: np.record, alarms: Alarms, readings: Readings) -> None:
    """Raise the alarm that ends the mission, once and for all: leak, pressure in the hull, battery."""
    if memory.alarm != NOTHING:
        return
    if alarms.leak and readings.leak:
        memory.alarm = ABORT_LEAK
    elif readings.internal_pressure > alarms.internal_pressure:
        memory.alarm = ABORT_PRESSURE
    elif memory.energy_used > alarms.energy:
        memory.alarm = ABORT_BATTERY


@inlined
def dive_state_of(memory: np.record) -> DiveState:
    """The dive state that the memory holds."""
    return DiveState(
        memory.phase,
        memory.since,
        memory.submerged_since,
        memory.dives,
        memory.dives_here,
        memory.event,
    )


@inlined
def advance_cycle(memory: np.record, plan: DivePlan, readings: Readings, t: float) -> None:
    """Advance the dive cycle, and open and close the accounts of a dive."""
    fixed = memory.first_fix_at >= 0.0
    now = Situation(readings.depth, readings.altitude, readings.V_b, memory.under_way != 0, fixed, memory.alarm)
    before = dive_state_of(memory)
    after = next_dive_state(before, plan, t, now)
    memory.phase, memory.since, memory.submerged_since = after.phase, after.since, after.submerged_since
    memory.dives, memory.dives_here, memory.event = after.dives, after.dives_here, after.event
    if after.phase == before.phase:
        return
    memory.drift_correction, memory.drift_corrected_at = 0.0, t
    if after.phase == SURFACE:
        surface(memory, t)
    elif before.phase == SURFACE and after.phase == DESCENT:
        leave_surface(memory, t)


@inlined
def guide(memory: np.record, orders: Orders) -> bool:
    """Choose the heading to the current waypoint from the vehicle's own position; returns whether any is left."""
    memory.metres_north, memory.metres_east = metres_per_radian(memory.latitude)
    cruise = look_up(orders.table, orders.dives.theta, orders.dives.V_b_dive)[2]
    while memory.waypoint < len(orders.waypoints):
        goal = orders.waypoints[memory.waypoint]
        north, east = to_waypoint(memory.latitude, memory.longitude, goal[0], goal[1])
        if math.hypot(north, east) > orders.radius:
            line_north, line_east = to_waypoint(memory.line_latitude, memory.line_longitude, goal[0], goal[1])
            current = (memory.current_north, memory.current_east)
            memory.heading_wanted = course_to_steer(
                north, east, line_north, line_east, orders.lookahead, current, cruise
            )
            return True
        memory.line_latitude, memory.line_longitude = goal[0], goal[1]
        memory.waypoint += 1
    return False


@inlined
def follow_heading(memory: np.record, psi: float, step: float) -> None:
    """Heading rate from one measured heading to the next, smoothed."""
    weight = min(1.0, TURNING_FILTER * step)
    memory.turning += weight * (wrapped(psi - memory.heading_before) / step - memory.turning)
    memory.heading_before = psi


@inlined
def command(memory: np.record, orders: Orders, readings: Readings, t: float) -> Commands:
    """Commands of machinery and loads for the phase."""
    plan, laws, table = orders.dives, orders.laws, orders.table
    state = dive_state_of(memory)
    phase = int(state.phase)
    V_b, loads, sampling, hold = wanted_ballast(state, plan), wanted_loads(phase), False, laws.pitch.tolerance
    if phase in (SURFACE, RECOVERY):
        memory.steering = 0.0
        r_px = plan.r_px_surface if not math.isnan(plan.r_px_surface) else _for_pitch(memory, plan, table, state)
        return Commands(r_px, V_b, 0.0, hold, loads, sampling, True, _ended(state, plan, t))
    sampling = orders.sampled[phase] != 0.0
    if phase == DRIFT:
        memory.steering = 0.0  # without way through the water nothing steers
        if t - memory.drift_corrected_at >= laws.drift.period:
            memory.drift_correction = drift_correction(
                laws.drift, memory.drift_correction, readings.depth - plan.depth, memory.vertical_speed
            )
            memory.drift_corrected_at = t
        return Commands(plan.r_px_drift, V_b + memory.drift_correction, 0.0, hold, loads, sampling, False, GOING_ON)
    memory.steering = _steer(memory, table, laws.heading, wanted_pitch(state, plan), V_b, readings.psi)
    _correct_pitch(memory, plan, laws.pitch, state, t, readings.theta)
    r_px = _for_pitch(memory, plan, table, state)
    return Commands(r_px, V_b, memory.steering, hold, loads, sampling, False, GOING_ON)


@inlined
def _ended(state: DiveState, plan: DivePlan, t: float) -> int:
    """Whether the vehicle has waited in recovery as long as it calls, and why it is there."""
    if state.phase != RECOVERY or t - state.since < plan.surface_time:
        return GOING_ON
    return COMPLETE if state.event == MISSION_COMPLETE else ABORTED


@inlined
def _steer(memory: np.record, table: FlightTable, law: HeadingLaw, theta: float, V_b: float, psi: float) -> float:
    """Command of the steering for the wanted heading, by how the flight at this pitch and ballast turns."""
    pole, drive = look_up_turning(table, theta, V_b)
    error = wrapped(memory.heading_wanted - psi)
    way = 1.0
    if pole > 0.0:
        way = min(1.0, memory.path_speed / look_up(table, theta, V_b)[2])
    return steering_command(law, memory.steering, error, memory.turning, pole, drive, way)


@inlined
def _correct_pitch(memory: np.record, plan: DivePlan, law: PitchLaw, state: DiveState, t: float, theta: float) -> None:
    """Once a period of an established glide, correct the moving mass for the error of the pitch."""
    gliding = (state.phase in (DESCENT, ASCENT)) and t - memory.since > 2.0 * law.period
    if gliding and t - memory.corrected_at >= law.period:
        # corrections of the climb mirror those of the dive: they make up for the same trim error
        sign = 1.0 if state.phase == DESCENT else -1.0
        before = sign * memory.correction
        memory.correction = sign * pitch_correction(law, before, wanted_pitch(state, plan), theta)
        memory.corrected_at = t


@inlined
def _for_pitch(memory: np.record, plan: DivePlan, table: FlightTable, state: DiveState) -> float:
    """Moving-mass position for the phase's pitch: of the flight table, with what feedback adds."""
    r_px, _, _ = look_up(table, wanted_pitch(state, plan), wanted_ballast(state, plan))
    correction: float = memory.correction if state.phase == DESCENT else -memory.correction
    return r_px + correction
