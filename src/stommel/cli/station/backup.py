"""`stommel station backup`: a copy of the archive, taken while the station runs."""

from pathlib import Path
from typing import Annotated, Any

import typer

from stommel.cli.finish import finish
from stommel.cli.options import JsonOption
from stommel.cli.station.options import DatabaseOption, FolderOption, SettingsOption, database_url


def backup(
    file: Annotated[Path, typer.Argument(metavar="BACKUP", help="The copy; what stood there is replaced.")],
    database: DatabaseOption = None,
    settings: SettingsOption = None,
    folder: FolderOption = None,
    as_json: JsonOption = False,
) -> None:
    """Copy the archive as it is at one moment into a file, and see that the copy is sound.

    The station may go on writing. Example: stommel station backup --database sea.sqlite sea-2026-11-27.sqlite
    """
    from stommel.archive.backup import back_up

    size = back_up(database_url(settings, database, folder), file)
    answer: dict[str, Any] = {"size_bytes": size}
    finish(answer, [file], as_json, lambda _: typer.echo(f"{size / 1e6:.1f} MB, found sound"))
