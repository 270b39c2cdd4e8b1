"""`stommel bench`: logs of the buoyancy engine and pressure tests of the hull."""

from math import pi
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from stommel.cli.numbers import numbers
from stommel.cli.options import JsonOption, VehicleArgument, load
from stommel.cli.output import number, show_json, show_table, show_values

if TYPE_CHECKING:
    from stommel.bench import EngineFit, EngineLog, PressureReport, SpeedChoice, TimeLimit

bench_app = typer.Typer(help="Bench tests: logs of the buoyancy engine, pressure tests of the hull.")

LogsArgument = Annotated[list[Path], typer.Argument(metavar="LOG...", help="Engine logs (CSV); read as one.")]
MapOption = Annotated[
    Path | None, typer.Option("--map", help="Column map (TOML); the log's name with .toml if left out.")
]
ColumnOption = Annotated[
    list[str] | None,
    typer.Option("--column", help="QUANTITY=COLUMN:UNIT, as often as needed; run=COLUMN tells runs apart."),
]
ConstantOption = Annotated[
    list[str] | None, typer.Option("--constant", help="QUANTITY=NUMBER:UNIT, for what no column holds.")
]
OfVehicle = Annotated[str, typer.Option("--vehicle", help="Vehicle whose engine was on the bench.")]
PlotOption = Annotated[Path | None, typer.Option("--plot", help="Plots to write as PNG and SVG, without an ending.")]
TimeOption = Annotated[float, typer.Option("--time-limit-s", help="Longest time that an inflation may take [s].")]
InflateOption = Annotated[float, typer.Option("--inflate-ml", help="Volume of that inflation [ml].")]
LimitPressureOption = Annotated[float, typer.Option("--limit-pressure-mpa", help="Pressure of that inflation [MPa].")]
MarginOption = Annotated[
    float, typer.Option("--margin-percent", help="Consumptions this close count as equal: the slowest speed is taken.")
]


@bench_app.command("generate")
def generate(
    vehicle: VehicleArgument,
    output: Annotated[Path, typer.Option("--output", "-o", help="Log to write (CSV); its map goes beside it.")],
    seed: Annotated[int, typer.Option("--seed", help="Of the noise: the same seed gives the same bytes.")] = 1,
    pressure: Annotated[
        str, typer.Option("--pressure-mpa", help="Pressures: a number, list or range first:last:step [MPa].")
    ] = "0:2.5:0.5",
    speed: Annotated[
        str, typer.Option("--speed-rpm", help="Motor speeds, in the same way [r/min].")
    ] = "3500:8750:1750",
    period: Annotated[float, typer.Option("--period-s", help="Time between two rows [s].")] = 0.5,
    noise: Annotated[float, typer.Option("--noise", help="Times the usual noise; 0 is none.")] = 1.0,
    as_json: JsonOption = False,
) -> None:
    """Make an engine log with the model, marked as generated: the paper's bench results are not published as numbers.

    Example: stommel bench generate zju --output build/bench.csv --seed 1
    """
    from stommel.bench import BenchPlan, SensorNoise, bench_engine, generate_log, write_log

    glider = load(vehicle)
    plan = BenchPlan(
        pressures=tuple(p * 1e6 for p in numbers(pressure, "--pressure-mpa")),
        motor_speeds=tuple(n * 2 * pi / 60 for n in numbers(speed, "--speed-rpm")),
        period=period,
    )
    log = generate_log(bench_engine(glider), seed, plan, SensorNoise().times(noise))
    written = write_log(log, output, seed, glider.name)
    if as_json:
        show_json({"origin": log.origin, "seed": seed, "runs": len(log.runs), "files": [str(path) for path in written]})
        return
    typer.echo(f"{len(log.runs)} runs, {log.origin}")
    for path in written:
        typer.echo(f"wrote {path}")


