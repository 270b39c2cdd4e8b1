"""`stommel link mission show|upload|download|roll-back`: the orders that a vehicle flies."""

import hashlib
from collections.abc import Callable
from math import isfinite
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
from stommel.cli.options import ForceOption, JsonOption
from stommel.cli.output import show_table, show_values
from stommel.cli.paths import file_parser, refuse_existing

if TYPE_CHECKING:
    from stommel.cli.link.line import Line
    from stommel.link.missions.port import HeldOrders, WaypointPlan

mission_app = typer.Typer(no_args_is_help=True, help="The orders that a vehicle flies.")


@mission_app.command("show")
def show(
    to: ToOption,
    key: KeyOption = None,
    unsigned: UnsignedOption = False,
    vehicle: VehicleOption = None,
    state: StateOption = None,
    within: WithinOption = 60.0,
    as_json: JsonOption = False,
) -> None:
    """Show which orders the vehicle holds, and their waypoints.

    Example: stommel link mission show --to tcp:127.0.0.1:5760 --unsigned
    """
    with line_to(to, key, unsigned, vehicle, state) as line:
        line.require_vehicle(within)
        held = _held(line, within)
        line.end.waypoints.fetch(line.now(), within)
        line.until(lambda: line.end.waypoints.outcome is not None, within + 1.0)
        outcome = line.end.waypoints.outcome
        plan = None if outcome is None else outcome.plan
    finish(_row(held) | _waypoints(plan), None, as_json, _show)


@mission_app.command("upload")
def upload(
    orders: Annotated[Path, typer.Argument(metavar="ORDERS.toml", help="From `stommel orders`.")],
    to: ToOption,
    key: KeyOption = None,
    unsigned: UnsignedOption = False,
    vehicle: VehicleOption = None,
    state: StateOption = None,
    only_check: Annotated[
        bool, typer.Option("--only-check", help="Let the vehicle check it, and change nothing.")
    ] = False,
    within: WithinOption = 600.0,
    as_json: JsonOption = False,
) -> None:
    """Send orders: the vehicle takes them whole, checks them against its limits, and flies them; or it keeps its own.

    Example: stommel link mission upload orders.toml --to tcp:127.0.0.1:5760 --key zju-1.key
    """
    from stommel.control.orders_file import parse_orders
    from stommel.files.opening import TOML_MIB, read_bytes, text_of

    content = read_bytes(orders, TOML_MIB)
    parse_orders(text_of(content, orders), str(orders))  # what is no orders file need not go to sea
    with line_to(to, key, unsigned, vehicle, state) as line:
        line.require_vehicle(within)
        client = line.end.orders
        client.send(content, line.now(), within, only_check=only_check)
        with progress("orders") as report:

            def watch() -> None:
                found = client.progress(line.now())
                report(found.done / found.of if found.of else None, f"{found.done} of {found.of} bytes")

            _require_end(line, within, watch)
        held = _held(line, within)
    if not only_check and held.sha256 != hashlib.sha256(content).digest():
        raise LinkError(f"the vehicle holds other orders: {held.name}, number {held.number}")
    finish(_row(held) | {"checked_only": only_check}, None, as_json, _show)


@mission_app.command("download")
def download(
    output: Annotated[
        Path, typer.Argument(metavar="FILE", parser=file_parser("FILE", ".toml"), help="The file to write, .toml.")
    ],
    to: ToOption,
    key: KeyOption = None,
    unsigned: UnsignedOption = False,
    vehicle: VehicleOption = None,
    state: StateOption = None,
    within: WithinOption = 600.0,
    force: ForceOption = False,
    as_json: JsonOption = False,
) -> None:
    """Fetch the orders that the vehicle holds, as the file that they came in.

    Example: stommel link mission download aboard.toml --to tcp:127.0.0.1:5760 --unsigned
    """
    from stommel.cli.link.files import fetched

    refuse_existing(output, force)
    with line_to(to, key, unsigned, vehicle, state) as line:
        line.require_vehicle(within)
        row = fetched(line, "missions/active.orders", output, within)
        held = _held(line, within)
    if row["name"] != output.name:
        output.with_name(row["name"]).replace(output)  # --force: other orders stood there
    if row["sha256"] != held.sha256.hex():
        raise LinkError(f"{output}: has the orders of before; the vehicle holds others meanwhile: {held.name}")
    finish(_row(held), [output], as_json, _show)


@mission_app.command("roll-back")
def roll_back(
    to: ToOption,
    key: KeyOption = None,
    unsigned: UnsignedOption = False,
    vehicle: VehicleOption = None,
    state: StateOption = None,
    within: WithinOption = 60.0,
    as_json: JsonOption = False,
) -> None:
    """Let the vehicle fly the orders before the present ones again.

    Example: stommel link mission roll-back --to tcp:127.0.0.1:5760 --unsigned
    """
    with line_to(to, key, unsigned, vehicle, state) as line:
        line.require_vehicle(within)
        held = _held(line, within)
        if not held.previous:
            raise LinkError("the vehicle holds no orders before the present ones")
        line.end.orders.roll_back(held.previous, line.now(), within)
        _require_end(line, within)
        held = _held(line, within)
    finish(_row(held), None, as_json, _show)


def _held(line: "Line", within: float) -> "HeldOrders":
    client = line.end.orders
    client.ask(line.now(), within)
    _require_end(line, within)
    assert client.outcome is not None
    assert client.outcome.held is not None
    return client.outcome.held


def _require_end(line: "Line", within: float, watch: Callable[[], None] | None = None) -> None:
    """Drive the line until the request about orders has ended well."""
    from stommel.link.endings import Ending

    line.until(lambda: line.end.orders.outcome is not None, within + 1.0, watch)
    outcome = line.end.orders.outcome
    if outcome is None:
        raise LinkError(f"no answer within {within:g} s; the vehicle holds what it held, or the new orders, whole")
    if outcome.ending is not Ending.WHOLE:
        raise LinkError("\n".join(outcome.words) or outcome.ending.value)


def _row(held: "HeldOrders") -> dict[str, Any]:
    return {
        "number": held.number, "mission": held.name or None, "sha256": held.sha256.hex() or None,
        "previous_sha256": held.previous.hex() or None,
    }  # fmt: skip


def _waypoints(plan: "WaypointPlan | None") -> dict[str, Any]:
    if plan is None:
        return {"waypoints_deg": None, "depth_m": None, "acceptance_radius_m": None}
    return {
        "waypoints_deg": [[each.latitude / 1e7, each.longitude / 1e7] for each in plan.waypoints],
        "depth_m": plan.depth if plan.depth is not None and isfinite(plan.depth) else None,
        "acceptance_radius_m": plan.radius,
    }


def _show(row: dict[str, Any]) -> None:
    values = {"mission": row["mission"] or "none", "SHA-256": row["sha256"] or "none"}
    if row.get("depth_m") is not None:
        values["dives to"] = f"{row['depth_m']:g} m"
    if row.get("checked_only"):
        values["checked"] = "the vehicle could fly what was sent; it holds what it held"
    show_values(f"Mission {row['number']}", values)
    if row.get("waypoints_deg"):
        rows = [(str(k), f"{lat:.6f}", f"{lon:.6f}") for k, (lat, lon) in enumerate(row["waypoints_deg"], 1)]
        typer.echo()
        show_table("Waypoints", ("number", "latitude [deg]", "longitude [deg]"), rows)
