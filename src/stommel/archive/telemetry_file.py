"""All samples of a vehicle as CSV: one line a sample, channel by channel."""

import csv
from collections.abc import Iterable
from datetime import UTC, datetime, timedelta
from pathlib import Path
from typing import TextIO

from stommel.archive.archive import Archive
from stommel.archive.readers import samples_between
from stommel.files.whole import whole_file

_EPOCH = datetime(1970, 1, 1, tzinfo=UTC)


def write_telemetry(archive: Archive, vehicle: int, begin: float, end: float, file: Path) -> int:
    """Write the samples from `begin` to `end` [s since 1970], whole or not at all; how many.

    Raises
    ------
    OutputError
        The file cannot be written.
    """
    with whole_file(file) as made, archive.reading() as connection, made.open("w", encoding="utf-8", newline="") as out:
        return _written(out, samples_between(connection, vehicle, begin, end))


def _written(out: TextIO, rows: Iterable[tuple[str, float, float]]) -> int:
    writer = csv.writer(out)
    writer.writerow(("time [UTC]", "channel", "value"))
    count = 0
    for key, t, value in rows:
        stamp = (_EPOCH + timedelta(microseconds=round(t * 1e6))).isoformat(timespec="milliseconds")
        writer.writerow((stamp.replace("+00:00", "Z"), key, repr(value)))
        count += 1
    return count
