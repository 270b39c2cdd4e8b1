"""Masses and volumes along the hull, and where the parts lie."""

from textwrap import fill
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from stommel.design.budget.study import BudgetStudy
from stommel.figures.style import (
    BLUE,
    FAINT,
    INK,
    MUTED,
    ORANGE,
    SHADE,
    SKY,
    VERMILION,
    legend_below,
    new_figure,
    number,
    styled,
)
from stommel.vehicle.schema.budget import Part

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

SLICE_M = 0.05
"""Width of a slice of the hull."""


@styled
def budget_figure(study: BudgetStudy) -> "Figure":
    """Draw mass and displaced volume by slices of the hull, and the parts from the side."""
    parts = study.vehicle.description.parts
    edges = _edges(study)
    figure = new_figure(8.8, 7.0)
    masses, volumes, side = figure.subplots(3, 1, sharex=True, height_ratios=(1.0, 1.0, 1.15))
    _draw_bays(study, masses, (masses, volumes, side))
    groups = (
        ("rigid body", INK, [p for p in parts if not p.moving and not p.ballast]),
        ("moving mass, at neutral", VERMILION, [p for p in parts if p.moving]),
        ("ballast system", BLUE, [p for p in parts if p.ballast]),
    )
    _draw_slices(masses, edges, [(label, c, _spread(g, edges, [p.mass_kg for p in g])) for label, c, g in groups])
    wet = [("displaced volume", SKY, _spread(parts, edges, [p.volume_ml / 1e3 for p in parts]))]
    _draw_slices(volumes, edges, wet)
    masses.set_title("Mass [kg in 50 mm]")
    volumes.set_title("Displaced volume [l in 50 mm]")
    _draw_side(study, side, groups)
    side.set_xlim(edges[0], edges[-1])
    legend_below(figure, side, 3)
    return figure


def _edges(study: BudgetStudy) -> NDArray[np.float64]:
    bays = study.vehicle.description.bays
    low, high = min(bay.to_m for bay in bays), max(bay.from_m for bay in bays)
    first, last = np.floor(low / SLICE_M), np.ceil(high / SLICE_M)
    return SLICE_M * np.arange(first, last + 1)


def _spread(
    parts: "list[Part] | tuple[Part, ...]", edges: NDArray[np.float64], amounts: list[float]
) -> NDArray[np.float64]:
    """Amount of each slice: a part is spread evenly over its length."""
    total = np.zeros(len(edges) - 1)
    for part, amount in zip(parts, amounts, strict=True):
        x, half = part.position_m[0], 0.5 * max(part.length_m, 1e-9)
        overlap = np.minimum(edges[1:], x + half) - np.maximum(edges[:-1], x - half)
        total += amount * np.clip(overlap, 0.0, None) / (2.0 * half)
    return total


def _draw_slices(axes: "Axes", edges: NDArray[np.float64], groups: list[tuple[str, str, NDArray[np.float64]]]) -> None:
    below = np.zeros(len(edges) - 1)
    for label, colour, amount in groups:
        axes.bar(edges[:-1], amount, SLICE_M, bottom=below, align="edge", color=colour, edgecolor="white",
                 linewidth=0.6, label=label, zorder=3)  # fmt: skip
        below += amount
    axes.grid(visible=False, axis="x")


def _draw_bays(study: BudgetStudy, top: "Axes", panels: "tuple[Axes, ...]") -> None:
    """Flooded bays in blue behind all panels, names above the first."""
    for bay in study.vehicle.description.bays:
        for axes in panels:
            if bay.flooded:
                axes.axvspan(bay.to_m, bay.from_m, color=SKY, alpha=0.13, linewidth=0, zorder=0)
            axes.axvline(bay.to_m, color=FAINT, linewidth=0.9, zorder=1)
        width = bay.from_m - bay.to_m
        name = fill(bay.name, max(6, int(46 * width)))
        top.annotate(name, (0.5 * (bay.from_m + bay.to_m), 1.0), xycoords=("data", "axes fraction"), xytext=(0, 20),
                     textcoords="offset points", ha="center", va="bottom", fontsize=8.0, color=MUTED)  # fmt: skip


def _draw_side(study: BudgetStudy, axes: "Axes", groups: tuple[tuple[str, str, list[Part]], ...]) -> None:
    """Parts as discs of an area in proportion to their mass, at their places; hull sections would hide the rest."""
    hull, budget = study.vehicle.description.hull, study.budget
    if hull is not None:
        stern, radius = hull.nose_position_m - hull.length_m, hull.outer_diameter_mm / 20.0
        axes.fill([stern, hull.nose_position_m, hull.nose_position_m, stern], [-radius, -radius, radius, radius],
                  facecolor=SHADE, edgecolor=MUTED, linewidth=1.0, zorder=1)  # fmt: skip
    for label, colour, parts in groups:
        x, z, area = ([p.position_m[0] for p in parts], [-100 * p.position_m[2] for p in parts],
                      [40.0 * p.mass_kg for p in parts])  # fmt: skip
        axes.scatter(x, z, s=area, color=colour, alpha=0.55, linewidth=0.6, edgecolor="white", label=label, zorder=3)
    added = [body for body in study.trimming.added if body.mass > 0.0] if study.trimming is not None else []
    if study.trimming is not None and added:
        axes.scatter([b.position[0] for b in added], [-100 * b.position[2] for b in added],
                     s=[40.0 * max(b.mass, 0.3) for b in added], color=ORANGE, edgecolor=INK, linewidth=0.8, zorder=4,
                     label=f"to add for {number(study.trimming.rho)} kg/m³")  # fmt: skip
    centre = budget.total.centre
    axes.plot(budget.centre_of_buoyancy[0], -100 * budget.centre_of_buoyancy[2], "+", color=INK, markersize=13,
              markeredgewidth=1.7, linestyle="none", label="centre of buoyancy", zorder=6)  # fmt: skip
    axes.plot(centre[0], -100 * centre[2], "x", color=VERMILION, markersize=9, markeredgewidth=1.9, linestyle="none",
              label=f"centre of mass, {number(round(1e3 * budget.stability_arm, 1))} mm lower", zorder=6)  # fmt: skip
    axes.set_title("Parts from the side, area by mass")
    axes.set_ylabel("Up [cm]")
    axes.set_xlabel("Forward of the centre of buoyancy [m]   (bow to the right)")
    axes.grid(visible=False)
