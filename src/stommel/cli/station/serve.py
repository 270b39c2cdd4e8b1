"""`stommel station serve`: vehicles, archive and page until Ctrl-C."""

from typing import Annotated

import typer


def serve(
    database: Annotated[str, typer.Option("--database", metavar="URL", help="Archive: a file, or postgresql://...")],
    host: Annotated[str, typer.Option("--host", metavar="HOST", help="Where the page is served.")] = "127.0.0.1",
    port: Annotated[int, typer.Option("--port", min=0, max=65535, help="Port of the page; 0 takes a free one.")] = 8000,
) -> None:
    """Attach the vehicles, keep everything they send and serve the page; Ctrl-C ends.

    Example: stommel station --database sea.sqlite --link tcp:127.0.0.1:5760
    """
    raise NotImplementedError
