"""`stommel vehicles` and `stommel vehicle show|check|new`."""

import os
from pathlib import Path
from typing import Annotated, Any

import typer

from stommel.cli.finish import finish
from stommel.cli.options import ForceOption, JsonOption, VehicleArgument, load
from stommel.cli.output import number, show_entries, show_notes, show_table, show_values
from stommel.cli.paths import file_parser, refuse_existing
from stommel.cli.vehicle_log import log
from stommel.cli.vehicle_run import run
from stommel.files.units import counted

vehicle_app = typer.Typer(help="Look at, check and begin vehicle files; read a vehicle's log.")
vehicle_app.command("log")(log)
vehicle_app.command("run")(run)


def vehicles(as_json: JsonOption = False) -> None:
    """List the built-in vehicles."""
    from stommel.vehicle import builtin_names

    rows = []
    for name in builtin_names():
        d = load(name).description
        planes = "vertical only" if list(d.unknown_lateral()) else "both"
        rows.append({"name": name, "mass_kg": d.mass_kg, "planes": planes, "summary": d.summary})
    finish(rows, None, as_json, _show_vehicles)


def _show_vehicles(rows: list[dict[str, Any]]) -> None:
    body = [[str(r["name"]), f"{r['mass_kg']:g}", str(r["planes"]), str(r["summary"])] for r in rows]
    show_table("Built-in vehicles", ["name", "mass\nkg", "planes", "what it is"], body)


@vehicle_app.command("show")
def show(
    vehicle: VehicleArgument,
    toml: Annotated[bool, typer.Option("--toml", help="Print the file itself.")] = False,
    as_json: JsonOption = False,
) -> None:
    """Show every number of a vehicle with its source, assumptions marked."""
    from stommel.files.units import unit_of
    from stommel.vehicle import stated_numbers, vehicle_text

    glider = load(vehicle)
    if toml:
        typer.echo(vehicle_text(vehicle), nl=False)
        return
    numbers = [
        {
            "key": key,
            "value": value,
            "unit": unit_of(key),
            "kind": origin.kind,
            "text": origin.text,
            "range": origin.range,
        }
        for key, value, origin in stated_numbers(glider)
    ]
    answer = {"name": glider.name, "numbers": numbers, "description": glider.description.model_dump(mode="json")}
    finish(answer, None, as_json, _show_numbers)


def _show_numbers(answer: dict[str, Any]) -> None:
    """Key, value and unit on one line, as a file or an option takes them; the source below."""
    entries = []
    for row in answer["numbers"]:
        value = row["value"]
        shown = ", ".join(f"{v}" for v in value) if isinstance(value, list) else f"{value}"
        entries.append((f"{row['key']} = {shown} {row['unit'] or ''}".rstrip(), _origin_in_words(row)))
    show_entries(f"{answer['name']}: {len(entries)} numbers", entries)
    show_notes(answer["description"]["notes"], "note")


def _origin_in_words(row: dict[str, Any]) -> str:
    """Where a number comes from; what is not printed in a source says so, with its range."""
    mark = f"{row['kind']}: " if row["kind"] in ("derived", "assumption") else ""
    between = "; between {:g} and {:g}".format(*row["range"]) if row["range"] else ""
    return mark + (row["text"] or "not stated") + between


@vehicle_app.command("check")
def check(vehicle: VehicleArgument, as_json: JsonOption = False) -> None:
    """Check a vehicle file, and hold its numbers against each other: errors, warnings, and what is unknown.

    A file that is no possible vehicle is refused, each problem in a line with the key and what is allowed.
    """
    from stommel.design.checking import cross_check
    from stommel.vehicle import stated_numbers

    glider = load(vehicle)
    found = cross_check(glider)
    d = glider.description
    kinds = [origin.kind for _, _, origin in stated_numbers(glider)]
    missing = list(d.unknown_lateral())
    summary = {
        "name": glider.name,
        "mass_kg": d.mass_kg,
        "numbers": len(kinds),
        "sourced": kinds.count("source"),
        "derived": kinds.count("derived"),
        "assumptions": kinds.count("assumption"),
        "not_stated": kinds.count("not stated"),
        "unknown_lateral": missing,
        "errors": [finding.as_row() for finding in found.errors],
        "warnings": [finding.as_row() for finding in found.warnings],
    }
    finish(summary, None, as_json, _show_check)


def _show_check(summary: dict[str, Any]) -> None:
    missing, errors, warnings = summary["unknown_lateral"], summary["errors"], summary["warnings"]
    show_values(
        f"{summary['name']}: {counted(len(errors), 'error')}, {counted(len(warnings), 'warning')}",
        {
            "mass": number(summary["mass_kg"], 2, "kg"),
            "numbers": f"{summary['numbers']}: {summary['sourced']} with a source, {summary['derived']} derived, "
            f"{counted(summary['assumptions'], 'assumption')}, {summary['not_stated']} without any origin",
            "planes": f"vertical only; missing {', '.join(missing)}" if missing else "vertical and lateral",
        },
    )
    for label, found in (("error", errors), ("warning", warnings)):
        show_notes((f"{finding['name']}: {finding['message']}" for finding in found), label)


_FILE = file_parser("FILE", ".toml")


def _new_file(text: str) -> Path:
    """A bare name stands for a file of that name in this folder."""
    there = os.path.exists(text)  # noqa: PTH110 - Path.exists raises for a name that is too long
    bare = text.strip() and not set(text) & {".", "/", "\\"} and not there
    return _FILE(f"{text}.toml" if bare else text)


@vehicle_app.command("new")
def new(
    path: Annotated[
        Path,
        typer.Argument(metavar="FILE", parser=_new_file, help="The file to write: myglider, or path/to/myglider.toml."),
    ],
    like: Annotated[
        str, typer.Option("--from", metavar="VEHICLE", help="Vehicle to begin from, a built-in one or a file.")
    ] = "zju",
    sections: Annotated[
        str | None,
        typer.Option(
            "--with",
            metavar="SECTIONS",
            help="Further sections, with commas between: hull, engine, drives, battery, parts, antenna. "
            "A file that is there already gets them at its end.",
        ),
    ] = None,
    force: ForceOption = False,
    as_json: JsonOption = False,
) -> None:
    """Begin a vehicle file: short, commented, every number an assumption copied from another vehicle.

    Example: stommel vehicle new myglider --from zju --with hull,engine
    """
    from stommel.files.whole import write_whole
    from stommel.vehicle.lean_file import begun_from, lean_text, sections_of, with_sections

    asked = sections_of(sections) if sections is not None else ()
    source, called = begun_from(like)
    adds = bool(asked) and path.exists() and not force
    if adds:
        from stommel.vehicle import vehicle_text

        text = with_sections(vehicle_text(path), str(path), source, called, asked)
    else:
        refuse_existing(path, force)
        text = lean_text(path.stem, source, called, asked)
    write_whole(path, text)
    answer = {"from": like, "sections": list(asked), "added": adds}
    finish(answer, [path], as_json, lambda _: _show_new(path, called, asked if adds else ()))


def _show_new(path: Path, called: str, added: tuple[str, ...]) -> None:
    what = f"added {', '.join(added)}" if added else "begun"
    typer.echo(f"{what} with numbers copied from {called}: edit it, then run: stommel vehicle check {path}")
