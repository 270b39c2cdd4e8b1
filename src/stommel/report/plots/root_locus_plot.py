"""Root loci, as Figs. 3 and 4 of the paper: from circles to squares, with crosses at the design value."""

from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from stommel.analysis import Modes, RootLocus
from stommel.figures.style import CYCLE, DASHES, INK, legend_below, new_figure, number, styled
from stommel.report.plots.complex_plane import Eigenvalues, prepare, write_names

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

Plane = Literal["longitudinal", "lateral"]

_PLANES: dict[str, tuple[Plane, ...]] = {"wing_position": ("longitudinal",), "rudder_position": ("lateral",)}
_WORDS = {
    "wing_position": "wing position $l_w/l$",
    "rudder_position": "rudder position $l_r/l$",
}


def planes_of(locus: RootLocus) -> tuple[Plane, ...]:
    """Planes worth showing: the one that the paper shows for a wing or a rudder, otherwise every known one."""
    wanted = _PLANES.get(locus.over, ("longitudinal", "lateral"))
    known = tuple(plane for plane in wanted if getattr(locus, plane) is not None)
    return known or ("longitudinal",)


def varied(locus: RootLocus) -> str:
    """What is varied from where to where, with its unit."""
    words = _WORDS.get(locus.over, locus.over)
    unit = "" if locus.over in _WORDS or not locus.unit else f" {locus.unit}"
    return f"{words} from {number(locus.values[0])} to {number(locus.values[-1])}{unit}"


def heading(locus: RootLocus) -> str:
    """What is varied from where to where, and the flight that the locus is about."""
    words = varied(locus)
    if locus.over in _WORDS:
        words = words[0].upper() + words[1:]
    return f"{words}   ·   {number(locus.speed_m_s)} m/s at pitch {number(locus.pitch_deg)}°"


@styled
def root_locus_figure(locus: RootLocus, plane: Plane | None = None, modes: Modes | None = None) -> "Figure":
    """Draw a root locus.

    Parameters
    ----------
    locus
        Eigenvalues along one number of the design.
    plane
        The plane to show; those of `planes_of` if left out.
    modes
        Modes of the design, whose names are written beside the crosses if given.
    """
    planes = (plane,) if plane is not None else planes_of(locus)
    figure = new_figure(7.0 if len(planes) == 1 else 10.0, 4.9)
    figure.suptitle(heading(locus), fontsize=9.5, x=0.012, ha="left")
    panels = figure.subplots(1, len(planes), squeeze=False)[0]
    for axes, name in zip(panels, planes, strict=True):
        branches, design = (locus.longitudinal, locus.design_longitudinal)
        if name == "lateral":
            if locus.lateral is None:
                axes.set_axis_off()
                axes.text(0.5, 0.5, "Lateral coefficients of this vehicle are unknown", ha="center")
                continue
            branches, design = locus.lateral, locus.design_lateral
        _draw_plane(axes, branches, design, locus)
        axes.set_title("Longitudinal modes" if name == "longitudinal" else "Lateral-directional modes")
        if modes is not None and design is not None:
            write_names(axes, getattr(modes, name) or ())
    legend_below(figure, panels[0], columns=3)
    return figure


def _draw_plane(axes: "Axes", branches: Eigenvalues, design: Eigenvalues | None, locus: RootLocus) -> None:
    shown = branches.ravel() if design is None else np.append(branches.ravel(), design)
    prepare(axes, shown)
    start, stop, here = (number(value) for value in (locus.values[0], locus.values[-1], locus.design_value))
    for k, style in enumerate(_styles(branches)):
        axes.plot(branches[:, k].real, branches[:, k].imag, color=CYCLE[style], linestyle=DASHES[style], gid="branch")
    ends: dict[str, Any] = {
        "linestyle": "none",
        "markersize": 6.5,
        "markerfacecolor": "white",
        "markeredgecolor": INK,
        "zorder": 4,
    }
    axes.plot(branches[0].real, branches[0].imag, "o", label=f"start, {start}", gid="start", **ends)
    axes.plot(branches[-1].real, branches[-1].imag, "s", label=f"end, {stop}", gid="end", **ends)
    if design is not None:
        axes.plot(
            design.real, design.imag, "x", color=INK, markersize=8.5, markeredgewidth=1.9, zorder=5, gid="design",
            linestyle="none", label=f"design value, {here}",
        )  # fmt: skip


def _styles(branches: Eigenvalues) -> list[int]:
    """Colour of each branch; the two halves of a conjugate pair share one."""
    styles: list[int] = []
    for k in range(branches.shape[1]):
        twin = next((j for j in range(k) if np.allclose(branches[0, j], np.conj(branches[0, k]), atol=1e-12)), None)
        styles.append(styles[twin] if twin is not None else max(styles, default=-1) + 1)
    return styles
