"""Options that the verbs of the bench share, and what they mean."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from stommel.cli.numbers import number_option
from stommel.cli.options import PRESSURES, VOLUMES

if TYPE_CHECKING:
    from stommel.bench import EngineLog

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
TimeOption = Annotated[float, number_option("--time-limit-s", 0.1, 86400, "s", "Longest time of an inflation")]
InflateOption = Annotated[float, number_option("--inflate-ml", *VOLUMES, "ml", "Volume of that inflation")]
LimitPressureOption = Annotated[float, number_option("--limit-pressure-mpa", *PRESSURES, "MPa", "Its pressure")]
MarginOption = Annotated[
    float,
    number_option("--margin-percent", 0, 100, "%", "Consumptions this close are equal; the slowest speed is taken"),
]


def read_logs(
    logs: list[Path], column_map: Path | None, columns: list[str] | None, constants: list[str] | None
) -> "EngineLog":
    """Read all logs as one."""
    from stommel.bench import joined, load_map, read_engine_log

    return joined([read_engine_log(log, load_map(log, column_map, columns or (), constants or ())) for log in logs])


def head_of(log: "EngineLog") -> dict[str, Any]:
    """Where a log comes from, at the top of each answer about it."""
    return {"origin": log.origin, "generated": log.generated}
