"""From the grid to one column of water, and from the column to the water at the vehicle (compiled).

Between nodes: linear in time, bilinear in space over the nodes that have water at the level, linear in depth. At a
node the node's values come out.
"""

from math import sin

import numpy as np

from stommel.compilation import compiled, inlined
from stommel.dynamics.state import Water
from stommel.ocean.cells import find_cell
from stommel.ocean.chart import project
from stommel.ocean.grid import (
    BOTTOM,
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
    SALINITY,
    TEMPERATURE,
    TIME,
    Column,
    OceanGrid,
    P,
)
from stommel.ocean.levels import (
    add_single_tide,
    add_tide,
    cell_levels,
    mean_levels,
    single_levels,
    wet_weights,
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
        single_levels(grid, first, second, share, span, column.levels)
        add_single_tide(grid, time, column.levels)
        bottom = grid.bottom[0, 0]
    else:
        point = project(grid.chart, latitude, longitude)
        at = find_cell(grid.x, grid.y, point.x, point.y, cell)
        if not at.inside:
            if grid.outside_space == ERROR:
                return OUTSIDE_SPACE
            status = HELD
        if at.inside or grid.outside_space == HOLD:
            weights, wet, bottom = wet_weights(grid, at)
            if wet < _SHORE:
                return LAND
            cell_levels(grid, at, point, weights, (first, second, share, span), column.levels)
            add_tide(grid, at, point, weights, time, column.levels)
        else:
            mean_levels(grid, column.levels)
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
