"""`stommel bench analyse`: what an engine log says, run by run, and the most economical motor speed."""

from typing import TYPE_CHECKING, Any

import typer

from stommel.cli.bench.choice import show_choice
from stommel.cli.bench.options import (
    ColumnOption,
    ConstantOption,
    InflateOption,
    LimitPressureOption,
    LogsArgument,
    MapOption,
    MarginOption,
    OfVehicle,
    TimeOption,
    head_of,
    read_logs,
)
from stommel.cli.finish import finish
from stommel.cli.options import JsonOption, load
from stommel.cli.output import number, show_table
from stommel.cli.paths import PlotsOption
from stommel.files.units import counted

if TYPE_CHECKING:
    from pathlib import Path

    from stommel.bench import EngineLog, OperatingPoint, RunPerformance, SpeedChoice, TimeLimit


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
    plots: PlotsOption = None,
    as_json: JsonOption = False,
) -> None:
    """Current, consumption K, efficiency and inflating time of every run, and the most economical motor speed.

    Example: stommel bench analyse build/bench.csv --plots build/bench
    """
    from stommel.bench import bench_engine, performance, piston_area_of, time_limit_of

    log = read_logs(logs, column_map, column, constant)
    engine = bench_engine(load(vehicle))
    area = piston_area_of(log, engine)
    runs = performance(log, area, engine)
    limit = time_limit_of(longest_s=time_limit, volume_ml=inflate, pressure_mpa=limit_pressure)
    choice, unanswered = _choice_of([run.point for run in runs], limit, area, margin)
    written = _plotted(log, runs, choice, plots) if plots is not None else []
    answer = head_of(log) | {
        "piston_area_cm2": area * 1e4,
        "inflate_ml": inflate,
        "runs": [run.as_row(area, limit.volume) for run in runs],
        "choice": choice.as_row() if choice is not None else None,
        "no_choice_because": unanswered,
    }

    def show(answer: dict[str, Any]) -> None:
        _show_runs(f"{counted(len(runs), 'run')}, {log.origin}", answer)
        if choice is not None:
            show_choice(choice)
        else:
            typer.echo(f"no choice of a motor speed: {unanswered}")

    finish(answer, written, as_json, show)


def _choice_of(
    points: "list[OperatingPoint]", limit: "TimeLimit", area: float, margin: float
) -> "tuple[SpeedChoice | None, str]":
    """The choice, or why these runs allow none."""
    from stommel.bench import BenchRequestError, choose_speed

    try:
        return choose_speed(points, limit, area, margin / 100), ""
    except BenchRequestError as error:
        return None, str(error)


def _plotted(
    log: "EngineLog", runs: "list[RunPerformance]", choice: "SpeedChoice | None", folder: "Path"
) -> "list[Path]":
    """Draw the runs, and the response to a motor speed: the chosen one, or the last."""
    from stommel.bench.performance_plot import performance_figure, response_figure
    from stommel.figures.saving import save_figure

    shown = choice.chosen if choice is not None else None
    at = shown.motor_speed if shown is not None else runs[-1].point.motor_speed
    figure = performance_figure([run.point for run in runs], generated=log.generated, choice=choice)
    return save_figure(figure, folder / "performance") + save_figure(response_figure(log, at), folder / "response")


def _show_runs(title: str, answer: dict[str, Any]) -> None:
    rows = [
        [
            number(run["pressure_mpa"], 2),
            number(run["motor_speed_rpm"], 0),
            number(run["average_current_a"], 3),
            number(run["consumption_j_per_mm"], 2),
            number(run["efficiency"], 3),
            number(run["inflating_time_s"], 1),
        ]
        for run in answer["runs"]
    ]
    columns = ["pressure\nMPa", "speed\nr/min", "current\nA", "K\nJ/mm", "efficiency\n"]
    show_table(title, [*columns, f"{answer['inflate_ml']:g} ml\ns"], rows)
