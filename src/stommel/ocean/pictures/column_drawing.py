"""The water column at one place, on axes that the caller styles."""

from dataclasses import dataclass
from math import radians
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from stommel.ocean.kernel.column import fill_column
from stommel.ocean.kernel.grid import (
    CT,
    EAST,
    NORTH,
    RHO,
    S_A,
    SALINITY,
    TEMPERATURE,
    U_X,
    U_Y,
    new_cell,
    new_column,
)
from stommel.ocean.ocean import Ocean

if TYPE_CHECKING:
    from matplotlib.axes import Axes

Array = NDArray[np.float64]

_SHALLOWEST_COLUMN = 200.0
"""Depth down to which a column is drawn at least, where there is no bottom [m]."""


@dataclass(frozen=True)
class _Scale:
    """One horizontal axis of the column, and the curves on it."""

    label: str
    colour: str
    least: float
    """Range that it has at least, so that rounding is not drawn as structure."""
    curves: tuple[tuple[Array, str], ...]
    """Values and the dashes of each."""


def draw_column(axes: "Axes", ocean: Ocean, time: float, place: tuple[float, float]) -> None:
    """Temperature, salinity, density and current against depth at one place, each on its own axis."""
    grid = ocean.grid()
    bottom = ocean.bottom_depth(*place)
    deepest = min(float(grid.nodes.depths[-1]), bottom) if np.isfinite(bottom) else _interesting_depth(ocean)
    column = new_column(grid, deepest, deepest / 400.0)
    fill_column(grid, ocean.table, time, radians(place[0]), radians(place[1]), new_cell(), column)
    z: Array = np.arange(len(column.values), dtype=np.float64) * column.dz
    kept = z <= deepest * (1.0 + 1e-9)
    T, S, rho, east, north = (column.values[kept, n] for n in (TEMPERATURE, SALINITY, RHO, EAST, NORTH))
    scales = (
        _Scale("Temperature in situ [°C]", "#c4501b", 1.0, ((T, "-"),)),
        _Scale("Absolute Salinity [g/kg]", "#00805f", 0.2, ((S, "--"),)),
        _Scale("Density − 1000 [kg/m³]", "#0b62a4", 0.5, ((rho - 1000.0, "-."),)),
        _Scale("Current to east (dotted) and north (dashed) [m/s]", "#9c4f86", 0.1, ((east, ":"), (north, "--"))),
    )
    axes.set_ylim(deepest, 0.0)
    axes.set_ylabel("Depth [m]")
    axes.set_title(_place_text(place))
    for n, scale in enumerate(scales):
        _draw_scale(axes if n == 0 else axes.twiny(), scale, z[kept], n)


def _draw_scale(own: "Axes", scale: _Scale, z: Array, n: int) -> None:
    for values, dashes in scale.curves:
        own.plot(values, z, color=scale.colour, linestyle=dashes)
    low, high = min(float(v.min()) for v, _ in scale.curves), max(float(v.max()) for v, _ in scale.curves)
    room = max(0.05 * (high - low), 0.5 * (scale.least - (high - low)))
    own.set_xlim(low - room, high + room)
    own.set_xlabel(scale.label, color=scale.colour, fontsize=8.4)
    own.tick_params(axis="x", labelcolor=scale.colour, labelsize=7.8)
    own.grid(visible=n == 0)
    own.xaxis.set_major_locator(_few_ticks())
    if n > 0:
        own.xaxis.set_ticks_position("bottom")
        own.xaxis.set_label_position("bottom")
        own.spines["bottom"].set_position(("outward", 34.0 * n))
        own.spines["bottom"].set_visible(True)


def _interesting_depth(ocean: Ocean) -> float:
    """Half again the depth above which the water of a bottomless ocean changes, at most that of its levels [m]."""
    nodes = ocean.grid().nodes
    wet = nodes.levels > 0
    mean = nodes.water[0][wet][:, [S_A, CT, U_X, U_Y]].mean(axis=0)
    from_below = np.abs(mean - mean[:, -1:]).max(axis=0)
    changing = np.flatnonzero(from_below > 0.01 * max(float(from_below.max()), 1e-3))
    last = float(nodes.depths[-1])
    depth = (
        1.5 * float(nodes.depths[min(changing[-1] + 1, len(nodes.depths) - 1)]) if changing.size else _SHALLOWEST_COLUMN
    )
    if nodes.profile_depths.size > 1:
        depth = max(depth, float(nodes.profile_depths[-1]))
    return min(max(depth, _SHALLOWEST_COLUMN), last)


def _few_ticks() -> Any:
    from matplotlib.ticker import MaxNLocator  # noqa: PLC0415 - start-up counts

    return MaxNLocator(nbins=4)


def _place_text(place: tuple[float, float]) -> str:
    latitude, longitude = place[0], (place[1] + 180.0) % 360.0 - 180.0
    return f"{abs(latitude):.2f}°{'N' if latitude >= 0 else 'S'} {abs(longitude):.2f}°{'E' if longitude >= 0 else 'W'}"
