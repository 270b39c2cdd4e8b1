"""`stommel vehicles` and `stommel vehicle show|check|new`."""

import os
from pathlib import Path
from typing import Annotated, Any

import typer

from stommel.cli.options import JsonOption, VehicleArgument, load
from stommel.cli.output import number, show_json, show_table, show_values

vehicle_app = typer.Typer(help="Look at, check and begin vehicle files.")


def vehicles(as_json: JsonOption = False) -> None:
    """List the built-in vehicles."""
    from stommel.vehicle import builtin_names

    rows = []
    for name in builtin_names():
        d = load(name).description
        planes = "vertical only" if list(d.unknown_lateral()) else "both"
        rows.append({"name": name, "mass_kg": d.mass_kg, "planes": planes, "summary": d.summary})
    if as_json:
        show_json(rows)
        return
    body = [[str(r["name"]), f"{r['mass_kg']:g}", str(r["planes"]), str(r["summary"])] for r in rows]
    show_table("Built-in vehicles", ["name", "mass\nkg", "planes", "what it is"], body)


@vehicle_app.command("show")
def show(
    vehicle: VehicleArgument,
    toml: Annotated[bool, typer.Option("--toml", help="Print the file itself.")] = False,
    as_json: JsonOption = False,
) -> None:
    """Show every number of a vehicle with its source, assumptions marked."""
    from stommel.vehicle import stated_numbers, vehicle_text

    glider = load(vehicle)
    if toml:
        typer.echo(vehicle_text(vehicle), nl=False)
        return
    if as_json:
        numbers = [
            {"key": key, "value": value, "kind": origin.kind, "text": origin.text}
            for key, value, origin in stated_numbers(glider)
        ]
        show_json({"name": glider.name, "numbers": numbers, "description": _plain(glider.description.model_dump())})
        return
    rows = []
    for key, value, origin in stated_numbers(glider):
        shown = ", ".join(f"{v}" for v in value) if isinstance(value, list) else f"{value}"
        mark = "assumption: " if origin.kind == "assumption" else ""
        rows.append([key, shown, mark + (origin.text or "not stated")])
    show_table(f"{glider.name}: {len(rows)} numbers", ["key", "value", "source"], rows, glider.description.notes)


def _plain(value: Any) -> Any:
    if isinstance(value, dict):
        return {key: _plain(item) for key, item in value.items()}
    if isinstance(value, tuple):
        return [_plain(item) for item in value]
    return value


@vehicle_app.command("check")
def check(vehicle: VehicleArgument, as_json: JsonOption = False) -> None:
    """Check a vehicle file; every problem is one line with the key and what is allowed."""
    from stommel.vehicle import stated_numbers

    glider = load(vehicle)
    d = glider.description
    kinds = [origin.kind for _, _, origin in stated_numbers(glider)]
    missing = list(d.unknown_lateral())
    summary = {
        "name": glider.name,
        "mass_kg": d.mass_kg,
        "numbers": len(kinds),
        "sourced": kinds.count("source"),
        "assumptions": kinds.count("assumption"),
        "not_stated": kinds.count("not stated"),
        "unknown_lateral": missing,
    }
    if as_json:
        show_json(summary)
        return
    show_values(
        f"{glider.name}: the file is sound",
        {
            "mass": number(d.mass_kg, 2, "kg"),
            "numbers": f"{len(kinds)}: {summary['sourced']} with a source, {summary['assumptions']} assumptions, "
            f"{summary['not_stated']} without either",
            "planes": f"vertical only; missing {', '.join(missing)}" if missing else "vertical and lateral",
        },
    )


@vehicle_app.command("new")
def new(
    path: Annotated[Path, typer.Argument(metavar="FILE", help="The file to write, for example myglider.toml.")],
    like: Annotated[str, typer.Option("--from", help="Built-in vehicle to begin from.")] = "zju",
    force: Annotated[bool, typer.Option("--force", help="Replace an existing file.")] = False,
) -> None:
    """Begin a vehicle file from a built-in one."""
    from stommel.errors import OutputError
    from stommel.files.whole import write_whole
    from stommel.vehicle import UnknownVehicleError, builtin_names, builtin_text

    if like not in builtin_names():
        raise UnknownVehicleError(
            f"--from {like}: no built-in vehicle of this name; there are {', '.join(builtin_names())}"
        )
    if os.path.exists(path) and not force:  # noqa: PTH110 - Path.exists raises for a name that is too long
        raise OutputError(f"{path}: already exists; --force replaces it")
    write_whole(path, builtin_text(like))
    typer.echo(f"wrote {path}, a copy of {like}; edit it, then run: stommel vehicle check {path}")
