"""Where the vehicle thinks it is between two positions, and what the difference says of the current (compiled).

In an established glide the horizontal speed through the water follows from what a glider measures: its vertical speed,
its pitch, and the angle of attack that the flight table gives for them. V_h = |z'| / tan|theta - alpha| is exact in
steady flight. Before that, while it gathers way or turns, its speed along the path follows from drag and mass, V' = k
(V_s^2 - V^2), towards the flight table's V_s, or towards rest while pitch and buoyancy disagree.
"""

import math

from stommel.compilation import compiled
from stommel.control.flight_table import FlightTable, look_up

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
