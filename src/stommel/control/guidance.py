"""Guidance: where to head, and what the current is doing (compiled)."""

import math

from stommel.compilation import compiled


@compiled
def course_to_steer(
    north: float,
    east: float,
    line_north: float,
    line_east: float,
    lookahead: float,
    U: tuple[float, float],
    speed: float,
) -> float:
    """Heading [rad] that takes the vehicle to the goal along its line, through a known current.

    Parameters
    ----------
    north, east
        From the vehicle to the goal [m].
    line_north, line_east
        From the start of the line to the goal [m]; zero for no line.
    lookahead
        How far ahead on the line to aim [m].
    U
        Current, north and east [m/s].
    speed
        Horizontal speed through the water [m/s].
    """
    aim_north, aim_east = north, east
    length = math.hypot(line_north, line_east)
    if length > 0.0:
        along = (north * line_north + east * line_east) / length
        ahead = max(0.0, along - lookahead)
        aim_north, aim_east = north - ahead * line_north / length, east - ahead * line_east / length
    course = math.atan2(aim_east, aim_north)
    # crab into the part of the current across the course; stronger than the vehicle, the best is straight across it
    across = -U[0] * math.sin(course) + U[1] * math.cos(course)
    crab = math.asin(max(-0.99, min(0.99, across / max(speed, 1e-3))))
    return course - crab
