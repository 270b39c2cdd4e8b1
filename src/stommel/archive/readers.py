"""Reading what a vehicle sent: frames, texts, dives, CTD samples, in order of time."""

from collections.abc import Iterator
from typing import Any, NamedTuple

from sqlalchemy import Connection, Row, Select, func, select

from stommel.archive.errors import ArchiveRequestError
from stommel.archive.rows import CtdRow, DiveRow, FrameRow, TextRow
from stommel.archive.schema import ctd, dives, frames, texts
from stommel.archive.times import GREATEST_TIME, microseconds, seconds

MOST_ROWS = 10_000
"""Of one answer about frames or texts."""

_AT_ONCE = 20_000
"""Rows that are held while many are read."""


class StoredFrame(NamedTuple):
    """A frame and its number in the archive; later ones have greater numbers."""

    number: int
    received: float
    """By the station's clock [s since 1970]."""
    row: FrameRow


def stored_frames(
    connection: Connection, vehicle: int, *, before: int | None = None, limit: int = 100, message: int | None = None
) -> list[StoredFrame]:
    """The newest frames of a vehicle, newest first.

    Parameters
    ----------
    connection
        Of an archive that is read.
    vehicle
        Its number.
    before
        Only frames of smaller numbers.
    limit
        How many at most, from 1 to `MOST_ROWS`.
    message
        Only of this message.

    Raises
    ------
    ArchiveRequestError
        `limit` is none that is allowed.
    """
    _require_limit(limit)
    query = select(frames).where(frames.c.vehicle_id == vehicle).order_by(frames.c.id.desc()).limit(limit)
    if before is not None:
        query = query.where(frames.c.id < before)
    if message is not None:
        query = query.where(frames.c.message_id == message)
    return [_frame(row) for row in connection.execute(query)]


def kept_messages(connection: Connection, vehicle: int) -> list[int]:
    """Numbers of the messages of which a vehicle has frames, from one to the next: not all frames are read."""
    of, found = frames.c, list[int]()
    while True:
        query = select(func.min(of.message_id)).where(of.vehicle_id == vehicle)
        if found:
            query = query.where(of.message_id > found[-1])
        number = connection.execute(query).scalar()
        if number is None:
            return found
        found.append(number)


def frames_between(connection: Connection, vehicle: int, begin: float, end: float) -> Iterator[StoredFrame]:
    """The frames from `begin` to `end` [s since 1970] in order of time, read little by little."""
    of = frames.c
    query = select(frames).where(of.vehicle_id == vehicle, of.t_us.between(microseconds(begin), microseconds(end)))
    for row in _many(connection, query.order_by(of.t_us, of.id)):
        yield _frame(row)


def stored_texts(
    connection: Connection, vehicle: int, *, begin: float = 0.0, end: float = GREATEST_TIME, limit: int = 1000
) -> list[TextRow]:
    """The newest texts of a vehicle from `begin` to `end`, at most `limit`, in order of time."""
    _require_limit(limit)
    of = texts.c
    query = (
        select(of.t_us, of.severity, of.words)
        .where(of.vehicle_id == vehicle, of.t_us.between(microseconds(begin), microseconds(end)))
        .order_by(of.t_us.desc(), of.id.desc())
        .limit(limit)
    )
    newest = [TextRow(seconds(t_us), severity, words) for t_us, severity, words in connection.execute(query)]
    return newest[::-1]


def stored_dives(
    connection: Connection, vehicle: int, *, begin: float = 0.0, end: float = GREATEST_TIME
) -> list[DiveRow]:
    """The dives of a vehicle that touch the range from `begin` to `end`, by time: each mission counts from 1."""
    of = dives.c
    query = (
        select(dives)
        .where(of.vehicle_id == vehicle, of.t_begin_us <= microseconds(end))
        .where(func.coalesce(of.t_end_us, microseconds(GREATEST_TIME)) >= microseconds(begin))
        .order_by(of.t_begin_us, of.dive)
    )
    return [dive_of(row) for row in connection.execute(query)]


def stored_ctd(
    connection: Connection, vehicle: int, *, begin: float = 0.0, end: float = GREATEST_TIME
) -> Iterator[CtdRow]:
    """The CTD samples of a vehicle from `begin` to `end` in order of time, read little by little."""
    of = ctd.c
    query = select(of.t_us, of.dive, of.pressure_dbar, of.temperature_degc, of.conductivity_s_m)
    query = query.where(of.vehicle_id == vehicle, of.t_us.between(microseconds(begin), microseconds(end)))
    for t_us, dive, pressure, temperature, conductivity in _many(connection, query.order_by(of.t_us)):
        yield CtdRow(seconds(t_us), dive, pressure, temperature, conductivity)


def _many(connection: Connection, query: Select[Any]) -> Iterator[Any]:
    yield from connection.execute(query, execution_options={"yield_per": _AT_ONCE})


def _require_limit(limit: int) -> None:
    if not 1 <= limit <= MOST_ROWS:
        raise ArchiveRequestError(f"{limit} rows; allowed are 1 to {MOST_ROWS} at once")


def _frame(row: Row[Any]) -> StoredFrame:
    fields = dict(row._mapping)
    del fields["vehicle_id"]
    number, received_us, t_us = fields.pop("id"), fields.pop("received_us"), fields.pop("t_us")
    return StoredFrame(number, seconds(received_us), FrameRow(t=seconds(t_us), **fields))


def dive_of(row: Row[Any]) -> DiveRow:
    """The dive of a row of `dives`."""
    fields = dict(row._mapping)
    del fields["vehicle_id"], fields["log_id"]
    begin_us, end_us = fields.pop("t_begin_us"), fields.pop("t_end_us")
    return DiveRow(t_begin=seconds(begin_us), t_end=None if end_us is None else seconds(end_us), **fields)
