"""A hull pressure test over time: pressure of each hold against its limit, and the rate at which it was lost."""

from typing import TYPE_CHECKING

from stommel.bench.leakage import HoldResult, PressureReport
from stommel.figures.style import BLUE, GREEN, INK, MUTED, VERMILION, new_figure, styled

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure


@styled
def holding_figure(report: PressureReport) -> "Figure":
    """Draw pressure over clock time, one line a hold, with the limit; below, the rate of loss and its leak."""
    figure = new_figure(8.4, 6.2)
    top, bottom = figure.subplots(2, 1, sharex=True, height_ratios=(1.25, 1.0))
    _draw_pressures(top, report)
    _draw_rates(bottom, report)
    first, last = report.results[0].hold.begin, report.results[-1].hold.end
    step = next((step for step in (0.5, 1, 2, 3, 6, 12, 24) if (last - first) / 3600 / step <= 10), 48)
    ticks = [k * step for k in range(int(first / 3600 / step), int(last / 3600 / step) + 2)]
    bottom.set_xticks(ticks, [f"{int(tick * 60) // 60 % 24:02d}:{int(tick * 60) % 60:02d}" for tick in ticks])
    room = 0.03 * (last - first) / 3600
    bottom.set_xlim(first / 3600 - room, last / 3600 + room)
    bottom.set_xlabel("Time of day")
    return figure


def _draw_pressures(axes: "Axes", report: PressureReport) -> None:
    limit = report.test.description.limits
    for result in report.results:
        h, colour = result.hold, _colour(result)
        axes.plot(
            [h.begin / 3600, h.end / 3600],
            [h.begin_pressure / 1e6, h.end_pressure / 1e6],
            "o-",
            color=colour,
            markersize=5,
        )
        axes.annotate(
            f"−{h.loss / 1e6:.3f}", (h.end / 3600, h.end_pressure / 1e6), xytext=(-2, -7), textcoords="offset points",
            ha="center", va="top", fontsize=8.4, color=colour,
        )  # fmt: skip
    axes.axhline(limit.lowest_pressure_mpa, color=VERMILION, linewidth=1.2, linestyle=(0, (5, 3)))
    highest = max(result.hold.begin_pressure for result in report.results) / 1e6
    lowest = min(min(result.hold.end_pressure for result in report.results) / 1e6, limit.lowest_pressure_mpa)
    axes.set_ylim(lowest - 0.14 * (highest - lowest), highest + 0.1 * (highest - lowest))
    axes.annotate(
        f"must stay above {limit.lowest_pressure_mpa:g} MPa", (0.995, limit.lowest_pressure_mpa), xytext=(0, 3),
        xycoords=("axes fraction", "data"), textcoords="offset points", ha="right", fontsize=8.8, color=VERMILION,
    )  # fmt: skip
    axes.set_ylabel("Pressure [MPa]")
    verdict = "passed" if report.passed else "FAILED"
    axes.set_title(f"{report.test.description.title}: {verdict}")


def _draw_rates(axes: "Axes", report: PressureReport) -> None:
    for result in report.results:
        h = result.hold
        axes.bar(
            h.begin / 3600, result.rate * 3600 / 1e6, width=h.duration / 3600, align="edge", alpha=0.75,
            color=_colour(result),
        )  # fmt: skip
        if result.leak is not None:
            axes.annotate(
                f"{result.leak * 3600e6:.1f} ml/h", ((h.begin + h.end) / 7200, result.rate * 3600 / 1e6), xytext=(0, 3),
                textcoords="offset points", ha="center", fontsize=8.4, color=INK,
            )  # fmt: skip
    axes.margins(y=0.16)
    axes.set_ylabel("Rate of loss [MPa/h]")
    leak = " and the leak that would explain it" if report.results[0].leak is not None else ""
    axes.set_title(f"Rate of loss{leak}")
    if report.settling is not None:
        axes.annotate(
            f"× {report.settling.ratio_per_hour:.2f} per hour under pressure", (0.995, 0.96), xycoords="axes fraction",
            ha="right", va="top", fontsize=8.8, color=MUTED,
        )  # fmt: skip


def _colour(result: HoldResult) -> str:
    if not result.passed:
        return VERMILION
    return BLUE if result.hold.loss > 0.0 else GREEN
