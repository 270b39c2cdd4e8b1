"""`stommel link`: the radio link between shore and vehicle."""

import typer

from stommel.cli.link.command import command_app
from stommel.cli.link.files import files_app
from stommel.cli.link.key import key_app
from stommel.cli.link.mission import mission_app
from stommel.cli.link.params import params_app
from stommel.cli.link.status import status

link_app = typer.Typer(no_args_is_help=True, help="The radio link between shore and vehicle.")
link_app.command("status")(status)
link_app.add_typer(params_app, name="params")
link_app.add_typer(mission_app, name="mission")
link_app.add_typer(files_app, name="files")
link_app.add_typer(command_app, name="command")
link_app.add_typer(key_app, name="key")
