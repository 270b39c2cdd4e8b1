"""What the CTD measured: temperature and practical salinity over time and depth."""

from typing import TYPE_CHECKING

import numpy as np
import xarray as xr

from stommel.figures.style import MUTED, new_figure, styled
from stommel.simulation.pictures.extracts import Array, date, days, mean_in_cells, seconds, utc_axis, values

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.cm import ScalarMappable
    from matplotlib.figure import Figure

_DOTS = 10_000
"""Samples that are drawn one by one; of more the mean in cells of time and depth."""
_PER_CELL = 400
"""Samples for each column of cells."""
_SPIKES = (0.5, 99.5)
"""Percentiles between which the colours lie: single spikes of salinity must not wash them out."""

_ROOM = 1e5
"""Area of a panel [pt2], which the samples share."""


@styled
def ctd_figure(dataset: xr.Dataset) -> "Figure":
    """Draw the samples where they were taken; a sentence instead where none was."""
    if not dataset.sizes["sample"]:
        figure = new_figure(7.0, 1.6)
        figure.text(0.5, 0.5, "No samples of the CTD in this mission", ha="center", color=MUTED)
        return figure
    time, pressure = seconds(dataset, "sample_time", dataset["time"].values[0]), values(dataset, "sample_pressure")
    figure = new_figure(9.4, 6.6)
    figure.suptitle(f"{dataset.attrs['title']}: samples of the CTD, from {date(dataset)}", fontsize=9.5, x=0.012,
                    ha="left")  # fmt: skip
    panels = (
        ("sample_temperature", "Temperature [°C]", "plasma", 0.05),
        ("sample_practical_salinity", "Practical salinity", "viridis", 0.005),
    )
    for axes, (name, title, colours, least_span) in zip(figure.subplots(2, 1, sharex=True), panels, strict=True):
        drawn = _section(axes, days(dataset, time), pressure, values(dataset, name), colours, least_span)
        axes.set_ylim(1.03 * max(float(pressure.max()), 1e-3), 0.0)
        axes.set_ylabel("Sea pressure [dbar]")
        axes.grid(visible=False)
        bar = figure.colorbar(drawn, ax=axes, label=title, pad=0.01, extend="both")
        bar.formatter.set_useOffset(False)  # type: ignore[attr-defined]  # a ScalarFormatter where colours are linear
    axes.set_xlim(*days(dataset, seconds(dataset)[[0, -1]]))
    utc_axis(axes, dataset)
    return figure


def _section(
    axes: "Axes", time: Array, pressure: Array, measured: Array, colours: str, least_span: float
) -> "ScalarMappable":
    """Every sample where it was taken, or their means in cells where there are too many."""
    low, high = _limits(measured, least_span)
    if len(time) <= _DOTS:
        size = float(np.clip(_ROOM / len(time), 3.0, 40.0))
        return axes.scatter(time, pressure, c=measured, s=size, marker="s", cmap=colours, vmin=low, vmax=high,
                            linewidths=0, rasterized=True)  # fmt: skip
    columns = min(200, len(time) // _PER_CELL)
    edges, levels, mean = mean_in_cells(time, pressure, measured, float(pressure.max()), columns)
    return axes.pcolormesh(edges, levels, mean, cmap=colours, vmin=low, vmax=high, rasterized=True)


def _limits(measured: Array, least_span: float) -> tuple[float, float]:
    """Colour limits; a constant must not look like structure."""
    low, high = (float(end) for end in np.percentile(measured[np.isfinite(measured)], _SPIKES))
    middle, half = 0.5 * (low + high), 0.5 * max(high - low, least_span)
    return middle - half, middle + half
