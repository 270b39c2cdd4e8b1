"""Times of the archive: whole microseconds since 1970 inside, seconds outside."""

import math
from typing import overload

import numpy as np
from numpy.typing import NDArray

from stommel.archive.errors import ArchiveRequestError

GREATEST_TIME = 4102444800.0
"""The year 2100 [s since 1970]."""
MINUTE_US = 60_000_000


def microseconds(t: float) -> int:
    """A time in seconds since 1970 as the archive keeps it.

    Raises
    ------
    ArchiveRequestError
        It is no time from 1970 to 2100.
    """
    if not is_time(t):
        raise ArchiveRequestError(f"a time of {t!r} s since 1970; allowed are 0 to {GREATEST_TIME:.0f}")
    return round(t * 1e6)


@overload
def seconds(t_us: int) -> float: ...


@overload
def seconds(t_us: NDArray[np.int64]) -> NDArray[np.float64]: ...


def seconds(t_us: int | NDArray[np.int64]) -> float | NDArray[np.float64]:
    """A time of the archive, or many, in seconds since 1970.

    Nobody multiplies by 1e-6 instead: of three such times one would differ in its last digit from the same time here.
    """
    return t_us / 1e6


def as_kept(t: float) -> float:
    """A time in seconds since 1970 as it comes back out of the archive; one that is none becomes the nearest."""
    return seconds(microseconds(min(max(t, 0.0), GREATEST_TIME)))


def is_time(t: float) -> bool:
    """Whether the archive takes this as a time."""
    return math.isfinite(t) and 0.0 <= t <= GREATEST_TIME
