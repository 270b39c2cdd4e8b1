"""The modes of the vehicle's nodes and their parameters, as tables and a diagram, from the tables of the code."""

from collections.abc import Iterator
from itertools import groupby
from textwrap import fill

from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.patches import FancyArrowPatch

from stommel.figures.saving import svg_text
from stommel.messages.parameters import ParameterType
from stommel.onboard.execution.node_states import STATES, TRANSITIONS, Event, Mode
from stommel.onboard.nodes.node_settings import NodeSettings, parameters_of

_BEFORE = "what it was before"

_PLACES = {
    Mode.INITIALISING: (0.13, 0.93),
    Mode.PRE_OPERATIONAL: (0.13, 0.64),
    Mode.OPERATIONAL: (0.50, 0.64),
    Mode.STOPPED: (0.50, 0.94),
    Mode.BRAKED: (0.90, 0.64),
    Mode.QUIET: (0.36, 0.30),
    Mode.LEFT_ALONE: (0.13, 0.10),
    Mode.ABORTED: (0.80, 0.14),
}

_DRAWN = {
    (Mode.INITIALISING, Mode.PRE_OPERATIONAL): (0.0, (0.13, 0.79)),
    (Mode.PRE_OPERATIONAL, Mode.OPERATIONAL): (0.2, (0.31, 0.595)),
    (Mode.OPERATIONAL, Mode.PRE_OPERATIONAL): (0.2, (0.31, 0.70)),
    (Mode.OPERATIONAL, Mode.STOPPED): (0.3, (0.60, 0.79)),
    (Mode.STOPPED, Mode.OPERATIONAL): (0.3, (0.41, 0.79)),
    (Mode.OPERATIONAL, Mode.BRAKED): (0.2, (0.72, 0.595)),
    (Mode.BRAKED, Mode.OPERATIONAL): (0.2, (0.72, 0.70)),
    (Mode.OPERATIONAL, Mode.QUIET): (0.2, (0.37, 0.47)),
    (Mode.QUIET, Mode.OPERATIONAL): (0.25, (0.51, 0.42)),
    (Mode.QUIET, Mode.LEFT_ALONE): (-0.15, (0.30, 0.17)),
    (Mode.LEFT_ALONE, Mode.OPERATIONAL): (-0.4, (0.13, 0.40)),
    (Mode.OPERATIONAL, Mode.ABORTED): (0.2, (0.60, 0.31)),
    (Mode.ABORTED, Mode.OPERATIONAL): (0.2, (0.80, 0.43)),
}
"""Ways that the picture shows, how far they are bent, and where their words stand; the table has them all."""

_INK, _PAPER, _ROOM = "#1f2937", "#ffffff", "#dbeafe"


def transition_table() -> Iterator[str]:
    """Lines of the table of transitions, in Markdown."""
    yield "| mode | heartbeat | when | next |\n|---|---|---|---|\n"
    for mode, rows in groupby(sorted(TRANSITIONS, key=lambda row: list(Mode).index(row.mode)), lambda row: row.mode):
        for row in rows:
            following = _BEFORE if row.next is None else row.next.value
            yield f"| {mode.value} | {STATES[mode].name} | {row.event.value} | {following} |\n"


def _events(mode: Mode, then: Mode) -> list[Event]:
    return [row.event for row in TRANSITIONS if row.mode is mode and (row.next or Mode.OPERATIONAL) is then]


def diagram() -> str:
    """SVG of the modes and the ways between them."""
    figure = Figure(figsize=(9.0, 6.6), facecolor=_PAPER)
    FigureCanvasAgg(figure)
    axes = figure.add_axes((0.0, 0.0, 1.0, 1.0))
    axes.set(xlim=(0.0, 1.0), ylim=(0.0, 1.0))
    axes.axis("off")
    rooms = {}
    for mode, (x, y) in _PLACES.items():
        box = {"boxstyle": "round,pad=0.5", "facecolor": _ROOM, "edgecolor": _INK}
        text = axes.text(x, y, mode.value, ha="center", va="center", fontsize=12, color=_INK, bbox=box, zorder=3)
        rooms[mode] = text.get_bbox_patch()
    for (mode, then), (bend, (x, y)) in _DRAWN.items():
        arrow = FancyArrowPatch(
            _PLACES[mode], _PLACES[then], arrowstyle="-|>", mutation_scale=16, shrinkA=0, shrinkB=2,
            patchA=rooms[mode], patchB=rooms[then], color=_INK, linewidth=1.1, zorder=3.5,
            connectionstyle=f"arc3,rad={bend}",
        )  # fmt: skip
        axes.add_patch(arrow)
        words = "\n".join(fill(event.value.replace("`", ""), 24) for event in _events(mode, then))
        back = {"facecolor": _PAPER, "edgecolor": "none", "pad": 1.0}
        axes.text(x, y, words, ha="center", va="center", fontsize=8, color=_INK, bbox=back, zorder=4)
    return svg_text(figure)


def parameter_table(settings: NodeSettings) -> Iterator[str]:
    """Lines of the table of a node's parameters, in Markdown; the limits are those of the default."""
    yield "| number | parameter | default | limits | meaning |\n|---|---|---|---|---|\n"
    for p in parameters_of(settings):
        unit = f" {p.unit}".rstrip()
        if p.type is ParameterType.bool:
            default, limits = str(p.default).lower(), "true, false"
        else:
            default, limits = f"{p.default:g}{unit}", f"{p.low:g} to {p.high:g}{unit}"
        yield f"| {p.number} | `{p.name}` | {default} | {limits} | {p.words} |\n"
