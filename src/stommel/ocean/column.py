"""From the grid to one column of water, and from the column to the water at the vehicle (compiled).

Between nodes: linear in time, bilinear in space over the nodes that have water at the level, linear in depth. At a
node the node's values come out.
"""

from math import cos, sin

import numpy as np

from stommel.compilation import compiled, inlined
from stommel.dynamics.state import Water
from stommel.ocean.cells import CellPoint, find_cell, jacobian
from stommel.ocean.chart import PlanePoint, project
from stommel.ocean.grid import (
    BOTTOM,
    CT,
    CT_ROW,
    EAST,
    EAST_ACCELERATION,
    EAST_RATE,
    ERROR,
    GRAVITY,
    HELD,
    HOLD,
    LAND,
    LATITUDE,
    LONGITUDE,
    NORTH,
    NORTH_ACCELERATION,
    NORTH_RATE,
    OK,
    OUTSIDE_SPACE,
    OUTSIDE_TIME,
    QUANTITIES,
    RHO,
    S_A,
    SALINITY,
    TEMPERATURE,
    TIME,
    U_X,
    U_Y,
    Column,
    OceanGrid,
    P,
    T,
)
from stommel.seawater.table import DensityTable, density

PASCAL_PER_DECIBAR = 1.0e4
GRAVITY_PER_METRE = 2.26e-7
"""Relative growth of gravity with depth, as in gsw.grav [1/m]."""
_SHORE = 0.5 - 1e-9
"""A place is on land where the nodes with water have less than half of the weight."""


@compiled
def fill_column(
    grid: OceanGrid,
    table: DensityTable,
    time: float,
    latitude: float,
    longitude: float,
    cell: np.ndarray,
    column: Column,
) -> int:
    """Fill `column` with the water at a place and time; nothing is allocated.

    Parameters
    ----------
    grid
        The ocean.
    table
        Density over the ocean's range.
    time
        [s since 1970-01-01 UTC]
    latitude, longitude
        Geodetic [rad].
    cell
        Memory of the last cell, from `new_cell`; one for each vehicle.
    column
        From `new_column` of the same grid.

    Returns
    -------
    int
        OK or HELD: the column is filled. OUTSIDE_SPACE, OUTSIDE_TIME or LAND: it is unchanged.
    """
    status, first, second, share = _time_slot(grid, time)
    if status > HELD:
        return status
    span = grid.times[second] - grid.times[first] if second > first and second < grid.times.size else np.inf
    if grid.x.size == 1:
        _single_levels(grid, first, second, share, span, column.levels)
        _add_single_tide(grid, time, column.levels)
        bottom = grid.bottom[0, 0]
    else:
        point = project(grid.chart, latitude, longitude)
        at = find_cell(grid.x, grid.y, point.x, point.y, cell)
        if not at.inside:
            if grid.outside_space == ERROR:
                return OUTSIDE_SPACE
            status = HELD
        if at.inside or grid.outside_space == HOLD:
            weights, wet, bottom = _wet_weights(grid, at)
            if wet < _SHORE:
                return LAND
            _cell_levels(grid, at, point, weights, (first, second, share, span), column.levels)
            _add_tide(grid, at, point, weights, time, column.levels)
        else:
            _mean_levels(grid, column.levels)
            bottom = grid.mean_bottom
    place = column.place
    place[BOTTOM], place[TIME], place[LATITUDE], place[LONGITUDE] = bottom, time, latitude, longitude
    place[GRAVITY] = gravity(latitude)
    # arrays, not the grid: as one tuple, all of its arrays would be counted in and out at every depth
    _spread(grid.depths, grid.profile_depths, grid.profile_rho, table, column)
    return status


@inlined
def gravity(latitude: float) -> float:
    """Gravity at the sea surface [m/s2], Moritz (2000) as in gsw.grav; latitude in rad."""
    square = sin(latitude) ** 2
    return 9.780327 * (1.0 + (5.2792e-3 + 2.32e-5 * square) * square)


