"""Which cell of a curvilinear grid holds a point of the plane, and where in it (compiled).

A cell is the bilinear image of the unit square between nodes (j, i) and (j + 1, i + 1). Newton's method on that map
walks from the last cell to the next; a search over all cells answers where the walk does not.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from stommel.compilation import compiled, inlined

_NEWTON_STEPS = 12
_CLOSE = 1e-12
_EDGE = 1e-9
"""A point this little outside a cell, in cell widths, is on its edge."""
_FAR = 1e6


class CellPoint(NamedTuple):
    """A point in a cell; u runs along i and v along j, both from 0 to 1 inside."""

    j: int
    i: int
    u: float
    v: float
    inside: bool


@inlined
def jacobian(
    x: NDArray[np.float64], y: NDArray[np.float64], j: int, i: int, u: float, v: float
) -> tuple[float, float, float, float]:
    """Derivatives x_u, x_v, y_u, y_v of the bilinear map of a cell."""
    x_u = (1.0 - v) * (x[j, i + 1] - x[j, i]) + v * (x[j + 1, i + 1] - x[j + 1, i])
    x_v = (1.0 - u) * (x[j + 1, i] - x[j, i]) + u * (x[j + 1, i + 1] - x[j, i + 1])
    y_u = (1.0 - v) * (y[j, i + 1] - y[j, i]) + v * (y[j + 1, i + 1] - y[j + 1, i])
    y_v = (1.0 - u) * (y[j + 1, i] - y[j, i]) + u * (y[j + 1, i + 1] - y[j, i + 1])
    return x_u, x_v, y_u, y_v


@inlined
def mapped(a: NDArray[np.float64], j: int, i: int, u: float, v: float) -> float:
    """Bilinear value of a node array at (u, v) of a cell."""
    value: float = (1.0 - v) * ((1.0 - u) * a[j, i] + u * a[j, i + 1]) + v * (
        (1.0 - u) * a[j + 1, i] + u * a[j + 1, i + 1]
    )
    return value


@inlined
def _solve(x: NDArray[np.float64], y: NDArray[np.float64], j: int, i: int, px: float, py: float) -> tuple[float, float]:
    """Coordinates (u, v) of a point in the bilinear map of a cell; far outside where there are none."""
    u, v = 0.5, 0.5
    for _ in range(_NEWTON_STEPS):
        x_u, x_v, y_u, y_v = jacobian(x, y, j, i, u, v)
        determinant = x_u * y_v - x_v * y_u
        if determinant == 0.0:
            return _FAR, _FAR
        rx, ry = px - mapped(x, j, i, u, v), py - mapped(y, j, i, u, v)
        du, dv = (y_v * rx - x_v * ry) / determinant, (x_u * ry - y_u * rx) / determinant
        u, v = u + du, v + dv
        if abs(du) + abs(dv) < _CLOSE:
            break
        if not abs(u) + abs(v) < _FAR:
            return _FAR, _FAR
    return u, v


@inlined
def _within(u: float, v: float) -> bool:
    return -_EDGE <= u <= 1.0 + _EDGE and -_EDGE <= v <= 1.0 + _EDGE


@inlined
def _unit(a: float) -> float:
    return min(max(a, 0.0), 1.0)


@inlined
def _hop(a: float) -> int:
    """Cells to move for a coordinate outside 0 to 1, as the map of this cell guesses it; at most 64."""
    return int(np.floor(min(max(a, -64.0), 64.0)))


@compiled
def find_cell(
    x: NDArray[np.float64], y: NDArray[np.float64], px: float, py: float, cell: NDArray[np.int64]
) -> CellPoint:
    """Find the cell of a point, beginning with `cell` (j, i), which becomes the cell found.

    Outside the grid, the nearest point of its edge is returned with `inside` false.
    """
    rows, columns = x.shape[0] - 1, x.shape[1] - 1
    j, i = min(max(cell[0], 0), rows - 1), min(max(cell[1], 0), columns - 1)
    for _ in range(rows + columns):
        u, v = _solve(x, y, j, i, px, py)
        if _within(u, v):
            cell[0], cell[1] = j, i
            return CellPoint(j, i, _unit(u), _unit(v), True)
        next_j, next_i = min(max(j + _hop(v), 0), rows - 1), min(max(i + _hop(u), 0), columns - 1)
        if next_j == j and next_i == i:
            break
        j, i = next_j, next_i
    return _search(x, y, px, py, cell)


@compiled
def _search(x: NDArray[np.float64], y: NDArray[np.float64], px: float, py: float, cell: NDArray[np.int64]) -> CellPoint:
    """Search every cell whose box holds the point; else the nearest point of the edge."""
    for j in range(x.shape[0] - 1):
        for i in range(x.shape[1] - 1):
            x_low, x_high = (
                min(x[j, i], x[j, i + 1], x[j + 1, i], x[j + 1, i + 1]),
                max(x[j, i], x[j, i + 1], x[j + 1, i], x[j + 1, i + 1]),
            )
            y_low, y_high = (
                min(y[j, i], y[j, i + 1], y[j + 1, i], y[j + 1, i + 1]),
                max(y[j, i], y[j, i + 1], y[j + 1, i], y[j + 1, i + 1]),
            )
            room = _EDGE * (x_high - x_low + y_high - y_low)
            if x_low - room <= px <= x_high + room and y_low - room <= py <= y_high + room:
                u, v = _solve(x, y, j, i, px, py)
                if _within(u, v):
                    cell[0], cell[1] = j, i
                    return CellPoint(j, i, _unit(u), _unit(v), True)
    return _nearest_on_edge(x, y, px, py, cell)


@compiled
def _nearest_on_edge(
    x: NDArray[np.float64], y: NDArray[np.float64], px: float, py: float, cell: NDArray[np.int64]
) -> CellPoint:
    rows, columns = x.shape[0] - 1, x.shape[1] - 1
    best, found = np.inf, CellPoint(0, 0, 0.0, 0.0, False)
    for i in range(columns):
        for j, v in ((0, 0.0), (rows - 1, 1.0)):
            row = j if v == 0.0 else j + 1
            distance, u = _to_segment(px, py, x[row, i], y[row, i], x[row, i + 1], y[row, i + 1])
            if distance < best:
                best, found = distance, CellPoint(j, i, u, v, False)
    for j in range(rows):
        for i, u in ((0, 0.0), (columns - 1, 1.0)):
            column = i if u == 0.0 else i + 1
            distance, v = _to_segment(px, py, x[j, column], y[j, column], x[j + 1, column], y[j + 1, column])
            if distance < best:
                best, found = distance, CellPoint(j, i, u, v, False)
    cell[0], cell[1] = found.j, found.i
    return found


@inlined
def _to_segment(px: float, py: float, ax: float, ay: float, bx: float, by: float) -> tuple[float, float]:
    """Square of the distance to a segment, and the share of it at which the nearest point lies."""
    dx, dy = bx - ax, by - ay
    share = _unit(((px - ax) * dx + (py - ay) * dy) / max(dx * dx + dy * dy, 1e-300))
    ex, ey = ax + share * dx - px, ay + share * dy - py
    return ex * ex + ey * ey, share
