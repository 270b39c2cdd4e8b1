"""`stommel station import`: logs that were brought home by hand, taken into the archive."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from stommel.cli.count_progress import count_progress
from stommel.cli.finish import finish
from stommel.cli.options import JsonOption
from stommel.cli.output import show_entries
from stommel.cli.station.options import DatabaseOption, FolderOption, SettingsOption, database_url
from stommel.errors import StommelError
from stommel.files.units import counted

if TYPE_CHECKING:
    from stommel.archive import Archive
    from stommel.archive.logs.rows import LogRow

_MOST_MIB = 256


class RefusedLogError(StommelError):
    """A file is no log, or its records cannot be dated."""


def import_log(
    files: Annotated[list[str], typer.Argument(metavar="LOG...", help="Files of a vehicle's log, .log.")],
    vehicle: Annotated[int, typer.Option("--vehicle", min=1, max=250, help="Number of the vehicle.")],
    database: DatabaseOption = None,
    settings: SettingsOption = None,
    folder: FolderOption = None,
    as_json: JsonOption = False,
) -> None:
    """Take logs of a vehicle into the archive: what it measured while its radio was silent. Twice changes nothing.

    The station may go on writing. A file that is cut off or damaged yields what is valid at its beginning, and says so.

    Example: stommel station import --database sea.sqlite --vehicle 1 00003-000001-essential.log
    """
    from stommel.archive import Archive
    from stommel.archive.address import address_of
    from stommel.archive.logs.rows import REFUSED
    from stommel.archive.looking import require_there
    from stommel.cli.station.export import require_known

    url = database_url(settings, database, folder)
    require_there(address_of(url))
    with Archive.open(url) as archive:
        require_known(archive, vehicle)
        rows = [_taken(archive, vehicle, file) for file in files]
    refused = [row for row in rows if row.state == REFUSED]
    if refused:
        raise RefusedLogError("; ".join(f"{row.name}: {_reason(row)}" for row in refused))
    finish({"vehicle": vehicle, "logs": [_told(row) for row in rows]}, None, as_json, lambda _: _show(rows))


def _reason(row: "LogRow") -> str:
    return row.words.removeprefix(f"{row.name}: ")


def _taken(archive: "Archive", vehicle: int, file: str) -> "LogRow":
    from stommel.archive.logs.taking import take_log
    from stommel.files.opening import read_bytes

    data = read_bytes(Path(file), _MOST_MIB)
    with count_progress(f"{Path(file).name} [byte]") as progress:

        def told(row: "LogRow") -> bool:
            progress(row.offset, row.size)
            return True

        return take_log(archive, vehicle, data, file, told)


def _told(row: "LogRow") -> dict[str, Any]:
    names = (
        "name", "sha256", "size", "series", "software", "state", "words", "records", "samples", "dives", "texts",
        "left_out",
    )  # fmt: skip
    told: dict[str, Any] = {name: getattr(row, name) for name in names}
    return told | {"begin": row.begin, "end": row.end}


def _show(rows: list["LogRow"]) -> None:
    show_entries("In the archive", [(Path(row.name).name, _sentence(row)) for row in rows])


def _sentence(row: "LogRow") -> str:
    span = "" if row.begin is None or row.end is None else f"; {_utc(row.begin)} to {_utc(row.end)} UTC"
    found = [counted(row.samples, "sample"), counted(row.dives, "dive"), counted(row.texts, "status text")]
    if row.left_out:
        found.append(f"{counted(row.left_out, 'row')} left out, which no archive takes")
    return f"{row.words}: {', '.join(found)}{span}"


def _utc(t: float) -> str:
    from datetime import UTC, datetime

    return f"{datetime.fromtimestamp(t, UTC):%Y-%m-%d %H:%M:%S}"
