"""Colours behind a curve that tell the phase of the dive."""

from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from stommel.control.dive_cycle import PHASES

if TYPE_CHECKING:
    from matplotlib.axes import Axes

SHADES = {
    "surface": "#dfe9f3",
    "descent": "#ffffff",
    "inflection": "#f6e0d0",
    "ascent": "#f1f2f4",
    "recovery": "#dfe9f3",
    "drift": "#dcf0e4",
}
"""Of each of `PHASES`."""

_NAMES = {
    "surface": "at the surface blue",
    "descent": "descent white",
    "drift": "drift green",
    "inflection": "inflection orange",
    "ascent": "ascent grey",
}


def shade_phases(axes: "Axes", phase: NDArray[np.int8], time: NDArray[np.float64]) -> None:
    """Colour the background by phase; `time` in the units of the axis."""
    changes = np.flatnonzero(np.diff(phase)) + 1
    edges = np.concatenate([[0], changes, [len(phase) - 1]])
    for low, high in pairwise(edges):
        axes.axvspan(time[low], time[high], color=SHADES[PHASES[int(phase[low])]], linewidth=0)


def legend_of(phase: NDArray[np.int8]) -> str:
    """The colours of the phases that occur, in words."""
    found = {PHASES[int(k)] for k in np.unique(phase)}
    return ", ".join(words for name, words in _NAMES.items() if name in found)
