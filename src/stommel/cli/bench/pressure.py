"""`stommel bench pressure`: a pressure test of the hull, judged."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from stommel.cli.finish import finish
from stommel.cli.options import JsonOption
from stommel.cli.output import number, show_table, show_values
from stommel.cli.paths import PlotOption

if TYPE_CHECKING:
    from stommel.bench import PressureReport


def pressure(
    table: Annotated[
        str, typer.Argument(metavar="TABLE", help="Table of holds (CSV), or fan2013-table5: the paper's Table 5.")
    ],
    description: Annotated[
        Path | None, typer.Option("--description", help="Columns, limits, chamber (TOML); the table's name with .toml.")
    ] = None,
    plot: PlotOption = None,
    as_json: JsonOption = False,
) -> None:
    """Judge a pressure test of the hull: loss and rate of each hold, the leak that would explain it, pass or fail.

    Example: stommel bench pressure fan2013-table5 --plot build/table5.png
    """
    from stommel.bench import judge, read_pressure_test

    report = judge(read_pressure_test(table, description))
    written = []
    if plot is not None:
        from stommel.bench.holding_plot import holding_figure
        from stommel.figures.saving import save_figure_as

        written.append(save_figure_as(holding_figure(report), plot))
    finish(report, written, as_json, _show)


def _show(report: "PressureReport") -> None:
    rows = []
    for result in report.results:
        h = result.as_row()
        leak = result.leak
        rows.append(
            [
                str(h["hold"]),
                f"{h['from']}-{h['to']}",
                number(result.hold.begin_pressure / 1e6, 3),
                number(result.hold.end_pressure / 1e6, 3),
                number(result.hold.loss / 1e6, 3),
                number(result.rate * 3600 / 1e6, 3),
                number(None if leak is None else leak * 3600e6, 1),
                "yes" if result.passed else "NO",
            ]
        )
    columns = ["hold", "time", "from\nMPa", "to\nMPa", "loss\nMPa", "rate\nMPa/h", "leak\nml/h", "passed"]
    show_table(report.test.description.title, columns, rows)
    limits = report.test.description.limits
    asked = f"less than {limits.largest_loss_mpa:g} MPa lost in each hold, above {limits.lowest_pressure_mpa:g} MPa"
    values = {"verdict": "passed" if report.passed else "FAILED", "asked": asked}
    show_values("Result", values, [*report.failures(), *report.notes()])
