"""`stommel sitl`: the vehicle's software in the loop with its simulated plant."""

import typer

from stommel.cli import sitl_campaign

sitl_app = typer.Typer(
    help="Fly the vehicle's software in the loop, and break things on purpose.", no_args_is_help=True
)

sitl_app.command("campaign")(sitl_campaign.campaign)
sitl_app.command("replay")(sitl_campaign.replay)
