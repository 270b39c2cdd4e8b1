"""Plots of a design study: each function returns a matplotlib `Figure`, drawn without pyplot or a display.

matplotlib is imported when the first figure is drawn, not when this package is.
"""

from stommel.report.plots.authority_plot import authority_figure
from stommel.report.plots.envelope_plot import envelope_figure
from stommel.report.plots.modes_plot import modes_figure
from stommel.report.plots.root_locus_plot import Plane, planes_of, root_locus_figure
from stommel.report.plots.trade_off import Decay, TradeOff, trade_off
from stommel.report.plots.trim_plot import trim_table_figure
from stommel.report.plots.turns_plot import turns_figure
from stommel.report.plots.vehicle_plot import vehicle_figure

__all__ = [
    "Decay",
    "Plane",
    "TradeOff",
    "authority_figure",
    "envelope_figure",
    "modes_figure",
    "planes_of",
    "root_locus_figure",
    "trade_off",
    "trim_table_figure",
    "turns_figure",
    "vehicle_figure",
]
