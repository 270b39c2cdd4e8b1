"""The way over ground: waypoints with their radius and the planned legs, surfacings, the currents that they found."""

from typing import TYPE_CHECKING, Any

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from stommel.errors import StommelError
from stommel.figures.style import BLUE, GREEN, INK, MUTED, VERMILION, new_figure, styled
from stommel.geometry.geodesics import travel
from stommel.ocean.errors import LandError
from stommel.simulation.pictures.extracts import values
from stommel.simulation.pictures.map_frame import Frame, frame_of
from stommel.simulation.results.verdict import length

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from stommel.ocean import Ocean

Array = NDArray[np.float64]

_ARROWS = 16
_LEAST_CURRENT = 0.1
"""The scale of the arrows is not finer than this [m/s]: noise must not look like a sea."""
_SHALLOW, _DEEP, _LAND = "#f3f8fb", "#8fb4d2", "#d9d4c9"
_LONGER_IN = 6.6
"""Longer side of the map."""
_NEAR = 0.6
"""Waypoints farther from the track than this share of its extent are pointed at, not shown."""
_METRES = 111e3
"""In a degree, about."""
_NODES = 70
"""Depths of the bottom along the longer side."""
_NARROW = 0.75
"""Of width over height: beside a narrower map there is room for its legend."""
_MOST_SURFACINGS = 150
"""More dots lie upon each other; then only some are drawn, and the legend says so."""
_CIRCLE = np.linspace(0.0, 360.0, 73)
_MOST_WAYPOINTS = 40
"""With `repeat` they lie upon each other."""


@styled
def map_figure(dataset: xr.Dataset, ocean: "Ocean | None" = None) -> "Figure":
    """Draw track, waypoints, radius and planned legs; with an ocean, the depth of its bottom around them."""
    latitude, longitude = values(dataset, "latitude"), values(dataset, "longitude")
    places = _waypoints(dataset)
    frame = _frame(dataset, latitude, longitude, places)
    with_bottom = ocean is not None and ocean.grid().x.size > 1
    beside = frame.aspect < _NARROW
    width = _LONGER_IN * min(1.0, frame.aspect) + (2.1 if with_bottom else 1.0) + (3.1 if beside else 0.0)
    figure = new_figure(max(width, 7.2), _LONGER_IN * min(1.0, 1.0 / frame.aspect) + (1.1 if beside else 2.0))
    axes = figure.subplots()
    figure.suptitle(f"{dataset.attrs['title']}: the way over ground\n{dataset.attrs['verdict']}", fontsize=9.5, x=0.012,
                    ha="left")  # fmt: skip
    frame.set_on(axes)
    if with_bottom and ocean is not None:
        _bottom(figure, axes, ocean, frame)
    _plan(axes, dataset, frame, places)
    axes.plot(frame.around(longitude), latitude, color=BLUE, linewidth=1.6, label="way over ground")
    axes.plot(frame.around(longitude[:1]), latitude[:1], "o", color=GREEN, markersize=7, label="start")
    axes.plot(frame.around(longitude[-1:]), latitude[-1:], "s", color=VERMILION, markersize=6, label="end")
    if dataset.sizes["surfacing"]:
        _surfacings(axes, dataset, frame)
        _currents(figure, axes, dataset, frame, beside=beside)
    handles, labels = axes.get_legend_handles_labels()
    if beside:
        figure.legend(handles, labels, loc="outside right center")
    else:
        figure.legend(handles, labels, loc="outside lower left", ncols=2)
    return figure


