"""A map of an ocean at one depth and time, and the water column at one place, on axes that the caller styles."""

from dataclasses import dataclass
from math import degrees, radians
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from stommel.ocean import times
from stommel.ocean.chart import project, project_nodes
from stommel.ocean.column import fill_column
from stommel.ocean.grid import (
    BOTTOM,
    EAST,
    HELD,
    NORTH,
    RHO,
    SALINITY,
    TEMPERATURE,
    UNBOUNDED_DEPTH,
    new_cell,
    new_column,
)
from stommel.ocean.ocean import Ocean

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure, SubFigure

Array = NDArray[np.float64]

_ARROWS = 22
"""Arrows along the longer side of the map; nearly all are shorter than 1.6 of their distance."""
_LAND = "#d9d4c9"
_STILL = 1e-6


@dataclass(frozen=True)
class Layer:
    """The water at every node at one depth and time; nan on land and below the bottom."""

    temperature: Array
    """In situ (j, i) [deg C]."""
    east: Array
    """[m/s]"""
    north: Array
    """[m/s]"""


def layer_of(ocean: Ocean, time: float, depth: float) -> Layer:
    """Temperature and current at the nodes, by the interpolation that a mission gets."""
    grid = ocean.grid()
    latitude, longitude = (np.radians(a) for a in ocean.node_places())
    found = np.full((3, *grid.x.shape), np.nan)
    column, cell = new_column(grid, max(depth, 1.0), max(depth, 1.0)), new_cell()
    row = 1 if depth > 0.0 else 0
    for j, i in np.argwhere(grid.levels > 0):
        status = fill_column(grid, ocean.table, time, latitude[j, i], longitude[j, i], cell, column)
        if status <= HELD and depth <= column.place[BOTTOM]:
            found[:, j, i] = column.values[row, [TEMPERATURE, EAST, NORTH]]
    return Layer(*found)


def draw_ocean(
    figure: "Figure", ocean: Ocean, time: float, depth: float, place: tuple[float, float] | None = None
) -> None:
    """Draw the map, where the ocean differs from place to place, and the column at `place` (latitude, longitude)."""
    here = place if place is not None else _deepest_place(ocean)
    if ocean.grid().x.size > 1:
        parts: Any = figure.subfigures(1, 2, width_ratios=(2.0, 1.0))
        _draw_map(parts[0], ocean, time, depth, here)
        _draw_column(parts[1].subplots(1, 1), ocean, time, here)
    else:
        _draw_column(figure.subplots(1, 1), ocean, time, here)


def _deepest_place(ocean: Ocean) -> tuple[float, float]:
    """Node with the deepest bottom; the middle where all are alike."""
    grid = ocean.grid()
    latitude, longitude = ocean.node_places()
    if np.ptp(grid.bottom[grid.levels > 0]) == 0.0:
        middle = grid.x.shape[0] // 2, grid.x.shape[1] // 2
        return float(latitude[middle]), float(longitude[middle])
    j, i = np.unravel_index(int(np.argmax(grid.bottom)), grid.bottom.shape)
    return float(latitude[j, i]), float(longitude[j, i])


