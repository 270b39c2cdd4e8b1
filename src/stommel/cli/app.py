"""The verbs of the command `stommel`."""

from typing import Annotated

import typer

from stommel import __version__
from stommel.cli import (
    bench,
    budget,
    can,
    compass,
    configuration,
    derivative,
    design,
    drives,
    endurance,
    engine,
    envelope,
    flight_table,
    hull,
    link,
    modes,
    ocean,
    orders,
    plan,
    root_locus,
    simulate,
    sitl,
    station,
    steady,
    study,
    table,
    trim,
    turn,
    vehicles,
)

app = typer.Typer(
    name="stommel",
    help="The open system for underwater gliders: design by dynamic-model analysis.",
    invoke_without_command=True,
    add_completion=True,
    pretty_exceptions_enable=False,
    rich_markup_mode="markdown",  # [m/s] in a help text is a unit, not markup
    context_settings={"help_option_names": ["-h", "--help"]},
)


def _show_version(wanted: bool) -> None:
    if wanted:
        typer.echo(f"stommel {__version__}")
        raise typer.Exit


@app.callback()
def _root(
    context: typer.Context,
    _version: Annotated[
        bool, typer.Option("--version", callback=_show_version, is_eager=True, help="Show the version and stop.")
    ] = False,
) -> None:
    if context.invoked_subcommand is None:
        typer.echo(context.get_help())


app.command("design")(design.design)
app.command("trim")(trim.trim)
app.command("table")(table.table)
app.command("steady")(steady.steady)
app.command("turn")(turn.turn)
app.command("envelope")(envelope.envelope)
app.command("flight-table")(flight_table.flight_table)
app.command("orders")(orders.orders)
app.command("modes")(modes.modes)
app.command("root-locus")(root_locus.root_locus)
app.command("derivative")(derivative.derivative)
app.command("hull")(hull.hull)
app.command("drives")(drives.drives)
app.command("engine")(engine.engine)
app.command("endurance")(endurance.endurance)
app.command("budget")(budget.budget)
app.command("simulate")(simulate.simulate)
app.command("study")(study.study)
app.command("vehicles")(vehicles.vehicles)
vehicles.vehicle_app.command("calibrate-compass")(compass.calibrate_compass)
vehicles.vehicle_app.command("config")(configuration.vehicle_config)
app.add_typer(vehicles.vehicle_app, name="vehicle")
app.add_typer(bench.bench_app, name="bench")
app.add_typer(ocean.ocean_app, name="ocean")
app.add_typer(can.can_app, name="can")
app.add_typer(link.link_app, name="link")
app.add_typer(sitl.sitl_app, name="sitl")
app.add_typer(station.station_app, name="station")
app.add_typer(plan.plan_app, name="plan")
