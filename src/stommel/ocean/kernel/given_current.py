"""The same water in another current: one that somebody gives, the same everywhere and always."""

import numpy as np

from stommel.ocean.kernel.chart import project_nodes
from stommel.ocean.kernel.grid import U_X, U_Y, Nodes, OceanGrid
from stommel.ocean.kernel.unproject import unproject


def with_current(grid: OceanGrid, east: float, north: float) -> OceanGrid:
    """Return an ocean whose water moves to east and north at these speeds everywhere [m/s]; tides stop."""
    return grid._replace(nodes=_moving(grid.nodes, east, north), behind=_moving(grid.behind, east, north))


def _moving(nodes: Nodes, east: float, north: float) -> Nodes:
    north_x, north_y = _north(nodes)
    water = nodes.water.copy()
    # east lies a right angle clockwise of north
    water[..., U_X, :] = (east * north_y + north * north_x)[..., None]
    water[..., U_Y, :] = (north * north_y - east * north_x)[..., None]
    still = np.zeros((0, *nodes.levels.shape, 4), dtype=np.float32)
    return nodes._replace(water=water, tide_speed=np.zeros(0), tide=still)


def _north(nodes: Nodes) -> tuple[np.ndarray, np.ndarray]:
    """Way to the north at each node, along x and y; a single node keeps (east, north)."""
    if nodes.x.size == 1:
        return np.zeros_like(nodes.x), np.ones_like(nodes.x)
    latitude, longitude = unproject(nodes.chart, nodes.x, nodes.y)
    out = np.empty((nodes.x.size, 4))
    project_nodes(nodes.chart, latitude.ravel(), longitude.ravel(), out)
    return out[:, 2].reshape(nodes.x.shape), out[:, 3].reshape(nodes.x.shape)
