"""A map of an ocean at one depth and time, and the water column at one place, on axes that the caller styles."""

from dataclasses import dataclass
from math import degrees, radians
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from stommel.figures.style import new_figure, styled
from stommel.ocean import times
from stommel.ocean.errors import BelowBottomError
from stommel.ocean.kernel.chart import project, project_nodes
from stommel.ocean.kernel.column import fill_column
from stommel.ocean.kernel.grid import (
    BOTTOM,
    EAST,
    HELD,
    NORTH,
    TEMPERATURE,
    UNBOUNDED_DEPTH,
    new_cell,
    new_column,
)
from stommel.ocean.ocean import Ocean
from stommel.ocean.pictures.column_drawing import draw_column

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure, SubFigure

Array = NDArray[np.float64]

_ARROWS = 22
"""Arrows along the longer side of the map; nearly all are shorter than 1.3 of their distance."""
_LAND = "#d9d4c9"
_STILL = 1e-6
_MOST_NODES = 240
"""Nodes along a side of the map; of larger grids only some are drawn."""
_SAME_TEMPERATURE = 0.3
"""A map of less than this range of temperature shows the speed of the current instead [deg C]."""


@dataclass(frozen=True)
class Layer:
    """The water at the nodes at one depth and time; nan on land and below the bottom."""

    x: Array
    """In the plane (j, i) [km]."""
    y: Array
    """[km]"""
    latitude: Array
    """[deg]"""
    longitude: Array
    """[deg]"""
    bottom: Array
    """Depth of the bottom; nan on land [m]."""
    temperature: Array
    """In situ [deg C]."""
    east: Array
    """[m/s]"""
    north: Array
    """[m/s]"""

    @property
    def speed(self) -> Array:
        """Of the current [m/s]."""
        return np.hypot(self.east, self.north)