def _surfacings(axes: "Axes", dataset: xr.Dataset, frame: Frame) -> None:
    every = -(-dataset.sizes["surfacing"] // _MOST_SURFACINGS)
    part = dataset.isel(surfacing=slice(None, None, every))
    label = "surfacings, by GPS" if every == 1 else f"every {every}th surfacing, by GPS"
    axes.plot(frame.around(values(part, "surfacing_longitude")), values(part, "surfacing_latitude"), ".",
              color=INK, markersize=3.0 if every == 1 else 1.6, label=label)  # fmt: skip


def _waypoints(dataset: xr.Dataset) -> Array:
    """Latitude and longitude, a row each [deg]."""
    count = min(dataset.sizes["waypoint"], _MOST_WAYPOINTS)
    return np.column_stack([values(dataset, f"waypoint_{name}")[:count] for name in ("latitude", "longitude")])


def _frame(dataset: xr.Dataset, latitude: Array, longitude: Array, places: Array) -> Frame:
    """Frame around the track, and around the waypoints that are not far from it with their radius."""
    track = frame_of(latitude, longitude)
    near = _NEAR * max(track.north - track.south, (track.east - track.west) * track.squeeze)
    away = np.maximum(
        np.maximum(track.south - places[:, 0], places[:, 0] - track.north),
        np.maximum(track.west - track.around(places[:, 1]), track.around(places[:, 1]) - track.east) * track.squeeze,
    )
    shown = places[away < near]
    radius = float(dataset["acceptance_radius"])
    if radius < near / _NEAR * _METRES:
        around = [travel(at, east, bearing, radius) for at, east in shown for bearing in (0.0, 90.0, 180.0, 270.0)]
        shown = np.concatenate([shown, np.array(around).reshape(-1, 2)])
    return frame_of(np.concatenate([latitude, shown[:, 0]]), np.concatenate([longitude, shown[:, 1]]))


def _plan(axes: "Axes", dataset: xr.Dataset, frame: Frame, places: Array) -> None:
    """Planned legs, and each waypoint with its radius and number; an arrow towards those outside."""
    if not len(places):
        return
    start = values(dataset, "latitude")[0], values(dataset, "longitude")[0]
    latitude, longitude = np.concatenate([[start[0]], places[:, 0]]), np.concatenate([[start[1]], places[:, 1]])
    # a leg goes the shorter way around the Earth
    longitude = frame.around(longitude[:1]) + np.concatenate([[0.0], np.cumsum((np.diff(longitude) + 180) % 360 - 180)])
    axes.plot(longitude, latitude, color=MUTED, linewidth=1.1, linestyle=(0, (5, 3)), label="planned legs", zorder=1.8)
    radius, reached = float(dataset["acceptance_radius"]), dataset["waypoint_reached"].values
    named: set[str] = set()
    told: set[tuple[float, float]] = set()
    for k, (at, east) in enumerate(zip(latitude[1:], longitude[1:], strict=True)):
        colour, state = (GREEN, "reached") if reached[k] else (VERMILION, "not reached")
        label = f"waypoint {state}, radius {length(radius)}"
        circle = [travel(at, east, bearing, radius) for bearing in _CIRCLE]
        beside = east + (np.array([place.longitude_deg for place in circle]) - east + 180.0) % 360.0 - 180.0
        axes.plot(beside, [place.latitude_deg for place in circle], color=colour, linewidth=1.1, zorder=2.2)
        axes.plot([east], [at], "P" if reached[k] else "X", color=colour, markersize=8, markeredgecolor="white",
                  linestyle="none", zorder=4, label=label if label not in named else None)  # fmt: skip
        named.add(label)
        if frame.holds(at, east) and (at, east) not in told:
            told.add((at, east))
            axes.annotate(str(k + 1), (east, at), xytext=(6, 5), textcoords="offset points", fontsize=9)
    _point_outside(axes, dataset, frame, latitude, longitude)


def _point_outside(axes: "Axes", dataset: xr.Dataset, frame: Frame, latitude: Array, longitude: Array) -> None:
    """Say where the first waypoint lies that is outside of the frame, and how far from the end of the track."""
    outside = [k for k in range(1, len(latitude)) if not (
        frame.south <= latitude[k] <= frame.north and frame.west <= longitude[k] <= frame.east)]  # fmt: skip
    if not outside:
        return
    k = outside[0]
    before = np.array([longitude[k - 1], latitude[k - 1]])
    way = np.array([longitude[k], latitude[k]]) - before
    low, high = np.array([frame.west, frame.south]), np.array([frame.east, frame.north])
    with np.errstate(divide="ignore", invalid="ignore"):
        edges = np.where(way > 0.0, (high - before) / way, (low - before) / way)
    share = float(np.nanmin(np.where(way == 0.0, np.inf, edges)))
    tip, tail = before + share * way, before + 0.9 * share * way
    axes.annotate("", tip, tail, arrowprops={"arrowstyle": "-|>", "color": VERMILION, "linewidth": 1.3})
    middle = 0.5 * (frame.west + frame.east) + 1e-9
    away = length(float(dataset["waypoint_distance"].values[k - 1]))
    left = tail[0] > middle
    axes.annotate(f"to waypoint {k}, {away}", tail, xytext=(-8 if left else 8, 0), textcoords="offset points",
                  color=VERMILION, fontsize=8.8, va="center", ha="right" if left else "left")  # fmt: skip


def _bottom(figure: "Figure", axes: "Axes", ocean: "Ocean", frame: Frame) -> None:
    """Depth of the bottom within the frame, as a mission meets it; land in sand, white beyond the data."""
    from matplotlib.colors import LinearSegmentedColormap  # noqa: PLC0415 - start-up counts
    from matplotlib.ticker import MaxNLocator  # noqa: PLC0415

    east = np.linspace(frame.west, frame.east, max(8, round(_NODES * min(1.0, frame.aspect))))
    north = np.linspace(frame.south, frame.north, max(8, round(_NODES * min(1.0, 1.0 / frame.aspect))))
    depth, land = _depths(ocean, np.clip(north, -90.0, 90.0), east)
    if land.any():
        axes.contourf(east, north, land, levels=[0.5, 1.5], colors=[_LAND])
    if not np.isfinite(depth).any():
        return
    levels: Any = MaxNLocator(10).tick_values(float(np.nanmin(depth)), float(np.nanmax(depth)))
    if np.nanmin(depth) == np.nanmax(depth):
        return
    colours = LinearSegmentedColormap.from_list("depth", [_SHALLOW, _DEEP])
    filled = axes.contourf(east, north, depth, levels=levels, cmap=colours)
    bar = figure.colorbar(filled, ax=axes, label="Depth of the bottom [m]", shrink=0.7, pad=0.01, format="%.0f")
    bar.ax.invert_yaxis()


def _depths(ocean: "Ocean", north: Array, east: Array) -> tuple[Array, Array]:
    """Depth of the bottom, not a number where there is none; and where land is, as 1."""
    depth, land = np.full((len(north), len(east)), np.nan), np.zeros((len(north), len(east)))
    for j, latitude in enumerate(north):
        for i, longitude in enumerate(east):
            try:
                found = ocean.bottom_depth(float(latitude), float(longitude))
            except LandError:
                land[j, i] = 1.0
            except StommelError:
                continue
            else:
                depth[j, i] = found if np.isfinite(found) else np.nan
    return depth, land


def _currents(figure: "Figure", axes: "Axes", dataset: xr.Dataset, frame: Frame, *, beside: bool) -> None:
    """Arrows of the depth-averaged current, found and true, every so many surfacings; their key beside or below."""
    every = -(-dataset.sizes["surfacing"] // _ARROWS)
    part = dataset.isel(surfacing=slice(None, None, every))
    places = frame.around(values(part, "surfacing_longitude")), values(part, "surfacing_latitude")
    found, true = (
        [values(part, f"{kind}_current_{way}") for way in ("east", "north")] for kind in ("depth_averaged", "true")
    )
    strongest = max(_LEAST_CURRENT, float(np.nanmax(np.hypot(*found))))
    unit = float(f"{strongest:.1g}")
    width, height = figure.get_size_inches()
    at = (1.0 - 2.0 / width, 0.25) if beside else (max(0.5, 1.0 - 2.2 / width), 0.55 / height)
    figure.text(at[0] - 0.7 / width, at[1], "current of the dives", color=MUTED, fontsize=8.8)
    arrows = (("true mean", true, INK, 0.045), ("found", found, VERMILION, 0.02))
    for k, (name, (east, north), colour, thick) in enumerate(arrows):
        drawn = axes.quiver(*places, east, north, color=colour, alpha=0.45 if name == "true mean" else 1.0, gid=name,
                            width=thick, units="inches", scale_units="inches", scale=1.4 * strongest,
                            zorder=3)  # fmt: skip
        axes.quiverkey(drawn, at[0], at[1] - (0.2 + 0.22 * k) / height, unit, f"{unit:g} m/s, {name}", labelpos="E",
                       coordinates="figure", fontproperties={"size": 8.8})  # fmt: skip
