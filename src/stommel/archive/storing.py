"""Writing a batch: frames, samples with their minutes, texts, dives, CTD, in one transaction."""

import math
import time
from collections import defaultdict
from collections.abc import Callable, Mapping, Sequence

from sqlalchemy import Connection

from stommel.archive.cells import Point, keep_up
from stommel.archive.ctd_storing import write_ctd
from stommel.archive.dive_storing import write_dives
from stommel.archive.rows import Batch, FrameRow
from stommel.archive.schema import frames, samples, texts, vehicles
from stommel.archive.times import is_time, microseconds
from stommel.archive.upserting import insert_rows

_FRAME = ("vehicle_id", "t_us", "received_us", *FrameRow._fields[1:])
_TEXT = ("vehicle_id", "t_us", "severity", "words")


def write_batch(
    connection: Connection, vehicle: int, batch: Batch, numbers_of: Callable[[set[str]], Mapping[str, int]]
) -> None:
    """Write what a vehicle sent, in the transaction of `connection`.

    Parameters
    ----------
    connection
        Of a transaction that writes.
    vehicle
        Its number; it is made known under that number if nobody did.
    batch
        Samples that are not finite, or of no time from 1970 to 2100, are left out: the archive keeps their frame.
    numbers_of
        Numbers of channels by their keys.

    Raises
    ------
    ArchiveRequestError
        A time of a frame, a text, a dive or a CTD sample is none.
    """
    now_us = round(time.time() * 1e6)
    unnamed = (vehicle, f"vehicle {vehicle}", "", now_us)
    insert_rows(connection, vehicles, ("id", "name", "model", "added_us"), [unnamed], "keep")
    frame_rows = [(vehicle, microseconds(row.t), now_us, *row[1:]) for row in batch.frames]
    insert_rows(connection, frames, _FRAME, frame_rows)
    _write_samples(connection, vehicle, batch.samples, numbers_of)
    text_rows = [(vehicle, microseconds(t), severity, _storable(words)) for t, severity, words in batch.texts]
    insert_rows(connection, texts, _TEXT, text_rows)
    if batch.dives:
        write_dives(connection, vehicle, batch.dives, batch.log)
    if batch.ctd:
        write_ctd(connection, vehicle, batch.ctd, batch.log)


def _write_samples(
    connection: Connection,
    vehicle: int,
    given: Sequence[tuple[str, float, float]],
    numbers_of: Callable[[set[str]], Mapping[str, int]],
) -> None:
    number = numbers_of({key for key, _, _ in given}) if given else {}
    values: dict[tuple[int, int], float] = {}
    for key, t, value in given:
        if is_time(t) and math.isfinite(value):
            values[number[key], round(t * 1e6)] = float(value)
    new: dict[int, list[Point]] = defaultdict(list)
    rows = []
    for (channel, t_us), value in sorted(values.items()):
        rows.append((vehicle, channel, t_us, value))
        new[channel].append((t_us, value))
    insert_rows(connection, samples, ("vehicle_id", "channel_id", "t_us", "value"), rows, "replace")
    if new:
        keep_up(connection, vehicle, new)


def _storable(words: str) -> str:
    """Words without what PostgreSQL does not take: the character 0, halves of pairs."""
    return words.replace("\0", "").encode("utf-8", "replace").decode()
