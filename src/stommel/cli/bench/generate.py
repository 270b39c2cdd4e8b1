"""`stommel bench generate`: an engine log made by the model."""

from math import pi
from pathlib import Path
from typing import Annotated

import typer

from stommel.cli.finish import finish
from stommel.cli.numbers import number_option, numbers, seed_option
from stommel.cli.options import PRESSURES, TURNS, JsonOption, VehicleArgument, load
from stommel.cli.paths import file_parser
from stommel.files.units import counted


def generate(
    vehicle: VehicleArgument,
    output: Annotated[
        Path,
        typer.Option(
            "--output",
            "-o",
            metavar="FILE",
            parser=file_parser("--output", ".csv"),
            help="Log to write, .csv; its column map goes beside it.",
        ),
    ],
    seed: Annotated[int, seed_option("Of the noise: the same seed gives the same bytes")] = 1,
    pressure: Annotated[
        str, typer.Option("--pressure-mpa", help="Pressures: a number, list or range first:last:step [MPa].")
    ] = "0:2.5:0.5",
    speed: Annotated[
        str, typer.Option("--speed-rpm", help="Motor speeds, in the same way [r/min].")
    ] = "3500:8750:1750",
    period: Annotated[float, number_option("--period-s", 0.01, 60, "s", "Time between two rows")] = 0.5,
    noise: Annotated[float, number_option("--noise", 0, 1000, "", "Times the usual noise; 0 is none")] = 1.0,
    as_json: JsonOption = False,
) -> None:
    """Make an engine log with the model, marked as generated: the paper's bench results are not published as numbers.

    Example: stommel bench generate zju --output build/bench.csv --seed 1
    """
    from stommel.bench import BenchPlan, SensorNoise, bench_engine, generate_log, write_log

    glider = load(vehicle)
    plan = BenchPlan(
        pressures=tuple(p * 1e6 for p in numbers(pressure, "--pressure-mpa", PRESSURES, "MPa")),
        motor_speeds=tuple(n * 2 * pi / 60 for n in numbers(speed, "--speed-rpm", TURNS, "r/min")),
        period=period,
    )
    log = generate_log(bench_engine(glider), seed, plan, SensorNoise().times(noise))
    written = write_log(log, output, seed, glider.name)
    answer = {"origin": log.origin, "seed": seed, "runs": len(log.runs)}
    finish(answer, written, as_json, lambda _: typer.echo(f"{counted(len(log.runs), 'run')}, {log.origin}"))
