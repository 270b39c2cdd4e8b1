"""Who used the battery's energy, over time."""

from typing import TYPE_CHECKING

import numpy as np
import xarray as xr

from stommel.figures.style import BLUE, INK, MUTED, new_figure, styled
from stommel.simulation.pictures.extracts import fitting_unit, seconds, thinned, values
from stommel.simulation.plant.parameters import CONSUMERS

if TYPE_CHECKING:
    from matplotlib.figure import Figure

COLOURS = ("#0b62a4", "#c4501b", "#00805f", "#9c4f86", "#c98a00", "#5aa9d6", "#8c6b4f", "#8a93a0")
"""One for each consumer."""
_POINTS = 600
_WATT_HOUR = 3600.0


@styled
def energy_figure(dataset: xr.Dataset) -> "Figure":
    """Draw the energy by consumer, one upon the other; a sentence instead where the vehicle file tells none."""
    time = seconds(dataset)
    stored = float(dataset.attrs["battery_energy_j"]) / _WATT_HOUR
    if not np.isfinite(stored):
        figure = new_figure(7.0, 1.6)
        figure.text(0.5, 0.5, "No energy: the vehicle file describes no battery or consumers", ha="center", color=MUTED)
        return figure
    figure = new_figure(8.8, 6.2)
    axes, below = figure.subplots(2, 1, sharex=True, height_ratios=(3.2, 1.0))
    chosen = np.unique(np.linspace(0, len(time) - 1, min(len(time), _POINTS)).astype(int))
    unit, length = fitting_unit(float(time[-1]))
    energies = {name: values(dataset, f"energy_{name}")[chosen] / _WATT_HOUR for name in CONSUMERS}
    order = sorted(range(len(CONSUMERS)), key=lambda k: -energies[CONSUMERS[k]][-1])
    total = sum(energies[name][-1] for name in CONSUMERS)
    axes.stackplot(
        time[chosen] / length,
        *(energies[CONSUMERS[k]] for k in order),
        labels=[f"{CONSUMERS[k].replace('_', ' ')}, {energies[CONSUMERS[k]][-1] / total:.0%}" for k in order],
        colors=[COLOURS[k] for k in order],
        linewidth=0.4,
        edgecolor="white",
    )
    if stored < 1.6 * total:
        axes.axhline(stored, color=INK, linewidth=1.2, linestyle=(0, (6, 2)))
        axes.annotate(f"usable in the battery, {stored:.0f} Wh", (0.0, stored), xytext=(4, -11),
                      textcoords="offset points")  # fmt: skip
    axes.set_xlim(0.0, time[-1] / length)
    axes.set_ylim(bottom=0.0)
    axes.set_title(f"{dataset.attrs['title']}: energy from the battery [Wh], {total:.4g} in all")
    below.plot(*thinned(time / length, values(dataset, "battery_voltage"), 2 * _POINTS), color=BLUE, linewidth=0.9)
    below.set_title("Voltage of the battery under load, measured [V]")
    below.set_xlabel(f"Time [{unit}]")
    handles, labels = axes.get_legend_handles_labels()
    figure.legend(handles[::-1], labels[::-1], loc="outside right upper")
    return figure
