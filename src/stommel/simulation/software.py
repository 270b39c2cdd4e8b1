"""One decision of the vehicle's software in the simulator: sense, decide, command, reckon (compiled)."""

import math
from typing import NamedTuple

import numpy as np

from stommel.compilation import inlined
from stommel.control.dead_reckoning import depth_averaged_current, path_speed
from stommel.control.dive_cycle import (
    ABORT_BATTERY,
    ABORT_LEAK,
    ABORT_PRESSURE,
    ASCENT,
    DESCENT,
    DRIFT,
    NOTHING,
    RECOVERY,
    SURFACE,
    DivePlan,
    DiveState,
    Readings,
    next_dive_state,
    wanted_ballast,
    wanted_pitch,
)
from stommel.control.flight_table import FlightTable, look_up, look_up_turning
from stommel.control.guidance import course_to_steer
from stommel.control.laws import DriftLaw, HeadingLaw, PitchLaw, drift_correction, pitch_correction, steering_command
from stommel.geometry.attitude import wrapped
from stommel.geometry.earth import metres_per_radian, to_waypoint
from stommel.simulation.plant.actuators import Commands
from stommel.simulation.plant.sensing import Heading
from stommel.simulation.plant.sensors import Alarms, Sensors

TURNING_FILTER = 0.2
"""Weight of a new difference of heading in the heading rate, per decision of one second: a rudder that follows the
compass's noise wears and costs energy."""

VERTICAL_FILTER = 0.1
"""Weight of a new depth difference in the vertical speed, per decision of one second."""


DRIFT_TIME = 60.0
"""Time between two positions that tell how the surface drifts [s]; the errors of both are over it."""

AFLOAT = 0.5
"""A buoyant vehicle no deeper than this lies on the water and makes no way through it [m]."""


class Laws(NamedTuple):
    """The laws of the actuators."""

    pitch: PitchLaw
    heading: HeadingLaw
    drift: DriftLaw


@inlined
def dive_state_of(software: np.record) -> DiveState:
    """The dive state that the software remembers."""
    return DiveState(
        software.phase,
        software.since,
        software.submerged_since,
        software.dives,
        software.dives_here,
        software.event,
    )


@inlined
def watch(software: np.record, alarms: Alarms, sensors: Sensors, leaked: float, internal_pressure: float) -> None:
    """Raise the alarm that ends the mission, once and for all: leak, pressure in the hull, battery."""
    if software.alarm != NOTHING:
        return
    if alarms.leak and leaked > sensors.leak_volume:
        software.alarm = ABORT_LEAK
    elif internal_pressure > alarms.internal_pressure:
        software.alarm = ABORT_PRESSURE
    elif software.energy_used > alarms.energy:
        software.alarm = ABORT_BATTERY


@inlined
def decide_phase(software: np.record, plan: DivePlan, t: float, readings: Readings) -> bool:
    """Advance the dive cycle; returns whether the phase changed."""
    before = dive_state_of(software)
    after = next_dive_state(before, plan, t, readings)
    software.phase, software.since, software.submerged_since = after.phase, after.since, after.submerged_since
    software.dives, software.dives_here, software.event = after.dives, after.dives_here, after.event
    if after.phase != before.phase:
        software.drift_correction, software.drift_corrected_at = 0.0, t
    return after.phase != before.phase


@inlined
def guide(software: np.record, waypoints: np.ndarray, radius: float, lookahead: float, speed: float) -> bool:
    """Choose the heading to the current waypoint from the vehicle's own position; returns whether any is left."""
    software.metres_north, software.metres_east = metres_per_radian(software.latitude)
    while software.waypoint < len(waypoints):
        goal = waypoints[software.waypoint]
        north, east = to_waypoint(software.latitude, software.longitude, goal[0], goal[1])
        if math.hypot(north, east) > radius:
            line_north, line_east = to_waypoint(software.line_latitude, software.line_longitude, goal[0], goal[1])
            current = (software.current_north, software.current_east)
            software.heading_wanted = course_to_steer(north, east, line_north, line_east, lookahead, current, speed)
            return True
        software.line_latitude, software.line_longitude = goal[0], goal[1]
        software.waypoint += 1
    return False


@inlined
def follow_heading(software: np.record, psi: float, step: float) -> None:
    """Heading rate from one measured heading to the next, smoothed."""
    weight = min(1.0, TURNING_FILTER * step)
    software.turning += weight * (wrapped(psi - software.heading_before) / step - software.turning)
    software.heading_before = psi


@inlined
def command(
    software: np.record,
    plan: DivePlan,
    table: FlightTable,
    laws: Laws,
    t: float,
    measured: Heading,
    depth: float,
) -> Commands:
    """Commands of ballast, moving mass and steering for the phase."""
    state = dive_state_of(software)
    V_b = wanted_ballast(state, plan)
    if state.phase in (SURFACE, RECOVERY):
        software.steering = 0.0
        r_px = plan.r_px_surface if not math.isnan(plan.r_px_surface) else _for_pitch(software, plan, table, state)
        return Commands(r_px, V_b, 0.0, laws.pitch.tolerance)
    if state.phase == DRIFT:
        software.steering = 0.0  # without way through the water nothing steers
        if t - software.drift_corrected_at >= laws.drift.period:
            software.drift_correction = drift_correction(
                laws.drift, software.drift_correction, depth - plan.depth, software.vertical_speed
            )
            software.drift_corrected_at = t
        return Commands(plan.r_px_drift, V_b + software.drift_correction, 0.0, laws.pitch.tolerance)
    software.steering = _steer(software, table, laws.heading, wanted_pitch(state, plan), V_b, measured.psi)
    _correct_pitch(software, plan, laws.pitch, state, t, measured)
    return Commands(_for_pitch(software, plan, table, state), V_b, software.steering, laws.pitch.tolerance)


