"""Writing a batch: frames, samples with their minutes, texts, dives, CTD, in one transaction."""

import math
import time
from collections import defaultdict
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any

from sqlalchemy import Connection

from stommel.archive.cells import Point, keep_up
from stommel.archive.rows import Batch, CtdRow, DiveRow, FrameRow
from stommel.archive.schema import ctd, dives, frames, samples, texts, vehicles
from stommel.archive.times import is_time, microseconds
from stommel.archive.upserting import insert_rows
from stommel.archive.wording import storable

_FRAME = ("vehicle_id", "t_us", "received_us", *FrameRow._fields[1:])
_TEXT = ("vehicle_id", "t_us", "severity", "words")
_DIVE = ("vehicle_id", "dive", "t_begin_us", "t_end_us", *DiveRow._fields[3:])
_CTD = ("vehicle_id", "t_us", *CtdRow._fields[1:])


NumbersOf = Callable[[set[str]], Mapping[str, int]]
"""Numbers of channels by their keys."""
GREATEST_VALUE = 1e290
"""Of a sample, either sign; the sum of as many as ten minutes can have is still a number."""


def write_batch(connection: Connection, vehicle: int, batch: Batch, numbers_of: NumbersOf) -> None:
    """Write what a vehicle sent, in the transaction of `connection`.

    Parameters
    ----------
    connection
        Of a transaction that writes.
    vehicle
        Its number; it is made known under that number if nobody did.
    batch
        Samples that are no number up to `GREATEST_VALUE`, or of no time from 1970 to 2100, are left out: the archive
        keeps their frame.
    numbers_of
        Numbers of channels by their keys.

    Raises
    ------
    ArchiveRequestError
        A time of a frame, a text, a dive or a CTD sample is none.
    """
    for write, rows in writers(connection, vehicle, batch, numbers_of):
        write(rows)


Write = Callable[[Sequence[Any]], None]


def writers(
    connection: Connection, vehicle: int, batch: Batch, numbers_of: NumbersOf
) -> tuple[tuple[Write, Sequence[Any]], ...]:
    """For each part of a batch, in order: what writes rows of that kind, and the rows; the vehicle is made known."""
    now_us = round(time.time() * 1e6)
    unnamed = (vehicle, f"vehicle {vehicle}", "", now_us)
    insert_rows(connection, vehicles, ("id", "name", "model", "added_us"), [unnamed], "keep")

    def write_frames(rows: Sequence[FrameRow]) -> None:
        told = [(vehicle, microseconds(row.t), now_us, *row[1:]) for row in rows]
        insert_rows(connection, frames, _FRAME, told)

    def write_samples(rows: Sequence[tuple[str, float, float]]) -> None:
        _write_samples(connection, vehicle, rows, numbers_of)

    def write_texts(rows: Sequence[tuple[float, int, str]]) -> None:
        told = [(vehicle, microseconds(t), severity, storable(words)) for t, severity, words in rows]
        insert_rows(connection, texts, _TEXT, told)

    def write_dives(rows: Sequence[DiveRow]) -> None:
        told = {(row.dive, microseconds(row.t_begin)): _dive(vehicle, row) for row in rows}
        insert_rows(connection, dives, _DIVE, list(told.values()), "replace")

    def write_ctd(rows: Sequence[CtdRow]) -> None:
        told = {microseconds(row.t): (vehicle, microseconds(row.t), *_finite(row[1:])) for row in rows}
        insert_rows(connection, ctd, _CTD, list(told.values()), "replace")

    return (
        (write_frames, batch.frames), (write_samples, batch.samples), (write_texts, batch.texts),
        (write_dives, batch.dives), (write_ctd, batch.ctd),
    )  # fmt: skip


def _write_samples(
    connection: Connection, vehicle: int, given: Sequence[tuple[str, float, float]], numbers_of: NumbersOf
) -> None:
    number = numbers_of({key for key, _, _ in given}) if given else {}
    values: dict[tuple[int, int], float] = {}
    for key, t, value in given:
        if is_time(t) and -GREATEST_VALUE <= value <= GREATEST_VALUE:
            values[number[key], round(t * 1e6)] = float(value)
    new: dict[int, list[Point]] = defaultdict(list)
    rows = []
    for (channel, t_us), value in sorted(values.items()):
        rows.append((vehicle, channel, t_us, value))
        new[channel].append((t_us, value))
    insert_rows(connection, samples, ("vehicle_id", "channel_id", "t_us", "value"), rows, "replace")
    if new:
        keep_up(connection, vehicle, new)


def _dive(vehicle: int, row: DiveRow) -> tuple[Any, ...]:
    end_us = None if row.t_end is None else microseconds(row.t_end)
    return (vehicle, row.dive, microseconds(row.t_begin), end_us, *_finite(row[3:]))


def _finite(values: Sequence[float | None]) -> Iterator[float | None]:
    """Values, of which those that are no number are not known."""
    return (None if value is None or not math.isfinite(value) else value for value in values)
