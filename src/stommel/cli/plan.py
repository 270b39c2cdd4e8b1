"""`stommel plan`: what the planner of the shore station does, for scripts: check a plan, preview it, open orders."""

from pathlib import Path
from typing import Annotated, Any

import typer

from stommel.cli.finish import finish
from stommel.cli.options import JsonOption
from stommel.cli.output import number, show_notes, show_table, show_values, show_warnings
from stommel.cli.paths import file_parser
from stommel.files.units import counted

plan_app = typer.Typer(no_args_is_help=True, help="Plans of the shore station: check, preview, open.")

PlanArgument = Annotated[
    str, typer.Argument(metavar="PLAN", help="A plan's file, as the page of the station saves it: .json, or .toml.")
]
PROBLEMS = 1
"""Exit status of a plan that cannot be flown."""
_FEW = 10
"""Dives that a terminal shows."""


@plan_app.command("check")
def check(
    plan: PlanArgument,
    output: Annotated[
        Path | None,
        typer.Option(
            "--output", metavar="FILE", parser=file_parser("--output", ".toml"), help="Orders to write, .toml."
        ),
    ] = None,
    as_json: JsonOption = False,
) -> None:
    """Name everything that is wrong with a plan at once, or make its orders; status 1 if anything is wrong.

    Example: stommel plan check plan.json --output orders.toml
    """
    from stommel.files.whole import write_whole
    from stommel.plans.plan_file import read_plan
    from stommel.plans.preview.ordering import ordered

    found = ordered(read_plan(plan))
    written = []
    if output is not None and found.orders is not None:
        write_whole(output, found.orders)
        written.append(output)
    finish(found.as_row(), written, as_json, _show_check)
    if found.problems:
        raise typer.Exit(PROBLEMS)


@plan_app.command("preview")
def preview(
    plan: PlanArgument,
    output: Annotated[
        Path | None,
        typer.Option(
            "--output", metavar="FILE", parser=file_parser("--output", ".json"), help="Preview to write, .json."
        ),
    ] = None,
    as_json: JsonOption = False,
) -> None:
    """Fly a plan in the simulator: track, dives, time, energy, what is left of the battery.

    Example: stommel plan preview plan.json
    """
    import json

    from stommel.cli.flight_progress import flight_progress
    from stommel.files.whole import write_whole
    from stommel.plans.plan_file import read_plan
    from stommel.plans.preview.flight import previewed
    from stommel.plans.preview.mission import mission_of

    read = read_plan(plan)
    with flight_progress(mission_of(read)) as progress:
        row = previewed(read, progress)
    written = []
    if output is not None:
        write_whole(output, json.dumps(row, allow_nan=False) + "\n")
        written.append(output)
    finish(row, written, as_json, _show_preview)


@plan_app.command("open")
def open_orders(
    orders: Annotated[str, typer.Argument(metavar="ORDERS", help="An orders file, .toml.")],
    vehicle: Annotated[str, typer.Option("--vehicle", metavar="VEHICLE", help="Built-in vehicle or vehicle file.")],
    start: Annotated[
        str, typer.Option("--start", metavar="LATITUDE,LONGITUDE", help="Where the vehicle is [degrees].")
    ],
    ocean: Annotated[
        str | None, typer.Option("--ocean", metavar="NAME", help="Analytic ocean that the plan expects.")
    ] = None,
    output: Annotated[
        Path | None,
        typer.Option("--output", metavar="FILE", parser=file_parser("--output", ".json"), help="Plan to write, .json."),
    ] = None,
    as_json: JsonOption = False,
) -> None:
    """Open orders as the plan that makes them again.

    Example: stommel plan open orders.toml --vehicle zju --start 28.7,126.1 --output plan.json
    """
    from stommel.files.opening import TOML_MIB, read_text
    from stommel.files.whole import write_whole
    from stommel.geometry.geodesics import Place
    from stommel.plans.expected_water import ocean_at
    from stommel.plans.plan_file import plan_text
    from stommel.plans.preview.opening import opened
    from stommel.plans.templates import place_row

    here = Place(*_place(start))
    around = {"vehicle": vehicle, "start": place_row(here), "water": {"ocean": ocean or ocean_at(here)}}
    found = opened(read_text(orders, TOML_MIB), around, orders)
    written = []
    if output is not None:
        write_whole(output, plan_text(found.plan))
        written.append(output)
    finish(found.as_row(), written, as_json, _show_opened)


def _place(text: str) -> tuple[float, float]:
    from math import isfinite

    parts = text.split(",")
    try:
        latitude, longitude = (float(part) for part in parts)
    except ValueError:
        latitude = longitude = float("nan")
    if not (isfinite(longitude) and -90.0 <= latitude <= 90.0 and -180.0 <= longitude <= 360.0):
        raise typer.BadParameter(
            f"{text!r}: must be a latitude between -90 and 90 and a longitude between -180 and 360, such as 28.7,126.1",
            param_hint="--start",
        )
    return latitude, longitude


def _show_check(row: dict[str, Any]) -> None:
    problems = row["problems"]
    if problems:
        typer.echo(counted(len(problems), "problem"))
        show_notes(problem["reason"] for problem in problems)
    else:
        typer.echo(f"the plan can be flown; its orders have {len(row['orders'].encode())} bytes")
    show_warnings(row["warnings"])


def _show_preview(row: dict[str, Any]) -> None:
    left = row["battery_left_share"]
    values = {
        "outcome": row["verdict"],
        "time": counted(number(row["duration_s"] / 86400.0, 2), "day"),
        "dives": f"{row['dive_count']}, {counted(row['surfacings'], 'surfacing')}",
        "way over ground": f"{row['distance_m'] / 1e3:.1f} km",
        "energy": "-" if row["energy_j"] is None else f"{row['energy_j'] / 3600.0:.1f} W h",
        "battery left": "-" if left is None else f"{left:.1%}",
    }
    show_values("Preview", values)
    rows = [_dive_row(dive) for dive in row["dives"][:_FEW]]
    if rows:
        more = len(row["dives"]) - len(rows)
        notes = [f"and {more} more; --json has them"] if more > 0 else []
        show_table("Dives", ("dive", "minutes", "depth m", "energy W h"), rows, notes)
    show_warnings(row["warnings"])


def _dive_row(dive: dict[str, Any]) -> list[str]:
    energy = dive["energy_j"]
    return [
        str(dive["dive"]),
        number((dive["t_end"] - dive["t_begin"]) / 60.0, 1),
        number(dive["greatest_depth_m"], 1),
        number(None if energy is None else energy / 3600.0, 2),
    ]


def _show_opened(row: dict[str, Any]) -> None:
    plan = row["plan"]
    dives = plan["dives"]
    values = {
        "mission": plan["name"],
        "vehicle": plan["vehicle"],
        "waypoints": str(len(plan["waypoints"])),
        "dives": f"to {dives['depth_m']:g} m at {dives['pitch_deg']:g} deg with {dives['ballast_ml']:.4g} ml",
        "expires": f"after {counted(plan['duration_days'], 'day')}",
    }
    show_values("Plan", values)
    show_warnings(row["remarks"])