@inlined
def _steer(software: np.record, table: FlightTable, law: HeadingLaw, theta: float, V_b: float, psi: float) -> float:
    """Command of the steering for the wanted heading, by how the flight at this pitch and ballast turns."""
    pole, drive = look_up_turning(table, theta, V_b)
    error = wrapped(software.heading_wanted - psi)
    way = 1.0
    if pole > 0.0:
        way = min(1.0, software.path_speed / look_up(table, theta, V_b)[2])
    return steering_command(law, software.steering, error, software.turning, pole, drive, way)


@inlined
def _correct_pitch(
    software: np.record, plan: DivePlan, law: PitchLaw, state: DiveState, t: float, measured: Heading
) -> None:
    """Once a period of an established glide, correct the moving mass for the error of the pitch."""
    gliding = (state.phase in (DESCENT, ASCENT)) and t - software.since > 2.0 * law.period
    if gliding and t - software.corrected_at >= law.period:
        # corrections of the climb mirror those of the dive: they make up for the same trim error
        sign = 1.0 if state.phase == DESCENT else -1.0
        before = sign * software.correction
        software.correction = sign * pitch_correction(law, before, wanted_pitch(state, plan), measured.theta)
        software.corrected_at = t


@inlined
def _for_pitch(software: np.record, plan: DivePlan, table: FlightTable, state: DiveState) -> float:
    """Moving-mass position for the phase's pitch: of the flight table, with what feedback adds."""
    r_px, _, _ = look_up(table, wanted_pitch(state, plan), wanted_ballast(state, plan))
    correction: float = software.correction if state.phase == DESCENT else -software.correction
    return r_px + correction


@inlined
def reckon(
    software: np.record, table: FlightTable, measured: Heading, depth: float, V_b: float, t: float, step: float
) -> None:
    """Move the vehicle's own idea of its position by one step under water."""
    weight, before, since = min(1.0, VERTICAL_FILTER * step), software.path_speed, t - software.since
    sinking = (1.0 - weight) * software.vertical_speed + weight * (depth - software.depth_before) / step
    software.vertical_speed = sinking
    if software.phase == DRIFT:
        V_b = 0.0  # no glide to hold: the way it still has runs out
    if depth < AFLOAT and V_b > 0.0:
        software.path_speed = V_h = 0.0  # the water alone carries it
    else:
        software.path_speed, V_h = path_speed(table, before, sinking, measured.theta, V_b, since, step)
    north, east = V_h * math.cos(measured.psi) * step, V_h * math.sin(measured.psi) * step
    software.reckoned_north += north
    software.reckoned_east += east
    software.latitude += (north + software.current_north * step) / software.metres_north
    software.longitude += (east + software.current_east * step) / software.metres_east


@inlined
def surface(software: np.record, t: float, latitude: float, longitude: float) -> None:
    """Close the dive: how long it was, and how far off the reckoning ended from the true position."""
    software.surfaced_at = t
    software.under_water += t - software.submerged_since
    north, east = to_waypoint(software.latitude, software.longitude, latitude, longitude)
    software.reckoning_error = math.hypot(north, east)
    software.received, software.first_fix_at = 0.0, -1.0
    software.path_speed = 0.0


@inlined
def receive(software: np.record, t: float, latitude: float, longitude: float) -> None:
    """Take a position from GPS: remember the first since surfacing and the last."""
    if software.first_fix_at < 0.0:
        software.first_fix_at, software.first_fix_latitude, software.first_fix_longitude = t, latitude, longitude
    software.fix_at, software.fix_latitude, software.fix_longitude = t, latitude, longitude


@inlined
def leave_surface(software: np.record, t: float) -> float:
    """Begin a dive where drift has carried the last position: drift, place of surfacing, depth-averaged current.

    Returns the time under water that the current was averaged over [s], zero where there was none. Without any
    position the reckoning goes on from the dive before, and the current waits for the next one: meanwhile the water has
    carried the vehicle at the surface too.
    """
    if software.first_fix_at < 0.0:
        waited = t - software.surfaced_at
        software.adrift += waited
        software.latitude += software.current_north * waited / software.metres_north
        software.longitude = wrapped(software.longitude + software.current_east * waited / software.metres_east)
        return 0.0
    between = software.fix_at - software.first_fix_at
    m_north, m_east = metres_per_radian(software.fix_latitude)
    # positions close together do not tell the drift: it is then that of the dives before
    drift_north, drift_east = software.current_north, software.current_east
    if between >= DRIFT_TIME:
        drift_north = (software.fix_latitude - software.first_fix_latitude) * m_north / between
        drift_east = wrapped(software.fix_longitude - software.first_fix_longitude) * m_east / between
    afloat = software.first_fix_at - software.surfaced_at
    surfaced_latitude = software.first_fix_latitude - drift_north * afloat / m_north
    surfaced_longitude = software.first_fix_longitude - drift_east * afloat / m_east
    submerged: float = software.under_water
    if submerged > 0.0:
        found_north = (surfaced_latitude - software.submerged_latitude) * m_north
        found_east = wrapped(surfaced_longitude - software.submerged_longitude) * m_east
        software.current_north, software.current_east = depth_averaged_current(
            software.reckoned_north, software.reckoned_east, found_north, found_east, submerged + software.adrift
        )
    since = t - software.fix_at
    software.latitude = software.fix_latitude + drift_north * since / m_north
    software.longitude = wrapped(software.fix_longitude + drift_east * since / m_east)
    software.submerged_latitude, software.submerged_longitude = software.latitude, software.longitude
    software.reckoned_north = software.reckoned_east = software.under_water = software.adrift = 0.0
    return submerged
