"""What the actuators did in the first dives: oil, moving mass, rudder or rolling mass, and the angles that follow."""

from typing import TYPE_CHECKING

import numpy as np
import xarray as xr

from stommel.figures.style import BLUE, GREEN, PURPLE, VERMILION, new_figure, styled
from stommel.simulation.pictures.extracts import date, first_dives, fitting_unit, seconds, unbroken, values
from stommel.simulation.pictures.phases import legend_of, shade_phases
from stommel.simulation.pictures.trial_figure import DIVES

if TYPE_CHECKING:
    from matplotlib.figure import Figure


@styled
def actuators_figure(dataset: xr.Dataset) -> "Figure":
    """Draw ballast, moving mass, steering, pitch and heading of the first dives, with the phases behind them."""
    part = first_dives(dataset, DIVES)
    time = seconds(part)
    unit, length = fitting_unit(float(time[-1]))
    by_mass = bool(np.any(values(dataset, "roll_mass_angle") != 0.0))
    steering = ("roll_mass_angle", "Roll angle of the mass [deg]") if by_mass else ("rudder_angle", "Rudder [deg]")
    panels = (
        ("depth", values(part, "depth"), "Depth [m]", BLUE),
        ("ballast", values(part, "ballast_volume"), "Ballast volume [ml]", BLUE),
        ("mass", 1e3 * values(part, "moving_mass_position"), "Moving mass [mm]", VERMILION),
        ("pitch", values(part, "pitch"), "Pitch [deg]", VERMILION),
        ("steering", values(part, steering[0]), steering[1], PURPLE),
        ("heading", unbroken(values(part, "heading")), "Heading [deg]", GREEN),
    )
    figure = new_figure(8.8, 9.2)
    figure.suptitle(f"{dataset.attrs['title']}: actuators in the first dives, from {date(part)}", fontsize=9.5,
                    x=0.012, ha="left")  # fmt: skip
    for axes, (name, curve, title, colour) in zip(figure.subplots(len(panels), 1, sharex=True), panels, strict=True):
        shade_phases(axes, part["phase"].values, time / length)
        axes.plot(time / length, curve, color=colour, linewidth=1.3, gid=name)
        axes.set_title(title)
        if name == "depth":
            axes.invert_yaxis()
        if np.ptp(curve) < 1e-3:
            axes.set_ylim(curve.mean() - 1.0, curve.mean() + 1.0)
    axes.set_xlim(0.0, time[-1] / length)
    axes.set_xlabel(f"Time [{unit}]; behind: {legend_of(part['phase'].values)}")
    return figure
