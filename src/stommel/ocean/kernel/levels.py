"""The column at the grid's own levels: interpolated in space and time, vectors turned to north and east (compiled)."""

from math import cos, sin

import numpy as np

from stommel.compilation import compiled, inlined
from stommel.ocean.kernel.cells import CellPoint, jacobian
from stommel.ocean.kernel.chart import PlanePoint
from stommel.ocean.kernel.grid import (
    CT,
    CT_ROW,
    EAST,
    EAST_ACCELERATION,
    EAST_RATE,
    NORTH,
    NORTH_ACCELERATION,
    NORTH_RATE,
    QUANTITIES,
    S_A,
    SALINITY,
    TEMPERATURE,
    U_X,
    U_Y,
    Nodes,
    T,
)

_TOO_LITTLE = 1e-3
"""Below this weight of nodes with water at a level, the level above is carried on: at the node without it, exactly."""


@inlined
def wet_weights(nodes: Nodes, at: CellPoint) -> tuple[tuple[float, float, float, float], float, float]:
    """Bilinear weights of the four nodes, how much of them has water, and the bottom over those."""
    j, i, u, v = at.j, at.i, at.u, at.v
    weights = ((1.0 - u) * (1.0 - v), u * (1.0 - v), (1.0 - u) * v, u * v)
    wet, bottom = 0.0, 0.0
    for corner in range(4):
        row, column = j + corner // 2, i + corner % 2
        if nodes.levels[row, column] > 0:
            wet += weights[corner]
            bottom += weights[corner] * nodes.bottom[row, column]
    return weights, wet, bottom / wet if wet > 0.0 else 0.0


@compiled
def cell_levels(
    nodes: Nodes,
    at: CellPoint,
    point: PlanePoint,
    weights: tuple[float, float, float, float],
    slot: tuple[int, int, float, float],
    out: np.ndarray,
) -> None:
    """Interpolate within a cell at every level of the grid, and turn the vectors to north and east."""
    first, second, share, span = slot
    water = nodes.water
    j, i = at.j, at.i
    wet = (nodes.levels[j, i], nodes.levels[j, i + 1], nodes.levels[j + 1, i], nodes.levels[j + 1, i + 1])
    for k in range(nodes.depths.size):
        total = 0.0
        for q in range(QUANTITIES):
            out[k, q] = 0.0
        for corner in range(4):
            if k < wet[corner]:
                w = weights[corner]
                row, column = j + corner // 2, i + corner % 2
                total += w
                a, b = water[first, row, column], water[second, row, column]
                out[k, TEMPERATURE] += w * _between(a[T, k], b[T, k], share)
                out[k, SALINITY] += w * _between(a[S_A, k], b[S_A, k], share)
                out[k, CT_ROW] += w * _between(a[CT, k], b[CT, k], share)
                out[k, NORTH] += w * _between(a[U_X, k], b[U_X, k], share)
                out[k, EAST] += w * _between(a[U_Y, k], b[U_Y, k], share)
                out[k, NORTH_RATE] += w * float(b[U_X, k] - a[U_X, k]) / span
                out[k, EAST_RATE] += w * float(b[U_Y, k] - a[U_Y, k]) / span
        if total > _TOO_LITTLE:
            for q in range(TEMPERATURE, NORTH_ACCELERATION):
                out[k, q] /= total
        elif k > 0:
            for q in range(TEMPERATURE, NORTH_ACCELERATION):
                out[k, q] = out[k - 1, q]
    _accelerate(nodes, at, point, slot, min(wet[0], wet[1], wet[2], wet[3]), out)
    _turn(point, out, NORTH)
    _turn(point, out, NORTH_RATE)
    _turn(point, out, NORTH_ACCELERATION)


@compiled
def _accelerate(
    nodes: Nodes, at: CellPoint, point: PlanePoint, slot: tuple[int, int, float, float], wet: int, out: np.ndarray
) -> None:
    """Acceleration of the water, dU/dt + (U . grad) U, along x and y; at levels that lack a node only dU/dt."""
    first, second, share, _ = slot
    j, i, u, v = at.j, at.i, at.u, at.v
    x_u, x_v, y_u, y_v = jacobian(nodes.x, nodes.y, j, i, u, v)
    determinant = x_u * y_v - x_v * y_u
    for k in range(nodes.depths.size):
        for axis in range(2):
            rate = out[k, NORTH_RATE + axis]
            if k < wet:
                c00 = _blend(nodes, first, second, share, j, i, U_X + axis, k)
                c01 = _blend(nodes, first, second, share, j, i + 1, U_X + axis, k)
                c10 = _blend(nodes, first, second, share, j + 1, i, U_X + axis, k)
                c11 = _blend(nodes, first, second, share, j + 1, i + 1, U_X + axis, k)
                a_u = (1.0 - v) * (c01 - c00) + v * (c11 - c10)
                a_v = (1.0 - u) * (c10 - c00) + u * (c11 - c01)
                a_x = (a_u * y_v - a_v * y_u) / determinant
                a_y = (a_v * x_u - a_u * x_v) / determinant
                rate += point.scale * (out[k, NORTH] * a_x + out[k, EAST] * a_y)
            out[k, NORTH_ACCELERATION + axis] = rate


