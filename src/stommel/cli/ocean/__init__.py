"""`stommel ocean`: what an ocean covers, its water at one point, a map."""

import typer

from stommel.cli.ocean.listing import list_oceans
from stommel.cli.ocean.show import show

ocean_app = typer.Typer(no_args_is_help=True, help="The ocean around a mission: what it covers, values, maps.")
ocean_app.command("show")(show)
ocean_app.command("list")(list_oceans)
