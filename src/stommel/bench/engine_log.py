"""Engine logs: runs of the buoyancy engine on the bench, in SI units."""

from collections.abc import Sequence
from dataclasses import dataclass
from math import isfinite
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from stommel.bench.column_map import Channel, EngineLogMap, load_map
from stommel.bench.failures import bench_files, refuse
from stommel.bench.log_checks import check_run
from stommel.bench.quantities import MARKER, QUANTITIES
from stommel.bench.raw_channel import RawChannel
from stommel.files.delimited import Delimited, number_in, read_delimited

Series = NDArray[np.float64]


@dataclass(frozen=True)
class EngineRun:
    """One run: the motor turns at one speed against one pressure. All series have one value a row."""

    name: str
    time: Series
    """[s]"""
    pressure: Series
    """Gauge pressure at the bladder [Pa]."""
    motor_speed: Series
    """[rad/s]"""
    voltage: Series
    """Of the supply [V]."""
    current: Series
    """From the supply [A]."""
    piston_travel: Series
    """[m]"""

    def rows(self, first: int, last: int) -> "EngineRun":
        """The rows from `first` up to and without `last`."""
        return EngineRun(self.name, *(getattr(self, name)[first:last] for name in QUANTITIES))


@dataclass(frozen=True)
class EngineLog:
    """Runs of one log, or of several read together."""

    origin: str
    """Where the log comes from, in words."""
    runs: tuple[EngineRun, ...]
    piston_diameter_m: float | None = None
    """As the column map says; None leaves it to the vehicle."""
    true_parameters: dict[str, float] | None = None
    """Constants that made a generated log, as its map tells; None for a measured one."""

    @property
    def generated(self) -> bool:
        """True if the model made this log, at least in part."""
        return MARKER in self.origin


@bench_files()
def read_engine_log(path: Path, column_map: EngineLogMap | None = None) -> EngineLog:
    """Read, convert and check an engine log.

    Parameters
    ----------
    path
        The CSV file.
    column_map
        What its columns are; the TOML file beside it if left out.

    Raises
    ------
    BenchFileError
        The log cannot be trusted: a column is missing, a unit unknown or mixed, a cell no finite number, time runs
        backwards or has a gap, a sensor is stuck or saturated, a run too short. The error names file, column, row and
        value.
    """
    described = column_map or load_map(path)
    table = read_delimited(path, described.delimiter)
    columns = {name: _channel(table, name, channel) for name, channel in described.columns.channels().items()}
    runs = []
    for name, where in _runs(table, described.columns.run):
        parts = {quantity: column.part(where) for quantity, column in columns.items()}
        runs.append(_converted(name, check_run(name, parts, described.checks)))
    diameter = described.piston_diameter_mm
    return EngineLog(
        origin=_origin(table, described),
        runs=tuple(runs),
        piston_diameter_m=diameter / 1e3 if diameter is not None else None,
        true_parameters=described.generated.parameters if described.generated is not None else None,
    )


def joined(logs: Sequence[EngineLog]) -> EngineLog:
    """Return the runs of several logs as one; generated ones keep their mark."""
    first = logs[0]
    return EngineLog(
        origin="; ".join(dict.fromkeys(log.origin for log in logs)),
        runs=tuple(run for log in logs for run in log.runs),
        piston_diameter_m=first.piston_diameter_m,
        true_parameters=first.true_parameters
        if all(log.true_parameters == first.true_parameters for log in logs)
        else None,
    )


def _origin(table: Delimited, described: EngineLogMap) -> str:
    """Origin in words; a mark in the log itself counts even where the map has lost it."""
    marked = any(MARKER in comment for comment in table.comments) or described.generated is not None
    if not marked or MARKER in described.origin:
        return described.origin
    return MARKER if described.origin == "measured" else f"{described.origin} ({MARKER})"


def _runs(table: Delimited, column: str | None) -> list[tuple[str, NDArray[np.bool_]]]:
    """Name and rows of each run, in the order of the file."""
    if column is None:
        return [(Path(table.file).stem, np.ones(len(table.rows), dtype=bool))]
    cells = np.array(table.cells(column))
    for k, cell in enumerate(cells):
        if cell == "":
            raise refuse(table.file, column, "empty cell; every row belongs to a run", table.lines[k])
    return [(str(name), cells == name) for name in dict.fromkeys(cells.tolist())]


def _channel(table: Delimited, quantity: str, channel: Channel) -> RawChannel:
    lines = np.array(table.lines)
    if channel.value is not None:
        return RawChannel(table.file, quantity, channel, np.full(len(lines), channel.value), lines)
    column = channel.column or ""
    cells = table.cells(column)
    _refuse_contradicting_name(table.file, column, quantity, channel.unit)
    values = [_number(table.file, column, cell, line, channel) for cell, line in zip(cells, table.lines, strict=True)]
    return RawChannel(table.file, quantity, channel, np.array(values), lines)


def _number(file: str, column: str, cell: str, line: int, channel: Channel) -> float:
    value = number_in(cell)
    if value is None:
        if cell == "":
            raise refuse(file, column, "empty cell; every reading must be there", line)
        number, _, unit = cell.partition(" ")
        if unit and number.replace(".", "").replace("-", "").isdigit():
            text = f"{cell!r}: a cell with a unit of its own; all cells must be plain numbers in {channel.unit}"
            raise refuse(file, column, text + (" (mixed units)" if unit != channel.unit else ""), line)
        raise refuse(file, column, f"{cell!r} is not a number", line)
    if not isfinite(value):
        raise refuse(file, column, f"{cell!r} is not a finite number", line)
    return value


def _refuse_contradicting_name(file: str, column: str, quantity: str, unit: str) -> None:
    """Refuse a column whose name ends with one unit while the map says another."""
    units = QUANTITIES[quantity].units
    bracketed = column.rstrip("])").replace("(", "[").rpartition("[")[2].strip() if column.endswith(("]", ")")) else ""
    suffix = column.rpartition("_")[2].lower() if "_" in column else ""
    named = [name for name in units if name == bracketed or (len(name) > 1 and name.lower() == suffix)]
    if named and all(abs(units[name] / units[unit] - 1.0) > 1e-9 for name in named):
        raise refuse(file, column, f"mixed units: the column is named in {named[0]} but its map says {unit}")


def _converted(name: str, parts: dict[str, RawChannel]) -> EngineRun:
    series = {q: part.values * QUANTITIES[q].factor(part.channel.unit) for q, part in parts.items()}
    return EngineRun(name, **series)
