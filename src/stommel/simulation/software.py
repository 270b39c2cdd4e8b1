"""One decision of the vehicle's software in the simulator: sense, decide, command, reckon (compiled)."""

import math

import numpy as np

from stommel.control.dead_reckoning import depth_averaged_current, path_speed
from stommel.control.dive_cycle import (
    ASCENT,
    DESCENT,
    RECOVERY,
    SURFACE,
    DivePlan,
    DiveState,
    next_dive_state,
    wanted_ballast,
    wanted_pitch,
)
from stommel.control.flight_table import FlightTable, look_up
from stommel.control.guidance import course_to_steer, metres_per_radian, to_waypoint
from stommel.control.laws import HeadingLaw, PitchLaw, pitch_correction, steering_command, wrapped
from stommel.dynamics.compilation import inlined
from stommel.simulation.acting import Commands
from stommel.simulation.sensing import Attitude

VERTICAL_FILTER = 0.1
"""Weight of a new depth difference in the vertical speed, per decision of one second."""


AFLOAT = 0.5
"""A buoyant vehicle no deeper than this lies on the water and makes no way through it [m]."""


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
def decide_phase(
    software: np.record, plan: DivePlan, t: float, depth: float, altitude: float, ballast: float, wanted: bool
) -> bool:
    """Advance the dive cycle; returns whether the phase changed."""
    before = dive_state_of(software)
    after = next_dive_state(before, plan, t, depth, altitude, ballast, wanted)
    software.phase, software.since, software.submerged_since = after.phase, after.since, after.submerged_since
    software.dives, software.dives_here, software.event = after.dives, after.dives_here, after.event
    return after.phase != before.phase


@inlined
def guide(software: np.record, waypoints: np.ndarray, radius: float, lookahead: float, speed: float) -> bool:
    """Choose the heading to the current waypoint from the vehicle's own position; returns whether any is left."""
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
def command(
    software: np.record,
    plan: DivePlan,
    table: FlightTable,
    pitch_law: PitchLaw,
    heading_law: HeadingLaw,
    t: float,
    attitude: Attitude,
    rate: float,
) -> Commands:
    """Commands of ballast, moving mass and steering for the phase."""
    state = dive_state_of(software)
    V_b = wanted_ballast(state, plan)
    theta = wanted_pitch(state, plan)
    r_px, _, _ = look_up(table, theta, V_b)
    gliding = (state.phase in (DESCENT, ASCENT)) and t - software.since > 2.0 * pitch_law.period
    if gliding and t - software.corrected_at >= pitch_law.period:
        # corrections of the climb mirror those of the dive: they make up for the same trim error
        sign = 1.0 if state.phase == DESCENT else -1.0
        before = software.correction
        software.correction = sign * pitch_correction(pitch_law, sign * before, theta, attitude.theta)
        software.corrected_at = t
    correction = software.correction if state.phase == DESCENT else -software.correction
    if state.phase in (SURFACE, RECOVERY):
        software.steering = 0.0
    else:
        software.steering = steering_command(
            heading_law, software.steering, software.heading_wanted, attitude.psi, rate
        )
    return Commands(r_px + correction, V_b, software.steering, pitch_law.tolerance)


@inlined
def reckon(
    software: np.record, table: FlightTable, attitude: Attitude, depth: float, V_b: float, t: float, step: float
) -> None:
    """Move the vehicle's own idea of its position by one step under water."""
    weight, before, since = min(1.0, VERTICAL_FILTER * step), software.path_speed, t - software.since
    sinking = (1.0 - weight) * software.vertical_speed + weight * (depth - software.depth_before) / step
    software.vertical_speed = sinking
    if depth < AFLOAT and V_b > 0.0:
        software.path_speed = 0.0
        return
    software.path_speed, V_h = path_speed(table, before, sinking, attitude.theta, V_b, since, step)
    north, east = V_h * math.cos(attitude.psi) * step, V_h * math.sin(attitude.psi) * step
    software.reckoned_north += north
    software.reckoned_east += east
    m_north, m_east = metres_per_radian(software.latitude)
    software.latitude += (north + software.current_north * step) / m_north
    software.longitude += (east + software.current_east * step) / m_east


@inlined
def surface(software: np.record, t: float, latitude: float, longitude: float) -> None:
    """Close the dive: how long it was, and how far off the reckoning ended from the true position."""
    software.surfaced_at, software.under_water = t, t - software.submerged_since
    north, east = to_waypoint(software.latitude, software.longitude, latitude, longitude)
    software.reckoning_error = math.hypot(north, east)
    software.first_fix_at = -1.0
    software.path_speed = 0.0


@inlined
def first_fix(software: np.record, t: float, latitude: float, longitude: float) -> None:
    """Remember the first position after surfacing."""
    software.first_fix_at, software.first_fix_latitude, software.first_fix_longitude = t, latitude, longitude


@inlined
def last_fix(software: np.record, t: float, latitude: float, longitude: float) -> float:
    """Take the last position before diving: drift, position of surfacing, depth-averaged current.

    Returns the time under water that the current was averaged over [s], zero where there was none.
    """
    since_first = t - software.first_fix_at
    m_north, m_east = metres_per_radian(latitude)
    drift_north = drift_east = 0.0
    if since_first > 0.0:
        drift_north = (latitude - software.first_fix_latitude) * m_north / since_first
        drift_east = wrapped(longitude - software.first_fix_longitude) * m_east / since_first
    afloat = software.first_fix_at - software.surfaced_at
    surfaced_latitude = software.first_fix_latitude - drift_north * afloat / m_north
    surfaced_longitude = software.first_fix_longitude - drift_east * afloat / m_east
    submerged: float = software.under_water
    if submerged > 0.0:
        found_north = (surfaced_latitude - software.submerged_latitude) * m_north
        found_east = wrapped(surfaced_longitude - software.submerged_longitude) * m_east
        software.current_north, software.current_east = depth_averaged_current(
            software.reckoned_north, software.reckoned_east, found_north, found_east, submerged
        )
    software.latitude, software.longitude = latitude, longitude
    software.submerged_latitude, software.submerged_longitude = latitude, longitude
    software.reckoned_north = software.reckoned_east = 0.0
    return submerged
