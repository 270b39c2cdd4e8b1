"""Whether an archive is sound: its file, its references, and what the minutes say of the samples."""

from dataclasses import dataclass
from typing import Any

from sqlalchemy import Connection, Select, func, inspect, select

from stommel.archive.address import address_of, file_of, shown
from stommel.archive.cells import LEVELS, Level
from stommel.archive.columns import metadata
from stommel.archive.looking import looking
from stommel.archive.migrating import CURRENT, version_of
from stommel.archive.schema import samples

_MOST_PROBLEMS = 10
"""Of a kind that are told."""


@dataclass(frozen=True)
class Soundness:
    """What a look at an archive found."""

    archive: str
    version: str
    current: bool
    """Whether its version is the one of this program."""
    size_bytes: int | None
    """Of its file; None in PostgreSQL."""
    rows: dict[str, int]
    """By table."""
    problems: tuple[str, ...]
    """Empty if it is sound."""

    def as_json(self) -> dict[str, Any]:
        """All of it."""
        return {**vars(self), "problems": list(self.problems)}


def soundness_of(url: str) -> Soundness:
    """Look through all of an archive; nothing is changed, and a station may be writing to it.

    Raises
    ------
    ArchiveError
        There is none, or it cannot be read at all.
    """
    address = address_of(url)
    with looking(address) as connection:
        there = set(inspect(connection).get_table_names())
        rows = {
            name: connection.execute(select(func.count()).select_from(table)).scalar_one()
            for name, table in sorted(metadata.tables.items())
            if name in there
        }
        version = str(version_of(connection))
        problems = [f"the table {name} is missing" for name in sorted(metadata.tables.keys() - there)]
        problems += _of_the_file(connection)
        for level in LEVELS:
            if {level.table.name, samples.name} <= there:
                problems += _of_cells(connection, level)
    file = file_of(address)
    size = None if file is None else file.stat().st_size
    return Soundness(shown(address), version, version == CURRENT, size, rows, tuple(problems))


def _of_the_file(connection: Connection) -> list[str]:
    """What SQLite finds in its file; PostgreSQL keeps its references itself, and pg_amcheck looks at its files."""
    if connection.dialect.name != "sqlite":
        return []
    found = [row[0] for row in connection.exec_driver_sql(f"PRAGMA integrity_check({_MOST_PROBLEMS})")]
    problems = [f"the file is damaged: {words}" for words in found if words != "ok"]
    broken = connection.exec_driver_sql("PRAGMA foreign_key_check").fetchmany(_MOST_PROBLEMS)
    return problems + [f"a row of {row[0]} names one of {row[2]} that is not there" for row in broken]


def _of_cells(connection: Connection, level: Level) -> list[str]:
    """Cells that are not what their samples come to, and samples without a cell."""
    table, of = level.table, samples.c
    number = of.t_us.op("/")(level.width_us)
    made = select(
        of.vehicle_id, of.channel_id, number.label("number"), func.count(), func.min(of.value), func.max(of.value),
        func.min(of.t_us), func.max(of.t_us),
    ).group_by(of.vehicle_id, of.channel_id, number)  # fmt: skip
    names = ("vehicle_id", "channel_id", table.c[2].name, "count", "low", "high", "first_t_us", "last_t_us")
    kept = select(*(table.c[name] for name in names))
    wrong = _count(connection, made, kept) + _count(connection, kept, made)
    return [f"{wrong} rows of {table.name} do not fit the samples; restore a backup"] if wrong else []


def _count(connection: Connection, some: Select[Any], others: Select[Any]) -> int:
    """How many rows of `some` are not among `others`."""
    return connection.execute(select(func.count()).select_from(some.except_(others).subquery())).scalar_one()
