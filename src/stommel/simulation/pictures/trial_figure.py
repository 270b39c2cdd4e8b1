"""The three panels of the paper's Fig. 17: volume of the bladder, attitude, path."""

from typing import TYPE_CHECKING

import xarray as xr

from stommel.figures.style import BLUE, GREEN, MUTED, PURPLE, VERMILION, new_figure, styled
from stommel.simulation.pictures.extracts import (
    Array,
    date,
    first_dives,
    fitting_unit,
    seconds,
    travelled,
    unbroken,
    values,
)

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

DIVES = 4
"""The first dives show it; more would be a comb."""


@styled
def trial_figure(dataset: xr.Dataset) -> "Figure":
    """Draw bladder volume and attitude over time, and depth over the way, of the first dives."""
    part = first_dives(dataset, DIVES)
    time = seconds(part)
    unit, length = fitting_unit(float(time[-1]))
    figure = new_figure(8.4, 8.6)
    figure.suptitle(f"{dataset.attrs['title']}: the first dives, from {date(part)}", fontsize=9.5, x=0.012, ha="left")
    volume, attitude, path = figure.subplots(3, 1)
    volume.plot(time / length, values(part, "ballast_volume"), color=BLUE)
    volume.set_title("Varied volume of the bladder [ml]")
    _attitude(attitude, part, time / length)
    for axes in (volume, attitude):
        axes.set_xlabel(f"Time [{unit}]")
        axes.set_xlim(0.0, time[-1] / length)
    _path(path, part)
    return figure


def _attitude(axes: "Axes", part: xr.Dataset, time: Array) -> None:
    """Measured angles strong, true ones thin above them: the difference is the sensors'."""
    heading = unbroken(values(part, "measured_heading"))
    true = heading + (values(part, "heading") - heading + 180.0) % 360.0 - 180.0
    axes.plot(time, values(part, "measured_pitch"), color=VERMILION, linewidth=1.2, label="pitch, measured")
    axes.plot(time, values(part, "roll"), color=GREEN, linewidth=1.2, label="roll, true", linestyle=(0, (6, 2)))
    axes.plot(time, heading, color=PURPLE, linewidth=1.0, label="heading, measured")
    axes.plot(time, true, color=MUTED, linewidth=1.6, linestyle=(0, (4, 1)), label="heading, true")
    axes.set_title("Attitude [deg]")
    axes.legend(loc="lower center", bbox_to_anchor=(0.55, 1.0), ncols=4, columnspacing=1.2)


def _path(axes: "Axes", part: xr.Dataset) -> None:
    way = travelled(part)
    scale, unit = (1e3, "km") if way[-1] > 3000.0 else (1.0, "m")
    axes.plot(way / scale, values(part, "depth"), color=BLUE)
    bottom = values(part, "bottom_depth")
    if (bottom < 2.0 * values(part, "depth").max()).any():
        axes.plot(way / scale, bottom, color=MUTED, linewidth=1.2, label="bottom")
        axes.legend(loc="lower right")
    axes.invert_yaxis()
    axes.set_xlim(0.0, max(way[-1] / scale, 1e-9))
    axes.set_title("Path: depth [m] over the way")
    axes.set_xlabel(f"Horizontal way over ground [{unit}]")
