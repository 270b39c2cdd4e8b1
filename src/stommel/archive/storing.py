"""Writing a batch: frames, samples with their minutes, texts, dives, CTD, in one transaction."""

import time
from collections import defaultdict
from collections.abc import Callable, Mapping, Sequence
from typing import Any

from sqlalchemy import Connection

from stommel.archive.cells import Point, keep_up
from stommel.archive.ctd_storing import write_ctd
from stommel.archive.dive_storing import write_dives
from stommel.archive.numbers import GREATEST_VALUE
from stommel.archive.rows import Batch, CtdRow, DiveRow, FrameRow
from stommel.archive.schema import frames, samples, vehicles
from stommel.archive.text_storing import write_texts
from stommel.archive.times import is_time, microseconds
from stommel.archive.upserting import insert_rows

_FRAME = ("vehicle_id", "t_us", "received_us", *FrameRow._fields[1:])


NumbersOf = Callable[[set[str]], Mapping[str, int]]
"""Numbers of channels by their keys."""


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
    for _, write, rows in writers(connection, vehicle, batch, numbers_of):
        write(rows)


Write = Callable[[Sequence[Any]], None]


def writers(
    connection: Connection, vehicle: int, batch: Batch, numbers_of: NumbersOf
) -> list[tuple[str, Write, Sequence[Any]]]:
    """For each part of a batch that has rows, in order: its name, what writes such rows, and the rows.

    The vehicle is made known.
    """
    now_us = round(time.time() * 1e6)
    unnamed = (vehicle, f"vehicle {vehicle}", "", now_us)
    insert_rows(connection, vehicles, ("id", "name", "model", "added_us"), [unnamed], "keep")

    def write_frames(rows: Sequence[FrameRow]) -> None:
        told = [(vehicle, microseconds(row.t), now_us, *row[1:]) for row in rows]
        insert_rows(connection, frames, _FRAME, told)

    def write_samples(rows: Sequence[tuple[str, float, float]]) -> None:
        _write_samples(connection, vehicle, rows, numbers_of)

    def write_of_texts(rows: Sequence[tuple[float, int, str]]) -> None:
        write_texts(connection, vehicle, rows, batch.log)

    def write_of_dives(rows: Sequence[DiveRow]) -> None:
        write_dives(connection, vehicle, rows, batch.log)

    def write_of_ctd(rows: Sequence[CtdRow]) -> None:
        write_ctd(connection, vehicle, rows, batch.log)

    parts: dict[str, Write] = {
        "frames": write_frames, "samples": write_samples, "texts": write_of_texts, "dives": write_of_dives,
        "ctd": write_of_ctd,
    }  # fmt: skip
    return [(name, write, rows) for name, write in parts.items() if (rows := getattr(batch, name))]


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
