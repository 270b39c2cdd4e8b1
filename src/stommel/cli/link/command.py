"""`stommel link command NAME`: tell a vehicle to do something, and follow what becomes of it."""

from datetime import UTC, datetime
from enum import StrEnum
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
from stommel.cli.numbers import number_option
from stommel.cli.options import JsonOption
from stommel.cli.output import show_entries, show_notes, show_values

if TYPE_CHECKING:
    from stommel.link.commands.report import Report

command_app = typer.Typer(
    no_args_is_help=True, help="Tell a vehicle to do something; each command is done once or not at all."
)


class WhenChoice(StrEnum):
    """As `stommel.link.commands.states.When`, which is not imported at the start."""

    at_once = "at-once"
    at_next_surfacing = "at-next-surfacing"
    until_expiry = "until-expiry"


@command_app.command("list")
def list_all(as_json: JsonOption = False) -> None:
    """List what a vehicle can be told.

    Example: stommel link command list
    """
    from stommel.link.commands.table import COMMANDS

    rows = [
        {
            "name": row.name, "words": row.words, "confirm": row.confirm or None,
            "parameters": [
                {"name": one.name, "unit": one.unit, "low": one.low, "high": one.high, "words": one.words}
                for one in row.parameters
            ],
        }
        for row in COMMANDS
    ]  # fmt: skip
    finish({"commands": rows}, None, as_json, _show_list)


def _show_list(row: dict[str, Any]) -> None:
    entries = []
    for each in row["commands"]:
        numbers = [f"{p['name']}={p['low']:g}..{p['high']:g} {p['unit']}".strip() for p in each["parameters"]]
        asks = f" Asks first: {each['confirm']}." if each["confirm"] else ""
        entries.append((" ".join([each["name"], *numbers]), f"{each['words']}.{asks}"))
    show_entries("Commands", entries)


@command_app.command("send")
def send(
    name: Annotated[str, typer.Argument(metavar="NAME", help="See `stommel link command list`.")],
    to: ToOption,
    values: Annotated[list[str] | None, typer.Argument(metavar="[KEY=VALUE]...", help="Its parameters.")] = None,
    key: KeyOption = None,
    unsigned: UnsignedOption = False,
    vehicle: VehicleOption = None,
    state: StateOption = None,
    when: Annotated[WhenChoice, typer.Option("--when", help="When it may be executed.")] = WhenChoice.until_expiry,
    expires: Annotated[
        float, number_option("--expires", 1.0, 2_600_000.0, "s", "After this it is never executed")
    ] = 600.0,
    yes: Annotated[bool, typer.Option("--yes", help="Do not ask before a command that may do harm.")] = False,
    within: WithinOption = 120.0,
    as_json: JsonOption = False,
) -> None:
    """Give a command and follow it until its last word, or until the time is over; it stays queued then.

    Example: stommel link command send hold --to tcp:127.0.0.1:5760 --key zju-1.key
    """
    from stommel.link.commands.states import When
    from stommel.link.commands.table import command_named, packed

    kind = command_named(name)
    numbers = _numbers(values or [])
    packed(kind, numbers)
    if kind.confirm and not yes and not typer.confirm(f"{name}: {kind.confirm}. Give it?", err=True):
        raise typer.Exit(1)
    with line_to(to, key, unsigned, vehicle, state) as line:
        commands = line.end.commands
        if name == "abort":
            id = commands.abort(line.now(), valid_for=expires)
        else:
            chosen = When[when.value.replace("-", "_").upper()]
            id = commands.give(name, numbers, line.now(), valid_for=expires, when=chosen)
        with progress(name) as report:

            def watch() -> None:
                found = commands.report(id, line.now())
                report(found.percent / 100.0 if found.percent <= 100 else None, found.words or found.state.words)

            line.until(lambda: commands.report(id, line.now()).is_last, within, watch)
        row = _row(commands.report(id, line.now())) | {"notes": commands.notes}
    finish(row, None, as_json, _show)
    if row["state"] not in ("done", "waiting aboard", "in progress"):
        raise typer.Exit(1)


@command_app.command("follow")
def follow(
    to: ToOption,
    key: KeyOption = None,
    unsigned: UnsignedOption = False,
    vehicle: VehicleOption = None,
    state: StateOption = None,
    cancel: Annotated[str | None, typer.Option("--cancel", metavar="ID", help="Take this command back.")] = None,
    within: WithinOption = 60.0,
    as_json: JsonOption = False,
) -> None:
    """Show what became of the commands that were given, and bring the open ones on.

    Example: stommel link command follow --to tcp:127.0.0.1:5760 --key zju-1.key
    """
    with line_to(to, key, unsigned, vehicle, state) as line:
        commands = line.end.commands
        if cancel is not None:
            commands.cancel(_id(cancel), line.now())
        line.until(lambda: all(each.is_last for each in commands.reports(line.now())), within)
        rows = [_row(each) for each in commands.reports(line.now())]
    finish({"commands": rows, "notes": commands.notes}, None, as_json, _show_reports)


def _numbers(values: list[str]) -> dict[str, float]:
    found = {}
    for each in values:
        name, _, value = each.partition("=")  # without one there is no number either
        try:
            found[name] = float(value)
        except ValueError:
            raise LinkError(f"{each}: must be KEY=VALUE with a number, as time=120") from None
    return found


def _id(text: str) -> int:
    try:
        return int(text, 16)
    except ValueError:
        raise LinkError(f"--cancel = {text[:40]}: must be the id of a command, as `follow` shows it") from None


def _row(report: "Report") -> dict[str, Any]:
    return {
        "id": f"{report.id:016x}",
        "name": report.name,
        "state": report.state.words,
        "is_last": report.is_last,
        "percent": report.percent if report.percent <= 100 else None,
        "words": report.words,
        "given": _time(report.given),
        "expires": _time(report.expires),
    }


def _time(seconds: float) -> str:
    return datetime.fromtimestamp(seconds, UTC).isoformat(timespec="seconds")


def _show(row: dict[str, Any]) -> None:
    values = {"state": row["state"], "id": row["id"], "expires": row["expires"]}
    if row["words"]:
        values["words"] = row["words"]
    show_values(row["name"], values)
    show_notes(row.get("notes", ()), "note")


def _show_reports(row: dict[str, Any]) -> None:
    if not row["commands"]:
        typer.echo("no command was given")
    for each in row["commands"]:
        _show(each)
    show_notes(row["notes"], "note")
