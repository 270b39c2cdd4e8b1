"""Many lives of a program, to be killed one after the other: each is a process of its own, forked from one that has
the imports behind it, as they take longer than a life."""

import os
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from multiprocessing import get_context
from multiprocessing.connection import Connection
from multiprocessing.process import BaseProcess
from typing import Any, TextIO

IMPORTED = (
    "stommel.archive", "stommel.cli", "stommel.cli.station.serve", "stommel.station.station",
    "stommel.station.web.app", "stommel.station.web.serving",
)  # fmt: skip
_context = get_context("forkserver")
_context.set_forkserver_preload(list(IMPORTED))


@contextmanager
def life(function: Callable[..., None], *arguments: Any) -> Iterator[tuple[BaseProcess, TextIO]]:
    """A process that calls a function of a module, and all that it prints; killed at the latest when the block ends."""
    hears, says = _context.Pipe(duplex=False)
    process = _context.Process(target=_live, args=(says, function, arguments))
    process.start()
    says.close()
    with os.fdopen(os.dup(hears.fileno()), encoding="utf-8") as told:
        hears.close()
        try:
            yield process, told
        finally:
            process.kill()
            process.join()


def command_line(*arguments: str) -> None:
    """The command `stommel`, as a function to live."""
    from stommel.cli import main

    sys.argv = ["stommel", *arguments]
    main()


def _live(says: "Connection[Any, Any]", function: Callable[..., None], arguments: tuple[Any, ...]) -> None:
    for stream in (1, 2):
        os.dup2(says.fileno(), stream)
    says.close()
    function(*arguments)
