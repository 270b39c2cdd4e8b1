"""Bench files that cannot be used, and requests that a good file cannot answer."""

from stommel.errors import FileError, Problem, StommelError


class BenchFileError(FileError):
    """A bench log or its column map that cannot be used; names file, column, row and value."""


class BenchRequestError(StommelError):
    """A question that these data or this model cannot answer."""


def refuse(file: str, column: str, message: str, row: int | None = None) -> BenchFileError:
    """Return the error for one column, and one row (line of the file) where there is one."""
    place = ", ".join([f"column {column!r}"] * bool(column) + [f"row {row}"] * (row is not None))
    return BenchFileError([Problem(file, column, f"{place}: {message}" if place else message)])
