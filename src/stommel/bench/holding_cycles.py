"""Tables of holds: a hull in a pressure chamber, its pressure read at the beginning and the end of each hold."""

import re
from dataclasses import dataclass, field
from importlib import resources
from math import isfinite
from pathlib import Path
from typing import Any

from stommel.bench.failures import bench_files, refuse
from stommel.bench.holding_description import HoldingDescription, PressureColumn
from stommel.files.delimited import Delimited, number_in, read_delimited
from stommel.files.opening import exists, require_regular
from stommel.files.provenance import Provenance, separate
from stommel.files.sentences import validated
from stommel.files.toml_reader import read_toml

BUILTIN = "fan2013-table5"
"""Name of the table that ships with stommel."""

_CLOCK = re.compile(r"([01]?\d|2[0-3]):([0-5]\d)(?::([0-5]\d))?")
_DAY = 86400.0


@dataclass(frozen=True)
class Hold:
    """One hold."""

    name: str
    begin: float
    """Seconds after midnight of the first day."""
    end: float
    """Seconds after midnight of the first day, later than `begin`."""
    begin_pressure: float
    """Gauge [Pa]."""
    end_pressure: float
    """Gauge [Pa]."""

    @property
    def duration(self) -> float:
        """How long the pressure is held [s]."""
        return self.end - self.begin

    @property
    def loss(self) -> float:
        """Pressure that is lost [Pa]."""
        return self.begin_pressure - self.end_pressure


@dataclass(frozen=True)
class PressureTest:
    """A table of holds with its description."""

    file: str
    comments: tuple[str, ...]
    """What the file says about itself."""
    holds: tuple[Hold, ...]
    description: HoldingDescription
    provenance: dict[str, Provenance] = field(default_factory=dict)
    """Source or assumption of each number of the description."""


@bench_files()
def read_pressure_test(name_or_path: str | Path, description: Path | None = None) -> PressureTest:
    """Read a table of holds.

    Parameters
    ----------
    name_or_path
        A CSV file, or `fan2013-table5`. Its description is the TOML file of the same name beside it; without one the
        columns are hold, from, to, from_pressure_mpa, to_pressure_mpa, and nothing is known about the chamber.
    description
        Another file with the description.

    Raises
    ------
    BenchFileError
        A file cannot be read, a column is missing, a time or pressure impossible, a pressure rises in a hold, or holds
        overlap; the error names file, column, row and value.
    """
    path = Path(name_or_path)
    if str(name_or_path) == BUILTIN:
        path = Path(str(resources.files("stommel.bench.examples") / f"{BUILTIN}.csv"))
    document: dict[str, Any] = {}
    provenance: dict[str, Provenance] = {}
    require_regular(path)
    beside = description or path.with_suffix(".toml")
    if description is not None or exists(beside):
        document, provenance = separate(read_toml(beside), str(beside))
    described = validated(document, HoldingDescription, str(beside))
    table = read_delimited(path, described.delimiter)
    name = path.name if str(name_or_path) == BUILTIN else str(path)
    return PressureTest(name, table.comments, _holds(table, described), described, provenance)


def _holds(table: Delimited, described: HoldingDescription) -> tuple[Hold, ...]:
    columns, limits = described.columns, described.limits
    names = table.cells(columns.hold)
    begin_cells, end_cells = table.cells(columns.begin), table.cells(columns.end)
    begins, ends = (_clock_times(table, column) for column in (columns.begin, columns.end))
    first, last = (_pressures(table, column) for column in (columns.begin_pressure, columns.end_pressure))
    holds: list[Hold] = []
    for k, line in enumerate(table.lines):
        begin = begins[k]
        if holds:
            begin = _after(table, columns.begin, line, holds[-1], begins[k], limits.longest_pause_hours)
        duration = (ends[k] - begins[k]) % _DAY
        written = f"{begin_cells[k]} to {end_cells[k]}"
        if duration == 0.0:
            raise refuse(table.file, columns.end, f"{written}: the hold lasts no time, or a whole day", line)
        if duration > limits.longest_hold_hours * 3600:
            raise refuse(
                table.file,
                columns.end,
                f"{written}: ends before it begins, or lasts {duration / 3600:.4g} h across midnight; at most "
                f"{limits.longest_hold_hours:g} h are allowed (limits.longest_hold_hours)",
                line,
            )
        hold = Hold(names[k], begin, begin + duration, first[k], last[k])
        if hold.loss < 0.0:
            raise refuse(
                table.file,
                columns.end_pressure.column,
                f"{hold.end_pressure / 1e6:.4g} MPa after {hold.begin_pressure / 1e6:.4g} MPa: the pressure rises in "
                f"hold {hold.name}; water was pumped in or grew warmer, and no leak can be told",
                line,
            )
        holds.append(hold)
    return tuple(holds)


def _after(table: Delimited, column: str, line: int, before: Hold, clock: float, longest_pause_hours: float) -> float:
    """Time of a clock reading after the hold before, the next day if need be."""
    pause = (clock - before.end) % _DAY
    if pause > longest_pause_hours * 3600:
        raise refuse(
            table.file,
            column,
            f"{_clock(clock)} comes before the end of hold {before.name} at {_clock(before.end)}: the holds overlap "
            f"or are out of order (or {pause / 3600:.4g} h lie between; "
            f"limits.longest_pause_hours = {longest_pause_hours:g})",
            line,
        )
    return before.end + pause


def _clock(seconds: float) -> str:
    minutes = int(seconds // 60)
    return f"{minutes // 60 % 24:02d}:{minutes % 60:02d}"


def _clock_times(table: Delimited, column: str) -> list[float]:
    """Seconds after midnight."""
    found = []
    for cell, line in zip(table.cells(column), table.lines, strict=True):
        match = _CLOCK.fullmatch(cell)
        if match is None:
            raise refuse(table.file, column, f"{cell!r} is no time of day; write hh:mm from 00:00 to 23:59", line)
        hours, minutes, seconds = (int(part or 0) for part in match.groups())
        found.append(hours * 3600.0 + minutes * 60.0 + seconds)
    return found


def _pressures(table: Delimited, column: PressureColumn) -> list[float]:
    """Gauge pressures [Pa]."""
    found = []
    for cell, line in zip(table.cells(column.column), table.lines, strict=True):
        value = number_in(cell)
        if value is None:
            raise refuse(table.file, column.column, f"{cell!r} is not a number in {column.unit}", line)
        if not isfinite(value) or not 0.0 < value * column.factor <= 150e6:
            limit = 150e6 / column.factor
            raise refuse(
                table.file,
                column.column,
                f"{cell} {column.unit}: must be above 0 and at most {limit:g} {column.unit}",
                line,
            )
        found.append(value * column.factor)
    return found
