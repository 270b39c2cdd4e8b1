"""How far a command is that does many things alike, on the error output."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager


@contextmanager
def count_progress(what: str) -> Iterator[Callable[[int, int], None]]:
    """Bar with an estimate on the error output, of so many things out of so many; silent where nobody watches."""
    from rich.console import Console
    from rich.progress import (
        BarColumn,
        MofNCompleteColumn,
        Progress,
        TextColumn,
        TimeElapsedColumn,
        TimeRemainingColumn,
    )

    console = Console(stderr=True)
    columns = (
        TextColumn(what),
        BarColumn(),
        MofNCompleteColumn(),
        TimeElapsedColumn(),
        TextColumn("left"),
        TimeRemainingColumn(),
    )
    with Progress(*columns, console=console, disable=not console.is_terminal, transient=True) as bar:
        task = bar.add_task(what, total=None)
        yield lambda finished, runs: bar.update(task, completed=finished, total=runs)
