"""`stommel station check`: whether the archive is sound."""

from typing import TYPE_CHECKING

import typer

from stommel.cli.finish import finish
from stommel.cli.options import JsonOption
from stommel.cli.output import show_values
from stommel.cli.station.options import DatabaseOption, FolderOption, SettingsOption, database_url

if TYPE_CHECKING:
    from stommel.archive.soundness import Soundness


def check(
    database: DatabaseOption = None,
    settings: SettingsOption = None,
    folder: FolderOption = None,
    as_json: JsonOption = False,
) -> None:
    """Look through the whole archive and tell what is wrong; nothing is changed. Exit status 1 if something is.

    Example: stommel station check --database sea.sqlite
    """
    from stommel.archive.soundness import soundness_of

    found = soundness_of(database_url(settings, database, folder))
    finish(found, None, as_json, _show)
    if found.problems:
        raise typer.Exit(1)


def migrate(
    database: DatabaseOption = None,
    settings: SettingsOption = None,
    folder: FolderOption = None,
    as_json: JsonOption = False,
) -> None:
    """Bring an archive of an older version up to date, as the station does at its start.

    Example: stommel station migrate --database sea.sqlite
    """
    from stommel.archive import Archive
    from stommel.archive.address import address_of
    from stommel.archive.looking import require_there
    from stommel.archive.migrating import CURRENT

    url = database_url(settings, database, folder)
    require_there(address_of(url))
    with Archive.open(url) as archive:
        answer = {"archive": archive.name, "version": CURRENT}
    finish(answer, None, as_json, lambda answer: typer.echo(f"{answer['archive']}: up to date ({answer['version']})"))


def _show(found: "Soundness") -> None:
    values = {"version": found.version if found.current else f"{found.version}, not that of this program"}
    if found.size_bytes is not None:
        values["size"] = f"{found.size_bytes / 1e6:.1f} MB"
    values |= {name: f"{count} rows" for name, count in found.rows.items() if count}
    values["found"] = "; ".join(found.problems) or "sound"
    show_values(found.archive, values)
