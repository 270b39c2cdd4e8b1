"""A cycle of the buoyancy engine over time: piston as in Fig. 8(b), oil, pressures, current and power."""

from typing import TYPE_CHECKING

import numpy as np

from stommel.figures.style import (
    BLUE,
    CYCLE,
    DASHES,
    GREEN,
    MUTED,
    ORANGE,
    PURPLE,
    SHADE,
    VERMILION,
    new_figure,
    number,
    styled,
)  # fmt: skip
from stommel.machinery.engine.results import EngineRun

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure


@styled
def engine_figure(run: EngineRun) -> "Figure":
    """Draw a cycle; the phases are shaded in turn."""
    figure = new_figure(10.0, 7.6)
    panels = figure.subplots(3, 2, sharex=True)
    piston, flow, pressure, power, current, voltage = panels.flat
    c = run.courses
    for axes, values, color, title in (
        (piston, c.piston_mm, BLUE, "Piston [mm]"),
        (flow, c.flow_ml_s, GREEN, "Flow into the bladder [ml/s]"),
        (power, c.power_w, VERMILION, "Power from the supply [W]"),
        (current, c.current_a, PURPLE, "Current of the motor [A]"),
        (voltage, c.voltage_v, ORANGE, "Voltage of the motor [V]"),
    ):
        axes.plot(c.t_s, values, color=color, gid=title)
        axes.set_title(title)
    _draw_pressures(pressure, run)
    for axes in panels.flat:
        axes.set_xlim(float(c.t_s[0]), float(c.t_s[-1]))
        axes.margins(y=0.12)
        for k, phase in enumerate(run.phases):
            if k % 2:
                axes.axvspan(phase.begin_s, phase.begin_s + phase.duration_s, color=SHADE, zorder=0, linewidth=0)
    for axes in panels[-1]:
        axes.set_xlabel("Time [s]")
    _name_phases(piston, run)
    ideal = ", without losses" if run.ideal else ""
    figure.suptitle(
        f"{run.name}: buoyancy engine at {number(run.pressure_pa / 1e6)} MPa{ideal}", x=0.01, ha="left", fontsize=11.5,
        fontweight="bold",
    )  # fmt: skip
    return figure


def _name_phases(axes: "Axes", run: EngineRun) -> None:
    """Write name and duration of the phases above the curve."""
    low, high = axes.get_ylim()
    axes.set_ylim(low, high + 0.3 * (high - low))
    end = float(run.courses.t_s[-1])
    for phase in run.phases:
        wide = phase.duration_s > 0.12 * end
        axes.annotate(
            f"{phase.name}\n{number(round(phase.duration_s, 1))} s",
            (phase.begin_s + phase.duration_s * (0.5 if wide else 1.0), 0.97), xycoords=("data", "axes fraction"),
            xytext=(0 if wide else -2, 0), textcoords="offset points", ha="center" if wide else "right", va="top",
            fontsize=8.6, color=MUTED,
        )  # fmt: skip


def _draw_pressures(axes: "Axes", run: EngineRun) -> None:
    """Draw the node pressures that differ from each other, the others once."""
    drawn: list[np.ndarray] = []
    for node, values in run.courses.pressure_mpa.items():
        scale = max(0.02, 0.01 * float(np.abs(values).max()))
        if any(float(np.abs(values - other).max()) < scale for other in drawn):
            continue
        k = len(drawn)
        label = " = ".join(port.replace(".", " ").replace("_", " ") for port in node.split(" - ")[:2])
        axes.plot(run.courses.t_s, values, color=CYCLE[k % len(CYCLE)], linestyle=DASHES[k % len(DASHES)], label=label)
        drawn.append(values)
    axes.set_title("Pressure [MPa, gauge]")
    axes.legend(loc="best")
