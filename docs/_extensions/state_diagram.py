"""Pictures of state machines: rooms, and ways between them with the words of what they wait for."""

from collections.abc import Iterable, Mapping
from itertools import groupby
from textwrap import fill

from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.patches import FancyArrowPatch

from stommel.figures.saving import svg_text

Place = tuple[float, float]
"""In the picture, from 0 to 1: to the right and up."""

_INK, _PAPER, _ROOM = "#1f2937", "#ffffff", "#dbeafe"


def drawn(
    places: Mapping[str, Place],
    labels: Mapping[tuple[str, str], Place],
    ways: Iterable[tuple[str, str, str]],
    *,
    width: int = 40,
) -> str:
    """Return the picture as SVG.

    Parameters
    ----------
    places
        Where each room stands.
    labels
        Where the words of each way stand, by the rooms it leads from and to; without a place it has an arrow only.
    ways
        From, to and words; those of one pair of rooms one after the other. Ways back to the same room are left out.
    width
        Of the words, in letters.
    """
    figure = Figure(figsize=(9.0, 6.6), facecolor=_PAPER)
    FigureCanvasAgg(figure)
    axes = figure.add_axes((0.0, 0.0, 1.0, 1.0))
    axes.set(xlim=(0.0, 1.0), ylim=(0.0, 1.0))
    axes.axis("off")
    rooms = {}
    for name, (x, y) in places.items():
        box = {"boxstyle": "round,pad=0.5", "facecolor": _ROOM, "edgecolor": _INK}
        text = axes.text(x, y, name, ha="center", va="center", fontsize=13, color=_INK, bbox=box, zorder=3)
        rooms[name] = text.get_bbox_patch()
    pairs = [(ends, list(rows)) for ends, rows in groupby(ways, key=lambda way: (way[0], way[1])) if ends[0] != ends[1]]
    there = {ends for ends, _ in pairs}
    for (start, end), rows in pairs:
        bend = "arc3,rad=0.12" if (end, start) in there else "arc3,rad=0"
        arrow = FancyArrowPatch(
            places[start], places[end], arrowstyle="-|>", mutation_scale=18, shrinkA=0, shrinkB=2,
            patchA=rooms[start], patchB=rooms[end], color=_INK, linewidth=1.2, zorder=3.5, connectionstyle=bend,
        )  # fmt: skip
        axes.add_patch(arrow)
        if (start, end) not in labels:
            continue
        x, y = labels[start, end]
        words = "\n".join(fill(words, width) for _, _, words in rows)
        back = {"facecolor": _PAPER, "edgecolor": "none", "pad": 1.5}
        axes.text(x, y, words, ha="center", va="center", fontsize=8.5, color=_INK, bbox=back, zorder=4)
    return svg_text(figure)
