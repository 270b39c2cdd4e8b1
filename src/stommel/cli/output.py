"""How results look in a terminal, and as JSON."""

import json
from collections.abc import Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

import typer

if TYPE_CHECKING:
    from rich.console import Console

WIDTH = 80
"""Tables fit into a terminal of this many columns."""


def show_json(value: Any) -> None:
    """Print `value` as JSON; numbers keep all their digits."""
    typer.echo(json.dumps(value, indent=2, allow_nan=False, ensure_ascii=False))


def show_table(title: str, columns: Sequence[str], rows: Iterable[Sequence[str]], notes: Iterable[str] = ()) -> None:
    """Print a table with numbers to the right, and notes below it."""
    from rich import box
    from rich.table import Table

    table = Table(title=title, box=box.SIMPLE_HEAD, title_justify="left", title_style="bold", pad_edge=False)
    rows = [list(row) for row in rows]
    for i, column in enumerate(columns):
        text = any(_is_text(row[i]) for row in rows)
        table.add_column(column, justify="left" if text else "right", overflow="fold")
    for row in rows:
        table.add_row(*row)
    console = _console()
    console.print(table)
    for note in notes:
        console.print(note)


def show_values(title: str, values: Mapping[str, str], notes: Iterable[str] = ()) -> None:
    """Print named values, one a line."""
    console = _console()
    console.print(title, style="bold")
    width = max(len(name) for name in values)
    for name, value in values.items():
        console.print(f"  {name:<{width}}  {value}")
    for note in notes:
        console.print(note)


def _console() -> "Console":
    """A console for text from vehicle files: brackets and colons in it are letters, not markup."""
    from rich.console import Console

    # a pipe has no width: keep the layout of an ordinary terminal
    return Console(width=None if _is_terminal() else WIDTH, highlight=False, markup=False, emoji=False)


def number(value: float | None, digits: int, unit: str = "") -> str:
    """Write a number with a fixed count of decimals; a dash for none."""
    if value is None:
        return "-"
    text = f"{value:.{digits}f}"
    if float(text) == 0.0:
        text = text.lstrip("-")
    return f"{text} {unit}".rstrip()


def _is_text(cell: str) -> bool:
    return any(letter.isalpha() for letter in cell.replace("inf", "").replace("e", ""))


def _is_terminal() -> bool:
    import sys

    return sys.stdout.isatty()
