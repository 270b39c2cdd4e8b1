"""The ellipsoid WGS 84: metres of a degree, and the way between places near each other (compiled)."""

import math

from stommel.compilation import compiled, inlined
from stommel.geometry.attitude import wrapped

SEMI_MAJOR, FLATTENING = 6378137.0, 1.0 / 298.257223563
"""WGS 84."""

MEAN_RADIUS = 6.371e6
"""Of the sphere that is good enough for bounds, faults and pictures [m]."""


@inlined
def metres_per_radian(latitude: float) -> tuple[float, float]:
    """North and east metres per radian of latitude and longitude on the WGS 84 ellipsoid, at `latitude` [rad]."""
    e2 = FLATTENING * (2.0 - FLATTENING)
    w = 1.0 - e2 * math.sin(latitude) ** 2
    N = SEMI_MAJOR / math.sqrt(w)
    return N * (1.0 - e2) / w, N * math.cos(latitude)


@compiled
def to_waypoint(latitude: float, longitude: float, goal_latitude: float, goal_longitude: float) -> tuple[float, float]:
    """North and east metres to a waypoint, on the ellipsoid at mid latitude; good to 1e-4 within 100 km."""
    m_north, m_east = metres_per_radian(0.5 * (latitude + goal_latitude))
    return (goal_latitude - latitude) * m_north, wrapped(goal_longitude - longitude) * m_east
