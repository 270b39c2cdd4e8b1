"""`stommel link params list|get|set`: parameters of a vehicle and its nodes."""

from operator import attrgetter
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
from stommel.cli.output import show_notes, show_table, show_values, terminal_width

if TYPE_CHECKING:
    from stommel.cli.link.line import Line
    from stommel.link.parameters.known import KnownSet

_WIDE = 130
"""Columns from which a table has room for what each parameter means."""

params_app = typer.Typer(no_args_is_help=True, help="Parameters of a vehicle and its nodes.")

NameArgument = Annotated[str, typer.Argument(metavar="NAME", help="Of the parameter, or COMPONENT:NAME.")]


@params_app.command("list")
def list_all(
    to: ToOption,
    key: KeyOption = None,
    unsigned: UnsignedOption = False,
    vehicle: VehicleOption = None,
    state: StateOption = None,
    within: WithinOption = 120.0,
    as_json: JsonOption = False,
) -> None:
    """Bring all parameters up to date and show them; what has not changed since the last time costs one message.

    Example: stommel link params list --to tcp:127.0.0.1:5760 --unsigned
    """
    with line_to(to, key, unsigned, vehicle, state) as line:
        _refresh(line, within)
        row = _row(line)
    finish(row, None, as_json, _show)


def _refresh(line: "Line", within: float) -> None:
    line.require_vehicle(within)
    client = line.end.parameters
    client.refresh(line.now(), within)
    with progress("parameters") as report:

        def watch() -> None:
            found = client.progress(line.now())
            report(found.done / found.of if found.of else None, f"{found.done} of {found.of or '?'}")

        line.until(lambda: client.refreshed is not None, within + 1.0, watch)


def _row(line: "Line") -> dict[str, Any]:
    from stommel.link.endings import Ending

    client = line.end.parameters
    ended = {outcome.component: outcome for outcome in client.refreshed or ()}
    if not client.known.sets:
        told = "; ".join(sorted({outcome.words for outcome in ended.values() if outcome.words}))
        raise LinkError(told or "the vehicle has told of no parameters in this time")
    return {
        "components": [
            {
                "component": known.component,
                "name": known.name,
                "state": known.state.name.lower(),
                "whole": known.component in ended and ended[known.component].ending is Ending.WHOLE,
                "reason": ended[known.component].words if known.component in ended else "was not asked",
                "parameters": [_parameter(known, k) for k in range(len(known.descriptions))],
            }
            for known in sorted(client.known.sets.values(), key=attrgetter("component"))
        ]
        + [
            {
                "component": outcome.component,
                "name": outcome.name,
                "state": "unknown",
                "whole": False,
                "reason": outcome.words,
                "parameters": [],
            }
            for outcome in ended.values()
            if outcome.component not in client.known.sets
        ],
        "notes": client.known.notes,
    }


def _parameter(known: "KnownSet", number: int) -> dict[str, Any]:
    each = known.descriptions[number]
    return {
        "name": each.id, "type": each.kind.name.lower(), "value": known.values[number], "default": each.default,
        "low": each.low, "high": each.high, "unit": each.unit, "words": each.words,
    }  # fmt: skip


def _show(row: dict[str, Any]) -> None:
    columns = ("name", "value", "unit", "range", "meaning")
    fit = columns if terminal_width() >= _WIDE else columns[:-1]
    for component in row["components"]:
        rows = [
            (each["name"], "?" if each["value"] is None else f"{each['value']:g}", each["unit"] or "-",
             f"{each['low']:g} to {each['high']:g}", each["words"] or "-")[: len(fit)]
            for each in component["parameters"]
        ]  # fmt: skip
        title = f"{component['name']} (component {component['component']})"
        notes = [] if component["whole"] else [f"not up to date: {component['reason'] or component['state']}"]
        show_table(title, fit, rows, notes)
    if fit != columns:
        show_notes([f"what each means stands beside it from {_WIDE} columns on, and in --json"])
    show_notes(row["notes"], "note")


@params_app.command("get")
def get(
    name: NameArgument,
    to: ToOption,
    key: KeyOption = None,
    unsigned: UnsignedOption = False,
    vehicle: VehicleOption = None,
    state: StateOption = None,
    within: WithinOption = 60.0,
    as_json: JsonOption = False,
) -> None:
    """Ask for one parameter.

    Example: stommel link params get 25:QUIET_AFTER --to tcp:127.0.0.1:5760 --unsigned
    """
    with line_to(to, key, unsigned, vehicle, state) as line:
        _refresh(line, within)
        component, parameter = _found(line, name)
        row = _single(line, line.end.parameters.read(component, parameter, within), within)
    finish(row, None, as_json, _show_single)


@params_app.command("set")
def set_one(
    name: NameArgument,
    value: Annotated[float, typer.Argument(metavar="VALUE", help="In the parameter's unit.")],
    to: ToOption,
    key: KeyOption = None,
    unsigned: UnsignedOption = False,
    vehicle: VehicleOption = None,
    state: StateOption = None,
    within: WithinOption = 60.0,
    as_json: JsonOption = False,
) -> None:
    """Set one parameter, and show what holds then.

    Example: stommel link params set 25:QUIET_AFTER 8 --to tcp:127.0.0.1:5760 --unsigned
    """
    with line_to(to, key, unsigned, vehicle, state) as line:
        _refresh(line, within)
        component, parameter = _found(line, name)
        row = _single(line, line.end.parameters.write(component, parameter, value, within), within)
    finish(row, None, as_json, _show_single)


def _found(line: "Line", name: str) -> tuple[int, str]:
    """Component and name of the parameter that a text means."""
    from stommel.files.nearest import did_you_mean

    wanted, _, parameter = name.upper().rpartition(":")
    sets = line.end.parameters.known.sets.values()
    known = [(each.component, one.id) for each in sets for one in each.descriptions]
    fits = [(component, one) for component, one in sorted(known) if one == parameter and wanted in ("", str(component))]
    if len(fits) == 1:
        return fits[0]
    if fits:
        told = " or ".join(f"{component}:{one}" for component, one in fits)
        raise LinkError(f"{name}: is a parameter of several components; say {told}")
    near = did_you_mean(parameter, {one for _, one in known})
    told = near if near != ";" else "; `stommel link params list` shows them"
    raise LinkError(f"{name}: is no parameter of the vehicle{told}")


def _single(line: "Line", ticket: int, within: float) -> dict[str, Any]:
    from stommel.link.endings import Ending

    outcomes: list[Any] = []

    def done() -> bool:
        outcomes.extend(each for each in line.end.parameters.outcomes() if each.ticket == ticket)
        return bool(outcomes)

    line.until(done, within + 1.0)
    if not outcomes or outcomes[0].ending is not Ending.WHOLE:
        raise LinkError(outcomes[0].words if outcomes else f"no answer within {within:g} s")
    outcome = outcomes[0]
    return {"component": outcome.component, "name": outcome.parameter, "value": outcome.value}


def _show_single(row: dict[str, Any]) -> None:
    show_values(f"Component {row['component']}", {row["name"]: f"{row['value']:g}"})
    show_notes(())
