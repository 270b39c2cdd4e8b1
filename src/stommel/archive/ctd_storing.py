"""Writing samples of the CTD: those of a log stand for the few of them that came by radio; each hour is counted."""

from bisect import bisect_left
from collections.abc import Iterable, Sequence

from sqlalchemy import Connection, func, select, update

from stommel.archive.log_tables import ctd_hours
from stommel.archive.numbers import known
from stommel.archive.rows import CtdRow
from stommel.archive.schema import ctd, vehicles
from stommel.archive.times import microseconds
from stommel.archive.upserting import insert_rows

HOUR_US = 3_600_000_000
SAME_US = 1_000_000
"""A sample by radio and one of the log that are no further apart [us] are the same: the radio rounds, clocks drift."""

_COLUMNS = ("vehicle_id", "t_us", *CtdRow._fields[1:], "log_id")


def write_ctd(connection: Connection, vehicle: int, given: Sequence[CtdRow], log: int | None) -> None:
    """Write samples in the transaction of `connection`.

    Parameters
    ----------
    connection
        Of a transaction that writes.
    vehicle
        Its number; it is known.
    given
        The samples; one at a known time replaces it.
    log
        Number of the log that they are from; None if they came by radio.

    Raises
    ------
    ArchiveRequestError
        A time is none.
    """
    rows = {microseconds(row.t): (vehicle, microseconds(row.t), *known(row[1:]), log) for row in given}
    touched = set(rows)
    others = _of_the_other_way(connection, vehicle, min(rows), max(rows), from_log=log is None)
    if log is None:
        for t_us in [t_us for t_us in rows if _is_near(t_us, others)]:
            del rows[t_us]
    else:
        taken = sorted(rows)
        doubled = [t_us for t_us in others if _is_near(t_us, taken)]
        _remove(connection, vehicle, doubled)
        touched |= set(doubled)
    insert_rows(connection, ctd, _COLUMNS, list(rows.values()), "replace")
    _count(connection, vehicle, sorted({t_us // HOUR_US for t_us in touched}))


def _of_the_other_way(connection: Connection, vehicle: int, first: int, last: int, *, from_log: bool) -> list[int]:
    """Times of samples of logs, or of those that came by radio."""
    of = ctd.c
    query = select(of.t_us).where(of.vehicle_id == vehicle, of.t_us.between(first - SAME_US, last + SAME_US))
    query = query.where(of.log_id.is_not(None) if from_log else of.log_id.is_(None)).order_by(of.t_us)
    return list(connection.execute(query).scalars())


def _is_near(t_us: int, sorted_times: Sequence[int]) -> bool:
    place = bisect_left(sorted_times, t_us - SAME_US)
    return place < len(sorted_times) and sorted_times[place] <= t_us + SAME_US


def _remove(connection: Connection, vehicle: int, times: Iterable[int]) -> None:
    for t_us in times:
        connection.execute(ctd.delete().where(ctd.c.vehicle_id == vehicle, ctd.c.t_us == t_us))


def _count(connection: Connection, vehicle: int, hours: Sequence[int]) -> None:
    """Count these hours anew, and mark them with the number of this change."""
    more = update(vehicles).where(vehicles.c.id == vehicle).values(ctd_changes=vehicles.c.ctd_changes + 1)
    change = connection.execute(more.returning(vehicles.c.ctd_changes)).scalar_one()
    rows = []
    for hour in hours:
        of = ctd.c
        query = select(func.count()).where(
            of.vehicle_id == vehicle, of.t_us.between(hour * HOUR_US, (hour + 1) * HOUR_US - 1)
        )
        rows.append((vehicle, hour, connection.execute(query).scalar_one(), change))
    insert_rows(connection, ctd_hours, tuple(ctd_hours.c.keys()), rows, "replace")
