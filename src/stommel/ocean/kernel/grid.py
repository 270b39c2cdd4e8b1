"""The ocean as compiled code sees it: a grid of nodes, and one column of water below the vehicle."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from stommel.ocean.kernel.chart import Chart

T, S_A, CT, U_X, U_Y = range(5)
"""Places of the fields in the last axis of `OceanGrid.water`."""
FIELDS = 5

OK = 0
"""The column is filled from the data."""
HELD = 1
"""The column is filled, but for a place or time outside the data, as the ocean's policy says."""
OUTSIDE_SPACE = 2
"""The place is outside the data and the policy is to refuse; the column is unchanged."""
OUTSIDE_TIME = 3
"""The time is outside the data and the policy is to refuse; the column is unchanged."""
LAND = 4
"""The place is on land; the column is unchanged."""

ERROR, HOLD, CLIMATOLOGY, MEAN_SLOT = 0, 1, 2, 3
"""Policies outside the data: refuse; keep the nearest values; go over to the ocean behind; go over to the mean over
time of the ocean's own data (for times only)."""

POLICIES = {"error": ERROR, "hold": HOLD, "climatology": CLIMATOLOGY}
"""Policies by the names that users write."""

UNBOUNDED_DEPTH = 1.0e5
"""Depth of the bottom where an ocean has none [m]."""


class Nodes(NamedTuple):
    """Nodes in time, depth and the plane; SI units unless noted. Every value is a number: nothing is missing.

    Below the last level with water, a node carries on the values of that level. A single node (j = i = 1) is an ocean
    that is the same everywhere: its vectors are (east, north) instead of (x, y).
    """

    times: NDArray[np.float64]
    """Time of each slot of `water` [s since 1970-01-01 UTC], increasing."""
    period: float
    """Times repeat after so long [s], and the last slot is the first again; infinite where they do not."""
    depths: NDArray[np.float64]
    """Depth of each level [m], positive down, increasing."""
    x: NDArray[np.float64]
    """Nodes in the plane of `chart` (j, i) [m]."""
    y: NDArray[np.float64]
    """Nodes in the plane of `chart` (j, i) [m]."""
    water: NDArray[np.float32]
    """(time, j, i, field, level): in-situ temperature [deg C], Absolute Salinity [g/kg], Conservative Temperature
    [deg C], current along the plane's x and y [m/s]."""
    levels: NDArray[np.int32]
    """Number of levels with water (j, i); 0 on land."""
    bottom: NDArray[np.float64]
    """Depth of the bottom (j, i) [m]; 0 on land."""
    tide_speed: NDArray[np.float64]
    """Angular speed of each tidal constituent [rad/s]."""
    tide: NDArray[np.float32]
    """(constituent, j, i, 4): U_x cos, U_x sin, U_y cos, U_y sin of the angle, the same at all depths [m/s]."""
    profile_depths: NDArray[np.float64]
    """Depths of a density that is given directly [m]; empty where it follows from TEOS-10."""
    profile_rho: NDArray[np.float64]
    """That density [kg/m3]."""
    chart: Chart
    """The plane."""
    time_range: NDArray[np.float64]
    """First and last time that the data speak for [s]; infinite where the ocean does not change or repeats."""


class OceanGrid(NamedTuple):
    """An ocean, what to do outside its data, and the ocean behind it that may answer there."""

    nodes: Nodes
    """The data. One more slot of water than times holds their mean over time if `outside_time` is MEAN_SLOT."""
    outside_space: int
    """Policy: ERROR, HOLD or CLIMATOLOGY."""
    outside_time: int
    """Policy: ERROR, HOLD, CLIMATOLOGY or MEAN_SLOT."""
    behind: Nodes
    """What CLIMATOLOGY goes over to: a second ocean, or the mean of this one; without that policy, of no meaning."""
    behind_outside_time: int
    """Policy of the ocean behind at times outside its own data: ERROR or HOLD. Outside its nodes it refuses."""
    blend_distance: float
    """Beyond the edge of the nodes, the values of the edge give way to those behind over this distance [m]."""
    blend_time: float
    """Before the first and after the last time, the same over this time [s]."""

    @property
    def x(self) -> NDArray[np.float64]:
        """Nodes in the plane (j, i) [m]; not for compiled code, as all properties here."""
        return self.nodes.x

    @property
    def y(self) -> NDArray[np.float64]:
        """Nodes in the plane (j, i) [m]."""
        return self.nodes.y

    @property
    def levels(self) -> NDArray[np.int32]:
        """Number of levels with water (j, i); 0 on land."""
        return self.nodes.levels

    @property
    def bottom(self) -> NDArray[np.float64]:
        """Depth of the bottom (j, i) [m]; 0 on land."""
        return self.nodes.bottom


RHO, P, TEMPERATURE, SALINITY, CT_ROW, NORTH, EAST, NORTH_RATE, EAST_RATE, NORTH_ACCELERATION, EAST_ACCELERATION = (
    range(11)
)
"""Places of the quantities in the last axis of `Column.values`."""
QUANTITIES = 11

BOTTOM, TIME, LATITUDE, LONGITUDE, GRAVITY = range(5)
"""Places of the numbers in `Column.place`."""


class Column(NamedTuple):
    """Water from the surface down at one place and time, at depths 0, dz, 2 dz, ...; its owner reuses it."""

    values: NDArray[np.float64]
    """(depth, quantity): density [kg/m3], gauge pressure [Pa], in-situ temperature [deg C], Absolute Salinity [g/kg],
    Conservative Temperature [deg C], current to north and east [m/s], its rate of change at a fixed point dU/dt and
    the acceleration of the water DU/Dt, each to north and east [m/s2]."""
    levels: NDArray[np.float64]
    """(level, quantity): room for one interpolated column at the grid's own levels."""
    place: NDArray[np.float64]
    """Depth of the bottom [m], time [s], latitude and longitude [rad], gravity at the surface [m/s2]."""
    dz: float
    """Distance of the depths [m]."""
    behind: NDArray[np.float64]
    """Room for the values of the ocean behind, as `values`; empty where no policy asks for them."""
    behind_cell: NDArray[np.int64]
    """Memory of the last cell (j, i) in the ocean behind."""


def new_column(grid: OceanGrid, depth: float, dz: float = 2.0) -> Column:
    """Return an empty column for `fill_column`, from the surface to at least `depth` [m] in steps of `dz` [m]."""
    count = max(int(np.ceil(depth / dz - 1e-9)), 1) + 1
    levels = max(len(grid.nodes.depths), len(grid.behind.depths))
    needed = CLIMATOLOGY in (grid.outside_space, grid.outside_time)
    return Column(
        np.zeros((count, QUANTITIES)), np.zeros((levels, QUANTITIES)), np.zeros(5), float(dz),
        np.zeros((count if needed else 0, QUANTITIES)), np.zeros(2, dtype=np.int64),
    )  # fmt: skip


def new_cell() -> NDArray[np.int64]:
    """Return the memory of the last cell (j, i) that `fill_column` keeps between calls of one vehicle."""
    return np.zeros(2, dtype=np.int64)
