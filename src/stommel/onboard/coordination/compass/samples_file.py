"""Samples of a compass as a table of delimited text, which a logger or a bench program writes."""

from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from stommel.errors import FileError, Problem
from stommel.files.delimited import Delimited, number_in, read_delimited
from stommel.onboard.coordination.compass.calibration import ACTUATORS

ACCELERATION = ("acceleration_x_g", "acceleration_y_g", "acceleration_z_g")
"""Columns of what the accelerometers feel; at rest and level 0, 0, 1."""
FIELD = ("field_x_ut", "field_y_ut", "field_z_ut")
"""Columns of what the magnetometers feel."""
RUNNING = "running"
"""Column of the actuators that run, with + between them; nothing for none. May be left out."""

_GREATEST = {**dict.fromkeys(ACCELERATION, 16.0), **dict.fromkeys(FIELD, 1000.0)}
_MOST_PROBLEMS = 20


class CompassSamples(NamedTuple):
    """Samples, one after the other."""

    acceleration: NDArray[np.float64]
    """(n x 3) [g]"""
    field: NDArray[np.float64]
    """(n x 3) [uT]"""
    running: tuple[int, ...]
    """Bits of the actuators that run."""


def read_samples(path: str | Path) -> CompassSamples:
    """Read samples of a compass.

    Raises
    ------
    FileError
        The file cannot be read, a column is missing, or a cell is no number within what sensors tell.
    """
    table = read_delimited(path)
    columns = {name: table.cells(name) for name in (*ACCELERATION, *FIELD)}
    words = table.cells(RUNNING) if RUNNING in table.header else [""] * len(table.rows)
    problems = [*_wrong_numbers(table, columns), *_wrong_words(table, words)]
    if problems:
        more = len(problems) - _MOST_PROBLEMS
        rest = [Problem(table.file, "", f"and {more} more problems")] if more > 0 else []
        raise FileError(problems[:_MOST_PROBLEMS] + rest)
    numbers = {name: [float(cell) for cell in cells] for name, cells in columns.items()}
    return CompassSamples(
        np.column_stack([numbers[name] for name in ACCELERATION]),
        np.column_stack([numbers[name] for name in FIELD]),
        tuple(sum(ACTUATORS[name] for name in _names(cell)) for cell in words),
    )


def _wrong_numbers(table: Delimited, columns: dict[str, list[str]]) -> Iterator[Problem]:
    for name, cells in columns.items():
        most = _GREATEST[name]
        for line, cell in zip(table.lines, cells, strict=True):
            value = number_in(cell)
            if value is None or not -most <= value <= most:
                what = f"row {line}: {name} = {cell[:40]!r}: must be a number between {-most:g} and {most:g}"
                yield Problem(table.file, name, what)


def _wrong_words(table: Delimited, words: list[str]) -> Iterator[Problem]:
    for line, cell in zip(table.lines, words, strict=True):
        names = _names(cell)
        if len(set(names)) < len(names) or any(name not in ACTUATORS for name in names):
            what = f"row {line}: {RUNNING} = {cell[:40]!r}: must be of {', '.join(ACTUATORS)}, with + between them"
            yield Problem(table.file, RUNNING, what)


def _names(cell: str) -> list[str]:
    return [name.strip() for name in cell.split("+")] if cell.strip() else []
