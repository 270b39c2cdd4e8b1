"""What used the battery's energy, over time."""

from typing import TYPE_CHECKING

import numpy as np
import xarray as xr

from stommel.figures.style import BLUE, INK, MUTED, new_figure, styled
from stommel.simulation.pictures.extracts import (
    READABLE_DIVES,
    Array,
    band,
    days,
    dives_in,
    seconds,
    utc_axis,
    values,
)
from stommel.simulation.results.energy import DRAINS

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

COLOURS = ("#0b62a4", "#c4501b", "#00805f", "#9c4f86", "#c98a00", "#5aa9d6", "#8c6b4f", "#8a93a0", "#3b4652")
"""One for each of `DRAINS`."""
_POINTS = 600
_WATT_HOUR = 3600.0


@styled
def energy_figure(dataset: xr.Dataset) -> "Figure":
    """Draw the energy by what took it, one upon the other; a sentence instead where the vehicle file tells none."""
    time = seconds(dataset)
    stored = float(dataset.attrs["battery_energy_j"]) / _WATT_HOUR
    if not np.isfinite(stored):
        figure = new_figure(7.0, 1.6)
        figure.text(0.5, 0.5, "No energy: the vehicle file describes no battery or consumers", ha="center", color=MUTED)
        return figure
    figure = new_figure(8.8, 6.2)
    axes, below = figure.subplots(2, 1, sharex=True, height_ratios=(3.2, 1.0))
    total = _stack(axes, dataset, time)
    if stored < 1.6 * total:
        axes.axhline(stored, color=INK, linewidth=1.2, linestyle=(0, (6, 2)))
        axes.annotate(f"usable in the battery, {stored:.0f} Wh", (0.0, stored), xytext=(4, -11),
                      xycoords=("axes fraction", "data"), textcoords="offset points")  # fmt: skip
    axes.set_xlim(days(dataset, time)[0], days(dataset, time)[-1])
    axes.set_ylim(bottom=0.0)
    axes.set_title(f"{dataset.attrs['title']}: energy from the battery, {total:.2f} Wh in all")
    axes.set_ylabel("Energy [Wh]")
    _voltage(below, dataset, time)
    utc_axis(below, dataset)
    handles, labels = axes.get_legend_handles_labels()
    figure.legend(handles[::-1], labels[::-1], loc="outside right upper")
    return figure


def _stack(axes: "Axes", dataset: xr.Dataset, time: Array) -> float:
    """Draw the energies one upon the other, the greatest below; returns their sum at the end [Wh]."""
    chosen = np.unique(np.linspace(0, len(time) - 1, min(len(time), _POINTS)).astype(int))
    energies = [values(dataset, f"energy_{name}")[chosen] / _WATT_HOUR for name in DRAINS]
    total = float(sum(curve[-1] for curve in energies))
    order = sorted(range(len(DRAINS)), key=lambda k: -energies[k][-1])
    axes.stackplot(
        days(dataset, time[chosen]),
        *(energies[k] for k in order),
        labels=[f"{DRAINS[k].replace('_', ' ')}, {_share(energies[k][-1], total)}" for k in order],
        colors=[COLOURS[k] for k in order],
        linewidth=0.4,
        edgecolor="white",
    )
    return total


def _share(part: float, total: float) -> str:
    share = part / total if total > 0.0 else 0.0
    return "below 0.1 %" if 0.0 < share < 5e-4 else f"{share:.1%}".replace("%", " %")


def _voltage(axes: "Axes", dataset: xr.Dataset, time: Array) -> None:
    dives, voltage = dives_in(dataset), values(dataset, "battery_voltage")
    if dives > READABLE_DIVES:
        middle, low, high = band(time, voltage, dives)
        axes.fill_between(days(dataset, middle), low, high, color=BLUE, alpha=0.35, linewidth=0.0)
        axes.plot(days(dataset, middle), low, color=BLUE, linewidth=0.9)
        axes.plot(days(dataset, middle), high, color=BLUE, linewidth=0.9)
        axes.set_title("Voltage of the battery, measured [V]: least (under load) to greatest, of each two dives")
    else:
        axes.plot(days(dataset, time), voltage, color=BLUE, linewidth=0.9)
        axes.set_title("Voltage of the battery under load, measured [V]")
