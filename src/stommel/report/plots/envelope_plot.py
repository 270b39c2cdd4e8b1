"""Flight envelope: reachable speeds against pitch, diving and climbing, with what limits them."""

from collections.abc import Sequence
from itertools import groupby
from math import degrees
from typing import TYPE_CHECKING

from stommel.analysis import EnvelopeRow, SteadyFlight
from stommel.design.study import DesignStudy
from stommel.figures.style import BLUE, GREEN, INK, MUTED, SKY, VERMILION, legend_below, new_figure, styled

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure


@styled
def envelope_figure(study: DesignStudy) -> "Figure":
    """Draw the speeds that the actuator ranges reach at each pitch; a sentence instead where no range is known."""
    if not study.envelope:
        figure = new_figure(7.0, 1.6)
        words = "No envelope: the vehicle file gives no range of ballast volume"
        figure.text(0.5, 0.5, words, ha="center", va="center", color=MUTED)
        return figure
    figure = new_figure(7.6, 6.4)
    axes = figure.subplots()
    for side, colour in ((-1.0, BLUE), (1.0, GREEN)):
        _draw_side(axes, [row for row in study.envelope if row.pitch_deg * side > 0], colour, side)
    _draw_wanted(axes, study)
    _draw_best(axes, study)
    fastest = max((row.fastest.V for row in study.envelope if row.fastest), default=1.0)
    wanted = [row.trim.flight.V for table in study.tables for row in table.rows]
    axes.set_xlim(0.0, 1.16 * max([fastest, *wanted]))
    axes.set_ylim(-90.0, 90.0)
    axes.set_yticks(range(-90, 91, 15))
    axes.axhline(0.0, color=INK, linewidth=0.9)
    axes.set_xlabel("Speed along the path [m/s]")
    axes.set_ylabel("Pitch [deg]")
    axes.set_title("Reachable flights")
    legend_below(figure, axes, columns=3)
    return figure


def _draw_side(axes: "Axes", rows: Sequence[EnvelopeRow], colour: str, side: float) -> None:
    """Fill the reachable pitches of one side, and name what ends them."""
    outward = sorted(rows, key=lambda row: abs(row.pitch_deg))
    label = "dives" if side < 0 else "climbs"
    for reachable, group in groupby(outward, key=lambda row: row.fastest is not None):
        part = list(group)
        if reachable:
            edge = [row.fastest.V for row in part if row.fastest]
            slow = [row.slowest.V for row in part if row.slowest]
            pitch = [row.pitch_deg for row in part]
            axes.fill_betweenx(pitch, slow, edge, color=colour, alpha=0.16, linewidth=0, label=label, gid="reachable")
            axes.plot(edge, pitch, color=colour, gid="fastest")
            _name_edge(axes, part, colour)
            label = "_nolegend_"
        else:
            _hatch(axes, part, outward, side)


def _name_edge(axes: "Axes", part: Sequence[EnvelopeRow], colour: str) -> None:
    """Write what limits the speed beside the fast edge, about its middle."""
    row = part[int(0.6 * len(part))]
    if row.fastest is not None:
        axes.annotate(
            f"limit: {row.limited_by}", (row.fastest.V, row.pitch_deg), textcoords="offset points",
            xytext=(11, -9 if row.pitch_deg > 0 else 9), fontsize=8.8, color=colour, va="center",
        )  # fmt: skip


def _hatch(axes: "Axes", part: Sequence[EnvelopeRow], outward: Sequence[EnvelopeRow], side: float) -> None:
    """Hatch the pitches that no speed reaches, and say why; between two rows nothing is claimed."""
    outermost = part[-1] is outward[-1]
    inner = part[0].pitch_deg if outermost else 0.0
    outer = 90.0 * side if outermost else part[-1].pitch_deg
    axes.axhspan(inner, outer, facecolor="none", edgecolor="#c9ced4", hatch="////", linewidth=0, gid="unreachable")
    words = f"from {abs(inner):g}° on" if outermost else f"up to {abs(outer):g}°"
    wide = abs(outer - inner) > 6.0
    axes.annotate(
        f"{words}: {part[0].limited_by}", (0.5 if wide else 0.985, 0.5 * (inner + outer)),
        xycoords=("axes fraction", "data"), xytext=(0, 0 if wide else 10 * int(side)), textcoords="offset points",
        ha="center" if wide else "right", va="center", fontsize=8.8, color=MUTED,
        bbox={"facecolor": "white", "edgecolor": "none", "pad": 2.5},
    )  # fmt: skip


def _draw_wanted(axes: "Axes", study: DesignStudy) -> None:
    """Mark the flights of the trim tables; those that the limits do not allow are crossed."""
    rows = [row.trim for table in study.tables for row in table.rows]
    for beyond, marker, label, colour in (
        (False, "o", "flights of the trim tables", INK),
        (True, "x", "the same, beyond a limit", VERMILION),
    ):
        flights = [row.flight for row in rows if bool(row.beyond) is beyond]
        if flights:
            axes.plot(
                [flight.V for flight in flights], [degrees(flight.theta) for flight in flights], marker, color=colour,
                markersize=6.5 if beyond else 4.0, markeredgewidth=1.4, linestyle="none", label=label, gid="wanted",
                zorder=4,
            )  # fmt: skip


def _draw_best(axes: "Axes", study: DesignStudy) -> None:
    if study.best is None:
        return
    marks: tuple[tuple[SteadyFlight, str, str], ...] = (
        (study.best.best_glide, "D", "best glide (dive)"),
        (study.best.fastest, "*", "greatest horizontal speed (dive)"),
    )
    for flight, marker, label in marks:
        axes.plot(
            flight.V, degrees(flight.theta), marker, color=SKY if marker == "D" else "#f2b705", markeredgecolor=INK,
            markersize=8 if marker == "D" else 13, linestyle="none", label=label, gid="best", zorder=5,
        )  # fmt: skip
    glide = study.best.best_glide
    axes.annotate(
        f"path {degrees(glide.gamma):.1f}°".replace("-", "−"), (glide.V, degrees(glide.theta)), xytext=(-9, 0),
        textcoords="offset points", ha="right", va="center", fontsize=8.4, color=INK,
    )  # fmt: skip
