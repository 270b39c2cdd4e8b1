"""The archive of the shore station: a month of 1 Hz data, of which any range is drawn."""

import math
import tempfile
from itertools import product
from pathlib import Path

from sqlalchemy import ColumnElement, Connection, Table, literal, select, text

from figures.registry import Measurement, figure
from figures.timing import seconds
from stommel.archive import Archive, Batch
from stommel.archive.cells import LEVELS
from stommel.archive.schema import channels, samples

DAY = 86400
DAYS = 30
CHANNELS = 4
POINTS = 2000
BEGIN = 19_675 * DAY
"""A midnight [s since 1970]."""
SPANS = (60.0, 3600.0, 6 * 3600.0, 20.8 * 3600, 40 * 3600.0, 3.0 * DAY, 8.6 * DAY, 29.9 * DAY, 30.0 * DAY)
PLACES = (0.0, 0.31, 0.77, 1.0)
METHODS = ("minmax", "lttb")
REPEATS = 3


@figure(unit="ms", bar=200.0)
def station_month_query_ms() -> Measurement:
    """Measure the slowest of many ranges of a month at 1 Hz, reduced to 2000 points [ms]."""
    with (
        tempfile.TemporaryDirectory() as folder,
        Archive.open(str(Path(folder) / "month.sqlite")) as archive,
    ):
        _fill(archive)
        slowest: dict[str, float] = {}
        for span, place, method in product(SPANS, PLACES, METHODS):
            begin = BEGIN + place * (DAYS * DAY - span)
            end = begin + span
            taken = seconds(lambda b=begin, e=end, m=method: archive.series(1, "depth_m", b, e, POINTS, m), REPEATS)
            name = f"{method} of {span / 3600:g} h"
            slowest[name] = max(slowest.get(name, 0.0), min(taken) * 1e3)
        whole = archive.series(1, "depth_m", BEGIN, BEGIN + DAYS * DAY, POINTS)
    return Measurement(max(slowest.values()), {"slowest_ms": slowest, "samples": whole.samples, "channels": CHANNELS})


def _fill(archive: Archive) -> None:
    """Store one day as a vehicle's, and copy it to the other days and channels."""
    values = [40 + 40 * math.sin(t / 1800) + math.sin(t / 7) for t in range(DAY)]
    archive.store(1, Batch(samples=[("depth_m", BEGIN + t, value) for t, value in enumerate(values)]))
    with archive.writing() as connection:
        first = connection.execute(select(channels.c.id)).scalar_one()
        for number in range(1, DAYS):
            _copy(connection, first, first, number)
        for channel in range(first + 1, first + CHANNELS):
            connection.execute(channels.insert().values(id=channel, key=f"channel_{channel}"))
            for number in range(DAYS):
                _copy(connection, first, channel, number)
    with archive.reading() as connection:
        assert connection.execute(text("SELECT count(*) FROM samples")).scalar_one() == CHANNELS * DAYS * DAY


def _copy(connection: Connection, first: int, channel: int, days: int) -> None:
    """Copy the first day of a channel to a later one."""
    _copy_table(connection, samples, first, channel, days * DAY * 1_000_000, 1_000_000 * DAY)
    for level in LEVELS:
        width = DAY * 1_000_000 // level.width_us
        _copy_table(connection, level.table, first, channel, days * width, width)


def _copy_table(connection: Connection, table: Table, first: int, channel: int, later: int, day: int) -> None:
    chosen: list[ColumnElement[object]] = list(table.columns)
    for place, column in enumerate(table.columns):
        if column.name == "channel_id":
            chosen[place] = literal(channel)
        elif column is table.c[2]:
            chosen[place] = column + later
        elif column.name.endswith("_us"):
            chosen[place] = column + later * (1_000_000 * DAY // day)
    begin = BEGIN // DAY * day
    days = table.c[2].between(begin, begin + day - 1)
    query = select(*chosen).where(table.c.channel_id == first, days).order_by(table.c[2])
    connection.execute(table.insert().from_select([column.name for column in table.columns], query))
