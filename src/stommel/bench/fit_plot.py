"""A fit of the engine model: how far each run is from it, and how the constants hang together."""

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from stommel.bench.fitting import EngineFit
from stommel.bench.performance import RunPerformance
from stommel.bench.performance_plot import mark_generated
from stommel.bench.wording import parameter_words
from stommel.figures.style import BLUE, INK, MUTED, SHADE, VERMILION, new_figure, styled

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure


@styled
def fit_figure(fit: EngineFit, runs: Sequence[RunPerformance], *, generated: bool) -> "Figure":
    """Draw deviations of the runs from the model over pressure, intervals of the constants, and their correlation."""
    figure = new_figure(10.4, 6.4)
    mark_generated(figure, generated)
    grid = figure.add_gridspec(2, 2, width_ratios=(1.25, 1.0))
    _draw_deviations(figure.add_subplot(grid[0, :]), fit, runs)
    _draw_intervals(figure.add_subplot(grid[1, 0]), fit)
    _draw_correlation(figure.add_subplot(grid[1, 1]), fit)
    return figure


def _draw_deviations(axes: "Axes", fit: EngineFit, runs: Sequence[RunPerformance]) -> None:
    where = np.arange(1, len(runs) + 1)
    for residuals, scatter, colour, marker, label, shift in (
        (fit.flow_residuals, fit.flow_scatter, BLUE, "o", "piston speed", -0.12),
        (fit.current_residuals, fit.current_scatter, VERMILION, "s", "average current", 0.12),
    ):
        words = f"{label}, scatter {scatter:.2%}"
        axes.vlines(where + shift, 0.0, residuals * 100, color=colour, linewidth=1.1)
        axes.plot(where + shift, residuals * 100, marker, color=colour, markersize=5, linestyle="none", label=words)
    axes.axhline(0.0, color=INK, linewidth=0.9)
    axes.set_title("Measured less model")
    axes.set_ylabel("Deviation [%]")
    axes.set_xlabel("Run, by pressure and then by speed")
    axes.set_xlim(0.3, len(runs) + 0.7)
    reach = 1.45 * float(np.max(np.abs([fit.flow_residuals, fit.current_residuals]))) * 100
    axes.set_ylim(-reach, reach)
    axes.legend(loc="upper right", ncols=2)


def _draw_intervals(axes: "Axes", fit: EngineFit) -> None:
    """Intervals relative to the estimate, so that constants of any unit stand side by side."""
    rows = np.arange(len(fit.parameters))[::-1]
    for row, one in zip(rows, fit.parameters, strict=True):
        size = abs(one.value) or 1.0
        low, high = ((end - one.value) / size * 100 for end in (one.low, one.high))
        axes.plot(
            [low, high],
            [row, row],
            color=BLUE,
            linewidth=2.2,
            label="_" if row else "stated interval, all at once 95 %",
        )
        axes.plot(0.0, row, "o", color=BLUE, markersize=5)
        if one.true is not None:
            axes.plot(
                (one.true - one.value) / size * 100,
                row,
                "x",
                color=INK,
                markersize=7,
                markeredgewidth=1.7,
                label="_" if row else "true value",
            )
    axes.set_yticks(rows, [f"{parameter_words(one.name)}  {k}" for k, one in enumerate(fit.parameters, start=1)])
    axes.set_ylim(-0.7, len(rows) - 0.3)
    axes.grid(visible=False, axis="y")
    axes.set_xlabel("Deviation from the estimate [%]")
    axes.set_title("Constants of the engine")
    axes.legend(loc="upper center", bbox_to_anchor=(0.4, -0.24), ncols=2)


def _draw_correlation(axes: "Axes", fit: EngineFit) -> None:
    count = len(fit.parameters)
    image = axes.imshow(fit.correlation, vmin=-1.0, vmax=1.0, cmap="RdBu_r", aspect="auto")
    for i in range(count):
        for j in range(count):
            value = float(fit.correlation[i, j])
            colour = "white" if abs(value) > 0.6 else MUTED
            axes.text(j, i, f"{value:.2f}".replace("-", "−"), ha="center", va="center", fontsize=8.2, color=colour)
    axes.set_xticks(range(count), [str(k + 1) for k in range(count)])
    axes.set_yticks(range(count), [f"{k + 1}" for k in range(count)])
    axes.set_xlabel("Constants in the order on the left")
    axes.grid(visible=False)
    axes.set_facecolor(SHADE)
    axes.set_title("Correlation of the estimates")
    axes.figure.colorbar(image, ax=axes, shrink=0.9)
