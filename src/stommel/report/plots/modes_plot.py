"""Natural modes of both planes in the complex plane."""

from typing import TYPE_CHECKING

import numpy as np

from stommel.analysis import Mode
from stommel.design.study import DesignStudy
from stommel.figures.style import BLUE, MUTED, VERMILION, new_figure, number, styled
from stommel.report.plots.complex_plane import prepare, write_names

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure


@styled
def modes_figure(study: DesignStudy) -> "Figure":
    """Draw the eigenvalues of the design flight with the names of the modes."""
    figure = new_figure(9.2, 4.1)
    flight = study.design_flight
    title = f"Flight of {number(flight.V)} m/s at pitch {number(round(np.degrees(flight.theta), 6))}°, actuators fixed"
    figure.suptitle(title, fontsize=9.5, x=0.012, ha="left")
    left, right = figure.subplots(1, 2)
    _draw(left, study.modes.longitudinal, BLUE)
    left.set_title("Longitudinal")
    right.set_title("Lateral-directional")
    if study.modes.lateral is None:
        right.set_axis_off()
        words = "not known:\nno lateral coefficients are published\nfor this vehicle"
        right.text(0.5, 0.5, words, transform=right.transAxes, ha="center", va="center", color=MUTED)
    else:
        _draw(right, study.modes.lateral, VERMILION)
    return figure


def _draw(axes: "Axes", modes: tuple[Mode, ...], colour: str) -> None:
    values = np.array([mode.eigenvalue for mode in modes])
    prepare(axes, values)
    axes.plot(
        values.real, values.imag, "x", color=colour, markersize=9, markeredgewidth=2.2, linestyle="none", zorder=4,
        gid="eigenvalues",
    )  # fmt: skip
    write_names(axes, modes)
