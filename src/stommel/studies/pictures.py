"""Pictures of a study: outputs over the values of a sweep, or over what was drawn, and which parameter matters."""

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from stommel.figures.saving import save_figure
from stommel.figures.style import BLUE, CYCLE, DASHES, MUTED, new_figure, styled
from stommel.studies.combinations import Combination
from stommel.studies.headline import in_words, shown_outputs
from stommel.studies.run import Finished
from stommel.studies.sensitivity import Sensitivity
from stommel.studies.study_file import SWEEP

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

Array = NDArray[np.float64]

_MOST_PANELS = 12
"""Outputs in one picture."""
_MOST_COLUMNS = 6
"""Parameters beside each other."""
_MOST_LINES = len(CYCLE)
"""Lines that can be told apart."""


def save_study_pictures(done: Finished, folder: Path) -> list[Path]:
    """Write the pictures of a study into a folder, as PNG and SVG; return their paths.

    Raises
    ------
    OutputError
        A file cannot be written; none is left half-written.
    """
    figures = {}
    if drawn_outputs(done):
        sweep = done.study.file.kind == SWEEP
        figures["sweep" if sweep else "runs"] = sweep_figure(done) if sweep else runs_figure(done)
    if measured_outputs(done):
        figures["sensitivity"] = sensitivity_figure(done)
    return [path for name, figure in figures.items() for path in save_figure(figure, folder / name)]


def drawn_outputs(done: Finished) -> list[str]:
    """Outputs that the pictures show: as the tables, as many as have room; without those that never change."""
    known = done.statistics()
    changing = {name: numbers for name, numbers in known.items() if numbers["greatest"] > numbers["least"]}
    return shown_outputs(done.study, changing or known)[:_MOST_PANELS]


def measured_outputs(done: Finished) -> list[str]:
    """Those of the drawn outputs that change, so that a sensitivity is known."""
    found = done.sensitivity
    if found is None:
        return []
    known = dict(zip(found.outputs, np.isfinite(found.explained), strict=True))
    return [name for name in drawn_outputs(done) if known.get(name)]


