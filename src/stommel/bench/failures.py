"""Bench files that cannot be used, and requests that a good file cannot answer."""

from collections.abc import Iterator
from contextlib import contextmanager

from stommel.errors import FileError, Problem, StommelError


class BenchFileError(FileError):
    """A bench log or its column map that cannot be used; names file, column, row and value."""


class BenchRequestError(StommelError):
    """A question that these data or this model cannot answer."""


@contextmanager
def bench_files() -> Iterator[None]:
    """Turn what is wrong with any file that is read inside into an error of bench files; also a decorator."""
    try:
        yield
    except BenchFileError:
        raise
    except FileError as error:
        raise BenchFileError(list(error.problems)) from None


def refuse(file: str, column: str, message: str, row: int | None = None) -> BenchFileError:
    """Return the error for one column, and one row (line of the file) where there is one."""
    place = ", ".join([f"column {column!r}"] * bool(column) + [f"row {row}"] * (row is not None))
    return BenchFileError([Problem(file, column, f"{place}: {message}" if place else message)])
