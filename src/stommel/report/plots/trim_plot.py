"""Trim tables as curves: moving mass, ballast volume and angle of attack, with published points on the lines."""

from math import degrees
from typing import TYPE_CHECKING

from stommel.analysis import Excess, Reason
from stommel.design.study import ComparedRow, ComparedTable
from stommel.figures.style import BLUE, INK, MUTED, VERMILION, legend_below, new_figure, styled

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_QUANTITIES = (
    ("Moving mass position [mm]", Reason.TRAVEL),
    ("Ballast volume [ml]", Reason.VOLUME),
    ("Angle of attack [deg]", Reason.STALL),
)


@styled
def trim_table_figure(table: ComparedTable) -> "Figure":
    """Draw a trim table against what it varies: pitch, or speed."""
    pitches = [degrees(row.trim.flight.theta) for row in table.rows]
    speeds = [row.trim.flight.V for row in table.rows]
    over_pitch = max(pitches) - min(pitches) > 1e-6
    x, label = (pitches, "Pitch [deg]") if over_pitch else (speeds, "Speed [m/s]")
    figure = new_figure(10.0, 3.7)
    panels = figure.subplots(1, 3)
    for k, axes in enumerate(panels):
        _draw_quantity(axes, table.rows, x, k)
        axes.set_xlabel(label)
        if over_pitch:
            axes.invert_xaxis()
    legend_below(figure, panels[0], columns=4)
    return figure


def _computed(row: ComparedRow) -> tuple[float, float, float]:
    flight = row.trim.flight
    return flight.r_px * 1e3, flight.V_b * 1e6, degrees(flight.alpha)


def _published(row: ComparedRow) -> tuple[float, float, float] | None:
    printed = row.published
    return (printed.moving_mass_mm, printed.ballast_ml, printed.angle_of_attack_deg) if printed else None


def _draw_quantity(axes: "Axes", rows: tuple[ComparedRow, ...], x: list[float], k: int) -> None:
    name, reason = _QUANTITIES[k]
    values = [_computed(row)[k] for row in rows]
    axes.plot(x, values, color=BLUE, label="computed", gid="computed", marker="." if rows[0].published is None else "")
    points = [(at, printed[k]) for at, row in zip(x, rows, strict=True) if (printed := _published(row)) is not None]
    if points:
        axes.plot(
            [at for at, _ in points], [value for _, value in points], "o", color="white", markeredgecolor=INK,
            markersize=5.5, markeredgewidth=1.2, linestyle="none", label="published", gid="published", zorder=3,
        )  # fmt: skip
    broken = [(at, values[j]) for j, (at, row) in enumerate(zip(x, rows, strict=True)) if row.trim.beyond]
    if broken:
        axes.plot(
            [at for at, _ in broken], [value for _, value in broken], "x", color=VERMILION, markersize=8,
            markeredgewidth=1.8, linestyle="none", label="beyond a limit of the vehicle file", gid="beyond", zorder=4,
        )  # fmt: skip
    excesses = [excess for row in rows for excess in row.trim.beyond if excess.reason is reason]
    _draw_limit(axes, excesses)
    if not excesses and max(values) - min(values) < 0.02 * max(map(abs, values)):
        middle = 0.5 * (max(values) + min(values))  # nearly constant: do not blow up the last digits
        axes.set_ylim(middle - 0.02 * abs(middle), middle + 0.02 * abs(middle))
    axes.set_title(name)


def _draw_limit(axes: "Axes", excesses: list[Excess]) -> None:
    """Draw the limits that some row breaks."""
    for excess in excesses[:1]:
        limit = excess.high if excess.needed > excess.high else excess.low
        axes.axhline(limit, color=MUTED, linewidth=1.0, linestyle=(0, (4, 3)), gid="limit")
        axes.annotate(
            f"limit {limit:g} {excess.unit}".replace("-", "−"), (0.02, limit), xycoords=("axes fraction", "data"),
            xytext=(0, 3), textcoords="offset points", fontsize=8.2, color=MUTED, in_layout=False,
        )  # fmt: skip
