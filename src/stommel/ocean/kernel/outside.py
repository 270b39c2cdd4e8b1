"""What an ocean answers outside its data: nothing, its nearest values, or the ocean behind it."""

import numpy as np
from numpy.typing import NDArray

from stommel.files.nearest import did_you_mean
from stommel.ocean.errors import UnknownOceanError
from stommel.ocean.kernel.chart import project_nodes
from stommel.ocean.kernel.grid import (
    CLIMATOLOGY,
    ERROR,
    FIELDS,
    HOLD,
    MEAN_SLOT,
    POLICIES,
    U_X,
    U_Y,
    Nodes,
    OceanGrid,
)
from stommel.ocean.kernel.unproject import unproject

Array = NDArray[np.float64]

POLICY_NAMES = {ERROR: "error", HOLD: "hold", CLIMATOLOGY: "climatology", MEAN_SLOT: "climatology"}
"""Policies as users write them."""


def policy(name: str, key: str = "outside") -> int:
    """Return the number of a policy.

    Raises
    ------
    UnknownOceanError
        There is none of this name.
    """
    if name not in POLICIES:
        raise UnknownOceanError(
            f"{key} = {name!r}: must be one of {', '.join(POLICIES)}{did_you_mean(name, POLICIES).removesuffix(';')}"
        )
    return POLICIES[name]


def with_policies(
    grid: OceanGrid, space: int, time: int, second: OceanGrid | None, blend_distance: float, blend_time: float
) -> OceanGrid:
    """Return the ocean with policies outside its data.

    Parameters
    ----------
    grid
        The ocean.
    space, time
        ERROR, HOLD or CLIMATOLOGY.
    second
        What CLIMATOLOGY goes over to; without it, the mean of the ocean's own data.
    blend_distance, blend_time
        Over which the ocean's nearest values give way to it [m, s].

    Raises
    ------
    UnknownOceanError
        The second ocean has a climatology of its own.
    """
    grid = grid._replace(outside_space=space, outside_time=time, blend_distance=blend_distance, blend_time=blend_time)
    if CLIMATOLOGY not in (space, time):
        return grid
    if second is None:
        if time == CLIMATOLOGY:
            grid = grid._replace(outside_time=MEAN_SLOT, nodes=_with_mean_slot(grid.nodes))
        return grid._replace(behind=mean_node(grid.nodes), behind_outside_time=HOLD)
    if {second.outside_space, second.outside_time} & {CLIMATOLOGY, MEAN_SLOT}:
        raise UnknownOceanError("climatology: the second ocean has a climatology of its own; only one is allowed")
    return grid._replace(behind=second.nodes, behind_outside_time=second.outside_time)


def _with_mean_slot(nodes: Nodes) -> Nodes:
    """Return nodes with the mean over time after the last slot; they may have been built with it."""
    count = len(nodes.times)
    if len(nodes.water) > count:
        return nodes
    mean = nodes.water.mean(axis=0, keepdims=True, dtype=np.float64).astype(np.float32)
    return nodes._replace(water=np.concatenate([nodes.water, mean]))


def mean_node(nodes: Nodes) -> Nodes:
    """Return one node with the mean of all times and of all nodes with water at each level; the deepest bottom."""
    count = len(nodes.times) - int(np.isfinite(nodes.period))
    wet = np.arange(len(nodes.depths)) < nodes.levels[..., None]
    number = np.maximum(wet.sum(axis=(0, 1)), 1)
    mean = np.zeros((FIELDS, len(nodes.depths)))
    for slot in nodes.water[:count]:
        mean += (_to_east_and_north(nodes, slot.astype(np.float64)) * wet[:, :, None, :]).sum(axis=(0, 1)) / count
    mean /= number
    for k in range(1, mean.shape[1]):
        if not wet[..., k].any():
            mean[:, k] = mean[:, k - 1]
    one = np.zeros((1, 1))
    return nodes._replace(
        times=np.zeros(1), period=np.inf, x=one, y=one, water=mean[None, None, None].astype(np.float32),
        levels=np.full((1, 1), nodes.levels.max(), dtype=np.int32), bottom=np.full((1, 1), nodes.bottom.max()),
        tide_speed=np.zeros(0), tide=np.zeros((0, 1, 1, 4), dtype=np.float32),
        time_range=np.array([-np.inf, np.inf]),
    )  # fmt: skip


def _to_east_and_north(nodes: Nodes, water: Array) -> Array:
    """Turn the currents of one slot (j, i, field, level) from the plane's axes to (east, north)."""
    if nodes.x.size == 1:
        return water
    latitude, longitude = unproject(nodes.chart, nodes.x, nodes.y)
    plane = np.empty((latitude.size, 4))
    project_nodes(nodes.chart, latitude.ravel(), longitude.ravel(), plane)
    north_x, north_y = (plane[:, k].reshape(nodes.x.shape)[..., None] for k in (2, 3))
    x, y = water[:, :, U_X].copy(), water[:, :, U_Y].copy()
    water[:, :, U_X] = x * north_y - y * north_x
    water[:, :, U_Y] = x * north_x + y * north_y
    return water
