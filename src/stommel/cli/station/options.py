"""Options that the verbs of `stommel station` share: where the archive is."""

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

if TYPE_CHECKING:
    from stommel.station.people.people import People

SettingsOption = Annotated[
    Path | None, typer.Option("--settings", metavar="SETTINGS", help="What the station is told, station.toml.")
]
DatabaseOption = Annotated[
    str | None,
    typer.Option(
        "--database",
        metavar="URL",
        help="Archive: a file, sqlite:///FILE or postgresql+psycopg://...; in the folder if left out.",
    ),
]
FolderOption = Annotated[
    Path | None,
    typer.Option("--folder", metavar="STATION", help="Folder of the station: files of vehicles, keys of links."),
]


def database_url(settings: Path | None, database: str | None, folder: Path | None) -> str:
    """The address of a station's archive, whether the station runs or not."""
    from stommel.station.settings import load_settings

    return load_settings(settings, {"database": database, "folder": folder}).database_url


@contextmanager
def opened_people(settings: Path | None, database: str | None, folder: Path | None) -> Iterator["People"]:
    """The people of a station, whether it runs or not."""
    from stommel.archive import Archive
    from stommel.station.people.people import People

    archive = Archive.open(database_url(settings, database, folder))
    try:
        yield People(archive)
    finally:
        archive.close()
