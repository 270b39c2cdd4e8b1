"""`stommel bench fit`: constants of the engine from a log."""

from typing import TYPE_CHECKING, Annotated

import typer

from stommel.cli.bench.options import (
    ColumnOption,
    ConstantOption,
    LogsArgument,
    MapOption,
    OfVehicle,
    head_of,
    read_logs,
)
from stommel.cli.finish import finish
from stommel.cli.options import JsonOption, load
from stommel.cli.output import show_notes, show_table, show_warnings
from stommel.cli.paths import PlotsOption
from stommel.files.units import counted

if TYPE_CHECKING:
    from stommel.bench import EngineFit, EngineLog


def fit(
    logs: LogsArgument,
    vehicle: OfVehicle = "zju",
    parameter: Annotated[
        list[str] | None,
        typer.Option("--parameter", help="Constant to fit, as often as needed; five of the pump if left out."),
    ] = None,
    column_map: MapOption = None,
    column: ColumnOption = None,
    constant: ConstantOption = None,
    plots: PlotsOption = None,
    as_json: JsonOption = False,
) -> None:
    """Fit constants of the engine model to a log, with intervals, correlation and warnings.

    Example: stommel bench fit build/bench.csv --plots build/bench
    """
    from stommel.bench import DEFAULT_PARAMETERS, bench_engine, fit_engine, performance, piston_area_of

    log = read_logs(logs, column_map, column, constant)
    engine = bench_engine(load(vehicle))
    runs = performance(log, piston_area_of(log, engine), engine)
    found = fit_engine(runs, engine, tuple(parameter or DEFAULT_PARAMETERS), log.true_parameters)
    written = []
    if plots is not None:
        from stommel.bench.fit_plot import fit_figure
        from stommel.bench.performance_plot import performance_figure
        from stommel.figures.saving import save_figure

        curves = performance_figure([run.point for run in runs], generated=log.generated, engine=found.engine)
        written = save_figure(fit_figure(found, runs, generated=log.generated), plots / "fit")
        written += save_figure(curves, plots / "fit-curves")
    finish(head_of(log) | found.as_json(), written, as_json, lambda _: _show(log, found))


def _show(log: "EngineLog", found: "EngineFit") -> None:
    from stommel.bench.wording import parameter_unit, parameter_words

    rows = []
    for one in found.parameters:
        unit, factor = parameter_unit(one.name)
        cells = [one.value, one.low, one.high, one.start, one.true]
        rows.append(
            [f"{parameter_words(one.name)}, {unit}"] + ["-" if v is None else f"{v * factor:.4g}" for v in cells]
        )
    columns = ["constant", "value", "low", "high", "vehicle\nfile", "true"]
    show_table(f"Fit to {counted(len(found.flow_residuals), 'run')}, {log.origin}", columns, rows)
    show_notes(
        [
            "All true values lie in their intervals at once with 95 % probability, if the model is right.",
            f"Runs scatter by {found.flow_scatter:.2%} in piston speed and {found.current_scatter:.2%} in current.",
        ]
    )
    show_warnings(found.warnings)
