"""Plot of an energy study: where the energy goes, what matters most, and how to fly."""

import textwrap
from typing import TYPE_CHECKING

from stommel.design.endurance.best_flights import endurance_over_speed
from stommel.design.endurance.dive_cycle import ACTUATORS
from stommel.design.endurance.endurance import SELF_DISCHARGE
from stommel.design.endurance.sensitivity import Sensitivity
from stommel.design.endurance.study import EnergyStudy
from stommel.figures.style import BLUE, GREEN, INK, MUTED, ORANGE, PURPLE, SKY, VERMILION, new_figure, styled
from stommel.files.units import counted

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

MOST_ASSUMPTIONS = 14
LABEL_WIDTH = 36
_PART_COLOURS = {
    "actuators": BLUE, "controller": VERMILION, "sensors": GREEN, "navigation": PURPLE, "communication": ORANGE,
    "hotel": MUTED, "battery": SKY,
}  # fmt: skip


@styled
def endurance_figure(study: EnergyStudy) -> "Figure":
    """Draw energy per dive by part, a tornado of the assumptions, and endurance and range over the speed."""
    figure = new_figure(10.4, 9.8)
    halves = figure.subfigures(2, 1, squeeze=False, height_ratios=[1.35, 1.0], hspace=0.03)
    upper, lower = halves[0, 0], halves[1, 0]
    parts, tornado = upper.subplots(1, 2)
    _draw_parts(parts, study)
    _draw_tornado(tornado, study)
    left, right = lower.subplots(1, 2)
    _draw_speeds(left, right, study)
    return figure


def part_of(study: EnergyStudy, name: str) -> str:
    """Part of the vehicle that a line of the balance belongs to."""
    if name in ACTUATORS:
        return "actuators"
    if name == SELF_DISCHARGE:
        return "battery"
    return next(consumer.part for consumer in study.result.model.consumers if consumer.name == name)


def _draw_parts(axes: "Axes", study: EnergyStudy) -> None:
    """Bars of energy per dive, the greatest on top, coloured by part."""
    energies = sorted(study.result.energy_per_dive_j.items(), key=lambda item: item[1])
    energies = [(name, energy) for name, energy in energies if energy > 0.0]
    total = sum(energy for _, energy in energies)
    parts = [part_of(study, name) for name, _ in energies]
    axes.barh(
        [name for name, _ in energies], [energy for _, energy in energies],
        color=[_PART_COLOURS[part] for part in parts], height=0.72, gid="energy",
    )  # fmt: skip
    for row, (_, energy) in enumerate(energies):
        text = f"{energy:.0f} J, {100 * energy / total:.1f} %"
        axes.annotate(text, (energy, row), xytext=(4, 0), textcoords="offset points", va="center", fontsize=8.2)
    axes.set_xlim(0.0, 1.34 * energies[-1][1])
    axes.tick_params(axis="y", labelsize=8.2, length=0)
    axes.grid(visible=False, axis="y")
    axes.set_xlabel("Energy per dive [J]")
    wanted = study.result.wanted
    axes.set_title(f"A dive to {wanted.depth_m:g} m: {total / 1e3:.2f} kJ")
    used = [part for part in _PART_COLOURS if part in parts]
    from matplotlib.patches import Patch  # noqa: PLC0415 - start-up counts

    axes.legend([Patch(color=_PART_COLOURS[part]) for part in used], used, loc="lower right", fontsize=8.2)


