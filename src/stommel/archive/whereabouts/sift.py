"""Which of the positions that a vehicle told it can have been at; pure functions on arrays.

0, 0 is what a receiver tells that knows nothing. A step that is faster than any glider swims leads from one course to
another; courses that do not last, and detours from a longer one, were never sailed.
"""

from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from stommel.geometry.earth import MEAN_RADIUS

FASTEST = 5.0
"""That a glider comes over ground, with the stream [m/s]."""
CERTAIN = 4.0
"""A position is surely nearer to the truth than so many of its standard deviations."""
ANYWAY = 100.0
"""Off which no position is surprising [m]."""
SIGMA = 300.0
"""Standard deviation of a position of which none was told [m]."""
NOWHERE = 1e-5
"""Latitude and longitude that are both nearer to 0 are no position [deg]."""
LASTS, LEAST = 120.0, 3
"""A course is believed that goes on for so long [s] with so many positions, also where it begins with a leap."""
MOST_COURSES = 8
"""That are followed at once."""

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]


class Places(NamedTuple):
    """Positions in the order of time, one array each."""

    t: Array
    """[s since 1970]"""
    latitude: Array
    """[deg]"""
    longitude: Array
    """[deg]"""
    sigma: Array
    """Standard deviation [m]; not a number where none was told."""

    def of(self, chosen: NDArray[np.intp] | Mask) -> "Places":
        """Some of them."""
        return Places(*(values[chosen] for values in self))


@dataclass
class _Course:
    """Stretches of positions, each of which can be reached from the one before it."""

    points: int = 0
    lasts: bool = False
    stretches: list[tuple[int, int]] = field(default_factory=list)

    @property
    def first(self) -> int:
        return self.stretches[0][0]

    @property
    def last(self) -> int:
        return self.stretches[-1][1]

    @property
    def worth(self) -> tuple[bool, int]:
        return self.lasts, self.points

    def holds(self, other: "_Course") -> bool:
        """Whether another, shorter one is a detour of this one."""
        return self.points > other.points and self.first < other.first and other.last < self.last


def is_nowhere(latitude: Array, longitude: Array) -> Mask:
    """Whether positions [deg] are none: 0, 0, beyond the poles, or not numbers."""
    zero = (np.abs(latitude) < NOWHERE) & (np.abs(longitude) < NOWHERE)
    found: Mask = zero | ~(np.abs(latitude) <= 90.0) | ~(np.abs(longitude) <= 180.0)
    return found


def believed(places: Places) -> Mask:
    """Which of the positions a vehicle can have been at.

    A leap that stays is believed on both sides: it is a correction, or a vehicle that was carried. Where no course
    lasts, as at the first contact, that of the most positions is believed.
    """
    found = np.zeros(len(places.t), dtype=np.bool_)
    somewhere = np.flatnonzero(~is_nowhere(places.latitude, places.longitude))
    known = places.of(somewhere)
    for course in _sailed(_courses(known)):
        for first, last in course.stretches:
            found[somewhere[first : last + 1]] = True
    return found


def metres_apart(latitude: Array, longitude: Array, to_latitude: Array, to_longitude: Array) -> Array:
    """Distances between positions [deg] on the sphere [m]."""
    phi, other = np.radians(latitude), np.radians(to_latitude)
    half = np.sin((other - phi) / 2.0) ** 2
    half = half + np.cos(phi) * np.cos(other) * np.sin(np.radians(to_longitude - longitude) / 2.0) ** 2
    found: Array = 2.0 * MEAN_RADIUS * np.arcsin(np.sqrt(np.minimum(half, 1.0)))
    return found


def _reached(places: Places, start: NDArray[np.intp], end: NDArray[np.intp]) -> Mask:
    """Whether a vehicle can have come from one position to another."""
    a, b = places.of(start), places.of(end)
    doubt = ANYWAY + CERTAIN * (np.nan_to_num(a.sigma, nan=SIGMA) + np.nan_to_num(b.sigma, nan=SIGMA))
    far = metres_apart(a.latitude, a.longitude, b.latitude, b.longitude)
    found: Mask = far <= FASTEST * (b.t - a.t) + doubt
    return found


def _courses(places: Places) -> list[_Course]:
    """Positions in courses; each stretch goes on with the best course from which it can be reached."""
    if not len(places.t):
        return []
    steps = np.arange(len(places.t) - 1)
    begins = np.concatenate([[0], np.flatnonzero(~_reached(places, steps, steps + 1)) + 1, [len(places.t)]])
    every: list[_Course] = []
    open_: list[_Course] = []
    for first, after in zip(begins[:-1].tolist(), begins[1:].tolist(), strict=True):
        lasts = [course.last for course in open_]
        can = _reached(places, np.array(lasts, dtype=np.intp), np.full(len(lasts), first))
        fitting = [course for course, reached in zip(open_, can.tolist(), strict=True) if reached]
        if not fitting:
            if len(open_) == MOST_COURSES:
                open_.remove(min(open_, key=lambda course: course.worth))
            fitting = [_Course()]
            every += fitting
            open_ += fitting
        course = max(fitting, key=lambda course: course.worth)
        course.stretches.append((first, after - 1))
        course.points += after - first
        course.lasts |= after - first >= LEAST and places.t[after - 1] - places.t[first] >= LASTS
    return every


def _sailed(courses: list[_Course]) -> list[_Course]:
    lasting = [course for course in courses if course.lasts]
    if not lasting:
        return sorted(courses, key=lambda course: -course.points)[:1]
    return [course for course in lasting if not any(other.holds(course) for other in lasting)]
