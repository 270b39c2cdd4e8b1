"""Where a vehicle is: the last position that it told and at which it can have been."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from stommel.archive import Archive
from stommel.archive.whereabouts.sift import Places, believed, is_nowhere
from stommel.archive.whereabouts.told import KEYS, SOON, end_of_told, told_places, value_before
from stommel.archive.whereabouts.track import source_of

LOOK_BACK = 2 * 3600.0
"""Before the last position, of what is looked at again after a restart [s]."""
MOST = 1500
"""Positions that are kept to tell which can be true."""
LATITUDE, LONGITUDE = KEYS
SIGMA, AGE = "position_sigma_m", "fix_age_s"

Sample = tuple[str, float, float]


class Told(NamedTuple):
    """A position as it was told."""

    t: float
    """[s since 1970]"""
    latitude: float
    longitude: float
    sigma: float
    """Standard deviation [m]; not a number where none was told."""
    fix_age: float
    """Since the last fix [s]; not a number where that was not told."""


class Whereabouts:
    """Watches samples of one vehicle; times by its clock [s since 1970]."""

    def __init__(self) -> None:
        self._told: tuple[Told, ...] = ()
        self._half: dict[str, tuple[float, float]] = {}
        """Last value of each channel, and when."""

    def take(self, samples: Sequence[Sample]) -> None:
        """Take samples in the order in which they came."""
        new: list[Told] = []
        for key, t, value in samples:
            if key not in (LATITUDE, LONGITUDE, SIGMA, AGE):
                continue
            self._half[key] = t, value
            other = self._half.get(LONGITUDE if key == LATITUDE else LATITUDE, (np.nan, 0.0))
            if key in KEYS and other[0] == t:
                new.append(Told(t, self._half[LATITUDE][1], self._half[LONGITUDE][1], self._of(SIGMA, t),
                                self._of(AGE, t)))  # fmt: skip
        for told in new:
            before = self._told
            if before and told.t <= before[-1].t:  # the clock was set back
                before = tuple(each for each in before if each.t < told.t)
            self._told = (*before[1 - MOST :], told)

    def restore(self, archive: Archive, vehicle: int, until: float) -> None:
        """Look again at what the archive has of the last hours before a time, so that a restart forgets nothing.

        Raises
        ------
        ArchiveError
            The archive fails.
        """
        ends = end_of_told(archive, vehicle, until)
        if ends is None:
            return
        begin, end = max(0.0, ends[1] - LOOK_BACK), ends[1]
        places = told_places(archive, vehicle, begin, end)
        age = value_before(archive, vehicle, AGE, begin, end, places.t)
        rows = zip(*(values.tolist() for values in (*places, age)), strict=True)
        self._told = tuple(Told(*row) for row in rows)[-MOST:]

    def last(self) -> tuple[Told | None, str]:
        """The last position that can be true, and why later ones are not believed, in words; empty if none are."""
        told = self._told
        if not told:
            return None, ""
        table = np.array(told, dtype=np.float64).T
        places = Places(*table[:4])
        found = np.flatnonzero(believed(places))
        newest = told[-1]
        if found.size and found[-1] == len(told) - 1:
            return newest, ""
        nowhere = bool(is_nowhere(places.latitude[-1:], places.longitude[-1:])[0])
        why = "is what a receiver tells without a fix" if nowhere else "is farther than the vehicle can have come"
        words = f"{newest.latitude:.3f}, {newest.longitude:.3f} was told since, which {why}"
        return (told[found[-1]] if found.size else None), words

    def _of(self, key: str, t: float) -> float:
        at, value = self._half.get(key, (-np.inf, np.nan))
        return value if abs(t - at) <= SOON else np.nan


def position_of(found: tuple[Told | None, str]) -> dict[str, object] | None:
    """A position as a summary tells it."""
    told, doubt = found
    if told is None:
        return None
    return {
        "latitude": told.latitude, "longitude": told.longitude, "t": told.t,
        "sigma_m": None if np.isnan(told.sigma) else told.sigma, "source": source_of(told.fix_age),
        "doubt": doubt or None,
    }  # fmt: skip
