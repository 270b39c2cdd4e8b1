"""`stommel station backup`: a copy of the archive, taken while the station runs."""

from pathlib import Path
from typing import Annotated, Any

import typer

from stommel.cli.finish import finish
from stommel.cli.options import JsonOption
from stommel.cli.station.database import DatabaseOption


def backup(
    file: Annotated[Path, typer.Argument(metavar="FILE", help="The copy; what stood there is replaced.")],
    database: DatabaseOption,
    as_json: JsonOption = False,
) -> None:
    """Copy the archive as it is at one moment into a file, and see that the copy is sound.

    The station may go on writing. Example: stommel station backup --database sea.sqlite sea-2026-11-27.sqlite
    """
    from stommel.station.archive.backup import back_up

    size = back_up(database, file)
    answer: dict[str, Any] = {"archive": database, "size_bytes": size}
    finish(answer, [file], as_json, lambda _: typer.echo(f"{size / 1e6:.1f} MB, found sound"))