def _draw_tornado(axes: "Axes", study: EnergyStudy) -> None:
    """Endurance at both ends of the weightiest assumptions."""
    chosen = [one for one in study.sensitivities if one.span_days > 0.0][:MOST_ASSUMPTIONS][::-1]
    widest = max((one.span_days for one in chosen), default=1.0)
    here = study.result.days
    for row, one in enumerate(chosen):
        for days, colour in ((one.days_at_low, SKY), (one.days_at_high, BLUE)):
            if days is not None:
                axes.barh(row, days - here, left=here, color=colour, height=0.66, gid="tornado")
    axes.axvline(here, color=INK, linewidth=1.0)
    axes.set_xlim(here - 0.62 * widest, here + 1.0 * widest)
    axes.set_yticks(range(len(chosen)), [_label(one) for one in chosen], fontsize=7.9)
    axes.tick_params(axis="y", length=0)
    axes.grid(visible=False, axis="y")
    axes.set_xlabel("Endurance [days]")
    axes.set_title(f"What {here:.1f} days rest on")
    from matplotlib.patches import Patch  # noqa: PLC0415 - start-up counts

    axes.legend(
        [Patch(color=SKY), Patch(color=BLUE)], ["at the lower value", "at the higher value"], fontsize=8.2,
        loc="lower right", frameon=True, framealpha=0.92, edgecolor="none",
    )  # fmt: skip


def _label(one: Sensitivity) -> str:
    a = one.assumption
    unit = {"1": "", "degrees": "°", "deg C": " °C"}.get(a.unit, f" {a.unit}")
    ends = f"{one.low:.3g} to {one.high:.3g}{unit}".replace("-", "−")
    if len(a.what) <= LABEL_WIDTH:
        return f"{a.what}\n{ends}"
    return textwrap.fill(f"{a.what} {ends}", LABEL_WIDTH + 4)


def _draw_speeds(left: "Axes", right: "Axes", study: EnergyStudy) -> None:
    """Endurance and range over the speed, at the wanted pitch and at those of the two optima."""
    result, best = study.result, study.best
    depth = result.wanted.depth_m
    lines = {
        round(best.longest.pitch_deg): (best.longest.pitch_deg, VERMILION, (0, (2, 1.4))),
        round(best.farthest.pitch_deg): (best.farthest.pitch_deg, GREEN, (0, (6, 2))),
        round(result.wanted.pitch_deg): (result.wanted.pitch_deg, BLUE, "-"),
    }
    for pitch, colour, dashes in lines.values():
        speeds, lasting, distance = endurance_over_speed(study.vehicle, result.model, study.physics, pitch, depth)
        label = f"pitch −{abs(pitch):.0f}°"
        left.plot(speeds, lasting, color=colour, linestyle=dashes, label=label, gid="endurance")
        right.plot(speeds, distance, color=colour, linestyle=dashes, label=label, gid="range")
    marks = (
        (result.wanted.speed_m_s, result.days, result.range_m / 1e3, "o", INK, "this dive"),
        (best.longest.speed_m_s, best.longest.endurance_s / 86400.0, best.longest.range_m / 1e3, "^", VERMILION,
         "longest"),
        (best.farthest.speed_m_s, best.farthest.endurance_s / 86400.0, best.farthest.range_m / 1e3, "D", GREEN,
         "farthest"),
    )  # fmt: skip
    for speed, days, kilometres, marker, colour, label in marks:
        for axes, height in ((left, days), (right, kilometres)):
            axes.plot(speed, height, marker, color=colour, markeredgecolor=INK, markersize=8, linestyle="none",
                      label=label, gid="mark", zorder=5, clip_on=False)  # fmt: skip
    if study.target_days is not None:
        left.axhline(study.target_days, color=INK, linewidth=1.0, linestyle=(0, (4, 2)))
        left.annotate(
            f"specification: {counted(study.target_days, 'day')}", (0.99, study.target_days),
            xycoords=("axes fraction", "data"), xytext=(0, 4), textcoords="offset points", ha="right", fontsize=8.4,
        )  # fmt: skip
    for axes, name in ((left, "Endurance [days]"), (right, "Range [km]")):
        axes.set_xlabel("Speed along the path [m/s]")
        axes.set_ylabel(name)
        axes.set_xlim(left=0.0)
        axes.set_ylim(0.0, 1.12 * axes.get_ylim()[1])
        axes.set_title(f"{name.split(' [')[0]} of dives to {depth:g} m")
    left.legend(loc="lower left", fontsize=8.2, ncols=2)
