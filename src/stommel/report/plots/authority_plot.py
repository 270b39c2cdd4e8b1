"""Stability against control authority along a root locus: the trade-off of section 3.2 of the paper."""

from typing import TYPE_CHECKING, Any

import numpy as np

from stommel.analysis import Modes, RootLocus
from stommel.figures.style import CYCLE, DASHES, INK, MUTED, at_least_span, new_figure, number, styled
from stommel.report.plots.root_locus_plot import Plane, heading, planes_of
from stommel.report.plots.trade_off import TradeOff, trade_off

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure


@styled
def authority_figure(locus: RootLocus, plane: Plane | None = None, modes: Modes | None = None) -> "Figure":
    """Draw decay rates and control authority along a locus, and one against the other.

    Parameters
    ----------
    locus
        Eigenvalues and authorities along one number of the design.
    plane
        The plane to show; the first of `planes_of` if left out.
    modes
        Modes of the design, for the names of the lines.
    """
    trade = trade_off(locus, plane or planes_of(locus)[0], modes)
    figure = new_figure(9.2, 4.9)
    figure.suptitle(heading(locus), fontsize=9.5, x=0.012, ha="left")
    panels = figure.subplot_mosaic([["decay", "against"], ["authority", "against"]], width_ratios=(1.0, 1.1))
    _draw_decay(panels["decay"], locus, trade)
    _draw_authority(panels["authority"], locus, trade)
    _draw_against(panels["against"], locus, trade)
    handles, labels = panels["decay"].get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside lower left", ncols=4)
    return figure


def _mark_design(axes: "Axes", locus: RootLocus) -> None:
    low, high = sorted((locus.values[0], locus.values[-1]))
    if low <= locus.design_value <= high:
        axes.axvline(locus.design_value, color=INK, linewidth=0.9, linestyle=(0, (1, 2)), gid="design-value")
    axes.set_xlim(low, high)


def _draw_decay(axes: "Axes", locus: RootLocus, trade: TradeOff) -> None:
    for k, decay in enumerate(trade.decays):
        axes.plot(locus.values, decay.rate, color=CYCLE[k], linestyle=DASHES[k], label=decay.name, gid="decay")
    least = min((float(decay.rate.min()) for decay in trade.decays), default=0.0)
    axes.set_ylim(bottom=0.0 if least >= 0.0 else None)
    if least < 0.0:
        axes.axhline(0.0, color=INK, linewidth=1.0)
    _mark_design(axes, locus)
    axes.set_title("Stability")
    axes.set_ylabel("Decay rate −Re λ [1/s]")
    axes.tick_params(labelbottom=False)


def _draw_authority(axes: "Axes", locus: RootLocus, trade: TradeOff) -> None:
    axes.set_title("Control authority")
    axes.set_xlabel(f"{heading(locus).split(' from ')[0]}{f' [{locus.unit}]' if locus.unit else ''}")
    _mark_design(axes, locus)
    if trade.authority is None:
        axes.text(0.5, 0.5, "no steering actuator", transform=axes.transAxes, ha="center", color=MUTED)
        return
    axes.plot(locus.values, trade.authority, color=INK, gid="authority")
    axes.set_ylim(0.0, 1.25 * float(trade.authority.max()))
    name = trade.authority_name.replace(" per ", "\nper ")
    axes.set_ylabel(f"{name[0].upper()}{name[1:]}\n[{trade.authority_unit}]", fontsize=8.6)


def _draw_against(axes: "Axes", locus: RootLocus, trade: TradeOff) -> None:
    """Both as shares of their values at the design, so that modes of any speed share one axis."""
    axes.set_title("One against the other")
    axes.set_xlabel("Control authority, % of design")
    axes.set_ylabel("Decay rate, % of design")
    k = int(np.argmin(np.abs(locus.values - locus.design_value)))
    if trade.authority is None or trade.authority[k] == 0.0:
        axes.text(0.5, 0.5, "no authority to compare with", transform=axes.transAxes, ha="center", color=MUTED)
        return
    across = 100.0 * trade.authority / trade.authority[k]
    ends: dict[str, Any] = {"markersize": 6.0, "markerfacecolor": "white", "markeredgecolor": INK, "zorder": 4}
    shares = [100.0 * decay.rate / (abs(decay.rate[k]) or 1.0) for decay in trade.decays]
    for j, share in enumerate(shares):
        axes.plot(across, share, color=CYCLE[j], linestyle=DASHES[j], gid="against")
        axes.plot(across[0], share[0], "o", gid="start", **ends)
        axes.plot(across[-1], share[-1], "s", gid="end", **ends)
        axes.plot(100.0, share[k], "x", color=INK, markersize=8.5, markeredgewidth=1.9, zorder=5, gid="design")
    axes.set_xlim(*at_least_span(float(across.min()), float(across.max()), 20.0))
    axes.set_ylim(*at_least_span(float(np.min(shares)), float(np.max(shares)), 20.0))
    note = f"○ {number(locus.values[0])}   □ {number(locus.values[-1])}   × {number(locus.values[k])}"
    if float(np.ptp(across)) < 1.0:
        note += "\nauthority changes\nby less than 1 %"
    axes.text(0.985, 0.985, note, transform=axes.transAxes, ha="right", va="top", fontsize=8.6, color=MUTED)