@styled
def sweep_figure(done: Finished) -> "Figure":
    """Draw each output over the first parameter of a sweep, a line for each combination of the others."""
    names = drawn_outputs(done)
    combinations = done.combinations()
    across = next(iter(combinations[0].values))
    columns = min(2, len(names))
    rows = -(-len(names) // columns)
    figure = new_figure(4.6 * columns + 0.6, 2.7 * rows + 0.9)
    _title(figure, done, names)
    panels: Any = figure.subplots(rows, columns, squeeze=False)
    for axes, name in zip(panels.ravel(), names, strict=False):
        _lines(axes, combinations, across, name)
    for axes in panels.ravel()[len(names) :]:
        axes.remove()
    handles, labels = panels.ravel()[0].get_legend_handles_labels()
    if labels:
        figure.legend(handles, labels, loc="outside lower left", ncols=2)
    return figure


def _title(figure: "Figure", done: Finished, names: Sequence[str]) -> None:
    known, runs = len(done.statistics()), len(done.study.values)
    some = f"; {len(names)} of {known} outputs" if len(names) < known else ""
    figure.suptitle(f"{done.study.file.name}: {runs} missions{some}", fontsize=9.5, x=0.012, ha="left")


def _lines(axes: "Axes", combinations: Sequence[Combination], across: str, name: str) -> None:
    """One line for each combination of the other parameters, with a standard deviation to each side of it."""
    lines: dict[str, list[Combination]] = {}
    for one in combinations:
        others = ", ".join(_said(key, value) for key, value in one.values.items() if key != across)
        lines.setdefault(others, []).append(one)
    texts = list(dict.fromkeys(_told(one.values[across]) for one in combinations))
    numbers = not isinstance(combinations[0].values[across], str | bool)
    shown = list(lines.items())[:_MOST_LINES]
    for k, (label, ones) in enumerate(shown):
        known = [one for one in ones if name in one.outputs]
        x = [float(one.values[across]) if numbers else texts.index(_told(one.values[across])) for one in known]
        mean = np.array([one.outputs[name].mean for one in known])
        spread = np.array([one.outputs[name].standard_deviation for one in known])
        axes.plot(x, mean, marker="o", markersize=4, color=CYCLE[k], linestyle=DASHES[k] if numbers else "none",
                  label=label or None)  # fmt: skip
        if spread.any():
            axes.errorbar(x, mean, spread, color=CYCLE[k], linestyle="none", capsize=3, linewidth=1.0)
    if not numbers:
        axes.set_xticks(range(len(texts)), texts)
    if len(lines) > len(shown):
        axes.annotate(f"{len(shown)} of {len(lines)} lines", (0.99, 0.02), xycoords="axes fraction", ha="right",
                      color=MUTED, fontsize=8)  # fmt: skip
    axes.set_title(with_unit(name))
    axes.set_xlabel(with_unit(across))


def _said(key: str, value: Any) -> str:
    """A parameter with its value: depth 40 m."""
    words, unit = in_words(key)
    return f"{words} {_told(value)} {unit}".rstrip()


def _told(value: Any) -> str:
    return str(value).lower() if isinstance(value, bool) else value if isinstance(value, str) else f"{value:.6g}"


def with_unit(name: str) -> str:
    """An output or parameter in words, its unit in brackets."""
    words, unit = in_words(name)
    return f"{words[:1].upper()}{words[1:]}" + (f" [{unit}]" if unit else "")


@styled
def runs_figure(done: Finished) -> "Figure":
    """Draw how each output is spread, and each over each parameter."""
    names = drawn_outputs(done)
    parameters = [k for k in range(len(done.study.names)) if not isinstance(done.study.values[0][k], str | bool)]
    parameters = parameters[:_MOST_COLUMNS]
    figure = new_figure(2.6 * (1 + len(parameters)) + 0.6, 2.2 * len(names) + 0.8)
    _title(figure, done, names)
    panels: Any = figure.subplots(len(names), 1 + len(parameters), squeeze=False)
    for row, name in zip(panels, names, strict=True):
        values = done.outputs[name]
        flown = np.isfinite(values)
        row[0].hist(values[flown], bins=min(30, max(5, round(np.sqrt(flown.sum())))), color=BLUE, alpha=0.75)
        row[0].set_xlabel(with_unit(name), fontsize=8.8)
        row[0].set_ylabel("Runs")
        for axes, k in zip(row[1:], parameters, strict=True):
            x = np.array([run[k] for run in done.study.values], float)
            axes.plot(x[flown], values[flown], "o", color=BLUE, markersize=3.2, alpha=0.6, markeredgewidth=0)
            axes.set_xlabel(with_unit(done.study.names[k]), fontsize=8.8)
        if parameters:
            row[1].set_ylabel(with_unit(name), fontsize=8.8)
    return figure


@styled
def sensitivity_figure(done: Finished) -> "Figure":
    """Draw the measure of each parameter for each of `measured_outputs` as bars."""
    found, names = done.sensitivity, measured_outputs(done)
    assert found is not None
    measure, title = {
        "sobol": ("total", "total Sobol indices, with 95 % intervals"),
        "regression": ("coefficient", "standardised regression coefficients"),
    }[found.method]
    count = len(found.parameters)
    figure = new_figure(7.6, 0.55 + len(names) * (0.34 + 0.16 * count) + 0.5)
    figure.suptitle(f"{done.study.file.name}: {title}", fontsize=9.5, x=0.012, ha="left")
    axes = figure.subplots()
    _bars(axes, found, names, measure)
    axes.axvline(0.0, color=MUTED, linewidth=0.8)
    axes.set_yticks(np.arange(len(names)), [with_unit(name) for name in names])
    axes.invert_yaxis()
    axes.grid(visible=False, axis="y")
    handles, labels = axes.get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside lower left", ncols=2)
    return figure


def _bars(axes: "Axes", found: Sensitivity, names: Sequence[str], measure: str) -> None:
    rows, count = [found.outputs.index(name) for name in names], len(found.parameters)
    height = 0.8 / count
    for j, parameter in enumerate(found.parameters):
        values = np.nan_to_num(found.measures[measure][rows, j])
        places = np.arange(len(rows)) + (j - 0.5 * (count - 1)) * height
        spread = found.measures.get(f"{measure}_interval")
        error = None if spread is None else np.nan_to_num(spread[rows, j])
        axes.barh(places, values, 0.9 * height, xerr=error, color=CYCLE[j % len(CYCLE)], label=with_unit(parameter))
