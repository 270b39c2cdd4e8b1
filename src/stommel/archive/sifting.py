"""Writing a batch of which some rows are wrong: those are left out, and nothing else."""

import time
from collections.abc import Callable, Sequence
from typing import Any, NamedTuple

from sqlalchemy import Connection
from sqlalchemy.exc import IntegrityError

from stommel.archive.errors import ArchiveRequestError, telling
from stommel.archive.rows import Batch, FrameRow
from stommel.archive.storing import NumbersOf, Write, writers
from stommel.archive.times import is_time
from stommel.errors import one_line

_LONGEST = 200


class Sifted(NamedTuple):
    """What became of a batch."""

    batch: Batch
    """What was stored."""
    left_out: Sequence[str] = ()
    """Of each row that was not: what it was, and why."""


def sift_batch(connection: Connection, vehicle: int, batch: Batch, numbers_of: NumbersOf, name: str) -> Sifted:
    """Write all rows that the database named `name` takes, in the transaction of `connection`.

    Frames are the record of what came: one whose time is none is kept at the time of now.
    """
    now = time.time()
    whole = batch._replace(frames=[_of_now(row, now) for row in batch.frames])
    left_out: list[str] = []
    kept: dict[str, Any] = {
        part: _sound(connection, rows, write, lambda row, why: left_out.append(_words(row, why)), name)
        for part, write, rows in writers(connection, vehicle, whole, numbers_of)
    }
    return Sifted(whole._replace(**kept), left_out)


def _of_now(row: FrameRow, now: float) -> FrameRow:
    return row if is_time(row.t) else row._replace(t=now)


def _sound(
    connection: Connection, rows: Sequence[Any], write: Write, leave_out: Callable[[Any, Exception], None], name: str
) -> Sequence[Any]:
    """Write rows; where that is refused each half of them, down to the ones that are wrong. Returns what is written."""
    if not rows:
        return rows
    try:
        with telling(name), connection.begin_nested():
            write(rows)
    except (ArchiveRequestError, IntegrityError) as error:
        if len(rows) == 1:
            leave_out(rows[0], error)
            return ()
        half = len(rows) // 2
        return [
            *_sound(connection, rows[:half], write, leave_out, name),
            *_sound(connection, rows[half:], write, leave_out, name),
        ]
    return rows


def _words(row: Any, why: Exception) -> str:
    reason = why.orig if isinstance(why, IntegrityError) else why
    return f"{one_line(ascii(tuple(row)), _LONGEST)}: {one_line(' '.join(str(reason).split()), _LONGEST)}"
