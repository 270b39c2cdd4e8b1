"""The option that names an archive."""

from typing import Annotated

import typer

DatabaseOption = Annotated[
    str,
    typer.Option("--database", metavar="URL", help="The archive: a file, sqlite:///FILE, or postgresql://..."),
]
