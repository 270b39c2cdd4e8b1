"""From the grid to one column of water, and from the column to the water at the vehicle (compiled).

Between nodes: linear in time, bilinear in space over the nodes that have water at the level, linear in depth. At a
node the node's values come out.
"""

from math import sqrt

import numpy as np

from stommel.compilation import compiled, inlined
from stommel.ocean.kernel.cells import CellPoint, find_cell, mapped
from stommel.ocean.kernel.chart import PlanePoint, project
from stommel.ocean.kernel.grid import (
    BOTTOM,
    CLIMATOLOGY,
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
    MEAN_SLOT,
    NORTH,
    NORTH_ACCELERATION,
    NORTH_RATE,
    OK,
    OUTSIDE_SPACE,
    OUTSIDE_TIME,
    QUANTITIES,
    RHO,
    TEMPERATURE,
    TIME,
    Column,
    Nodes,
    OceanGrid,
    P,
)
from stommel.ocean.kernel.levels import add_single_tide, add_tide, cell_levels, single_levels, wet_weights
from stommel.ocean.kernel.weight import gravity, spread
from stommel.seawater.table import DensityTable
from stommel.seawater.water import Water

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
    near = grid.nodes
    late = _time_outside(near, time)
    if late > 0.0 and grid.outside_time == ERROR:
        return OUTSIDE_TIME
    point = project(near.chart, latitude, longitude)
    at = _cell_of(near, point, cell)
    if not at.inside and grid.outside_space == ERROR:
        return OUTSIDE_SPACE
    wet, bottom = _ground(near, at)
    if wet < _SHORE and (at.inside or grid.outside_space != CLIMATOLOGY):
        return LAND
    share = _share_behind(grid, point, at, late, wet)
    if share > 0.0:
        status, bottom_behind = _fill_behind(grid, table, time, latitude, longitude, column)
        if status != OK:
            return status
        if not at.inside:
            bottom += share * (bottom_behind - bottom)
    if share < 1.0:
        slot = _time_slot(near, time, late, grid.outside_time, grid.blend_time)
        _fill_values(near, table, slot, time, latitude, point, at, column.levels, column.values, column.dz)
    if share > 0.0:
        _blend(column.values, column.behind, share)
    place = column.place
    place[BOTTOM], place[TIME], place[LATITUDE], place[LONGITUDE] = bottom, time, latitude, longitude
    place[GRAVITY] = gravity(latitude)
    return OK if at.inside and late == 0.0 else HELD


@inlined
def _cell_of(nodes: Nodes, point: PlanePoint, cell: np.ndarray) -> CellPoint:
    """Cell of a point; a single node is everywhere."""
    if nodes.x.size == 1:
        return CellPoint(0, 0, 0.0, 0.0, True)
    return find_cell(nodes.x, nodes.y, point.x, point.y, cell)


@inlined
def _ground(nodes: Nodes, at: CellPoint) -> tuple[float, float]:
    """How much of a cell has water, by weight, and the depth of the bottom there [m]."""
    if nodes.x.size == 1:
        return 1.0, nodes.bottom[0, 0]
    _, wet, bottom = wet_weights(nodes, at)
    return wet, bottom


@inlined
def _share_behind(grid: OceanGrid, point: PlanePoint, at: CellPoint, late: float, wet: float) -> float:
    """Share of the ocean behind: 0 in the data, growing with the distance to them in space or in time to 1."""
    share = 0.0
    if late > 0.0 and grid.outside_time == CLIMATOLOGY:
        share = _ramp(late, grid.blend_time)
    if not at.inside and grid.outside_space == CLIMATOLOGY:
        x, y = grid.nodes.x, grid.nodes.y
        east = point.x - mapped(x, at.j, at.i, at.u, at.v)
        north = point.y - mapped(y, at.j, at.i, at.u, at.v)
        share = max(share, _ramp(sqrt(east * east + north * north) / point.scale, grid.blend_distance))
        # where the nearest of the edge is land there is nothing to give way
        if wet < _SHORE:
            share = 1.0
    return share


@inlined
def _ramp(distance: float, over: float) -> float:
    return min(distance / over, 1.0) if over > 0.0 else 1.0


@compiled
def _fill_behind(
    grid: OceanGrid, table: DensityTable, time: float, latitude: float, longitude: float, column: Column
) -> tuple[int, float]:
    """Fill the column's second room from the ocean behind; its status and the depth of its bottom [m]."""
    behind = grid.behind
    late = _time_outside(behind, time)
    if late > 0.0 and grid.behind_outside_time == ERROR:
        return OUTSIDE_TIME, 0.0
    point = project(behind.chart, latitude, longitude)
    at = _cell_of(behind, point, column.behind_cell)
    if not at.inside:
        return OUTSIDE_SPACE, 0.0
    wet, bottom = _ground(behind, at)
    if wet < _SHORE:
        return LAND, 0.0
    slot = _time_slot(behind, time, late, HOLD, 0.0)
    _fill_values(behind, table, slot, time, latitude, point, at, column.levels, column.behind, column.dz)
    return OK, bottom


@compiled
def _fill_values(
    nodes: Nodes,
    table: DensityTable,
    slot: tuple[int, int, float, float],
    time: float,
    latitude: float,
    point: PlanePoint,
    at: CellPoint,
    levels: np.ndarray,
    values: np.ndarray,
    dz: float,
) -> None:
    """Interpolate to the nodes' own levels, and from them to the depths of a column."""
    if nodes.x.size == 1:
        single_levels(nodes, slot, levels)
        add_single_tide(nodes, time, levels)
    else:
        weights, _, _ = wet_weights(nodes, at)
        cell_levels(nodes, at, point, weights, slot, levels)
        add_tide(nodes, at, point, weights, time, levels)
    # arrays, not the nodes: as one tuple, all of its arrays would be counted in and out at every depth
    spread(nodes.depths, nodes.profile_depths, nodes.profile_rho, table, levels, values, dz, gravity(latitude))


@inlined
def _blend(values: np.ndarray, behind: np.ndarray, share: float) -> None:
    for n in range(values.shape[0]):
        for q in range(QUANTITIES):
            values[n, q] = behind[n, q] if share == 1.0 else values[n, q] + share * (behind[n, q] - values[n, q])


@inlined
def _time_outside(nodes: Nodes, time: float) -> float:
    """How long a time lies before or after the data [s]; 0 within."""
    late: float = max(nodes.time_range[0] - time, time - nodes.time_range[1], 0.0)
    return late


@inlined
def _time_slot(nodes: Nodes, time: float, late: float, policy: int, blend_time: float) -> tuple[int, int, float, float]:
    """Return the two slots around a time, the share of the second, and the time between them [s]."""
    times = nodes.times
    last = times.size - 1
    if late > 0.0:
        slot = 0 if time < nodes.time_range[0] else last
        if policy == MEAN_SLOT:
            return slot, last + 1, _ramp(late, blend_time), np.inf
        return slot, slot, 0.0, np.inf
    at = times[0] + (time - times[0]) % nodes.period if nodes.period < np.inf else time
    if at <= times[0]:
        return 0, 0, 0.0, np.inf
    if at >= times[last]:
        return last, last, 0.0, np.inf
    first = min(int(np.searchsorted(times, at, side="right")) - 1, last - 1)
    span = times[first + 1] - times[first]
    return first, first + 1, (at - times[first]) / span, span


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
