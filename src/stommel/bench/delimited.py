"""Reading delimited text: header, cells with their line numbers, comments. Nothing is converted here."""

import csv
from dataclasses import dataclass
from pathlib import Path

from stommel.bench.failures import BenchFileError, refuse
from stommel.errors import Problem


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
        BenchFileError
            There is no such column.
        """
        if column not in self.header:
            raise refuse(self.file, column, f"missing; the file has: {', '.join(self.header)}")
        at = self.header.index(column)
        return [row[at] for row in self.rows]


def read_delimited(path: Path, delimiter: str = ",") -> Delimited:
    """Read a table with one line of column names; blank lines and lines that begin with # are no rows.

    Raises
    ------
    BenchFileError
        The file cannot be read, has no rows, a column twice, or a row of another length than its header.
    """
    name = str(path)
    try:
        text = path.read_text(encoding="utf-8-sig")
    except (OSError, UnicodeDecodeError) as error:
        reason = error.strerror if isinstance(error, OSError) else f"is not UTF-8 text ({error.reason})"
        raise BenchFileError([Problem(name, "", f"cannot be read: {reason}")]) from error
    content, comments = [], []
    for number, line in enumerate(text.splitlines(), start=1):
        if line.lstrip().startswith("#"):
            comments.append(line.lstrip().lstrip("#").strip())
        elif line.strip(" \t" + delimiter):
            content.append((number, line))
    if len(content) < 2:
        raise refuse(name, "", "has no rows below a line of column names")
    parsed = [
        tuple(cell.strip() for cell in row) for row in csv.reader([line for _, line in content], delimiter=delimiter)
    ]
    header, rows = parsed[0], tuple(parsed[1:])
    lines = tuple(number for number, _ in content[1:])
    if len(rows) != len(lines):
        raise refuse(name, "", "has a quoted cell that runs over the end of its line")
    twice = [column for k, column in enumerate(header) if column in header[:k]]
    if twice:
        raise refuse(name, twice[0], "stands twice in the line of column names")
    for row, number in zip(rows, lines, strict=True):
        if len(row) != len(header):
            raise refuse(name, "", f"row {number}: has {len(row)} cells where the column names are {len(header)}")
    return Delimited(name, header, rows, lines, tuple(comments))
