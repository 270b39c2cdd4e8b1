"""Reading delimited text: header, cells with their line numbers, comments. Nothing is converted here."""

import csv
from dataclasses import dataclass
from pathlib import Path

from stommel.errors import FileError, Problem
from stommel.files.opening import TABLE_MIB, read_text

_NAMES = {",": "commas", ";": "semicolons", "\t": "tabs"}


@dataclass(frozen=True)
class Delimited:
    """The text of a table."""

    file: str
    header: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]
    lines: tuple[int, ...]
    """Line of the file that each row stands on, counted from 1 as editors do."""
    comments: tuple[str, ...]
    """Text of the lines that begin with #."""

    def cells(self, column: str) -> list[str]:
        """Cells of a column, top to bottom.

        Raises
        ------
        FileError
            There is no such column.
        """
        if column not in self.header:
            raise _refused(self.file, column, f"column {column!r}: missing; the file has: {', '.join(self.header)}")
        at = self.header.index(column)
        return [row[at] for row in self.rows]


def number_in(cell: str) -> float | None:
    """Number that a cell is, finite or not; None where it is none, as 1_000 and an empty cell."""
    try:
        return None if "_" in cell else float(cell)
    except ValueError:
        return None


def read_delimited(path: str | Path, delimiter: str = ",") -> Delimited:
    """Read a table with one line of column names; blank lines and lines that begin with # are no rows.

    Raises
    ------
    FileError
        The file cannot be read, has no rows, a column twice, or a row of another length than its header.
    """
    name = str(path)
    content, comments = [], []
    for number, line in enumerate(read_text(path, TABLE_MIB).split("\n"), start=1):
        if line.lstrip().startswith("#"):
            comments.append(line.lstrip().lstrip("#").strip())
        elif line.strip(" \t" + delimiter):
            content.append((number, line))
    if len(content) < 2:
        raise _refused(name, "", "has no rows below a line of column names")
    header, *rows = _cells(name, [line for _, line in content], delimiter)
    lines = tuple(number for number, _ in content[1:])
    if len(rows) != len(lines):
        raise _refused(name, "", "has a quoted cell that runs over the end of its line")
    others = [mark for mark in ";\t," if mark != delimiter and mark in header[0]]
    if len(header) == 1 and others:
        wrong, right = (_NAMES.get(mark, mark) for mark in (others[0], delimiter))
        raise _refused(name, "", f"is delimited by {wrong}; must be by {right}")
    twice = [column for k, column in enumerate(header) if column in header[:k]]
    if twice:
        raise _refused(name, twice[0], f"column {twice[0]!r}: stands twice in the line of column names")
    for row, number in zip(rows, lines, strict=True):
        if len(row) != len(header):
            text = f"row {number}: has {len(row)} cells where the column names are {len(header)}"
            raise _refused(name, "", text)
    return Delimited(name, header, tuple(rows), lines, tuple(comments))


def _cells(name: str, lines: list[str], delimiter: str) -> list[tuple[str, ...]]:
    try:
        return [tuple(cell.strip() for cell in row) for row in csv.reader(lines, delimiter=delimiter)]
    except csv.Error as error:  # a cell of more than 128 KiB
        raise _refused(name, "", f"is not a table of numbers: {error}") from None


def _refused(file: str, column: str, message: str) -> FileError:
    return FileError([Problem(file, column, message)])
