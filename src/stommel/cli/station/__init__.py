"""`stommel station`: the shore station, with which people watch and command vehicles from a page in the browser."""

from typing import Any

import typer
from typer.core import TyperGroup

from stommel.cli.station.backup import backup
from stommel.cli.station.check import check, migrate
from stommel.cli.station.export import export
from stommel.cli.station.import_log import import_log
from stommel.cli.station.serve import serve
from stommel.cli.station.token import token_app
from stommel.cli.station.user import user_app

SERVE = "serve"
"""The verb that `stommel station --database ...` stands for."""


class _ServesByDefault(TyperGroup):
    """Options without a verb are for `serve`."""

    def parse_args(self, ctx: Any, args: list[str]) -> list[str]:
        if args and args[0].startswith("-") and args[0] not in ctx.help_option_names:
            args = [SERVE, *args]
        return super().parse_args(ctx, args)


station_app = typer.Typer(
    cls=_ServesByDefault,
    no_args_is_help=True,
    rich_markup_mode="markdown",
    help="The shore station: `stommel station --database ...` is short for `stommel station serve --database ...`.",
)
station_app.command(SERVE)(serve)
for _verb in (backup, export, check, migrate):
    station_app.command()(_verb)
station_app.command("import")(import_log)
station_app.add_typer(user_app, name="user")
station_app.add_typer(token_app, name="token")
