"""The sawtooth of the dives over the density that the vehicle met."""

from typing import TYPE_CHECKING

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from stommel.control.dive_cycle import PHASES
from stommel.figures.style import INK, MUTED, VERMILION, new_figure, styled
from stommel.simulation.pictures.extracts import (
    date,
    days,
    dives_in,
    first_dives,
    mean_in_cells,
    seconds,
    utc_axis,
    values,
)

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.colors import Colormap
    from matplotlib.figure import Figure

Array = NDArray[np.float64]

_READABLE_DIVES = 16
"""More dives side by side hide the water; then a panel of its own shows so many."""
_LEAST_SPAN = 0.1
"""Of the colours [kg/m3]: water of one density must not look stratified."""

_BOTTOM_SHOWN = 1.5
"""The bottom is drawn down to so many times the deepest dive."""


@styled
def sawtooth_figure(dataset: xr.Dataset) -> "Figure":
    """Draw density over time and depth, averaged in cells between the dives, with the path and the bottom."""
    many = dives_in(dataset) > _READABLE_DIVES
    figure = new_figure(9.4, 7.4 if many else 4.2)
    figure.suptitle(f"{dataset.attrs['title']}: sawtooth over density, from {date(dataset)}", fontsize=9.5, x=0.012,
                    ha="left")  # fmt: skip
    panels = figure.subplots(2 if many else 1, 1, squeeze=False).ravel()
    density = values(dataset, "density")
    low, high = float(np.nanmin(density)), float(np.nanmax(density))
    limits = (low, max(high, low + _LEAST_SPAN))
    parts = [dataset, first_dives(dataset, _READABLE_DIVES)] if many else [dataset]
    for axes, part in zip(panels, parts, strict=True):
        _panel(axes, part, limits, with_path=part is parts[-1])
    figure.colorbar(axes.collections[0], ax=list(panels), label="Density in situ [kg/m³]", pad=0.01)
    return figure


def _panel(axes: "Axes", part: xr.Dataset, limits: tuple[float, float], *, with_path: bool) -> None:
    time, depth = seconds(part), values(part, "depth")
    deepest = max(1.04 * float(depth.max()), 1e-3)
    # a column of cells for each dive: narrower ones are crossed at other depths each, and look striped
    dives = dives_in(part)
    columns = min(160, max(8, len(time) // 60 if with_path else dives))
    edges, levels, mean = mean_in_cells(time, depth, values(part, "density"), deepest, columns)
    often = np.flatnonzero(np.isfinite(mean).sum(axis=1) >= 0.5 * min(dives, columns))
    mean[int(often.max(initial=0)) + 1 :] = np.nan  # where only the deepest dives have been
    filled = np.array([_filled(row) for row in mean])
    axes.pcolormesh(days(part, edges), levels, filled, cmap=_colours(), vmin=limits[0], vmax=limits[1], rasterized=True)
    time = days(part, time)
    if with_path:
        axes.plot(time, depth, color=INK, linewidth=1.0)
        _drift(axes, part, time, depth)
    bottom = values(part, "bottom_depth")
    shown = _BOTTOM_SHOWN * float(depth.max())
    if np.nanmin(bottom, initial=np.inf) < shown:
        deepest = max(deepest, min(1.04 * float(np.nanmax(bottom)), shown))
        axes.plot(time, bottom, color=MUTED, linewidth=1.4)
        axes.fill_between(time, bottom, 1e5, color="#d9d4c9", linewidth=0)
    axes.set_ylim(deepest, 0.0)
    axes.set_xlim(time[0], time[-1])
    axes.grid(visible=False)
    utc_axis(axes, part)
    axes.set_ylabel("Depth [m]")


def _colours() -> "Colormap":
    """Colours on which the path can be read at the dense end too."""
    from matplotlib import colormaps  # noqa: PLC0415 - start-up counts
    from matplotlib.colors import ListedColormap  # noqa: PLC0415

    return ListedColormap(colormaps["YlGnBu"](np.linspace(0.0, 0.68, 200)))


def _drift(axes: "Axes", part: xr.Dataset, time: Array, depth: Array) -> None:
    """Draw over the path where the vehicle hangs in the water."""
    drifting = part["phase"].values == PHASES.index("drift")
    if drifting.any():
        axes.plot(time, np.where(drifting, depth, np.nan), color=VERMILION, linewidth=2.4, label="drift")
        axes.legend(loc="lower right", framealpha=0.85, frameon=True)


def _filled(row: Array) -> Array:
    """A row of cells where those that no dive crossed take the nearest value."""
    known = np.flatnonzero(np.isfinite(row))
    if len(known) == 0:
        return row
    cells = np.arange(len(row))
    after = np.clip(np.searchsorted(known, cells), 0, len(known) - 1)
    before = np.maximum(after - 1, 0)
    nearest = np.where(np.abs(known[before] - cells) <= np.abs(known[after] - cells), known[before], known[after])
    return np.asarray(row[nearest])