@compiled
def _time_slot(grid: OceanGrid, time: float) -> tuple[int, int, int, float]:
    """Status, the two slots around a time, and the share of the second."""
    last = grid.times.size - 1
    if not grid.time_range[0] <= time <= grid.time_range[1]:
        if grid.outside_time == ERROR:
            return OUTSIDE_TIME, 0, 0, 0.0
        if grid.outside_time == HOLD:
            slot = 0 if time < grid.time_range[0] else last
            return HELD, slot, slot, 0.0
        return HELD, last + 1, last + 1, 0.0
    if time <= grid.times[0]:
        return OK, 0, 0, 0.0
    if time >= grid.times[last]:
        return OK, last, last, 0.0
    first = min(int(np.searchsorted(grid.times, time, side="right")) - 1, last - 1)
    share = (time - grid.times[first]) / (grid.times[first + 1] - grid.times[first])
    return OK, first, first + 1, share


@inlined
def _wet_weights(grid: OceanGrid, at: CellPoint) -> tuple[tuple[float, float, float, float], float, float]:
    """Bilinear weights of the four nodes, how much of them has water, and the bottom over those."""
    j, i, u, v = at.j, at.i, at.u, at.v
    weights = ((1.0 - u) * (1.0 - v), u * (1.0 - v), (1.0 - u) * v, u * v)
    wet, bottom = 0.0, 0.0
    for corner in range(4):
        row, column = j + corner // 2, i + corner % 2
        if grid.levels[row, column] > 0:
            wet += weights[corner]
            bottom += weights[corner] * grid.bottom[row, column]
    return weights, wet, bottom / wet if wet > 0.0 else 0.0


@compiled
def _cell_levels(
    grid: OceanGrid,
    at: CellPoint,
    point: PlanePoint,
    weights: tuple[float, float, float, float],
    slot: tuple[int, int, float, float],
    out: np.ndarray,
) -> None:
    """Interpolate within a cell at every level of the grid, and turn the vectors to north and east."""
    first, second, share, span = slot
    water = grid.water
    j, i = at.j, at.i
    wet = (grid.levels[j, i], grid.levels[j, i + 1], grid.levels[j + 1, i], grid.levels[j + 1, i + 1])
    for k in range(grid.depths.size):
        total = 0.0
        for q in range(QUANTITIES):
            out[k, q] = 0.0
        for corner in range(4):
            if k < wet[corner]:
                w = weights[corner]
                row, column = j + corner // 2, i + corner % 2
                total += w
                a, b = water[first, row, column], water[second, row, column]
                out[k, TEMPERATURE] += w * (a[T, k] + share * (b[T, k] - a[T, k]))
                out[k, SALINITY] += w * (a[S_A, k] + share * (b[S_A, k] - a[S_A, k]))
                out[k, CT_ROW] += w * (a[CT, k] + share * (b[CT, k] - a[CT, k]))
                out[k, NORTH] += w * (a[U_X, k] + share * (b[U_X, k] - a[U_X, k]))
                out[k, EAST] += w * (a[U_Y, k] + share * (b[U_Y, k] - a[U_Y, k]))
                out[k, NORTH_RATE] += w * (b[U_X, k] - a[U_X, k]) / span
                out[k, EAST_RATE] += w * (b[U_Y, k] - a[U_Y, k]) / span
        if total > 0.0:
            for q in range(TEMPERATURE, NORTH_ACCELERATION):
                out[k, q] /= total
        elif k > 0:
            for q in range(TEMPERATURE, NORTH_ACCELERATION):
                out[k, q] = out[k - 1, q]
    _accelerate(grid, at, point, slot, min(wet[0], wet[1], wet[2], wet[3]), out)
    _turn(point, out, NORTH)
    _turn(point, out, NORTH_RATE)
    _turn(point, out, NORTH_ACCELERATION)


