"""Writing a batch: frames, samples with their minutes, texts, dives, CTD, in one transaction."""

import math
import time
from collections import defaultdict
from collections.abc import Callable, Mapping, Sequence
from typing import Any

from sqlalchemy import Connection, insert

from stommel.station.archive.cells import Point, keep_up
from stommel.station.archive.rows import Batch, CtdRow, DiveRow, FrameRow
from stommel.station.archive.schema import ctd, dives, frames, samples, texts, vehicles
from stommel.station.archive.times import is_time, microseconds
from stommel.station.archive.upserting import insert_new, upsert


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
    unnamed = {"id": vehicle, "name": f"vehicle {vehicle}", "model": "", "added_us": now_us}
    insert_new(connection, vehicles, [unnamed])
    if batch.frames:
        connection.execute(insert(frames), [_frame(vehicle, row, now_us) for row in batch.frames])
    _write_samples(connection, vehicle, batch.samples, numbers_of)
    if batch.texts:
        connection.execute(
            insert(texts),
            [
                {"vehicle_id": vehicle, "t_us": microseconds(t), "severity": severity, "words": words}
                for t, severity, words in batch.texts
            ],
        )
    upsert(connection, dives, list({row.dive: _dive(vehicle, row) for row in batch.dives}.values()))
    upsert(connection, ctd, list({row.t: _ctd(vehicle, row) for row in batch.ctd}.values()))


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
        rows.append({"vehicle_id": vehicle, "channel_id": channel, "t_us": t_us, "value": value})
        new[channel].append((t_us, value))
    upsert(connection, samples, rows)
    if new:
        keep_up(connection, vehicle, new)


def _frame(vehicle: int, row: FrameRow, now_us: int) -> dict[str, Any]:
    fields = row._asdict()
    return {"vehicle_id": vehicle, "t_us": microseconds(fields.pop("t")), "received_us": now_us, **fields}


def _dive(vehicle: int, row: DiveRow) -> dict[str, Any]:
    fields = row._asdict()
    begin, end = fields.pop("t_begin"), fields.pop("t_end")
    end_us = None if end is None else microseconds(end)
    return {"vehicle_id": vehicle, "t_begin_us": microseconds(begin), "t_end_us": end_us, **fields}


def _ctd(vehicle: int, row: CtdRow) -> dict[str, Any]:
    fields = row._asdict()
    return {"vehicle_id": vehicle, "t_us": microseconds(fields.pop("t")), **fields}
