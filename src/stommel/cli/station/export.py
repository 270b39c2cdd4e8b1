"""`stommel station export`: what a vehicle sampled, as CF NetCDF or CSV."""

from enum import StrEnum
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from stommel.cli.finish import finish
from stommel.cli.options import JsonOption
from stommel.cli.paths import file_parser
from stommel.cli.station.options import DatabaseOption, FolderOption, SettingsOption, database_url
from stommel.errors import OutputError, StommelError
from stommel.files.units import counted

if TYPE_CHECKING:
    from stommel.archive import Archive


class NotInArchiveError(StommelError):
    """The archive holds nothing of this vehicle."""


class ExportTimeError(StommelError):
    """A time of which no archive holds anything."""


class What(StrEnum):
    """Which samples."""

    ctd = "ctd"
    telemetry = "telemetry"


BeginOption = Annotated[str, typer.Option("--begin", metavar="TIME", help="First time, like 2026-05-01T12:00 (UTC).")]
EndOption = Annotated[str, typer.Option("--end", metavar="TIME", help="Last time.")]


def export(
    vehicle: Annotated[int, typer.Option("--vehicle", min=1, max=250, help="Number of the vehicle.")],
    output: Annotated[
        Path,
        typer.Option(
            "--output", metavar="FILE", parser=file_parser("--output", ".nc", ".csv"), help="Ends with .nc or .csv."
        ),
    ],
    what: Annotated[
        What, typer.Option("--what", help="Samples of the CTD with what follows from them, or all telemetry.")
    ] = What.ctd,
    begin: BeginOption = "1970-01-01",
    end: EndOption = "2100-01-01",
    database: DatabaseOption = None,
    settings: SettingsOption = None,
    folder: FolderOption = None,
    as_json: JsonOption = False,
) -> None:
    """Write what a vehicle sampled to a file; the station may go on writing to the archive.

    Example: stommel station export --database sea.sqlite --vehicle 1 --output sea.nc
    """
    from stommel.archive import Archive
    from stommel.archive.address import address_of
    from stommel.archive.looking import require_there

    span = _span(begin, end)
    url = database_url(settings, database, folder)
    require_there(address_of(url))
    with Archive.open(url) as archive:
        require_known(archive, vehicle)
        write = _write_telemetry if what is What.telemetry else _write_ctd
        count = write(archive, vehicle, *span, output)
    answer: dict[str, Any] = {"vehicle": vehicle, "what": str(what), "samples": count}
    finish(answer, [output], as_json, lambda _: typer.echo(counted(count, "sample")))


def _span(begin: str, end: str) -> tuple[float, float]:
    from stommel.archive.times import is_time
    from stommel.ocean.times import seconds

    span = seconds(begin), seconds(end)
    for option, words, t in (("--begin", begin, span[0]), ("--end", end, span[1])):
        if not is_time(t):
            raise ExportTimeError(f"{option} {words}: allowed are times from 1970-01-01 to 2100-01-01")
    if span[0] > span[1]:
        raise ExportTimeError(f"--end {end}: must not be before --begin {begin}")
    return span


def require_known(archive: "Archive", vehicle: int) -> None:
    """Refuse a vehicle of which the archive holds nothing.

    Raises
    ------
    NotInArchiveError
        It names those that are there.
    """
    known = archive.vehicles()
    if vehicle not in known:
        among = ", ".join(f"{number} ({name})" for number, name in known.items()) or "none"
        raise NotInArchiveError(f"{archive.name}: nothing of vehicle {vehicle} is there; there are: {among}")


def _write_telemetry(archive: "Archive", vehicle: int, begin: float, end: float, output: Path) -> int:
    from stommel.archive.sample_pieces import kept_channels, sample_pieces
    from stommel.archive.telemetry_file import write_telemetry
    from stommel.data.files import write_netcdf_pieces
    from stommel.station.telemetry import telemetry_pieces

    keys = kept_channels(archive, vehicle)
    if output.suffix.lower() == ".nc":
        return write_netcdf_pieces(telemetry_pieces(archive, vehicle, keys, begin, end), output)
    return write_telemetry(sample_pieces(archive, vehicle, keys, begin, end), output)


def _write_ctd(archive: "Archive", vehicle: int, begin: float, end: float, output: Path) -> int:
    from stommel.data.files import write_csv_pieces, write_netcdf_pieces
    from stommel.products.record import SampleRecords
    from stommel.products.samples import trajectory

    records = SampleRecords(archive)
    count = records.count(vehicle, begin, end)
    if not count:
        raise OutputError(f"{output}: not written: there are no samples of the CTD in this time")
    pieces = (trajectory(archive, vehicle, each) for each in records.pieces(vehicle, begin, end))
    (write_netcdf_pieces if output.suffix.lower() == ".nc" else write_csv_pieces)(pieces, output)
    return count
