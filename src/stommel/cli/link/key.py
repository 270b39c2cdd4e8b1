"""`stommel link key new|show|check`: the key by which a vehicle knows its shore."""

import time
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from stommel.cli.finish import finish
from stommel.cli.numbers import count_option
from stommel.cli.options import ForceOption, JsonOption
from stommel.cli.output import show_notes, show_values
from stommel.cli.paths import file_parser, refuse_existing

if TYPE_CHECKING:
    from stommel.link.signing.keys import Keys

key_app = typer.Typer(no_args_is_help=True, help="The key by which a vehicle knows its shore.")

NewFile = Annotated[
    Path,
    typer.Argument(metavar="KEYFILE", parser=file_parser("KEYFILE", ".key"), help="The file to write, .key."),
]
FileArgument = Annotated[Path, typer.Argument(metavar="KEY", help="The key file of a vehicle.")]


@key_app.command("new")
def new(
    file: NewFile,
    vehicle: Annotated[int, count_option("--vehicle", 1, 250, "MAVLink system of the vehicle")] = 1,
    force: ForceOption = False,
    as_json: JsonOption = False,
) -> None:
    """Make a key: 32 random bytes in a file that only you may read. Vehicle and shore each need a copy.

    Example: stommel link key new zju-1.key --vehicle 1
    """
    from stommel.link.signing.key_file import KeyFile, new_keys

    refuse_existing(file, force)
    keys = new_keys(vehicle, time.time())
    KeyFile(file).write(keys)
    finish(_row(keys), [file], as_json, _show)


@key_app.command("show")
def show(file: FileArgument, as_json: JsonOption = False) -> None:
    """Show whose key a file holds, and its fingerprint; never the key.

    Example: stommel link key show zju-1.key
    """
    from stommel.link.signing.key_file import KeyFile

    key_file = KeyFile(file)
    keys = key_file.read_of_any_mode()
    finish(_row(keys) | {"mode": f"{key_file.mode:04o}"}, None, as_json, _show)


@key_app.command("check")
def check(file: FileArgument, as_json: JsonOption = False) -> None:
    """Say whether a vehicle or a shore would take a key file; status 2 and why if it would not.

    Example: stommel link key check zju-1.key
    """
    from stommel.link.signing.key_file import KeyFile

    finish(_row(KeyFile(file).read()) | {"sound": True}, None, as_json, _show)


def _row(keys: "Keys") -> dict[str, Any]:
    from stommel.link.signing.key_file import made_text

    return {
        "vehicle": keys.vehicle,
        "made": made_text(keys),
        "fingerprint": keys.current.fingerprint,
        "next_fingerprint": None if keys.next is None else keys.next.fingerprint,
        "used": not keys.unused,
    }


def _show(row: dict[str, Any]) -> None:
    values = {
        "vehicle": str(row["vehicle"]),
        "made": row["made"],
        "fingerprint": row["fingerprint"],
        "used": "yes" if row["used"] else "not yet",
    }
    if row["next_fingerprint"]:
        values["next"] = row["next_fingerprint"]
    if "mode" in row:
        values["mode"] = row["mode"]
    show_values("Key", values)
    notes = []
    if row["next_fingerprint"]:
        notes.append("a change of the key is under way; frames signed with either are accepted")
    if row.get("mode", "0600") != "0600":
        notes.append("only mode 0600 is taken by vehicle and shore: chmod 600")
    show_notes(notes, "note")
    if row.get("sound"):
        show_notes(["the file is sound, and only its owner may read it"])