@compiled
def _accelerate(
    grid: OceanGrid, at: CellPoint, point: PlanePoint, slot: tuple[int, int, float, float], wet: int, out: np.ndarray
) -> None:
    """Acceleration of the water, dU/dt + (U . grad) U, along x and y; at levels that lack a node only dU/dt."""
    first, second, share, _ = slot
    j, i, u, v = at.j, at.i, at.u, at.v
    x_u, x_v, y_u, y_v = jacobian(grid.x, grid.y, j, i, u, v)
    determinant = x_u * y_v - x_v * y_u
    for k in range(grid.depths.size):
        for axis in range(2):
            rate = out[k, NORTH_RATE + axis]
            if k < wet:
                c00 = _blend(grid, first, second, share, j, i, U_X + axis, k)
                c01 = _blend(grid, first, second, share, j, i + 1, U_X + axis, k)
                c10 = _blend(grid, first, second, share, j + 1, i, U_X + axis, k)
                c11 = _blend(grid, first, second, share, j + 1, i + 1, U_X + axis, k)
                a_u = (1.0 - v) * (c01 - c00) + v * (c11 - c10)
                a_v = (1.0 - u) * (c10 - c00) + u * (c11 - c01)
                a_x = (a_u * y_v - a_v * y_u) / determinant
                a_y = (a_v * x_u - a_u * x_v) / determinant
                rate += point.scale * (out[k, NORTH] * a_x + out[k, EAST] * a_y)
            out[k, NORTH_ACCELERATION + axis] = rate


@inlined
def _blend(grid: OceanGrid, first: int, second: int, share: float, j: int, i: int, field: int, k: int) -> float:
    a, b = grid.water[first, j, i, field, k], grid.water[second, j, i, field, k]
    blend: float = a + share * (b - a)
    return blend


@inlined
def _turn(point: PlanePoint, out: np.ndarray, row: int) -> None:
    """Turn the rows (x, y) at `row` to (north, east)."""
    for k in range(out.shape[0]):
        x, y = out[k, row], out[k, row + 1]
        out[k, row] = x * point.north_x + y * point.north_y
        out[k, row + 1] = x * point.north_y - y * point.north_x


@compiled
def _single_levels(grid: OceanGrid, first: int, second: int, share: float, span: float, out: np.ndarray) -> None:
    """Levels of an ocean that is the same everywhere; its vectors are (east, north)."""
    for k in range(grid.depths.size):
        out[k, TEMPERATURE] = _blend(grid, first, second, share, 0, 0, T, k)
        out[k, SALINITY] = _blend(grid, first, second, share, 0, 0, S_A, k)
        out[k, CT_ROW] = _blend(grid, first, second, share, 0, 0, CT, k)
        out[k, EAST] = _blend(grid, first, second, share, 0, 0, U_X, k)
        out[k, NORTH] = _blend(grid, first, second, share, 0, 0, U_Y, k)
        out[k, EAST_RATE] = (grid.water[second, 0, 0, U_X, k] - grid.water[first, 0, 0, U_X, k]) / span
        out[k, NORTH_RATE] = (grid.water[second, 0, 0, U_Y, k] - grid.water[first, 0, 0, U_Y, k]) / span
        out[k, NORTH_ACCELERATION] = out[k, NORTH_RATE]
        out[k, EAST_ACCELERATION] = out[k, EAST_RATE]


@compiled
def _mean_levels(grid: OceanGrid, out: np.ndarray) -> None:
    for k in range(grid.depths.size):
        out[k, TEMPERATURE] = grid.mean_water[T, k]
        out[k, SALINITY] = grid.mean_water[S_A, k]
        out[k, CT_ROW] = grid.mean_water[CT, k]
        out[k, EAST] = grid.mean_water[U_X, k]
        out[k, NORTH] = grid.mean_water[U_Y, k]
        for q in range(NORTH_RATE, QUANTITIES):
            out[k, q] = 0.0


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
def _add_single_tide(grid: OceanGrid, time: float, out: np.ndarray) -> None:
    for n in range(grid.tide_speed.size):
        omega = grid.tide_speed[n]
        c, s = cos(omega * time), sin(omega * time)
        a = grid.tide[n, 0, 0]
        _add_current(
            out,
            a[2] * c + a[3] * s,
            a[0] * c + a[1] * s,
            omega * (a[3] * c - a[2] * s),
            omega * (a[1] * c - a[0] * s),
        )


