"""The way over ground, with surfacings and the depth-averaged current that they found."""

from typing import TYPE_CHECKING, Any

import numpy as np
import xarray as xr

from stommel.figures.style import BLUE, GREEN, INK, MUTED, VERMILION, new_figure, styled
from stommel.simulation.pictures.extracts import values

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from stommel.ocean import Ocean

_ARROWS = 16
_LEAST_CURRENT = 0.1
"""The scale of the arrows is not finer than this [m/s]: noise must not look like a sea."""
_SHALLOW, _DEEP = "#f3f8fb", "#8fb4d2"


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
                  markersize=3.0, label="surfacings, by GPS")  # fmt: skip
        _currents(axes, dataset)
    axes.set_xlabel("Longitude [deg]")
    axes.set_ylabel("Latitude [deg]")
    axes.ticklabel_format(useOffset=False)
    axes.locator_params(nbins=6)
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
    """Depth of the bottom within the frame, land in sand."""
    from matplotlib.colors import LinearSegmentedColormap  # noqa: PLC0415 - start-up counts
    from matplotlib.ticker import MaxNLocator  # noqa: PLC0415

    grid = ocean.grid()
    latitude, longitude = ocean.node_places()
    depth = np.where(grid.levels > 0, grid.bottom, np.nan)
    if not np.isfinite(depth).any() or np.nanmax(depth) > 2e4:
        return
    south, north, west, east = *axes.get_ylim(), *axes.get_xlim()
    seen = depth[(latitude >= south) & (latitude <= north) & (longitude >= west) & (longitude <= east)]
    seen = seen[np.isfinite(seen)]
    if len(seen) and np.ptp(seen) > 0.0:
        levels: Any = MaxNLocator(10).tick_values(float(seen.min()), float(seen.max()))
    else:
        levels = 10
    colours = LinearSegmentedColormap.from_list("depth", [_SHALLOW, _DEEP])
    filled = axes.contourf(longitude, latitude, depth, levels=levels, cmap=colours, extend="both")
    axes.set_facecolor("#d9d4c9")
    bar = figure.colorbar(filled, ax=axes, label="Depth of the bottom [m]", shrink=0.7, pad=0.01, format="%.0f")
    bar.ax.invert_yaxis()


def _currents(axes: "Axes", dataset: xr.Dataset) -> None:
    """Arrows of the depth-averaged current, found and true, every so many surfacings."""
    every = -(-dataset.sizes["surfacing"] // _ARROWS)
    part = dataset.isel(surfacing=slice(None, None, every))
    places = values(part, "surfacing_longitude"), values(part, "surfacing_latitude")
    found, true = (
        [values(part, f"{kind}_current_{way}") for way in ("east", "north")] for kind in ("depth_averaged", "true")
    )
    strongest = max(_LEAST_CURRENT, float(np.nanmax(np.hypot(*found))))
    unit = float(f"{strongest:.1g}")
    arrows = (("true mean", true, INK, 0.006, 0.075), ("found", found, VERMILION, 0.0028, 0.04))
    for name, (east, north), colour, width, height in arrows:
        drawn = axes.quiver(*places, east, north, color=colour, alpha=0.45 if name == "true mean" else 1.0, width=width,
                            scale=8.0 * strongest, zorder=3)  # fmt: skip
        axes.quiverkey(drawn, 0.70, height, unit, f"{unit:g} m/s, {name}", labelpos="E", coordinates="axes")
    axes.annotate("current of the dives", (0.58, 0.105), xycoords="axes fraction", color=MUTED, fontsize=8.8)
