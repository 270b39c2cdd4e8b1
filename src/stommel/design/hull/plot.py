"""Pressures that a wall stands by each criterion, and the mass of the hull in each material."""

from typing import TYPE_CHECKING

import numpy as np

from stommel.design.hull.sizing import SizedHull, size
from stommel.design.hull.study import HullStudy
from stommel.figures.style import (
    BLUE,
    FAINT,
    GREEN,
    INK,
    MUTED,
    ORANGE,
    PURPLE,
    SKY,
    VERMILION,
    new_figure,
    styled,
)
from stommel.machinery.hull import paper_formulas

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_LOOK = {
    paper_formulas.YIELD: (BLUE, "--"),
    paper_formulas.CIRCUMFERENTIAL: (VERMILION, "-"),
    paper_formulas.AXIAL: (ORANGE, "--"),
    "von Mises, n lobes": (GREEN, "-"),
    "Windenburg and Trilling": (PURPLE, (0, (6, 2))),
    "rings and tube, Bryant": (INK, (0, (7, 2, 1.5, 2))),
    "first yield inside, Lame": (SKY, (0, (2, 1.4))),
}
"""Colour and dashes of each criterion that is drawn."""


@styled
def hull_figure(study: HullStudy) -> "Figure":
    """Draw pressure against wall for the vehicle's material, or the first ranked, beside the masses of all."""
    figure = new_figure(9.6, 4.6)
    left, right = figure.subplots(1, 2, width_ratios=(1.5, 1.0))
    _draw_pressures(left, study.own if study.own is not None else study.hulls[0])
    _draw_masses(right, study)
    return figure


def _draw_pressures(axes: "Axes", hull: SizedHull) -> None:
    need, chosen = hull.requirement, hull.tube.delta
    walls = np.linspace(0.3, 2.2, 191) * max(chosen, hull.exact_wall)
    walls = walls[walls < 0.4 * need.D_o]
    rows = [{c.name: c.pressure / 1e6 for c in size(hull.material, need, float(wall)).criteria} for wall in walls]
    for name, (colour, dashes) in _LOOK.items():
        if name in rows[-1]:
            pressures = [row.get(name, np.nan) for row in rows]
            label = name.replace("Lame", "Lamé")
            axes.plot(walls * 1e3, pressures, color=colour, linestyle=dashes, label=label)
    P = need.P / 1e6
    axes.axhspan(axes.get_ylim()[0] or 1e-3, P, color=FAINT, alpha=0.6, linewidth=0, zorder=0)
    axes.axhline(P, color=INK, linewidth=1.0)
    axes.axvline(chosen * 1e3, color=MUTED, linewidth=1.0, linestyle=":")
    axes.plot(chosen * 1e3, hull.collapse.pressure / 1e6, "o", color=INK, markersize=6, zorder=5)
    axes.annotate(
        f"{chosen * 1e3:.4g} mm: {hull.collapse.pressure / 1e6:.3g} MPa, {hull.depth(hull.collapse.pressure):.0f} m",
        (chosen * 1e3, hull.collapse.pressure / 1e6), xytext=(9, -11), textcoords="offset points", fontsize=8.8,
        bbox={"facecolor": "white", "edgecolor": "none", "pad": 1.5, "alpha": 0.85},
    )  # fmt: skip
    axes.annotate(
        f"working pressure {P:.4g} MPa", (1.0, P), xycoords=("axes fraction", "data"), xytext=(-3, -4),
        textcoords="offset points", ha="right", va="top", fontsize=8.8, color=MUTED,
    )  # fmt: skip
    axes.set_yscale("log")
    axes.set_ylim(0.3 * P, None)
    axes.set_xlim(walls[0] * 1e3, walls[-1] * 1e3)
    axes.yaxis.set_major_formatter(lambda value, _: f"{value:g}")
    axes.set_xlabel("Wall [mm]")
    axes.set_ylabel("Pressure at which it is reached [MPa]")
    axes.set_title(f"{hull.material.name}: what a wall stands")
    axes.legend(loc="upper left", bbox_to_anchor=(0.0, -0.16), ncols=2, borderaxespad=0.0)


def _draw_masses(axes: "Axes", study: HullStudy) -> None:
    rows = study.ranking[::-1]
    masses = [row.hull.tube.mass for row in rows]
    axes.barh(range(len(rows)), masses, color=[BLUE if row.hull.fits else FAINT for row in rows], height=0.62)
    for k, row in enumerate(rows):
        room = "" if row.hull.fits else ", no room"
        axes.annotate(
            f"{row.hull.tube.mass:.1f} kg, {row.hull.tube.delta * 1e3:.1f} mm{room}", (row.hull.tube.mass, k),
            xytext=(4, 0), textcoords="offset points", va="center", fontsize=8.4,
        )  # fmt: skip
    axes.set_yticks(range(len(rows)), [f"{row.place}  {row.hull.material.name}" for row in rows])
    axes.set_xlim(0.0, 1.85 * max(masses))
    axes.grid(visible=False, axis="y")
    axes.set_xlabel("Mass of the tube [kg]")
    axes.set_title("Materials in the order of the ranking")
