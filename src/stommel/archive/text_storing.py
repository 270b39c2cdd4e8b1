"""Writing texts: what the vehicle said at the surface, and what its log says of the same, are one row."""

from collections.abc import Sequence
from typing import Any

from sqlalchemy import Connection, select, update

from stommel.archive.schema import texts
from stommel.archive.times import microseconds
from stommel.archive.upserting import insert_rows
from stommel.archive.wording import storable

SOONER_US, LATER_US = 2_000_000, 86_400_000_000
"""What happens is written into the log at once, and said when the vehicle is next heard: so much sooner or later [us].

A text of the radio that is taken for a later one of the same words changes nothing: the log tells that one too.
"""

_COLUMNS = ("vehicle_id", "t_us", "severity", "words", "log_id")


def write_texts(connection: Connection, vehicle: int, given: Sequence[tuple[float, int, str]], log: int | None) -> None:
    """Write texts in the transaction of `connection`.

    One of a log takes the place of the same words by radio, which came later than what they tell of; the severity stays
    as it was said.

    Parameters
    ----------
    connection
        Of a transaction that writes.
    vehicle
        Its number; it is known.
    given
        Time [s since 1970], severity and words of each, in order of time.
    log
        Number of the log that they are from; None if they came by radio.

    Raises
    ------
    ArchiveRequestError
        A time is none.
    """
    rows = [(vehicle, microseconds(t), severity, storable(words), log) for t, severity, words in given]
    if log is not None:
        rows = [row for row in rows if not _is_told(connection, row)]
    insert_rows(connection, texts, _COLUMNS, rows)


def _is_told(connection: Connection, row: tuple[Any, ...]) -> bool:
    """Whether a text of a log is there; what the radio has told of it becomes the log's, at its time."""
    vehicle, t_us, _, words, log = row
    of = texts.c
    same = (of.vehicle_id == vehicle, of.words == words)
    there = select(of.id).where(*same, of.t_us == t_us, of.log_id.is_not(None))
    if connection.execute(there.limit(1)).first() is not None:
        return True
    span = of.t_us.between(t_us - SOONER_US, t_us + LATER_US)
    said = select(of.id).where(*same, span, of.log_id.is_(None)).order_by(of.t_us, of.id)
    number = connection.execute(said.limit(1)).scalar()
    if number is not None:
        connection.execute(update(texts).where(of.id == number).values(t_us=t_us, log_id=log))
    return number is not None
