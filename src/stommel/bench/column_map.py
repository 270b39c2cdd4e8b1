"""The column map of an engine log: which column holds which quantity, in which unit (a small TOML beside the CSV)."""

from collections.abc import Sequence
from pathlib import Path
from typing import Annotated, Any, Literal, Self

from pydantic import BaseModel, ConfigDict, Field, model_validator

from stommel.bench.failures import BenchFileError, BenchRequestError, bench_files
from stommel.bench.quantities import QUANTITIES
from stommel.errors import Problem
from stommel.files.fields import Name
from stommel.files.opening import exists, require_regular
from stommel.files.provenance import separate
from stommel.files.ranges import GREATEST_SEED, between
from stommel.files.sentences import validated
from stommel.files.toml_reader import read_toml

Number = Annotated[float, between(-1e12, 1e12)]
"""A reading or a constant in its own unit."""


MOST_ROWS = 1_000_000
"""Of a log, about."""


class MapTable(BaseModel):
    """A table of a file that describes a bench test."""

    model_config = ConfigDict(extra="forbid", frozen=True)


class Channel(MapTable):
    """Where a quantity stands, and in which unit."""

    unit: Name
    """One of the units that the quantity may be written in."""
    column: Name | None = None
    """Name of the column."""
    value: Number | None = None
    """Constant of the whole log, where no column holds it."""
    range: tuple[Number, Number] | None = None
    """Both ends of what the sensor can show, in its unit; readings that lie flat there are refused."""
    setting: bool = False
    """True: the value that was set, not a sensor; it may stand still."""

    @model_validator(mode="after")
    def _column_or_value(self) -> Self:
        if (self.column is None) == (self.value is None):
            raise ValueError("needs either column or value, and not both")
        if self.range is not None and not self.range[0] < self.range[1]:
            raise ValueError(f"range = {list(self.range)}: the first number must be less than the second")
        return self


class Columns(MapTable):
    """The quantities of an engine log."""

    run: Name | None = None
    """Column whose text tells one run from the next; without it the file is one run."""
    time: Channel
    pressure: Channel
    """Gauge pressure at the bladder."""
    motor_speed: Channel
    voltage: Channel
    """Of the supply."""
    current: Channel
    """From the supply."""
    piston_travel: Channel
    """Of the reservoir's piston, from either end."""

    @model_validator(mode="after")
    def _units_are_known(self) -> Self:
        for name, channel in self.channels().items():
            known = QUANTITIES[name].units
            if channel.unit not in known:
                raise ValueError(f"{name}.unit = {channel.unit!r}: unknown unit; allowed are {', '.join(known)}")
            if name in ("time", "piston_travel") and channel.column is None:
                raise ValueError(f"{name}: must be a column; a constant says nothing")
        return self

    def channels(self) -> dict[str, Channel]:
        """The channel of each quantity."""
        return {name: getattr(self, name) for name in QUANTITIES}


class Checks(MapTable):
    """When a log is refused."""

    longest_gap: Annotated[float, between(1, 1e6)] = 3.0
    """Greatest time between two rows, in multiples of the usual one."""
    stuck_rows: Annotated[int, Field(strict=True, ge=2, le=MOST_ROWS)] = 10
    """Rows that a sensor may show the same reading while others change."""
    saturated_rows: Annotated[int, Field(strict=True, ge=2, le=MOST_ROWS)] = 3
    """Rows that a sensor may lie at an end of its range."""
    fewest_rows: Annotated[int, Field(strict=True, ge=3, le=MOST_ROWS)] = 20
    """Rows that a run must have while the motor turns."""


class Generated(MapTable):
    """How the model made this log."""

    vehicle: Name
    seed: Annotated[int, Field(strict=True, ge=0, le=GREATEST_SEED)]
    parameters: dict[str, Annotated[float, between(0, 1e20)]]
    """Constants of the engine that were used, in SI units."""


class EngineLogMap(MapTable):
    """Description of an engine log."""

    format: Literal[1] = 1
    origin: Annotated[str, Field(max_length=400)] = "measured"
    """Where the log comes from, in words; repeated in every result."""
    delimiter: Annotated[str, Field(min_length=1, max_length=1)] = ","
    piston_diameter_mm: Annotated[float, between(2, 500)] | None = None
    """Of the reservoir cylinder; the vehicle's if left out."""
    columns: Columns
    checks: Checks = Checks()
    generated: Generated | None = None


@bench_files()
def load_map(
    log: Path, map_file: Path | None = None, columns: Sequence[str] = (), constants: Sequence[str] = ()
) -> EngineLogMap:
    """Find the column map of an engine log.

    Parameters
    ----------
    log
        The log; its map is the file of the same name that ends in .toml.
    map_file
        Another file with the map.
    columns, constants
        `quantity=column:unit` and `quantity=number:unit`, which stand above what the file says.

    Raises
    ------
    BenchFileError
        There is no log or no map, or the map is wrong.
    BenchRequestError
        A column or constant is not written as it must be.
    """
    require_regular(log)
    beside = log.with_suffix(".toml")
    given = _given(columns, constants)
    document: dict[str, Any] = {}
    origin = "--column"
    if map_file is not None or exists(beside):
        path = map_file or beside
        origin = str(path)
        document, _ = separate(read_toml(path), origin)
    elif not given:
        raise BenchFileError(
            [Problem(str(log), "", f"no column map: write {beside}, or give --map, or --column quantity=column:unit")]
        )
    if isinstance(document.get("columns", {}), dict):
        document = document | {"columns": document.get("columns", {}) | given}
    return validated(document, EngineLogMap, origin)


def _given(columns: Sequence[str], constants: Sequence[str]) -> dict[str, Any]:
    """Channels that options name."""
    found: dict[str, Any] = {}
    for option, texts in (("--column", columns), ("--constant", constants)):
        for text in texts:
            name, equals, rest = text.partition("=")
            if option == "--column" and name == "run" and rest:
                found["run"] = rest
                continue
            what, colon, unit = rest.rpartition(":")
            if not equals or not colon or not what or name not in QUANTITIES:
                kind = "COLUMN" if option == "--column" else "NUMBER"
                raise BenchRequestError(
                    f"{option} {text!r}: must be QUANTITY={kind}:UNIT with a quantity of {', '.join(QUANTITIES)}"
                )
            found[name] = {"column": what, "unit": unit} if option == "--column" else _constant(text, what, unit)
    return found


def _constant(text: str, number: str, unit: str) -> dict[str, Any]:
    try:
        return {"value": float(number), "unit": unit}
    except ValueError:
        raise BenchRequestError(f"--constant {text!r}: {number!r} is not a number") from None
