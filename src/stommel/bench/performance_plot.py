"""Bench results as in Figs. 14 and 15 of the paper: current and consumption over speed, response over time."""

from collections.abc import Sequence
from math import pi
from typing import TYPE_CHECKING

from stommel.bench.engine_log import EngineLog
from stommel.bench.performance import OperatingPoint, levels, model_points, nearest
from stommel.bench.quantities import MARKER
from stommel.bench.speed_choice import SpeedChoice
from stommel.figures.style import MUTED, VERMILION, legend_below, new_figure, styled
from stommel.machinery.engine.steady_state import EngineParameters

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_MARKERS = ("o", "s", "^", "D", "v", "P", "X", "h")
_RPM = 60 / (2 * pi)


def pressure_colours(count: int) -> list[str]:
    """From light for low to dark for high pressure: the order can be read without the legend, also in grey."""
    from matplotlib import colormaps  # noqa: PLC0415 - start-up counts
    from matplotlib.colors import to_hex  # noqa: PLC0415

    scale = colormaps["viridis_r"]
    return [to_hex(scale(0.18 + 0.8 * k / max(count - 1, 1))) for k in range(count)]


def mark_generated(figure: "Figure", generated: bool) -> None:
    """Write into a figure that its data come from the model."""
    if generated:
        figure.suptitle(f"Data {MARKER}", x=0.012, ha="left", fontsize=9.0, color=VERMILION, style="italic")


@styled
def performance_figure(
    points: Sequence[OperatingPoint],
    *,
    generated: bool,
    engine: EngineParameters | None = None,
    choice: SpeedChoice | None = None,
) -> "Figure":
    """Draw average current and K over motor speed, one curve a pressure (Fig. 14 of the paper).

    Parameters
    ----------
    points
        Averages of the runs of a log, or points of the model.
    generated
        They come from the model; the figure says so.
    engine
        If given, its curves are drawn through the points.
    choice
        If given, the chosen speed is marked.
    """
    figure = new_figure(9.6, 4.7)
    mark_generated(figure, generated)
    left, right = figure.subplots(1, 2)
    pressures = levels([point.pressure for point in points])
    for k, (P, colour) in enumerate(zip(pressures, pressure_colours(len(pressures)), strict=True)):
        here = [point for point in points if nearest(point.pressure, pressures) == k]
        style = {"color": colour, "marker": _MARKERS[k % len(_MARKERS)], "markersize": 5.5}
        _draw_pressure(left, right, here, engine, P, style)
    for axes, title, label in (
        (left, "Average current", "Average current from the supply [A]"),
        (right, "Consumption K = U I t / l", "Energy per millimetre of piston travel [J/mm]"),
    ):
        axes.set_title(title)
        axes.set_xlabel("Motor speed [r/min]")
        axes.set_ylabel(label)
        axes.set_ylim(bottom=0.0)
        if choice is not None and choice.chosen is not None:
            axes.axvline(
                choice.chosen.motor_speed * _RPM, color=VERMILION, linewidth=1.0, linestyle=(0, (4, 3)), zorder=1
            )
    if choice is not None and choice.chosen is not None:
        right.annotate(
            f"chosen {choice.chosen.motor_speed * _RPM:.0f} r/min", (choice.chosen.motor_speed * _RPM, 1.0),
            xycoords=("data", "axes fraction"), xytext=(5, -4), textcoords="offset points", va="top", color=VERMILION,
            fontsize=8.8,
        )  # fmt: skip
    legend_below(figure, left, columns=min(6, len(pressures)))
    return figure


def _draw_pressure(
    left: "Axes",
    right: "Axes",
    points: Sequence[OperatingPoint],
    engine: EngineParameters | None,
    P: float,
    style: dict[str, object],
) -> None:
    speeds = [point.motor_speed for point in points]
    label = f"{P / 1e6:.2f} MPa".replace("-0.00", "0.00")
    values = ([point.current for point in points], [point.K / 1e3 for point in points])
    for axes, measured in zip((left, right), values, strict=True):
        line = "none" if engine is not None else "-"
        axes.plot([s * _RPM for s in speeds], measured, linestyle=line, linewidth=1.3, label=label, **style)  # type: ignore[arg-type]
    if engine is not None and len(speeds) > 1:
        low, high = min(speeds), max(speeds)
        curve = model_points(engine, [P], [low + (high - low) * k / 40 for k in range(41)])
        for axes, along in (
            (left, [point.current for point in curve]),
            (right, [point.K / 1e3 for point in curve]),
        ):
            axes.plot([p.motor_speed * _RPM for p in curve], along, color=str(style["color"]), linewidth=1.3)


@styled
def response_figure(log: EngineLog, motor_speed: float) -> "Figure":
    """Draw piston travel over time, one curve a pressure, at the motor speed nearest to one [rad/s] (Fig. 15)."""
    figure = new_figure(7.4, 4.8)
    mark_generated(figure, log.generated)
    axes = figure.subplots()
    speeds = levels([float(run.motor_speed.mean()) for run in log.runs])
    at = nearest(motor_speed, speeds)
    runs = [run for run in log.runs if nearest(float(run.motor_speed.mean()), speeds) == at]
    runs.sort(key=lambda run: float(run.pressure.mean()))
    for run, colour in zip(runs, pressure_colours(len(runs)), strict=True):
        t = run.time - run.time[0]
        label = f"{run.pressure.mean() / 1e6:.2f} MPa".replace("-0.00", "0.00")
        axes.plot(t, run.piston_travel * 1e3, color=colour, linewidth=1.7, label=label)
        axes.plot(t[-1], run.piston_travel[-1] * 1e3, "o", color=colour, markersize=5)
        axes.annotate(
            f"{t[-1]:.0f} s", (t[-1], run.piston_travel[-1] * 1e3), xytext=(0, -6), textcoords="offset points",
            ha="center", va="top", fontsize=8.2, color=MUTED,
        )  # fmt: skip
    axes.set_title(f"Response at {round(speeds[at] * _RPM, -1):.0f} r/min")
    axes.set_xlabel("Time since the motor started [s]")
    axes.set_ylabel("Piston travel [mm]")
    axes.set_xlim(left=0.0)
    axes.set_ylim(bottom=min(0.0, *(float(run.piston_travel.min()) * 1e3 for run in runs)))
    legend_below(figure, axes, columns=min(6, len(runs)))
    return figure
