"""`stommel orders`: what the vehicle's software is told of a mission, as one file."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from stommel.cli.finish import finish
from stommel.cli.numbers import number_option
from stommel.cli.options import JsonOption
from stommel.cli.output import number, show_values
from stommel.cli.paths import file_parser
from stommel.files.units import counted

if TYPE_CHECKING:
    from stommel.control.orders import Orders
    from stommel.control.orders_file import OrdersHeader


def orders(
    mission: Annotated[
        str,
        typer.Argument(metavar="MISSION", help="A mission file, or a shipped mission (see `stommel simulate --list`)."),
    ],
    output: Annotated[
        Path | None,
        typer.Option(
            "--output",
            metavar="FILE",
            parser=file_parser("--output", ".toml"),
            help="File to write for the vehicle's software, .toml.",
        ),
    ] = None,
    expires_hours: Annotated[
        float | None,
        number_option(
            "--expires-hours",
            0.01,
            17520.0,
            "h",
            "The mission expires so long after its start; its duration if left out",
        ),
    ] = None,
    as_json: JsonOption = False,
) -> None:
    """Plan a mission: ballast, flight table, laws, waypoints and alarms, as the vehicle's software is told them.

    Example: stommel orders pool_trial --output pool-orders.toml
    """
    from stommel.control.orders_file import write_orders
    from stommel.simulation.planned_orders import planned_orders
    from stommel.simulation.scenario.loading import load_mission
    from stommel.simulation.scenario.orders_header import orders_header
    from stommel.simulation.scenario.shipped import mission_path

    loaded = load_mission(mission_path(mission))
    header = orders_header(loaded, expires_hours)
    told = planned_orders(loaded)
    written = []
    if output is not None:
        write_orders(output, told, header)
        written.append(output)
    finish(vars(header) | _row(told), written, as_json, lambda answer: _show(answer, header))


def _row(told: "Orders") -> dict[str, Any]:
    from math import degrees, isfinite

    dives, alarms = told.dives, told.alarms
    return {
        "step_s": told.step,
        "waypoints": len(told.waypoints),
        "depth_m": dives.depth,
        "turns_early_m": dives.turns_early,
        "pitch_deg": degrees(dives.theta),
        "ballast_dive_ml": 1e6 * float(dives.V_b_dive),
        "ballast_climb_ml": 1e6 * float(dives.V_b_climb),
        "ballast_surface_ml": 1e6 * float(dives.V_b_surface),
        "abort_depth_m": dives.abort_depth,
        "abort_hours": dives.abort_time / 3600.0,
        "alarm_energy_wh": alarms.energy / 3600.0 if isfinite(alarms.energy) else None,
        "alarm_leak": alarms.leak,
        "alarm_internal_pressure_kpa": (alarms.internal_pressure / 1e3 if isfinite(alarms.internal_pressure) else None),
        "flights": int(told.table.r_px.size),
    }


def _show(row: dict[str, Any], header: "OrdersHeader") -> None:
    alarms = [
        "leak" if row["alarm_leak"] else "",
        _alarm("energy used", row["alarm_energy_wh"], "Wh"),
        _alarm("pressure in the hull", row["alarm_internal_pressure_kpa"], "kPa"),
    ]
    ballast = "/".join(number(row[f"ballast_{when}_ml"], 0) for when in ("dive", "climb", "surface"))
    values = {
        "mission": f"{header.mission}, from {header.created_from}",
        "vehicle": f"{header.vehicle} ({header.vehicle_sha256[:12]}), {header.physics} physics",
        "dives": f"to {row['depth_m']:g} m, turning {row['turns_early_m']:.1f} m early",
        "pitch": f"{row['pitch_deg']:.4g} deg, down and up",
        "ballast": f"{ballast} ml down/up/at the surface",
        "waypoints": str(row["waypoints"]),
        "CTD": "as configured" if header.sample_every_s is None else f"each {header.sample_every_s:g} s",
        "ends by": ", ".join(filter(None, alarms)) or "no alarm",
        "dive ends": f"deeper than {row['abort_depth_m']:g} m, or longer than {row['abort_hours']:g} h",
        "expires": f"{counted(number(header.expires_hours, 2), 'hour')} after its start",
        "flight table": counted(row["flights"], "flight"),
    }
    show_values("Orders", values)


def _alarm(name: str, limit: float | None, unit: str) -> str:
    return "" if limit is None else f"{name} > {limit:.4g} {unit}"
