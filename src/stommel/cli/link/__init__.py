"""`stommel link`: the radio link between shore and vehicle."""

import typer

from stommel.cli.link.key import key_app

link_app = typer.Typer(no_args_is_help=True, help="The radio link between shore and vehicle.")
link_app.add_typer(key_app, name="key")
