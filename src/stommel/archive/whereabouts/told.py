"""The positions that a vehicle told in a stretch of time: all, or, of a long stretch, the ends of its cells."""

from typing import Any

import numpy as np
from numpy.typing import NDArray
from sqlalchemy import Connection, func, select

from stommel.archive.archive import Archive
from stommel.archive.cells import LEVELS, Level
from stommel.archive.schema import channels, samples
from stommel.archive.times import MINUTE_US, microseconds, seconds
from stommel.archive.whereabouts.sift import Places

KEYS = "latitude_deg", "longitude_deg"
MOST_SAMPLES = 20_000
"""That are read as they are; of more, the first and the last of each cell."""
MOST_MINUTES = 6000
"""A longer stretch is read by tens of minutes."""
SOON = 60.0
"""How much older than a position its accuracy may be [s]."""
_MOST_POINTS = 20_000

Times = NDArray[np.int64]
Values = NDArray[np.float64]


def told_places(archive: Archive, vehicle: int, begin: float, end: float, level: Level | None = None) -> Places:
    """Positions that a vehicle told in a range of time [s since 1970], both ends among it.

    Parameters
    ----------
    archive, vehicle
        Whose.
    begin, end
        The range.
    level
        Whose cells' ends are read; if left out, it is as fine as the range allows.

    Raises
    ------
    ArchiveError
        The archive fails.
    """
    begin_us, end_us = microseconds(begin), microseconds(end)
    with archive.reading() as connection:
        rows = {
            key: _points(connection, vehicle, number, begin_us, end_us, level)
            for key, number in _numbers(connection).items()
        }
    if len(rows) < len(KEYS):
        return Places(*(np.empty(0) for _ in Places._fields))
    (latitude_t, latitude), (longitude_t, longitude) = (rows[key] for key in KEYS)
    both, at, also = np.intersect1d(latitude_t, longitude_t, assume_unique=True, return_indices=True)
    t = seconds(both)
    sigma = value_before(archive, vehicle, "position_sigma_m", begin, end, t)
    return Places(t, latitude[at], longitude[also], sigma)


def end_of_told(archive: Archive, vehicle: int, until: float) -> tuple[float, float] | None:
    """When a vehicle told its first and its last position until a time [s since 1970]; None where it told none."""
    of = samples.c
    with archive.reading() as connection:
        number = _numbers(connection).get(KEYS[0])
        mine = (of.vehicle_id == vehicle, of.channel_id == number, of.t_us <= microseconds(until))
        first, last = (connection.execute(select(end(of.t_us)).where(*mine)).scalar() for end in (func.min, func.max))
    return None if first is None or last is None else (seconds(first), seconds(last))


def value_before(archive: Archive, vehicle: int, key: str, begin: float, end: float, at: Values) -> Values:
    """Value of a channel at each time or shortly before it; not a number where there is none."""
    if not len(at):
        return np.empty(0)
    found = archive.series(vehicle, key, begin, end, min(_MOST_POINTS, max(4, 2 * len(at))), "minmax")
    known = ~np.isnan(found.value)
    t, value = found.t[known], found.value[known]
    if not len(t):
        return np.full(len(at), np.nan)
    place = np.searchsorted(t, at, side="right") - 1
    usual = max(SOON, 2.0 * (end - begin) / max(1, len(t))) if found.reduced else SOON
    fits = (place >= 0) & (at - t[np.maximum(place, 0)] <= usual)
    return np.where(fits, value[np.maximum(place, 0)], np.nan)


def _numbers(connection: Connection) -> dict[str, int]:
    query = select(channels.c.key, channels.c.id).where(channels.c.key.in_(KEYS))
    return {row.key: row.id for row in connection.execute(query)}


def _points(
    connection: Connection, vehicle: int, channel: int, begin_us: int, end_us: int, level: Level | None
) -> tuple[Times, Values]:
    """Samples of a channel, or the first and the last of each cell, with samples at the range's ends."""
    level = _level(connection, vehicle, channel, begin_us, end_us) if level is None else level
    if level is None:
        return _samples(connection, vehicle, channel, begin_us, end_us)
    first, last = -(-begin_us // level.width_us), end_us // level.width_us
    parts = [
        _samples(connection, vehicle, channel, begin_us, min(first * level.width_us - 1, end_us)),
        _ends(connection, vehicle, channel, level, first, last),
        _samples(connection, vehicle, channel, max(last, first) * level.width_us, end_us),
    ]
    return np.concatenate([t for t, _ in parts]), np.concatenate([value for _, value in parts])


def _level(connection: Connection, vehicle: int, channel: int, begin_us: int, end_us: int) -> Level | None:
    of = LEVELS[0].table.c
    query = select(func.count(), func.coalesce(func.sum(of.count), 0)).where(
        of.vehicle_id == vehicle, of.channel_id == channel,
        of.minute.between(begin_us // MINUTE_US, end_us // MINUTE_US),
    )  # fmt: skip
    minutes, held = connection.execute(query).one()
    if held <= MOST_SAMPLES:
        return None
    return LEVELS[0] if minutes <= MOST_MINUTES else LEVELS[1]


def _samples(connection: Connection, vehicle: int, channel: int, begin_us: int, end_us: int) -> tuple[Times, Values]:
    of = samples.c
    query = (
        select(of.t_us, of.value)
        .where(of.vehicle_id == vehicle, of.channel_id == channel, of.t_us.between(begin_us, end_us))
        .order_by(of.t_us)
    )
    return _table(connection.execute(query).cursor)


def _ends(
    connection: Connection, vehicle: int, channel: int, level: Level, first: int, last: int
) -> tuple[Times, Values]:
    """First and last of each cell from one to before another."""
    of = level.table.c
    query = (
        select(of.first_t_us, of.first, of.last_t_us, of.last)
        .where(of.vehicle_id == vehicle, of.channel_id == channel, of[2] >= first, of[2] < last)
        .order_by(of[2])
    )
    return _table(connection.execute(query).cursor)


def _table(cursor: Any) -> tuple[Times, Values]:
    """Pairs of time and value, straight from the driver; one that is told twice once."""
    flat = np.fromiter((number for row in cursor for number in row), np.float64).reshape(-1, 2)
    times, places = np.unique(flat[:, 0].astype(np.int64), return_index=True)
    return times, flat[places, 1]
