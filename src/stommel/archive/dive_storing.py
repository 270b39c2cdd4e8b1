"""Writing dives: what the vehicle told at the surface, and what its log says of the same dive, are one row."""

from collections.abc import Sequence
from typing import Any

from sqlalchemy import Connection, select

from stommel.archive.numbers import known as known_numbers
from stommel.archive.rows import DiveRow
from stommel.archive.schema import dives
from stommel.archive.times import microseconds
from stommel.archive.upserting import insert_rows

SAME_US = 10_000_000
"""Dives of one number whose begins by radio and by log are no further apart [us] are the same dive."""

_COLUMNS = ("vehicle_id", "dive", "t_begin_us", "t_end_us", *DiveRow._fields[3:], "log_id")
_DEPTH = _COLUMNS.index("greatest_depth_m")
_FIRST, _LOG = _COLUMNS.index("t_end_us"), len(_COLUMNS) - 1
_Row = tuple[Any, ...]


def write_dives(connection: Connection, vehicle: int, given: Sequence[DiveRow], log: int | None) -> None:
    """Write dives in the transaction of `connection`.

    What the radio told stands over what a log says, which fills in what is not known.

    Parameters
    ----------
    connection
        Of a transaction that writes.
    vehicle
        Its number; it is known.
    given
        The dives; a later row of the same dive replaces it.
    log
        Number of the log that they are from; None if they came by radio.

    Raises
    ------
    ArchiveRequestError
        A time is none.
    """
    new = [_row(vehicle, row, log) for row in given]
    known = _known(connection, vehicle, min(row[2] for row in new), max(row[2] for row in new))
    rows: dict[tuple[int, int], _Row] = {}
    for row in new:
        old = _same(row, [*rows.values(), *known])
        kept = row if old is None else _joined(old, row)
        rows[kept[1], kept[2]] = kept
    insert_rows(connection, dives, _COLUMNS, list(rows.values()), "replace")


def _row(vehicle: int, row: DiveRow, log: int | None) -> _Row:
    end_us = None if row.t_end is None else microseconds(row.t_end)
    return (vehicle, row.dive, microseconds(row.t_begin), end_us, *known_numbers(row[3:]), log)


def _known(connection: Connection, vehicle: int, first: int, last: int) -> list[_Row]:
    of = dives.c
    query = select(*(of[name] for name in _COLUMNS)).where(
        of.vehicle_id == vehicle, of.t_begin_us.between(first - SAME_US, last + SAME_US)
    )
    return [tuple(row) for row in connection.execute(query)]


def _same(row: _Row, among: Sequence[_Row]) -> _Row | None:
    """The same dive as a log, or the radio beside a log, has told it."""
    found = [
        old
        for old in among
        if old[1] == row[1] and abs(old[2] - row[2]) <= SAME_US and (old[_LOG] is not None or row[_LOG] is not None)
    ]
    return min(found, key=lambda old: abs(old[2] - row[2]), default=None)


def _joined(old: _Row, new: _Row) -> _Row:
    """Both in one, under the key that is there."""
    first, second = (new, old) if new[_LOG] is None else (old, new)
    values = [a if a is not None else b for a, b in zip(first[_FIRST:_LOG], second[_FIRST:_LOG], strict=True)]
    if old[_LOG] is not None and new[_LOG] is not None and None not in (old[_DEPTH], new[_DEPTH]):
        values[_DEPTH - _FIRST] = max(old[_DEPTH], new[_DEPTH])
    return (*old[:_FIRST], *values, old[_LOG] if new[_LOG] is None else new[_LOG])