@bench_app.command("analyse")
def analyse(
    logs: LogsArgument,
    vehicle: OfVehicle = "zju",
    column_map: MapOption = None,
    column: ColumnOption = None,
    constant: ConstantOption = None,
    time_limit: TimeOption = 90.0,
    inflate: InflateOption = 500.0,
    limit_pressure: LimitPressureOption = 2.0,
    margin: MarginOption = 5.0,
    plot: PlotOption = None,
    as_json: JsonOption = False,
) -> None:
    """Current, consumption K, efficiency and inflating time of every run, and the most economical motor speed.

    Example: stommel bench analyse build/bench.csv --plot build/bench
    """
    from stommel.bench import bench_engine, performance, piston_area_of, time_limit_of

    log = _read(logs, column_map, column, constant)
    engine = bench_engine(load(vehicle))
    area = piston_area_of(log, engine)
    runs = performance(log, area, engine)
    limit = time_limit_of(longest_s=time_limit, volume_ml=inflate, pressure_mpa=limit_pressure)
    choice, unanswered = _choice_of([run.point for run in runs], limit, area, margin)
    written: list[Path] = []
    if plot is not None:
        from stommel.bench.performance_plot import performance_figure, response_figure
        from stommel.figures.saving import save_figure

        shown = choice.chosen if choice is not None else None
        at = shown.motor_speed if shown is not None else runs[-1].point.motor_speed
        written = save_figure(
            performance_figure([run.point for run in runs], generated=log.generated, choice=choice), plot
        )
        written += save_figure(response_figure(log, at), plot.with_name(f"{plot.name}-response"))
    rows = [run.as_row(area, limit.volume) for run in runs]
    if as_json:
        show_json(
            _head(log)
            | {"piston_area_cm2": area * 1e4, "inflate_ml": inflate, "runs": rows}
            | {"choice": _choice_json(choice), "no_choice_because": unanswered, "plots": [str(p) for p in written]}
        )
        return
    body = [
        [
            number(run.point.pressure / 1e6, 2),
            number(run.point.motor_speed * 60 / (2 * pi), 0),
            number(run.point.current, 3),
            number(run.point.K / 1e3, 2),
            number(run.point.efficiency, 3),
            number(run.point.inflating_time(limit.volume, area), 1),
        ]
        for run in runs
    ]
    columns = ["pressure\nMPa", "speed\nr/min", "current\nA", "K\nJ/mm", "efficiency\n", f"{inflate:g} ml\ns"]
    show_table(f"{len(runs)} runs, {log.origin}", columns, body)
    _show_choice(choice, unanswered)
    _show_written(written)


@bench_app.command("fit")
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
    plot: PlotOption = None,
    as_json: JsonOption = False,
) -> None:
    """Fit constants of the engine model to a log, with intervals, correlation and warnings.

    Example: stommel bench fit build/bench.csv --plot build/bench-fit
    """
    from stommel.bench import DEFAULT_PARAMETERS, bench_engine, fit_engine, performance, piston_area_of

    log = _read(logs, column_map, column, constant)
    engine = bench_engine(load(vehicle))
    runs = performance(log, piston_area_of(log, engine), engine)
    found = fit_engine(runs, engine, tuple(parameter or DEFAULT_PARAMETERS), log.true_parameters)
    written: list[Path] = []
    if plot is not None:
        from stommel.bench.fit_plot import fit_figure
        from stommel.bench.performance_plot import performance_figure
        from stommel.figures.saving import save_figure

        written = save_figure(fit_figure(found, runs, generated=log.generated), plot)
        curves = performance_figure([run.point for run in runs], generated=log.generated, engine=found.engine)
        written += save_figure(curves, plot.with_name(f"{plot.name}-curves"))
    if as_json:
        show_json(_head(log) | found.as_json() | {"plots": [str(path) for path in written]})
        return
    _show_fit(log, found)
    _show_written(written)


@bench_app.command("speed")
def speed(
    vehicle: VehicleArgument,
    speeds: Annotated[str, typer.Option("--speed-rpm", help="Motor speeds to choose from [r/min].")] = "3500:8750:1750",
    pressures: Annotated[
        str, typer.Option("--pressure-mpa", help="Pressures that the consumption is averaged over [MPa].")
    ] = "0:2.5:0.5",
    time_limit: TimeOption = 90.0,
    inflate: InflateOption = 500.0,
    limit_pressure: LimitPressureOption = 2.0,
    margin: MarginOption = 5.0,
    as_json: JsonOption = False,
) -> None:
    """Choose the most economical motor speed by the model, without a log.

    Example: stommel bench speed zju --time-limit-s 90
    """
    from stommel.bench import MARKER, bench_engine, choose_speed, model_points, time_limit_of

    engine = bench_engine(load(vehicle))
    points = model_points(
        engine,
        [p * 1e6 for p in numbers(pressures, "--pressure-mpa")],
        [n * 2 * pi / 60 for n in numbers(speeds, "--speed-rpm")],
    )
    limit = time_limit_of(longest_s=time_limit, volume_ml=inflate, pressure_mpa=limit_pressure)
    choice = choose_speed(points, limit, engine.piston_area_m2, margin / 100)
    if as_json:
        show_json({"origin": MARKER, "choice": _choice_json(choice)})
        return
    _show_choice(choice, "")