def _draw_map(figure: "SubFigure", ocean: Ocean, time: float, depth: float, place: tuple[float, float]) -> None:
    axes = figure.subplots(1, 1)
    grid, layer = ocean.grid(), layer_of(ocean, time, depth)
    x, y = grid.x / 1e3, grid.y / 1e3
    dry = np.where(np.isnan(layer.temperature), 1.0, np.nan)
    axes.pcolormesh(x, y, dry, shading="nearest", cmap=_one_colour(_LAND), rasterized=True)
    if np.isfinite(layer.temperature).any():
        low, high = np.nanpercentile(layer.temperature, (0.5, 99.5))
        room = max(0.25 - 0.5 * (high - low), 0.0)
        mesh = axes.pcolormesh(
            x, y, layer.temperature, shading="gouraud" if _all_wet(layer) else "nearest", cmap="RdYlBu_r",
            vmin=low - room, vmax=high + room, rasterized=True,
        )  # fmt: skip
        figure.colorbar(mesh, ax=axes, label="Temperature in situ [°C]", shrink=0.85, extend="both")
    _draw_bottom(axes, grid.x / 1e3, grid.y / 1e3, np.where(grid.levels > 0, grid.bottom, np.nan))
    _draw_arrows(axes, ocean, layer)
    _draw_graticule(axes, ocean)
    point = _in_plane(ocean, place)
    axes.plot(
        point[0] / 1e3, point[1] / 1e3, marker="o", color="white", markeredgecolor="black", markersize=7, zorder=6
    )
    axes.set_aspect("equal")
    axes.set_xlim(float(x.min()), float(x.max()))
    axes.set_ylim(float(y.min()), float(y.max()))
    axes.grid(visible=False)
    axes.set_xlabel("km from the middle")
    axes.set_title(f"{depth:g} m, {times.text(time)}", pad=14.0)


def _all_wet(layer: Layer) -> bool:
    return bool(np.isfinite(layer.temperature).all())


def _in_plane(ocean: Ocean, place: tuple[float, float]) -> tuple[float, float]:
    point = project(ocean.grid().chart, radians(place[0]), radians(place[1]))
    return point.x, point.y


def _draw_bottom(axes: "Axes", x: Array, y: Array, bottom: Array) -> None:
    deepest = np.nanmax(bottom)
    if deepest >= UNBOUNDED_DEPTH or np.nanmin(bottom) == deepest:
        return
    levels = [d for d in (10, 20, 50, 100, 200, 500, 1000, 2000, 3000, 4000, 5000) if np.nanmin(bottom) < d < deepest]
    if levels:
        lines = axes.contour(x, y, bottom, levels=levels, colors="#3b4652", linewidths=0.7)
        axes.clabel(lines, fmt="%d m", fontsize=7.5)


def _draw_arrows(axes: "Axes", ocean: Ocean, layer: Layer) -> None:
    """Arrows in the plane's own directions: north is not up everywhere on it."""
    grid = ocean.grid()
    speed = np.hypot(layer.east, layer.north)
    if not (np.isfinite(speed).any() and np.nanpercentile(speed, 98.0) > _STILL):
        return
    longest = float(np.nanpercentile(speed, 98.0))
    reach = max(float(np.ptp(grid.x)), float(np.ptp(grid.y)))
    j, i = (_every(grid.x, grid.y, axis, reach / _ARROWS) for axis in (0, 1))
    latitude, longitude = (np.radians(a[j, i]).ravel() for a in ocean.node_places())
    plane = np.empty((latitude.size, 4))
    project_nodes(grid.chart, latitude, longitude, plane)
    east, north = layer.east[j, i].ravel(), layer.north[j, i].ravel()
    along_x, along_y = east * plane[:, 3] + north * plane[:, 2], north * plane[:, 3] - east * plane[:, 2]
    arrows = axes.quiver(
        plane[:, 0] / 1e3, plane[:, 1] / 1e3, along_x, along_y, color="#1d2733", width=0.0026, pivot="mid", zorder=5,
        angles="xy", scale_units="xy", scale=longest / (1.6e-3 * reach / _ARROWS),
    )  # fmt: skip
    length = _round_number(longest)
    axes.quiverkey(arrows, 0.82, 1.025, length, f"{length:g} m/s", labelpos="E", coordinates="axes")