def layer_of(ocean: Ocean, time: float, depth: float) -> Layer:
    """Temperature and current at the nodes, by the interpolation that a mission gets."""
    grid = ocean.grid()
    thin = tuple(slice(None, None, -(-length // _MOST_NODES)) for length in grid.x.shape)
    latitude, longitude = (a[thin] for a in ocean.node_places())
    levels, found = grid.levels[thin], np.full((3, *latitude.shape), np.nan)
    column, cell = new_column(grid, max(depth, 1.0), max(depth, 1.0)), new_cell()
    row = 1 if depth > 0.0 else 0
    for j, i in np.argwhere(levels > 0):
        place = radians(latitude[j, i]), radians(longitude[j, i])
        status = fill_column(grid, ocean.table, time, *place, cell, column)
        if status <= HELD and depth <= column.place[BOTTOM]:
            found[:, j, i] = column.values[row, [TEMPERATURE, EAST, NORTH]]
    bottom = np.where(levels > 0, grid.bottom[thin], np.nan)
    return Layer(grid.x[thin] / 1e3, grid.y[thin] / 1e3, latitude, longitude, bottom, *found)


@styled
def ocean_figure(ocean: Ocean, time: float, depth: float, place: tuple[float, float] | None = None) -> "Figure":
    """Map and column in a figure of their own, as `draw_ocean` draws them and with its errors."""
    figure = new_figure(11.0, 6.0) if ocean.grid().x.size > 1 else new_figure(5.0, 6.0)
    draw_ocean(figure, ocean, time, depth, place)
    return figure


def draw_ocean(
    figure: "Figure", ocean: Ocean, time: float, depth: float, place: tuple[float, float] | None = None
) -> None:
    """Draw the map, where the ocean differs from place to place, and the column at `place` (latitude, longitude).

    Raises
    ------
    OutsideOceanError, LandError
        The place or time is outside the ocean, or the place is on land.
    BelowBottomError
        No place of the ocean is so deep.
    """
    here = place if place is not None else _deepest_place(ocean)
    ocean.at(time, *here)
    grid = ocean.grid()
    if grid.x.size > 1 and depth > grid.bottom.max():
        raise BelowBottomError(f"{ocean.name}: depth = {depth:g} m: its deepest bottom is at {grid.bottom.max():.6g} m")
    if ocean.grid().x.size > 1:
        parts: Any = figure.subfigures(1, 2, width_ratios=(2.0, 1.0))
        _draw_map(parts[0], ocean, time, depth, here)
        draw_column(parts[1].subplots(1, 1), ocean, time, here)
    else:
        draw_column(figure.subplots(1, 1), ocean, time, here)


def _deepest_place(ocean: Ocean) -> tuple[float, float]:
    """Of the nodes where the bottom is about the deepest, the one nearest the middle."""
    grid = ocean.grid()
    latitude, longitude = ocean.node_places()
    deep = (grid.levels > 0) & (grid.bottom >= 0.98 * grid.bottom.max())
    j, i = np.unravel_index(int(np.argmin(np.where(deep, np.hypot(grid.x, grid.y), np.inf))), deep.shape)
    return float(latitude[j, i]), float(longitude[j, i])


def _draw_map(figure: "SubFigure", ocean: Ocean, time: float, depth: float, place: tuple[float, float]) -> None:
    axes = figure.subplots(1, 1)
    layer = layer_of(ocean, time, depth)
    dry = np.where(np.isnan(layer.temperature), 1.0, np.nan)
    axes.pcolormesh(layer.x, layer.y, dry, shading="nearest", cmap=_one_colour(_LAND), rasterized=True)
    if np.isfinite(layer.temperature).any():
        _draw_field(figure, axes, layer)
    _draw_bottom(axes, layer)
    _draw_arrows(axes, ocean, layer)
    _draw_graticule(axes, ocean, layer)
    point = _in_plane(ocean, place)
    axes.plot(
        point[0] / 1e3, point[1] / 1e3, marker="o", color="white", markeredgecolor="black", markersize=7, zorder=6,
        clip_on=False,
    )  # fmt: skip
    axes.set_aspect("equal")
    axes.set_xlim(float(layer.x.min()), float(layer.x.max()))
    axes.set_ylim(float(layer.y.min()), float(layer.y.max()))
    axes.grid(visible=False)
    axes.set_xlabel("km from the middle")
    axes.set_ylabel("km from the middle")
    axes.set_title(f"{depth:g} m deep" + ("" if _steady(ocean) else f", {times.text(time)}"), pad=14.0)


def _steady(ocean: Ocean) -> bool:
    """Whether nothing changes with time."""
    nodes = ocean.grid().nodes
    return nodes.times.size == 1 and nodes.tide_speed.size == 0


def _draw_field(figure: "SubFigure", axes: "Axes", layer: Layer) -> None:
    """Colours of temperature; of the current's speed where the temperature is the same everywhere."""
    values, label, colours, least = layer.temperature, "Temperature in situ [°C]", "RdYlBu_r", 0.5
    if np.ptp(values[np.isfinite(values)]) < _SAME_TEMPERATURE and np.nanmax(layer.speed) > _STILL:
        values, label, colours, least = layer.speed, "Speed of the current [m/s]", "speed", 0.02
    low, high = np.nanpercentile(values, (0.5, 99.5))
    room = max(0.5 * (least - (high - low)), 0.0)
    low, high = (low - room, high + room) if colours != "speed" else (0.0, max(high, least))
    mesh = axes.pcolormesh(
        layer.x, layer.y, values, shading="gouraud" if _all_wet(layer) else "nearest", vmin=low, vmax=high,
        cmap=_pale_blues() if colours == "speed" else colours, rasterized=True,
    )  # fmt: skip
    figure.colorbar(mesh, ax=axes, label=label, shrink=0.85, extend="max" if low == 0.0 else "both")


def _all_wet(layer: Layer) -> bool:
    return bool(np.isfinite(layer.temperature).all())


def _in_plane(ocean: Ocean, place: tuple[float, float]) -> tuple[float, float]:
    point = project(ocean.grid().nodes.chart, radians(place[0]), radians(place[1]))
    return point.x, point.y


def _draw_bottom(axes: "Axes", layer: Layer) -> None:
    bottom = layer.bottom
    deepest = np.nanmax(bottom)
    if deepest >= UNBOUNDED_DEPTH or np.nanmin(bottom) == deepest:
        return
    levels = [d for d in (10, 20, 50, 100, 200, 500, 1000, 2000, 3000, 4000, 5000) if np.nanmin(bottom) < d < deepest]
    if levels:
        lines = axes.contour(layer.x, layer.y, bottom, levels=levels, colors="#3b4652", linewidths=0.7)
        axes.clabel(lines, fmt="%d m", fontsize=7.5)


def _draw_arrows(axes: "Axes", ocean: Ocean, layer: Layer) -> None:
    """Arrows in the plane's own directions: north is not up everywhere on it."""
    speed = layer.speed
    if not (np.isfinite(speed).any() and np.nanpercentile(speed, 98.0) > _STILL):
        return
    longest = float(np.nanpercentile(speed, 98.0))
    reach = 1e3 * max(float(np.ptp(layer.x)), float(np.ptp(layer.y)))
    j, i = (_every(1e3 * layer.x, 1e3 * layer.y, axis, reach / _ARROWS) for axis in (0, 1))
    latitude, longitude = (np.radians(a[j, i]).ravel() for a in (layer.latitude, layer.longitude))
    plane = np.empty((latitude.size, 4))
    project_nodes(ocean.grid().nodes.chart, latitude, longitude, plane)
    east, north = layer.east[j, i].ravel(), layer.north[j, i].ravel()
    along_x, along_y = east * plane[:, 3] + north * plane[:, 2], north * plane[:, 3] - east * plane[:, 2]
    arrows = axes.quiver(
        plane[:, 0] / 1e3, plane[:, 1] / 1e3, along_x, along_y, color="#1d2733", width=0.0026, pivot="mid", zorder=5,
        angles="xy", scale_units="xy", scale=longest / (1.3e-3 * reach / _ARROWS),
    )  # fmt: skip
    length = _round_number(longest)
    axes.quiverkey(arrows, 0.82, 1.025, length, f"{length:g} m/s", labelpos="E", coordinates="axes")


def _every(x: Array, y: Array, axis: int, spacing: float) -> slice:
    """Nodes along an axis about `spacing` apart."""
    apart = float(np.median(np.hypot(np.diff(x, axis=axis), np.diff(y, axis=axis))))
    step = max(1, round(spacing / apart))
    return slice(min(step // 2, x.shape[axis] - 1), None, step)


def _pale_blues() -> Any:
    """Colours on which arrows and lines can be read at the dark end too."""
    from matplotlib import colormaps  # noqa: PLC0415 - start-up counts
    from matplotlib.colors import ListedColormap  # noqa: PLC0415

    return ListedColormap(colormaps["YlGnBu"](np.linspace(0.0, 0.55, 128)))


def _one_colour(colour: str) -> Any:
    from matplotlib.colors import ListedColormap  # noqa: PLC0415 - start-up counts

    return ListedColormap([colour])


def _round_number(value: float) -> float:
    """Largest of 1, 2, 5 times a power of ten that is not above `value`."""
    power = 10.0 ** np.floor(np.log10(value))
    return float(next(digit * power for digit in (5.0, 2.0, 1.0) if digit * power <= value * 1.0000001))


def _draw_graticule(axes: "Axes", ocean: Ocean, layer: Layer) -> None:
    middle = degrees(ocean.grid().nodes.chart.longitude)
    beside = middle + (layer.longitude - middle + 180.0) % 360.0 - 180.0
    for values, sides in ((layer.latitude, "NS"), (beside, "EW")):
        step = _graticule_step(float(np.ptp(values)))
        marks = np.arange(np.ceil(values.min() / step) * step, values.max(), step)
        if len(marks):
            lines = axes.contour(
                layer.x, layer.y, values, levels=marks, colors="#5c6875", linewidths=0.5, linestyles=":"
            )
            axes.clabel(lines, fmt=_marked(sides), fontsize=7.5)


def _marked(sides: str) -> Any:
    def text(value: float) -> str:
        beside = (value + 180.0) % 360.0 - 180.0
        return f"{abs(beside):g}°{sides[0] if beside >= 0 else sides[1]}"

    return text


def _graticule_step(span: float) -> float:
    return next((step for step in (0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 15.0) if span / step <= 6.0), 30.0)
