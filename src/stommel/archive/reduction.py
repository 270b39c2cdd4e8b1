"""Fewer points that draw the same curve: pure functions on arrays of time [us] and value."""

from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

GAP_PERIODS = 5
"""Samples further apart than this many periods have a gap between them."""

Times = NDArray[np.int64]
Values = NDArray[np.float64]
Places = NDArray[np.intp]


@dataclass(frozen=True)
class Curve:
    """Points in order of time, of which each is a sample, and what they stand for."""

    t_us: Times
    value: Values
    samples: int
    """How many samples they stand for."""
    period_us: float
    """Usual time between these; 0 if nobody can tell."""


def gaps_of(t_us: Times, shortest_us: float) -> Places:
    """Places of the points that come after a gap, longer than `shortest_us`."""
    return np.flatnonzero(np.diff(t_us) > shortest_us) + 1


def low_and_high(curve: Curve, width_us: int, gaps: Places) -> Places:
    """Places of the lowest and highest point of each bucket, of the points beside gaps, and of both ends.

    Buckets are `width_us` wide and counted since 1970, so that they stay where they are when a plot is moved.
    """
    bucket = curve.t_us // width_us
    starts = np.flatnonzero(np.diff(bucket, prepend=bucket[0] - 1))
    index = np.repeat(np.arange(len(starts)), np.diff(starts, append=len(bucket)))
    extremes = [
        _first_where(curve.value == reduced.reduceat(curve.value, starts)[index], index)
        for reduced in (np.minimum, np.maximum)
    ]
    return np.unique(np.concatenate([*extremes, _edges(curve, gaps)]))


def largest_triangles(curve: Curve, points: int, gaps: Places) -> Places:
    """Places of about `points` points that keep the shape (LTTB), of the points beside gaps, and of both ends."""
    from tsdownsample import LTTBDownsampler  # noqa: PLC0415 - takes time, and few ask for it

    lttb: Any = LTTBDownsampler
    found: Places = lttb().downsample(curve.t_us, curve.value, n_out=points)
    return np.unique(np.concatenate([found.astype(np.intp), _edges(curve, gaps)]))


def unwound(curve: Curve, turn: float) -> Curve:
    """The curve without jumps where values begin anew after a turn: 359 and 1 deg are two apart."""
    return replace(curve, value=np.unwrap(curve.value, period=turn))


def with_gaps(curve: Curve, kept: Places, gaps: Places) -> tuple[Times, Values]:
    """The kept points, and a value that is NaN in the middle of each gap."""
    t_us, value = curve.t_us[kept], curve.value[kept]
    before = np.searchsorted(kept, gaps)
    middle = (curve.t_us[gaps - 1] + curve.t_us[gaps]) // 2
    return np.insert(t_us, before, middle), np.insert(value, before, np.nan)


def _edges(curve: Curve, gaps: Places) -> Places:
    return np.concatenate([gaps - 1, gaps, np.array([0, len(curve.t_us) - 1])])


def _first_where(true: NDArray[np.bool_], index: Places) -> Places:
    """Place of the first true of each index."""
    places = np.flatnonzero(true)
    _, first = np.unique(index[places], return_index=True)
    return places[first]