@inlined
def _blend(nodes: Nodes, first: int, second: int, share: float, j: int, i: int, field: int, k: int) -> float:
    a, b = nodes.water[first, j, i, field, k], nodes.water[second, j, i, field, k]
    return _between(a, b, share)


@inlined
def _between(a: np.float32, b: np.float32, share: float) -> float:
    """Value between those of two times, in double precision; plain Python would go on in that of the grid."""
    return float(a) + share * float(b - a)


@inlined
def _turn(point: PlanePoint, out: np.ndarray, row: int) -> None:
    """Turn the rows (x, y) at `row` to (north, east)."""
    for k in range(out.shape[0]):
        x, y = out[k, row], out[k, row + 1]
        out[k, row] = x * point.north_x + y * point.north_y
        out[k, row + 1] = x * point.north_y - y * point.north_x


@compiled
def single_levels(nodes: Nodes, slot: tuple[int, int, float, float], out: np.ndarray) -> None:
    """Levels of an ocean that is the same everywhere; its vectors are (east, north)."""
    first, second, share, span = slot
    for k in range(nodes.depths.size):
        out[k, TEMPERATURE] = _blend(nodes, first, second, share, 0, 0, T, k)
        out[k, SALINITY] = _blend(nodes, first, second, share, 0, 0, S_A, k)
        out[k, CT_ROW] = _blend(nodes, first, second, share, 0, 0, CT, k)
        out[k, EAST] = _blend(nodes, first, second, share, 0, 0, U_X, k)
        out[k, NORTH] = _blend(nodes, first, second, share, 0, 0, U_Y, k)
        out[k, EAST_RATE] = float(nodes.water[second, 0, 0, U_X, k] - nodes.water[first, 0, 0, U_X, k]) / span
        out[k, NORTH_RATE] = float(nodes.water[second, 0, 0, U_Y, k] - nodes.water[first, 0, 0, U_Y, k]) / span
        out[k, NORTH_ACCELERATION] = out[k, NORTH_RATE]
        out[k, EAST_ACCELERATION] = out[k, EAST_RATE]


@inlined
def _tide(nodes: Nodes, n: int, j: int, i: int) -> tuple[float, float, float, float]:
    """One constituent at a node, in double precision."""
    a = nodes.tide[n, j, i]
    return float(a[0]), float(a[1]), float(a[2]), float(a[3])


@inlined
def _add_current(out: np.ndarray, north: float, east: float, north_rate: float, east_rate: float) -> None:
    for k in range(out.shape[0]):
        out[k, NORTH] += north
        out[k, EAST] += east
        out[k, NORTH_RATE] += north_rate
        out[k, EAST_RATE] += east_rate
        out[k, NORTH_ACCELERATION] += north_rate
        out[k, EAST_ACCELERATION] += east_rate


@compiled
def add_single_tide(nodes: Nodes, time: float, out: np.ndarray) -> None:
    """Add the tides of an ocean that is the same everywhere."""
    for n in range(nodes.tide_speed.size):
        omega = nodes.tide_speed[n]
        c, s = cos(omega * time), sin(omega * time)
        a = _tide(nodes, n, 0, 0)
        _add_current(
            out,
            a[2] * c + a[3] * s,
            a[0] * c + a[1] * s,
            omega * (a[3] * c - a[2] * s),
            omega * (a[1] * c - a[0] * s),
        )


@compiled
def add_tide(
    nodes: Nodes,
    at: CellPoint,
    point: PlanePoint,
    weights: tuple[float, float, float, float],
    time: float,
    out: np.ndarray,
) -> None:
    """Add the tides of the cell; nodes on land have none, and no share of the weight."""
    for n in range(nodes.tide_speed.size):
        omega = nodes.tide_speed[n]
        c, s = cos(omega * time), sin(omega * time)
        total, x, y, x_rate, y_rate = 0.0, 0.0, 0.0, 0.0, 0.0
        for corner in range(4):
            row, column = at.j + corner // 2, at.i + corner % 2
            if nodes.levels[row, column] > 0:
                w = weights[corner]
                a = _tide(nodes, n, row, column)
                total += w
                x += w * (a[0] * c + a[1] * s)
                y += w * (a[2] * c + a[3] * s)
                x_rate += w * omega * (a[1] * c - a[0] * s)
                y_rate += w * omega * (a[3] * c - a[2] * s)
        _add_current(
            out,
            (x * point.north_x + y * point.north_y) / total,
            (x * point.north_y - y * point.north_x) / total,
            (x_rate * point.north_x + y_rate * point.north_y) / total,
            (x_rate * point.north_y - y_rate * point.north_x) / total,
        )
