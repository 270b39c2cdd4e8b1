"""The sawtooth of the dives over the density that the vehicle met."""

from typing import TYPE_CHECKING

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from stommel.design.plots.style import INK, MUTED, new_figure, styled
from stommel.simulation.pictures.extracts import date, fitting_unit, seconds, values

if TYPE_CHECKING:
    from matplotlib.figure import Figure

Array = NDArray[np.float64]

_LONGEST_SAWTOOTH = 3.0 * 86400.0
"""Over a longer mission single dives cannot be told apart; the panel below shows so much of its start [s]."""


@styled
def sawtooth_figure(dataset: xr.Dataset) -> "Figure":
    """Draw density over time and depth, averaged in cells between the dives, with the path and the bottom."""
    time, depth = seconds(dataset), values(dataset, "depth")
    whole = float(time[-1]) <= _LONGEST_SAWTOOTH
    figure = new_figure(9.4, 4.2 if whole else 7.4)
    figure.suptitle(f"{dataset.attrs['title']}: sawtooth over density, from {date(dataset)}", fontsize=9.5, x=0.012,
                    ha="left")  # fmt: skip
    panels = figure.subplots(1 if whole else 2, 1, squeeze=False).ravel()
    density = values(dataset, "density")
    limits = (float(np.nanmin(density)), max(float(np.nanmax(density)), float(np.nanmin(density)) + 0.1))
    spans = [float(time[-1])] if whole else [float(time[-1]), _LONGEST_SAWTOOTH / 3.0]
    for axes, span in zip(panels, spans, strict=True):
        unit, length = fitting_unit(span)
        kept = time <= span
        edges, levels, mean = _cells(time[kept], depth[kept], density[kept])
        mesh = axes.pcolormesh(edges / length, levels, mean, cmap="YlGnBu", vmin=limits[0], vmax=limits[1],
                               rasterized=True)  # fmt: skip
        if span <= _LONGEST_SAWTOOTH:
            axes.plot(time[kept] / length, depth[kept], color=INK, linewidth=0.9)
        bottom = values(dataset, "bottom_depth")[kept]
        if np.nanmin(bottom, initial=np.inf) < 2.0 * depth.max():
            axes.plot(time[kept] / length, bottom, color=MUTED, linewidth=1.4)
            axes.fill_between(time[kept] / length, bottom, 1e5, color="#d9d4c9", linewidth=0)
        axes.set_ylim(1.06 * max(depth.max(), 1e-3), 0.0)
        axes.set_xlim(0.0, span / length)
        axes.grid(visible=False)
        axes.set_xlabel(f"Time [{unit}]")
        axes.set_ylabel("Depth [m]")
    figure.colorbar(mesh, ax=list(panels), label="Density in situ [kg/m³]", pad=0.01)
    return figure


def _cells(time: Array, depth: Array, density: Array) -> tuple[Array, Array, Array]:
    """Mean density in cells of time and depth; cells that no dive crossed take the last value before them."""
    columns, rows = min(160, max(8, len(time) // 60)), 50
    edges, levels = np.linspace(time[0], time[-1], columns + 1), np.linspace(0.0, max(depth.max(), 1e-3), rows + 1)
    i = np.clip(np.searchsorted(edges, time, side="right") - 1, 0, columns - 1)
    j = np.clip(np.searchsorted(levels, depth, side="right") - 1, 0, rows - 1)
    cell = j * columns + i
    count = np.bincount(cell, minlength=rows * columns)
    total = np.bincount(cell, weights=density, minlength=rows * columns)
    with np.errstate(invalid="ignore"):
        mean = np.where(count > 0, total / count, np.nan).reshape(rows, columns)
    return edges, levels, np.array([_filled(row) for row in mean])


def _filled(row: Array) -> Array:
    """A row of cells with its gaps filled from the left, and the first from the right."""
    known = np.flatnonzero(np.isfinite(row))
    if len(known) == 0:
        return row
    last = np.maximum.accumulate(np.where(np.isfinite(row), np.arange(len(row)), known[0]))
    return np.asarray(row[last])
