"""Steady turns: radius, roll, sideslip and steering angle against turn rate."""

from math import degrees
from typing import TYPE_CHECKING

import numpy as np

from stommel.design.study import DesignStudy
from stommel.figures.style import BLUE, GREEN, MUTED, PURPLE, VERMILION, new_figure, number, styled

if TYPE_CHECKING:
    from matplotlib.figure import Figure


@styled
def turns_figure(study: DesignStudy) -> "Figure":
    """Draw the steady turns of a study; a sentence instead where there are none."""
    if not study.turns:
        figure = new_figure(7.0, 1.6)
        figure.text(0.5, 0.5, "No steady turns: this vehicle cannot steer, or how is unknown", ha="center", color=MUTED)
        return figure
    by_rudder = any(flight.delta_r != 0.0 for flight in study.turns)
    steering = ("Rudder angle [deg]", "delta_r") if by_rudder else ("Roll angle of moving mass [deg]", "mu")
    figure = new_figure(8.4, 5.2)
    flight = study.turns[0]
    pitch = number(round(degrees(flight.theta), 6))
    figure.suptitle(f"Steady turns to starboard at {number(flight.V)} m/s, pitch {pitch}°", fontsize=9.5, x=0.012,
                    ha="left")  # fmt: skip
    panels = figure.subplots(2, 2, sharex=True)
    rates = np.degrees([flight.turn_rate for flight in study.turns])
    radii = [flight.radius for flight in study.turns]
    for axes, (title, values, colour) in zip(
        panels.ravel(),
        (
            ("Radius [m]", radii, BLUE),
            (steering[0], np.degrees([getattr(flight, steering[1]) for flight in study.turns]), VERMILION),
            ("Roll [deg]", np.degrees([flight.phi for flight in study.turns]), GREEN),
            ("Sideslip [deg]", np.degrees([flight.beta for flight in study.turns]), PURPLE),
        ),
        strict=True,
    ):
        axes.plot(rates, values, color=colour, marker="o", markersize=3.4, gid=title)
        axes.set_title(title)
    panels[0, 0].set_yscale("log")
    panels[0, 0].yaxis.set_major_formatter(lambda value, _: f"{value:g}")
    tightest = (rates[-1], radii[-1])
    panels[0, 0].annotate(f"{radii[-1]:.1f} m", tightest, xytext=(-2, 8), textcoords="offset points", ha="right")
    for axes in panels[1]:
        axes.set_xlabel("Turn rate [deg/s]")
        axes.set_xlim(left=0.0)
    return figure
