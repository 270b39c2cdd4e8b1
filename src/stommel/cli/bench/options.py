"""Options that the verbs of the bench share, and what they mean."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

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
TimeOption = Annotated[float, typer.Option("--time-limit-s", help="Longest time that an inflation may take [s].")]
InflateOption = Annotated[float, typer.Option("--inflate-ml", help="Volume of that inflation [ml].")]
LimitPressureOption = Annotated[float, typer.Option("--limit-pressure-mpa", help="Pressure of that inflation [MPa].")]
MarginOption = Annotated[
    float, typer.Option("--margin-percent", help="Consumptions this close count as equal: the slowest speed is taken.")
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