@compiled
def _add_tide(
    grid: OceanGrid,
    at: CellPoint,
    point: PlanePoint,
    weights: tuple[float, float, float, float],
    time: float,
    out: np.ndarray,
) -> None:
    """Add the tides of the cell; nodes on land have none, and no share of the weight."""
    for n in range(grid.tide_speed.size):
        omega = grid.tide_speed[n]
        c, s = cos(omega * time), sin(omega * time)
        total, x, y, x_rate, y_rate = 0.0, 0.0, 0.0, 0.0, 0.0
        for corner in range(4):
            row, column = at.j + corner // 2, at.i + corner % 2
            if grid.levels[row, column] > 0:
                w = weights[corner]
                a = grid.tide[n, row, column]
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


@compiled
def _spread(
    depths: np.ndarray,
    profile_depths: np.ndarray,
    profile_rho: np.ndarray,
    table: DensityTable,
    column: Column,
) -> None:
    """Interpolate the levels to the column's depths and integrate density to pressure from the surface down."""
    values, levels, dz, g = column.values, column.levels, column.dz, column.place[GRAVITY]
    last, k = depths.size - 1, 0
    above, pressure = 0.0, 0.0
    for n in range(values.shape[0]):
        z = n * dz
        while k < last - 1 and depths[k + 1] < z:
            k += 1
        lower = min(k + 1, last)
        share = min(max((z - depths[k]) / (depths[lower] - depths[k]), 0.0), 1.0) if last > 0 else 0.0
        for q in range(TEMPERATURE, QUANTITIES):
            values[n, q] = levels[k, q] + share * (levels[lower, q] - levels[k, q])
        weight = g * (1.0 + GRAVITY_PER_METRE * (z - 0.5 * dz)) * dz if n > 0 else 0.0
        # with the density above, the pressure is some Pa off, which moves the density by about 1e-6 kg/m3
        pressure += weight * above
        if profile_depths.size > 0:
            rho = _profile_density(profile_depths, profile_rho, z)
        else:
            rho = density(table, values[n, SALINITY], values[n, CT_ROW], pressure / PASCAL_PER_DECIBAR)
        pressure += 0.5 * weight * (rho - above)
        above = rho
        values[n, P], values[n, RHO] = pressure, rho


@inlined
def _profile_density(depths: np.ndarray, rho: np.ndarray, z: float) -> float:
    """Density that is given directly, held at the ends of its depths."""
    k = min(max(int(np.searchsorted(depths, z)), 1), depths.size - 1)
    first = max(k - 1, 0)
    share = min(max((z - depths[first]) / (depths[k] - depths[first]), 0.0), 1.0) if k > first else 0.0
    at: float = rho[first] + share * (rho[k] - rho[first])
    return at


@inlined
def water_at(column: Column, z: float, age: float = 0.0) -> Water:
    """Water at depth `z` [m, positive down] of a filled column, `age` seconds after it was filled.

    The current is carried on by its rate of change. Above the surface the surface's values hold, with no pressure;
    below the column its deepest values hold, with the pressure carried on.
    """
    values = column.values
    position = max(z, 0.0) / column.dz
    n = min(int(position), values.shape[0] - 2)
    beyond = position - n
    b = min(beyond, 1.0)
    a = 1.0 - b
    upper, lower = values[n], values[n + 1]
    return Water(
        a * upper[RHO] + b * lower[RHO],
        upper[P] + beyond * (lower[P] - upper[P]),
        a * upper[TEMPERATURE] + b * lower[TEMPERATURE],
        (
            a * upper[NORTH] + b * lower[NORTH] + age * (a * upper[NORTH_RATE] + b * lower[NORTH_RATE]),
            a * upper[EAST] + b * lower[EAST] + age * (a * upper[EAST_RATE] + b * lower[EAST_RATE]),
            0.0,
        ),
        (
            a * upper[NORTH_ACCELERATION] + b * lower[NORTH_ACCELERATION],
            a * upper[EAST_ACCELERATION] + b * lower[EAST_ACCELERATION],
            0.0,
        ),
    )
