"""The samples of a channel in a window, reduced to what a plot can show."""

from dataclasses import dataclass
from math import ceil, isfinite
from typing import Literal, NamedTuple, get_args

import numpy as np
from numpy.typing import NDArray

from stommel.archive.cells import LEVELS
from stommel.archive.curves import ChannelReader
from stommel.archive.errors import ArchiveRequestError
from stommel.archive.reduction import (
    GAP_PERIODS,
    Curve,
    Places,
    gaps_of,
    largest_triangles,
    low_and_high,
    unwound,
    with_gaps,
)
from stommel.archive.times import microseconds, seconds

Method = Literal["minmax", "lttb", "raw"]

FEWEST_POINTS, MOST_POINTS = 4, 20_000
MOST_RAW = 2_000_000
"""Samples that one answer gives unreduced."""
LONGEST_PERIOD = 366 * 86400.0
"""Of a channel [s]."""

_READ_AT_ONCE = 80_000
"""Samples that are read to draw a window finely; of more, the minutes are."""
_FEWEST_MINUTES = 120
"""A window of fewer minutes is drawn from the samples anyway."""


class Series(NamedTuple):
    """What to draw: seconds since 1970, and values that are NaN in the middle of gaps."""

    t: NDArray[np.float64]
    value: NDArray[np.float64]
    samples: int
    """How many samples the window holds."""
    reduced: bool
    """Whether some of them were left out."""


@dataclass(frozen=True)
class Window:
    """What is asked: the samples from `begin_us` to `end_us`, both among them, in about `points` points."""

    begin_us: int
    end_us: int
    points: int
    method: Method
    period_us: float | None
    turn: float | None = None
    """After which values begin anew, as of a heading."""

    @property
    def width_us(self) -> int:
        """Of a bucket, of which two points are shown."""
        return ceil((self.end_us - self.begin_us + 1) / (self.points // 2))


def window_of(
    begin: float, end: float, points: int, method: str, period: float | None, turn: float | None = None
) -> Window:
    """The window that somebody asks for, in seconds.

    Raises
    ------
    ArchiveRequestError
        One of the values is none that is allowed.
    """
    begin_us, end_us = microseconds(begin), microseconds(end)
    if begin_us > end_us:
        raise ArchiveRequestError(f"a range from {begin:.3f} to {end:.3f} s ends before it begins")
    if not FEWEST_POINTS <= points <= MOST_POINTS:
        raise ArchiveRequestError(f"{points} points of a series; allowed are {FEWEST_POINTS} to {MOST_POINTS}")
    if method not in get_args(Method):
        raise ArchiveRequestError(f"no such reduction: {method!r}; allowed are {', '.join(get_args(Method))}")
    if period is not None and not (isfinite(period) and 0.0 < period <= LONGEST_PERIOD):
        raise ArchiveRequestError(f"a period of {period!r} s; allowed is more than 0, to {LONGEST_PERIOD:.0f}")
    period_us = None if period is None else period * 1e6
    return Window(begin_us, end_us, points, method, period_us, turn)  # type: ignore[arg-type]


def read_series(reader: ChannelReader, window: Window) -> Series:
    """The samples of a window as it is asked, with gaps as NaN.

    A gap is longer than `GAP_PERIODS` periods, and than one bucket if the samples were reduced: a shorter one could
    not be seen. Points beside gaps are kept, so at most `points` and three more for each gap are given, and both ends.
    Each point is a sample, and the lowest and highest of each bucket are there: of values that begin anew after a turn,
    those where it is furthest to either side. A cell knows no more of them than its ends where they begin anew in it.

    Raises
    ------
    ArchiveRequestError
        More than `MOST_RAW` samples are wanted unreduced.
    """
    if window.method == "raw":
        return _whole(reader, window)
    level, width_us = _level(reader, window)
    curve = reader.curve(window.begin_us, window.end_us + 1, LEVELS[:level])
    if curve.samples <= window.points:
        return _whole(reader, window) if level else _unreduced(curve, window)
    gaps = gaps_of(curve.t_us, max(_shortest_gap(curve, window), width_us))
    shape = curve if window.turn is None else unwound(curve, window.turn)
    if window.method == "lttb":
        return _series(curve, largest_triangles(shape, window.points, gaps), gaps)
    return _series(curve, low_and_high(shape, width_us, gaps), gaps)


def _level(reader: ChannelReader, window: Window) -> tuple[int, int]:
    """How many levels of cells to use, and the width of buckets, of which each holds whole cells.

    A bucket of less than a cell and a quarter would have to grow too much to hold whole ones.
    """
    level = sum(4 * window.width_us >= 5 * level.width_us for level in LEVELS)
    if level == 0 and _is_fine(reader, window):
        return 0, window.width_us
    level = max(level, 1)
    cell_us = LEVELS[level - 1].width_us
    return level, cell_us * ceil(window.width_us / cell_us)


def _is_fine(reader: ChannelReader, window: Window) -> bool:
    """Whether the samples themselves are read for a window whose buckets are short."""
    minutes, samples = reader.size(window.begin_us, window.end_us, LEVELS[0])
    return samples <= (MOST_RAW if minutes < _FEWEST_MINUTES else _READ_AT_ONCE)


def _whole(reader: ChannelReader, window: Window) -> Series:
    _, count = reader.size(window.begin_us, window.end_us, LEVELS[0])
    if count > MOST_RAW:
        raise ArchiveRequestError(
            f"{reader.key}: {count} samples are in this range; at most {MOST_RAW} are given at once: ask for a shorter"
            " range, or for fewer points"
        )
    return _unreduced(reader.curve(window.begin_us, window.end_us + 1, ()), window)


def _unreduced(curve: Curve, window: Window) -> Series:
    return _series(curve, np.arange(len(curve.t_us)), gaps_of(curve.t_us, _shortest_gap(curve, window)))


def _series(curve: Curve, kept: Places, gaps: Places) -> Series:
    t_us, value = with_gaps(curve, kept, gaps)
    return Series(seconds(t_us), value, curve.samples, len(kept) < curve.samples)


def _shortest_gap(curve: Curve, window: Window) -> float:
    period_us = curve.period_us if window.period_us is None else window.period_us
    return GAP_PERIODS * period_us if period_us > 0 else np.inf
