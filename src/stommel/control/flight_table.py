"""What the flight software needs to know of the model: the trim, as a table over pitch and ballast volume.

The trim solver writes it (`stommel.analysis.flight_table`); the vehicle and the simulator read it. Between its points
it is bilinear; beyond them the nearest edge holds.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from stommel.compilation import compiled, inlined


class FlightTable(NamedTuple):
    """Wings-level flights over a grid of pitch and of the magnitude of ballast volume, diving and climbing."""

    theta: NDArray[np.float64]
    """Pitch magnitudes [rad], in even steps (n)."""
    V_b: NDArray[np.float64]
    """Ballast-volume magnitudes [m3], in even steps (m)."""
    r_px: NDArray[np.float64]
    """Moving-mass position [m] of the dive (0) and the climb (1) (2 x n x m)."""
    alpha: NDArray[np.float64]
    """Angle of attack [rad] (2 x n x m)."""
    speed: NDArray[np.float64]
    """Speed along the path [m/s] (2 x n x m)."""
    turn_pole: NDArray[np.float64]
    """Slowest lateral mode [1/s], negative where it dies out (2 x n x m)."""
    turn_drive: NDArray[np.float64]
    """Slow turning answers the steering by r' = pole r + drive times its angle [1/s2] (2 x n x m)."""
    drag_per_mass: float
    """Drag coefficient over the mass that the vehicle must speed up, its water included [1/m]."""


@inlined
def _place(grid: np.ndarray, value: float) -> tuple[int, float]:
    """Cell and share within it of `value` in an even grid; the ends hold."""
    last = len(grid) - 1
    position = (value - grid[0]) / (grid[1] - grid[0])
    position = min(float(last), max(0.0, position))
    k = min(int(position), last - 1)
    return k, position - k


@inlined
def _bilinear(values: np.ndarray, i: int, s: float, j: int, t: float) -> float:
    low: float = (1.0 - t) * values[i, j] + t * values[i, j + 1]
    high: float = (1.0 - t) * values[i + 1, j] + t * values[i + 1, j + 1]
    return (1.0 - s) * low + s * high


@compiled
def look_up(table: FlightTable, theta: float, V_b: float) -> tuple[float, float, float]:
    """Moving-mass position [m], angle of attack [rad] and speed [m/s] at pitch `theta` [rad] and ballast `V_b` [m3].

    A negative `V_b` dives, a positive one climbs; the magnitude of the pitch counts.
    """
    way = 0 if V_b <= 0.0 else 1
    i, s = _place(table.theta, abs(theta))
    j, t = _place(table.V_b, abs(V_b))
    return (
        _bilinear(table.r_px[way], i, s, j, t),
        _bilinear(table.alpha[way], i, s, j, t),
        _bilinear(table.speed[way], i, s, j, t),
    )


@compiled
def look_up_turning(table: FlightTable, theta: float, V_b: float) -> tuple[float, float]:
    """Pole [1/s] and drive [1/s2] of slow turning at pitch `theta` [rad] and ballast `V_b` [m3]."""
    way = 0 if V_b <= 0.0 else 1
    i, s = _place(table.theta, abs(theta))
    j, t = _place(table.V_b, abs(V_b))
    return _bilinear(table.turn_pole[way], i, s, j, t), _bilinear(table.turn_drive[way], i, s, j, t)
