"""Where the vehicle thinks it is between two positions, and what the difference says of the current (compiled).

In an established glide the horizontal speed through the water follows from what a glider measures: its vertical speed,
its pitch, and the angle of attack that the flight table gives for them. V_h = |z'| / tan|theta - alpha| is exact in
steady flight. Before that, while it gathers way or turns, its speed along the path follows from drag and mass, V' = k
(V_s^2 - V^2), towards the flight table's V_s, or towards rest while pitch and buoyancy disagree.
"""

import math

import numpy as np

from stommel.compilation import compiled, inlined
from stommel.control.dive_cycle import DRIFT
from stommel.control.flight_table import FlightTable, look_up
from stommel.control.readings import Readings
from stommel.geometry.attitude import wrapped
from stommel.geometry.earth import metres_per_radian

VERTICAL_FILTER = 0.1
"""Weight of a new depth difference in the vertical speed, per decision of one second."""

DRIFT_TIME = 60.0
"""Time between two positions that tell how the surface drifts [s]; the errors of both are over it."""

AFLOAT = 0.5
"""A buoyant vehicle no deeper than this lies on the water and makes no way through it [m]."""

_STEEP_ENOUGH = math.radians(8.0)
_SETTLED = 60.0
"""A glide counts as established on steeper paths, so long after the last change of phase [s]."""


@compiled
def path_speed(
    table: FlightTable, before: float, vertical_speed: float, theta: float, V_b: float, since: float, step: float
) -> tuple[float, float]:
    """Speed along the path and horizontal speed through the water [m/s].

    Parameters
    ----------
    table
        Flight table.
    before
        Speed along the path one step ago [m/s].
    vertical_speed
        Measured, positive down [m/s].
    theta
        Measured pitch [rad].
    V_b
        Measured ballast volume [m3].
    since
        Time since the phase of the dive changed [s].
    step
        Time since `before` [s].
    """
    _, alpha, settled_speed = look_up(table, theta, V_b)
    gamma = theta - alpha
    agree = theta * V_b > 0.0
    if since > _SETTLED and agree and abs(gamma) > _STEEP_ENOUGH and gamma * vertical_speed < 0.0:
        V = abs(vertical_speed / math.sin(gamma))
        return V, V * abs(math.cos(gamma))
    goal = settled_speed if agree else 0.0
    V = max(0.0, before + step * table.drag_per_mass * (goal * goal - before * before))
    return V, V * abs(math.cos(gamma))


@compiled
def depth_averaged_current(
    reckoned_north: float, reckoned_east: float, found_north: float, found_east: float, submerged: float
) -> tuple[float, float]:
    """Depth-averaged current, north and east [m/s].

    Parameters
    ----------
    reckoned_north, reckoned_east
        Displacement by dead reckoning through the water between submerging and surfacing [m].
    found_north, found_east
        Displacement between the positions of submerging and surfacing [m].
    submerged
        Time between them [s].
    """
    if submerged <= 0.0:
        return 0.0, 0.0
    return (found_north - reckoned_north) / submerged, (found_east - reckoned_east) / submerged


@inlined
def reckon(memory: np.record, table: FlightTable, readings: Readings, t: float, step: float) -> None:
    """Move the vehicle's own idea of its position by one step under water."""
    depth, theta, psi, V_b = readings.depth, readings.theta, readings.psi, readings.V_b
    weight, before, since = min(1.0, VERTICAL_FILTER * step), memory.path_speed, t - memory.since
    sinking = (1.0 - weight) * memory.vertical_speed + weight * (depth - memory.depth_before) / step
    memory.vertical_speed = sinking
    if memory.phase == DRIFT:
        V_b = 0.0  # no glide to hold: the way it still has runs out
    if depth < AFLOAT and V_b > 0.0:
        memory.path_speed = V_h = 0.0  # the water alone carries it
    else:
        memory.path_speed, V_h = path_speed(table, before, sinking, theta, V_b, since, step)
    north, east = V_h * math.cos(psi) * step, V_h * math.sin(psi) * step
    memory.reckoned_north += north
    memory.reckoned_east += east
    memory.latitude += (north + memory.current_north * step) / memory.metres_north
    memory.longitude += (east + memory.current_east * step) / memory.metres_east


@inlined
def surface(memory: np.record, t: float) -> None:
    """Close the dive, and wait for a position."""
    memory.surfaced_at = t
    memory.under_water += t - memory.submerged_since
    memory.first_fix_at = -1.0
    memory.path_speed = 0.0


@inlined
def take_fix(memory: np.record, t: float, latitude: float, longitude: float) -> None:
    """Take a position from GPS: remember the first since surfacing and the last."""
    if memory.first_fix_at < 0.0:
        memory.first_fix_at, memory.first_fix_latitude, memory.first_fix_longitude = t, latitude, longitude
    memory.fix_at, memory.fix_latitude, memory.fix_longitude = t, latitude, longitude


@inlined
def leave_surface(memory: np.record, t: float) -> None:
    """Begin a dive where drift has carried the last position: drift, place of surfacing, depth-averaged current.

    `averaged_over` becomes the time under water that the current is the mean of [s], zero where there was none. Without
    any position the reckoning goes on from the dive before, and the current waits for the next one: meanwhile the water
    has carried the vehicle at the surface too.
    """
    memory.averaged_over = 0.0
    if memory.first_fix_at < 0.0:
        waited = t - memory.surfaced_at
        memory.adrift += waited
        memory.latitude += memory.current_north * waited / memory.metres_north
        memory.longitude = wrapped(memory.longitude + memory.current_east * waited / memory.metres_east)
        return
    between = memory.fix_at - memory.first_fix_at
    m_north, m_east = metres_per_radian(memory.fix_latitude)
    # positions close together do not tell the drift: it is then that of the dives before
    drift_north, drift_east = memory.current_north, memory.current_east
    if between >= DRIFT_TIME:
        drift_north = (memory.fix_latitude - memory.first_fix_latitude) * m_north / between
        drift_east = wrapped(memory.fix_longitude - memory.first_fix_longitude) * m_east / between
    afloat = memory.first_fix_at - memory.surfaced_at
    surfaced_latitude = memory.first_fix_latitude - drift_north * afloat / m_north
    surfaced_longitude = memory.first_fix_longitude - drift_east * afloat / m_east
    memory.averaged_over = memory.under_water
    if memory.under_water > 0.0:
        found_north = (surfaced_latitude - memory.submerged_latitude) * m_north
        found_east = wrapped(surfaced_longitude - memory.submerged_longitude) * m_east
        memory.current_north, memory.current_east = depth_averaged_current(
            memory.reckoned_north,
            memory.reckoned_east,
            found_north,
            found_east,
            memory.under_water + memory.adrift,
        )
    since = t - memory.fix_at
    memory.latitude = memory.fix_latitude + drift_north * since / m_north
    memory.longitude = wrapped(memory.fix_longitude + drift_east * since / m_east)
    memory.submerged_latitude, memory.submerged_longitude = memory.latitude, memory.longitude
    memory.reckoned_north = memory.reckoned_east = memory.under_water = memory.adrift = 0.0
