"""How results look in a terminal: tables, named values, notes and warnings, all within its width."""

from collections.abc import Iterable, Mapping, Sequence
from typing import TYPE_CHECKING

import typer

if TYPE_CHECKING:
    from rich.console import Console

WIDTH = 80
"""Tables fit into a terminal of this many columns."""


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
    _console().print(table)
    show_notes(notes)


def show_values(title: str, values: Mapping[str, str], notes: Iterable[str] = ()) -> None:
    """Print named values, one a line; what a line does not hold goes on below the value."""
    console = _console()
    console.print(title, style="bold")
    width = max(len(name) for name in values)
    for name, value in values.items():
        typer.echo(_filled(value, f"  {name:<{width}}  ", " " * (width + 4), console.width))
    show_notes(notes)


def show_entries(title: str, entries: Iterable[tuple[str, str]]) -> None:
    """Print entries of two lines: what it is, and below it what there is to say about it."""
    console = _console()
    console.print(title, style="bold")
    for entry, about in entries:
        typer.echo(_filled(entry, "", "  ", console.width))
        typer.echo(_filled(about, "    ", "    ", console.width))


def show_notes(notes: Iterable[str], label: str = "") -> None:
    """Print notes, each a paragraph whose further lines are indented, after a `label` such as "note"."""
    width = _console().width
    for note in notes:
        typer.echo(_filled(note, f"{label}: " if label else "", "  ", width))


def show_warnings(warnings: Iterable[object]) -> None:
    """Print warnings, all verbs in the same words."""
    show_notes((str(warning) for warning in warnings), "warning")


def _filled(text: str, first: str, further: str, width: int) -> str:
    """Wrap a text between words; a key or a path is never broken."""
    from textwrap import fill

    filled = (
        fill(line, width, initial_indent=first if i == 0 else further, subsequent_indent=further,
             break_long_words=False, break_on_hyphens=False)
        for i, line in enumerate(text.splitlines() or [""])
    )  # fmt: skip
    return "\n".join(line or first.rstrip() for line in filled)


def _console() -> "Console":
    """A console for text from vehicle files: brackets and colons in it are letters, not markup."""
    from rich.console import Console

    # a pipe has no width: keep the layout of an ordinary terminal
    return Console(width=None if _is_terminal() else WIDTH, highlight=False, markup=False, emoji=False)


def terminal_width() -> int:
    """Columns of the terminal; without one, those of an ordinary one."""
    return _console().width


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
