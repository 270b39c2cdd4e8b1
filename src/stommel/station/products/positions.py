"""Where a vehicle was at some times: between the first and the last position that it told in each minute."""

import numpy as np
from numpy.typing import NDArray
from sqlalchemy import select

from stommel.archive import schema
from stommel.archive.archive import Archive
from stommel.archive.times import MINUTE_US, seconds

FARTHEST = 7200.0
"""Time from a sample to a position, over which none is made up [s]."""
Array = NDArray[np.float64]
_Track = tuple[NDArray[np.int64], Array]


def positions(archive: Archive, vehicle: int, time: Array) -> tuple[Array, Array]:
    """Latitude and longitude [deg] at some times in order [s since 1970].

    Where the next told position is more than `FARTHEST` away in time there is none.
    """
    if not time.size:
        return np.empty(0), np.empty(0)
    begin, end = float(time[0]) - FARTHEST, float(time[-1]) + FARTHEST
    latitudes, longitudes = (_told(archive, vehicle, key, begin, end) for key in ("latitude_deg", "longitude_deg"))
    both, at, also = np.intersect1d(latitudes[0], longitudes[0], return_indices=True)
    if not both.size:
        return np.full(time.size, np.nan), np.full(time.size, np.nan)
    stamps = seconds(both)
    latitude = np.interp(time, stamps, latitudes[1][at])
    unwrapped = np.unwrap(longitudes[1][also], period=360.0)  # over the date line
    longitude = (np.interp(time, stamps, unwrapped) + 180.0) % 360.0 - 180.0
    after = np.clip(np.searchsorted(stamps, time), 0, stamps.size - 1)
    nearest = np.minimum(np.abs(stamps[after] - time), np.abs(stamps[np.maximum(after - 1, 0)] - time))
    far = nearest > FARTHEST
    return np.where(far, np.nan, latitude), np.where(far, np.nan, longitude)


def _told(archive: Archive, vehicle: int, key: str, begin: float, end: float) -> _Track:
    """Times [us] and values of a channel, two a minute: what a vehicle sails in a minute is a straight line."""
    m, n = schema.minutes.c, schema.channels.c
    span = int(begin * 1e6) // MINUTE_US, int(end * 1e6) // MINUTE_US
    with archive.reading() as connection:
        number = connection.execute(select(n.id).where(n.key == key)).scalar()
        query = select(m.first_t_us, m.first, m.last_t_us, m.last).where(
            m.vehicle_id == vehicle, m.channel_id == number, m.minute.between(*span)
        )
        rows = connection.execute(query.order_by(m.minute)).cursor.fetchall()
    table = np.array(rows, dtype=np.float64).reshape(-1, 2)  # first and last, one below the other
    times, places = np.unique(table[:, 0].astype(np.int64), return_index=True)
    return times, table[places, 1]
