"""The sawtooth of the dives over the density that the vehicle met."""

from typing import TYPE_CHECKING

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from stommel.control.dive_cycle import PHASES
from stommel.figures.style import INK, MUTED, VERMILION, new_figure, styled
from stommel.simulation.pictures.extracts import (
    date,
    dives_in,
    first_dives,
    fitting_unit,
    mean_in_cells,
    seconds,
    values,
)

if TYPE_CHECKING:
    from matplotlib.axes import Axes
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
    span, deepest = float(time[-1]), max(1.04 * float(depth.max()), 1e-3)
    unit, length = fitting_unit(span)
    columns = min(160, max(8, len(time) // 60))
    edges, levels, mean = mean_in_cells(time, depth, values(part, "density"), deepest, columns)
    filled = np.array([_filled(row) for row in mean])
    axes.pcolormesh(edges / length, levels, filled, cmap="YlGnBu", vmin=limits[0], vmax=limits[1], rasterized=True)
    if with_path:
        axes.plot(time / length, depth, color=INK, linewidth=1.0)
        _drift(axes, part, time / length, depth)
    bottom = values(part, "bottom_depth")
    shown = _BOTTOM_SHOWN * float(depth.max())
    if np.nanmin(bottom, initial=np.inf) < shown:
        deepest = max(deepest, min(1.04 * float(np.nanmax(bottom)), shown))
        axes.plot(time / length, bottom, color=MUTED, linewidth=1.4)
        axes.fill_between(time / length, bottom, 1e5, color="#d9d4c9", linewidth=0)
    axes.set_ylim(deepest, 0.0)
    axes.set_xlim(0.0, span / length)
    axes.grid(visible=False)
    axes.set_xlabel(f"Time [{unit}]")
    axes.set_ylabel("Depth [m]")


def _drift(axes: "Axes", part: xr.Dataset, time: Array, depth: Array) -> None:
    """Draw over the path where the vehicle hangs in the water."""
    drifting = part["phase"].values == PHASES.index("drift")
    if drifting.any():
        axes.plot(time, np.where(drifting, depth, np.nan), color=VERMILION, linewidth=2.4, label="drift")
        axes.legend(loc="lower right", framealpha=0.85, frameon=True)


def _filled(row: Array) -> Array:
    """A row of cells where those that no dive crossed take the last value before them, the first the next."""
    known = np.flatnonzero(np.isfinite(row))
    if len(known) == 0:
        return row
    last = np.maximum.accumulate(np.where(np.isfinite(row), np.arange(len(row)), known[0]))
    return np.asarray(row[last])
