"""`stommel link files list|get|put|release`: files of a vehicle, over as many surfacings as they take."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from stommel.cli.finish import finish
from stommel.cli.link.line import (
    KeyOption,
    LinkError,
    StateOption,
    ToOption,
    UnsignedOption,
    VehicleOption,
    WithinOption,
    line_to,
    progress,
)
from stommel.cli.options import JsonOption
from stommel.cli.output import show_table, show_values
from stommel.cli.paths import file_parser

if TYPE_CHECKING:
    from stommel.cli.link.line import Line
    from stommel.link.files.progress import Progress

files_app = typer.Typer(no_args_is_help=True, help="Files of a vehicle: its log, its missions, its inbox.")

LONG = 86_400.0


@files_app.command("list")
def list_folder(
    to: ToOption,
    folder: Annotated[
        str, typer.Argument(metavar="PATH", help="log, missions or inbox; all of them if left out.")
    ] = "",
    key: KeyOption = None,
    unsigned: UnsignedOption = False,
    vehicle: VehicleOption = None,
    state: StateOption = None,
    within: WithinOption = 60.0,
    as_json: JsonOption = False,
) -> None:
    """List a folder of the vehicle.

    Example: stommel link files list log --to tcp:127.0.0.1:5760 --unsigned
    """
    with line_to(to, key, unsigned, vehicle, state) as line:
        line.require_vehicle(within)
        rows = [
            {"path": f"{where}/{entry.name}".lstrip("/"), "bytes": entry.size}
            for where in ([folder] if folder else _folders(line, within))
            for entry in _listed(line, where, within)
        ]
    finish({"files": rows}, None, as_json, _show_list)


def _folders(line: "Line", within: float) -> list[str]:
    return [entry.name for entry in _listed(line, "", within) if entry.is_folder]


def _listed(line: "Line", folder: str, within: float) -> list[Any]:
    from stommel.link.files.progress import State

    listing = line.end.listing(folder)
    line.until(lambda: listing.state.is_over, within)
    line.end.drop(listing)
    if listing.state is not State.WHOLE:
        raise LinkError(listing.reason or f"{folder or '/'}: not listed within {within:g} s")
    return list(listing.entries)


def _show_list(row: dict[str, Any]) -> None:
    show_table("Files aboard", ("path", "bytes"), [(each["path"], str(each["bytes"])) for each in row["files"]])


@files_app.command("get")
def get(
    path: Annotated[str, typer.Argument(metavar="PATH", help="Of the file aboard, as `files list` shows it.")],
    output: Annotated[Path, typer.Argument(metavar="COPY", parser=file_parser("COPY"), help="The file to write.")],
    to: ToOption,
    key: KeyOption = None,
    unsigned: UnsignedOption = False,
    vehicle: VehicleOption = None,
    state: StateOption = None,
    release: Annotated[
        bool, typer.Option("--release", help="Then tell the vehicle that it is whole ashore and may go.")
    ] = False,
    within: WithinOption = LONG,
    as_json: JsonOption = False,
) -> None:
    """Fetch a file; a part that is there already goes on where it was left, and no byte is asked for twice.

    Example: stommel link files get log/00001-000001-state.log state.log --to tcp:127.0.0.1:5760 --unsigned
    """
    with line_to(to, key, unsigned, vehicle, state) as line:
        line.require_vehicle(within)
        row = fetched(line, path, output, within)
        row["released"] = release and _released(line, row, within)
    finish(row, [output.with_name(row["name"])], as_json, _show)


def fetched(line: "Line", path: str, output: Path, within: float) -> dict[str, Any]:
    """Fetch a file, and return what came.

    Raises
    ------
    StommelError
        It did not come whole; what came is kept beside its place.
    """
    from stommel.link.files.folder_disk import FolderDisk

    disk = FolderDisk(output.parent)
    try:
        download = line.end.download(path, disk, output.name)
        _watched(line, download, f"{path}", within)
        line.end.drop(download)
        file = download.file
        assert file is not None
        return {
            "path": path, "name": file.kept_as or output.name, "bytes": file.identity.size,
            "sha256": file.identity.sha256, "bytes_in_vain": download.progress.duplicate,
        }  # fmt: skip
    finally:
        disk.close()


def _watched(line: "Line", transfer: Any, what: str, within: float) -> None:
    """Drive a transfer to its end; it rests while the vehicle is not heard, and goes on when it is."""
    from stommel.link.files.progress import State

    with progress(what) as report:

        def watch() -> None:
            found = transfer.progress
            report(found.share if found.size else None, _words(found))

        line.until(lambda: transfer.state.is_over, within, watch)
    if transfer.state is not State.WHOLE:
        found = transfer.progress
        kept = f"{found.done} of {found.size} bytes are kept" if found.size else "nothing came"
        raise LinkError(transfer.reason or f"{what}: not whole within {within:g} s; {kept}: the same command goes on")


def _words(found: "Progress") -> str:
    if found.is_paused:
        return "vehicle not heard, waiting"
    left = "" if found.seconds_left is None else f", {found.seconds_left:.0f} s left"
    return f"{found.done / 1000:.0f} of {(found.size or 0) / 1000:.0f} kB, {found.rate / 1000:.1f} kB/s{left}"


def _released(line: "Line", row: dict[str, Any], within: float) -> bool:
    from stommel.link.files.progress import State
    from stommel.link.files.received_file import Identity

    release = line.end.release(Identity(row["path"], row["bytes"], row["sha256"]))
    line.until(lambda: release.state.is_over, within)
    if release.state is not State.WHOLE:
        raise LinkError(f"{row['path']}: is whole here, and not released aboard: {release.reason or 'no answer'}")
    return True


@files_app.command("put")
def put(
    file: Annotated[Path, typer.Argument(metavar="SOURCE", help="The file to send.")],
    to: ToOption,
    key: KeyOption = None,
    unsigned: UnsignedOption = False,
    vehicle: VehicleOption = None,
    state: StateOption = None,
    within: WithinOption = LONG,
    as_json: JsonOption = False,
) -> None:
    """Send a file to the vehicle's inbox; what has come there is not sent again.

    Example: stommel link files put notes.txt --to tcp:127.0.0.1:5760 --unsigned
    """
    from stommel.files.opening import read_bytes

    content, path = read_bytes(file, 8), f"inbox/{file.name}"
    with line_to(to, key, unsigned, vehicle, state) as line:
        line.require_vehicle(within)
        _watched(line, line.end.upload(content, path), path, within)
    finish({"path": path, "name": file.name, "bytes": len(content)}, None, as_json, _show)


def _show(row: dict[str, Any]) -> None:
    values = {"bytes": str(row["bytes"])}
    if "sha256" in row:
        values["SHA-256"] = row["sha256"]
    if row.get("released"):
        values["aboard"] = "released: it goes when room is needed"
    show_values(row["path"], values)
