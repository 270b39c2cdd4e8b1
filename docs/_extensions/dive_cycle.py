"""The dive cycle as a table and a diagram, both from `stommel.control.dive_cycle.TRANSITIONS`."""

from collections.abc import Iterator
from itertools import groupby
from textwrap import fill

from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.patches import FancyArrowPatch

from stommel.control.dive_cycle import (
    CONDITIONS,
    EVENTS,
    KEPT,
    PHASES,
    THE_ALARM,
    TRANSITIONS,
    Transition,
)
from stommel.figures.saving import svg_text

_PLACES = {
    "surface": (0.16, 0.93),
    "recovery": (0.86, 0.93),
    "descent": (0.16, 0.50),
    "drift": (0.16, 0.14),
    "inflection": (0.86, 0.14),
    "ascent": (0.66, 0.60),
}
"""Where each phase stands: the surface above, the depth below."""

_LABELS = {
    ("surface", "recovery"): (0.50, 0.965),
    ("surface", "descent"): (0.16, 0.72),
    ("descent", "inflection"): (0.50, 0.325),
    ("descent", "drift"): (0.16, 0.32),
    ("drift", "inflection"): (0.50, 0.075),
    ("inflection", "ascent"): (0.77, 0.37),
    ("ascent", "descent"): (0.39, 0.548),
    ("ascent", "surface"): (0.42, 0.76),
}
"""Where the words of each way stand."""

_INK, _PAPER, _ROOM = "#1f2937", "#ffffff", "#dbeafe"


def _reason(row: Transition) -> str:
    return {KEPT: "", THE_ALARM: "the alarm"}.get(row.reason) or (EVENTS[row.reason] if row.reason >= 0 else "")


def transition_table() -> Iterator[str]:
    """Lines of the table of transitions, in Markdown."""
    yield "| phase | when | next | reason |\n|---|---|---|---|\n"
    for row in TRANSITIONS:
        stays = row.next == row.phase
        yield f"| {PHASES[row.phase]} | {CONDITIONS[row.condition]} | " + (
            "stays | |\n" if stays else f"{PHASES[row.next]} | {_reason(row)} |\n"
        )


def diagram() -> str:
    """SVG of the phases and the ways between them."""
    figure = Figure(figsize=(9.0, 6.6), facecolor=_PAPER)
    FigureCanvasAgg(figure)
    axes = figure.add_axes((0.0, 0.0, 1.0, 1.0))
    axes.set(xlim=(0.0, 1.0), ylim=(0.0, 1.0))
    axes.axis("off")
    rooms = {}
    for name, (x, y) in _PLACES.items():
        box = {"boxstyle": "round,pad=0.5", "facecolor": _ROOM, "edgecolor": _INK}
        text = axes.text(x, y, name, ha="center", va="center", fontsize=13, color=_INK, bbox=box, zorder=3)
        rooms[name] = text.get_bbox_patch()
    ways = sorted((row for row in TRANSITIONS if row.next != row.phase), key=lambda row: (row.phase, row.next))
    for (phase, then), rows in groupby(ways, key=lambda row: (PHASES[row.phase], PHASES[row.next])):
        arrow = FancyArrowPatch(
            _PLACES[phase], _PLACES[then], arrowstyle="-|>", mutation_scale=18, shrinkA=0, shrinkB=2,
            patchA=rooms[phase], patchB=rooms[then], color=_INK, linewidth=1.2, zorder=3.5,
        )  # fmt: skip
        axes.add_patch(arrow)
        words = "\n".join(fill(CONDITIONS[row.condition], 40) for row in rows)
        x, y = _LABELS[phase, then]
        back = {"facecolor": _PAPER, "edgecolor": "none", "pad": 1.5}
        axes.text(x, y, words, ha="center", va="center", fontsize=8.5, color=_INK, bbox=back, zorder=4)
    return svg_text(figure)