def _every(x: Array, y: Array, axis: int, spacing: float) -> slice:
    """Nodes along an axis about `spacing` apart."""
    apart = float(np.median(np.hypot(np.diff(x, axis=axis), np.diff(y, axis=axis))))
    step = max(1, round(spacing / apart))
    return slice(min(step // 2, x.shape[axis] - 1), None, step)


def _one_colour(colour: str) -> Any:
    from matplotlib.colors import ListedColormap  # noqa: PLC0415 - start-up counts

    return ListedColormap([colour])


def _round_number(value: float) -> float:
    """Largest of 1, 2, 5 times a power of ten that is not above `value`."""
    power = 10.0 ** np.floor(np.log10(value))
    return float(next(digit * power for digit in (5.0, 2.0, 1.0) if digit * power <= value * 1.0000001))


def _draw_graticule(axes: "Axes", ocean: Ocean) -> None:
    grid = ocean.grid()
    latitude, longitude = ocean.node_places()
    middle = degrees(grid.chart.longitude)
    beside = middle + (longitude - middle + 180.0) % 360.0 - 180.0
    for values, sides in ((latitude, "NS"), (beside, "EW")):
        step = _graticule_step(float(np.ptp(values)))
        marks = np.arange(np.ceil(values.min() / step) * step, values.max(), step)
        if len(marks):
            lines = axes.contour(
                grid.x / 1e3, grid.y / 1e3, values, levels=marks, colors="#5c6875", linewidths=0.5, linestyles=":"
            )
            axes.clabel(lines, fmt=_marked(sides), fontsize=7.5)


def _marked(sides: str) -> Any:
    def text(value: float) -> str:
        beside = (value + 180.0) % 360.0 - 180.0
        return f"{abs(beside):g}°{sides[0] if beside >= 0 else sides[1]}"

    return text


def _graticule_step(span: float) -> float:
    return next((step for step in (0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 15.0) if span / step <= 6.0), 30.0)


def _draw_column(axes: "Axes", ocean: Ocean, time: float, place: tuple[float, float]) -> None:
    """Temperature, salinity and density against depth at one place, each on its own axis."""
    grid = ocean.grid()
    deepest = min(float(grid.depths[-1]), ocean.bottom_depth(*place))
    column = new_column(grid, deepest, deepest / 400.0)
    fill_column(grid, ocean.table, time, radians(place[0]), radians(place[1]), new_cell(), column)
    z = np.arange(len(column.values)) * column.dz
    kept = z <= deepest * (1.0 + 1e-9)
    current = np.hypot(column.values[:, NORTH], column.values[:, EAST])
    curves: list[tuple[str, Array, str, str]] = [
        ("Temperature in situ [°C]", column.values[:, TEMPERATURE], "#c4501b", "-"),
        ("Absolute Salinity [g/kg]", column.values[:, SALINITY], "#00805f", "--"),
        ("Density − 1000 [kg/m³]", column.values[:, RHO] - 1000.0, "#0b62a4", "-."),
        ("Current [m/s]", current, "#9c4f86", ":"),
    ]
    axes.set_ylim(deepest, 0.0)
    axes.set_ylabel("Depth [m]")
    axes.set_title(_place_text(place))
    for n, (label, values, colour, dashes) in enumerate(curves):
        own = axes if n == 0 else axes.twiny()
        own.plot(values[kept], z[kept], color=colour, linestyle=dashes)
        low, high = float(values[kept].min()), float(values[kept].max())
        room = max(0.05 * (high - low), 0.02)
        own.set_xlim(low - room, high + room)
        own.set_xlabel(label, color=colour, fontsize=8.4)
        own.tick_params(axis="x", labelcolor=colour, labelsize=7.8)
        own.grid(visible=n == 0)
        own.xaxis.set_major_locator(_few_ticks())
        if n > 0:
            own.xaxis.set_ticks_position("bottom")
            own.xaxis.set_label_position("bottom")
            own.spines["bottom"].set_position(("outward", 34.0 * n))
            own.spines["bottom"].set_visible(True)


def _few_ticks() -> Any:
    from matplotlib.ticker import MaxNLocator  # noqa: PLC0415 - start-up counts

    return MaxNLocator(nbins=4)


def _place_text(place: tuple[float, float]) -> str:
    latitude, longitude = place[0], (place[1] + 180.0) % 360.0 - 180.0
    return f"{abs(latitude):.2f}°{'N' if latitude >= 0 else 'S'} {abs(longitude):.2f}°{'E' if longitude >= 0 else 'W'}"
