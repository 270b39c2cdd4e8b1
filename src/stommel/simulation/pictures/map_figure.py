"""The way over ground, with surfacings and the depth-averaged current that they found."""

from typing import TYPE_CHECKING

import numpy as np
import xarray as xr

from stommel.design.plots.style import BLUE, GREEN, INK, MUTED, VERMILION, new_figure, styled
from stommel.simulation.pictures.extracts import positions, thinned, values

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from stommel.ocean import Ocean

_ARROWS = 40
_LEAST_CURRENT = 0.005
"""Currents below this are noise, not arrows [m/s]."""


@styled
def map_figure(dataset: xr.Dataset, ocean: "Ocean | None" = None) -> "Figure":
    """Draw the track; with an ocean, the depth of its bottom around it."""
    figure = new_figure(7.6, 7.2)
    axes = figure.subplots()
    axes.set_title(f"{dataset.attrs['title']}: the way over ground")
    latitude, longitude = values(dataset, "latitude"), values(dataset, "longitude")
    _frame(axes, latitude, longitude)
    if ocean is not None and ocean.grid().x.size > 1:
        _bottom(figure, axes, ocean)
    axes.plot(longitude, latitude, color=BLUE, linewidth=1.4, label="way over ground")
    axes.plot(longitude[0], latitude[0], "o", color=GREEN, markersize=7, label="start")
    axes.plot(longitude[-1], latitude[-1], "s", color=VERMILION, markersize=6, label="end")
    if dataset.sizes["surfacing"]:
        axes.plot(values(dataset, "surfacing_longitude"), values(dataset, "surfacing_latitude"), ".", color=INK,
                  markersize=3.0, label="surfacings")  # fmt: skip
        _currents(axes, dataset)
    axes.set_xlabel("Longitude [deg]")
    axes.set_ylabel("Latitude [deg]")
    axes.ticklabel_format(useOffset=False)
    handles, labels = axes.get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside lower left", ncols=4)
    return figure


def _frame(axes: "Axes", latitude: np.ndarray, longitude: np.ndarray) -> None:
    """Square frame around the track, true to scale at its middle."""
    middle = 0.5 * (latitude.min() + latitude.max()), 0.5 * (longitude.min() + longitude.max())
    squeeze = np.cos(np.radians(middle[0]))
    reach = 0.62 * max(np.ptp(latitude), np.ptp(longitude) * squeeze, 1e-5)
    axes.set_ylim(middle[0] - reach, middle[0] + reach)
    axes.set_xlim(middle[1] - reach / squeeze, middle[1] + reach / squeeze)
    axes.set_aspect(1.0 / squeeze)
    axes.set_autoscale_on(False)


def _bottom(figure: "Figure", axes: "Axes", ocean: "Ocean") -> None:
    grid = ocean.grid()
    latitude, longitude = ocean.node_places()
    depth = np.where(grid.levels > 0, grid.bottom, np.nan)
    if not np.isfinite(depth).any() or np.nanmax(depth) > 2e4:
        return
    filled = axes.contourf(longitude, latitude, depth, levels=12, cmap="Blues", alpha=0.45)
    axes.set_facecolor("#d9d4c9")
    figure.colorbar(filled, ax=axes, label="Depth of the bottom [m]", shrink=0.7, pad=0.01)


def _currents(axes: "Axes", dataset: xr.Dataset) -> None:
    """Arrows of the depth-averaged current, every so many surfacings."""
    every = max(1, dataset.sizes["surfacing"] // _ARROWS)
    part = dataset.isel(surfacing=slice(None, None, every))
    east, north = (values(part, f"depth_averaged_current_{way}") for way in ("east", "north"))
    strongest = float(np.hypot(east, north).max())
    if strongest < _LEAST_CURRENT:
        axes.annotate("no current found", (0.02, 0.02), xycoords="axes fraction", color=MUTED)
        return
    arrows = axes.quiver(values(part, "surfacing_longitude"), values(part, "surfacing_latitude"), east, north,
                         color=VERMILION, width=0.0028, scale=8.0 * strongest, zorder=3)  # fmt: skip
    unit = float(f"{strongest:.1g}")
    axes.quiverkey(arrows, 0.86, 0.04, unit, f"{unit:g} m/s", labelpos="E", coordinates="axes")


def track(dataset: xr.Dataset, most: int) -> tuple[np.ndarray, np.ndarray]:
    """Kilometres east and north of the start, thinned to about `most` points."""
    east, north = positions(dataset)
    kept, _ = thinned(np.arange(len(east), dtype=float), north, most)
    chosen = kept.astype(int)
    return east[chosen], north[chosen]
