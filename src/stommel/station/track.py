"""Where a vehicle was: its positions over time, as many as a map can show."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from sqlalchemy import select

from stommel.archive import Archive
from stommel.archive.schema import channels, samples
from stommel.archive.times import seconds

AT_ONCE = 500
"""Times that are looked up by one query."""
FRESH_FIX = 15.0
"""A position is by GPS if its fix is no older [s]."""
SOON = 60.0
"""How much older than a position its accuracy may be [s]."""

_Times = NDArray[np.float64]


class Track(NamedTuple):
    """Positions in the order of time [s since 1970]."""

    t: list[float]
    latitude: list[float]
    """[deg]"""
    longitude: list[float]
    """[deg]"""
    sigma_m: list[float | None]
    source: list[str]
    """`gps` or `estimate`."""


def read_track(archive: Archive, vehicle: int, begin: float, end: float, points: int) -> Track:
    """Read the positions of a vehicle in a range [s since 1970], about as many as are wanted.

    Those are kept that the shape of latitude or of longitude over time needs.

    Raises
    ------
    ArchiveError
        The archive fails.
    """
    wanted = max(4, points // 2)
    times = np.unique(np.concatenate([
        _kept(archive, vehicle, key, begin, end, wanted) for key in ("latitude_deg", "longitude_deg")
    ]))  # fmt: skip
    latitude = _values_at(archive, vehicle, "latitude_deg", times)
    longitude = _values_at(archive, vehicle, "longitude_deg", times)
    both = [t for t in _micro(times) if t in latitude and t in longitude]
    at = seconds(np.array(both, dtype=np.int64))
    sigma = _before(archive, vehicle, "position_sigma_m", begin, end, at)
    age = _before(archive, vehicle, "fix_age_s", begin, end, at)
    return Track(
        [seconds(t) for t in both], [latitude[t] for t in both], [longitude[t] for t in both],
        [None if np.isnan(each) else float(each) for each in sigma],
        ["gps" if each <= FRESH_FIX else "estimate" for each in age],
    )  # fmt: skip


def _kept(archive: Archive, vehicle: int, key: str, begin: float, end: float, points: int) -> _Times:
    """Times of the samples that the shape of a channel needs."""
    found = archive.series(vehicle, key, begin, end, points, "lttb")
    times: _Times = found.t[~np.isnan(found.value)]
    return times


def _micro(times: _Times) -> list[int]:
    return [int(t) for t in np.rint(times * 1e6).astype(np.int64)]


def _values_at(archive: Archive, vehicle: int, key: str, times: _Times) -> dict[int, float]:
    """Values of a channel at exactly these times, by the times in microseconds."""
    wanted, found = _micro(times), dict[int, float]()
    with archive.reading() as connection:
        number = connection.execute(select(channels.c.id).where(channels.c.key == key)).scalar()
        for first in range(0, len(wanted), AT_ONCE):
            chosen = select(samples.c.t_us, samples.c.value).where(
                samples.c.vehicle_id == vehicle, samples.c.channel_id == number,
                samples.c.t_us.in_(wanted[first : first + AT_ONCE]),
            )  # fmt: skip
            found |= {row.t_us: row.value for row in connection.execute(chosen)}
    return found


def _before(archive: Archive, vehicle: int, key: str, begin: float, end: float, at: _Times) -> Sequence[float]:
    """Value of a channel at each time or shortly before it; not a number where there is none."""
    if not len(at):
        return []
    found = archive.series(vehicle, key, begin, end, min(20_000, max(4, 2 * len(at))), "minmax")
    known = ~np.isnan(found.value)
    t, value = found.t[known], found.value[known]
    if not len(t):
        return [float("nan")] * len(at)
    place = np.searchsorted(t, at, side="right") - 1
    usual = max(SOON, 2.0 * (end - begin) / max(1, len(t))) if found.reduced else SOON
    fits = (place >= 0) & (at - t[np.maximum(place, 0)] <= usual)
    return [float(each) for each in np.where(fits, value[np.maximum(place, 0)], np.nan)]
