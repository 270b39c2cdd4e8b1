"""`stommel bench speed`: the most economical motor speed by the model."""

from math import pi
from typing import Annotated

import typer

from stommel.cli.bench.choice import show_choice
from stommel.cli.bench.options import InflateOption, LimitPressureOption, MarginOption, TimeOption
from stommel.cli.finish import finish
from stommel.cli.numbers import numbers
from stommel.cli.options import PRESSURES, TURNS, JsonOption, VehicleArgument, load


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
        [p * 1e6 for p in numbers(pressures, "--pressure-mpa", PRESSURES, "MPa")],
        [n * 2 * pi / 60 for n in numbers(speeds, "--speed-rpm", TURNS, "r/min")],
    )
    limit = time_limit_of(longest_s=time_limit, volume_ml=inflate, pressure_mpa=limit_pressure)
    choice = choose_speed(points, limit, engine.piston_area_m2, margin / 100)
    finish({"origin": MARKER, "choice": choice.as_row()}, None, as_json, lambda _: show_choice(choice))