@bench_app.command("pressure")
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

    Example: stommel bench pressure fan2013-table5 --plot build/table5
    """
    from stommel.bench import judge, read_pressure_test

    report = judge(read_pressure_test(table, description))
    written: list[Path] = []
    if plot is not None:
        from stommel.bench.holding_plot import holding_figure
        from stommel.figures.saving import save_figure

        written = save_figure(holding_figure(report), plot)
    if as_json:
        show_json(report.as_json() | {"plots": [str(path) for path in written]})
        return
    _show_holds(report)
    _show_written(written)


def _read(
    logs: list[Path], column_map: Path | None, columns: list[str] | None, constants: list[str] | None
) -> "EngineLog":
    from stommel.bench import joined, load_map, read_engine_log

    return joined([read_engine_log(log, load_map(log, column_map, columns or (), constants or ())) for log in logs])


def _head(log: "EngineLog") -> dict[str, Any]:
    return {"origin": log.origin, "generated": log.generated}


def _choice_of(points: list[Any], limit: "TimeLimit", area: float, margin: float) -> "tuple[SpeedChoice | None, str]":
    """The choice, or why these runs allow none."""
    from stommel.bench import BenchRequestError, choose_speed

    try:
        return choose_speed(points, limit, area, margin / 100), ""
    except BenchRequestError as error:
        return None, str(error)


def _choice_json(choice: "SpeedChoice | None") -> dict[str, Any] | None:
    if choice is None:
        return None
    return {
        "motor_speed_rpm": None if choice.chosen is None else choice.chosen.motor_speed * 60 / (2 * pi),
        "reason": choice.reason(),
        "time_limit_s": choice.limit.longest,
        "inflate_ml": choice.limit.volume * 1e6,
        "limit_pressure_mpa": choice.limit.pressure / 1e6,
        "margin_percent": choice.margin * 100,
        "pressures_mpa": [P / 1e6 for P in choice.pressures],
        "candidates": [one.as_row() for one in choice.candidates],
    }


def _show_choice(choice: "SpeedChoice | None", unanswered: str) -> None:
    if choice is None:
        typer.echo(f"no choice of a motor speed: {unanswered}")
        return
    rows = [
        [
            number(one.motor_speed * 60 / (2 * pi), 0),
            number(one.K / 1e3, 2),
            number(one.inflating_time, 1),
            "chosen" if one is choice.chosen else one.refused_because or "possible",
        ]
        for one in choice.candidates
    ]
    title = f"Motor speed, averaged over {', '.join(f'{abs(round(P / 1e6, 2)):g}' for P in choice.pressures)} MPa"
    columns = ["speed\nr/min", "K\nJ/mm", f"{choice.limit.volume * 1e6:g} ml\ns", ""]
    show_table(title, columns, rows, [choice.reason()])


def _show_fit(log: "EngineLog", found: "EngineFit") -> None:
    from stommel.bench.wording import parameter_unit, parameter_words

    rows = []
    for one in found.parameters:
        unit, factor = parameter_unit(one.name)
        cells = [one.value, one.low, one.high, one.start, one.true]
        rows.append(
            [f"{parameter_words(one.name)}, {unit}"] + ["-" if v is None else f"{v * factor:.4g}" for v in cells]
        )
    notes = [
        "All true values lie in their intervals at once with 95 % probability, if the model is right.",
        f"Runs scatter by {found.flow_scatter:.2%} in piston speed and {found.current_scatter:.2%} in current.",
        *(f"warning: {words}" for words in found.warnings),
    ]
    columns = ["constant", "value", "low", "high", "vehicle\nfile", "true"]
    show_table(f"Fit to {len(found.flow_residuals)} runs, {log.origin}", columns, rows, notes)


def _show_holds(report: "PressureReport") -> None:
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


def _show_written(written: list[Path]) -> None:
    for path in written:
        typer.echo(f"wrote {path}")
