"""Profiles: the way down and the way up of a dive, found in the pressure and numbered.

A profile goes from one turning point of the pressure to the next. A turning point is confirmed once the pressure has
come back from it by `least_change`, so that noise below that makes none. Of what lies between, the waits are taken
off: a profile begins when the vehicle leaves the band of `edge` about the one turning point, and ends when it comes
to the band about the other.
"""

from collections.abc import Sequence
from itertools import pairwise
from typing import NamedTuple

import numpy as np
import xarray as xr
from numpy.typing import NDArray

LEAST_CHANGE = 3.0
"""By how much the pressure comes back from a turning point [dbar]."""
EDGE = 0.5
"""Half width of the band in which the vehicle waits [dbar]."""
LONGEST_GAP = 600.0
"""Time without a sample over which nothing is joined [s]."""
DOWN, UP = 1, -1

EARLIEST, LATEST = 946_684_800.0, 4_102_444_800.0
"""Between which stamps lie that can be true: 2000 and 2100 [s since 1970]."""


class Profile(NamedTuple):
    """A profile by its samples."""

    number: int
    """From 0."""
    direction: int
    """`DOWN` or `UP`."""
    first: int
    last: int
    """Index of the first sample and of the last."""


def good_stamps(time: NDArray[np.float64]) -> NDArray[np.bool_]:
    """Tell which stamps [s since 1970] can be true; a false one says nothing about its neighbours.

    Of stamps that go back, those stay of which most stand in order (the longest rising row).
    """
    good = np.isfinite(time) & (time >= EARLIEST) & (time <= LATEST)
    candidates = np.flatnonzero(good)
    if np.all(np.diff(time[candidates]) > 0.0):
        return good
    kept = candidates[_longest_rising(time[candidates])]
    found = np.zeros_like(good)
    found[kept] = True
    return found


def _longest_rising(values: NDArray[np.float64]) -> NDArray[np.int64]:
    """Indices of the longest strictly rising subsequence (patience sorting)."""
    tails: list[float] = []
    at: list[int] = []
    before = np.full(values.size, -1, dtype=np.int64)
    for k, value in enumerate(values.tolist()):
        place = int(np.searchsorted(tails, value)) if tails and value <= tails[-1] else len(tails)
        before[k] = at[place - 1] if place else -1
        if place == len(tails):
            tails.append(value)
            at.append(k)
        else:
            tails[place], at[place] = value, k
    row = []
    k = at[-1] if at else -1
    while k >= 0:
        row.append(k)
        k = int(before[k])
    return np.array(row[::-1], dtype=np.int64)


def profiles_of(
    time: NDArray[np.float64],
    pressure: NDArray[np.float64],
    *,
    least_change: float = LEAST_CHANGE,
    edge: float = EDGE,
    longest_gap: float = LONGEST_GAP,
) -> list[Profile]:
    """Return the profiles in the order of time.

    Parameters
    ----------
    time
        [s since 1970], (N,).
    pressure
        Of the sea [dbar], (N,); what is no number is passed over.
    least_change, edge
        See the head of the module [dbar]; positive, and the edge at most half of the change.
    longest_gap
        [s].

    Raises
    ------
    ValueError
        The arrays are not of one length, or a threshold is impossible.
    """
    ways = ways_of(time, pressure, least_change=least_change, edge=edge, longest_gap=longest_gap)
    return [way.profile for way in ways]


class Way(NamedTuple):
    """A profile and the turning points about it."""

    profile: Profile
    turned: int
    """Index of the turning point at which its way begins: detection that begins anew there finds the same."""
    is_settled: bool
    """Whether no later sample can change it."""


def ways_of(
    time: NDArray[np.float64],
    pressure: NDArray[np.float64],
    *,
    least_change: float = LEAST_CHANGE,
    edge: float = EDGE,
    longest_gap: float = LONGEST_GAP,
) -> list[Way]:
    """Return the profiles with what is needed to go on from them when more samples come; as `profiles_of`."""
    if time.shape != pressure.shape or time.ndim != 1:
        raise ValueError(f"time {time.shape} and pressure {pressure.shape} must be of one length")
    if not (0.0 < 2.0 * edge <= least_change and longest_gap > 0.0):
        raise ValueError(f"edge = {edge:g}, least_change = {least_change:g}: 0 < 2 edge <= least_change is wanted")
    used = np.flatnonzero(good_stamps(time) & np.isfinite(pressure))
    parts = np.split(used, np.flatnonzero(np.diff(time[used]) > longest_gap) + 1)
    found: list[Way] = []
    for part in parts:
        turns = turning_points(pressure[part], least_change)
        ends = turns[-1:] if part is parts[-1] else []  # the last turning point of all may still move
        for turned, end, first, last in _between_turns(pressure[part], turns, edge):
            direction = DOWN if pressure[part[last]] > pressure[part[first]] else UP
            profile = Profile(len(found), direction, int(part[first]), int(part[last]))
            found.append(Way(profile, int(part[turned]), end not in ends))
    return found


def _between_turns(p: NDArray[np.float64], turns: list[int], edge: float) -> list[tuple[int, int, int, int]]:
    """Both turning points of each way from one to the next, and its first and last sample."""
    found = []
    for begin, end in pairwise(turns):
        way = p[begin : end + 1]
        leaves = np.flatnonzero(np.abs(way - way[0]) <= edge)[-1]
        comes = leaves + np.flatnonzero(np.abs(way[leaves:] - way[-1]) <= edge)[0]
        if comes > leaves:
            found.append((begin, end, begin + int(leaves), begin + int(comes)))
    return found


def turning_points(p: NDArray[np.float64], least_change: float) -> list[int]:
    """Indices of the turning points of a series, its ends among them.

    From one to the next the series changes by at least `least_change`; nowhere between does it come back by so much.
    """
    steps = np.sign(np.diff(p))
    moves = np.flatnonzero(steps)
    bends = moves[1:][steps[moves[1:]] != steps[moves[:-1]]]  # only where it bends can it turn
    turns: list[int] = []
    low = high = way = 0
    for k in [0, *bends.tolist(), p.size - 1] if p.size else []:
        low, high = (k if p[k] < p[low] else low), (k if p[k] > p[high] else high)
        if way <= 0 and p[k] - p[low] >= least_change:
            turns.append(low)
            way, high = 1, k
        elif way >= 0 and p[high] - p[k] >= least_change:
            turns.append(high)
            way, low = -1, k
    if way:
        turns.append(high if way > 0 else low)
    return turns


def with_profiles(
    samples: xr.Dataset,
    *,
    least_change: float = LEAST_CHANGE,
    edge: float = EDGE,
    longest_gap: float = LONGEST_GAP,
) -> xr.Dataset:
    """Return the samples with `profile_number` (from 1; 0 for none) and `profile_direction` (1 down, -1 up, 0 none).

    Parameters
    ----------
    samples
        `time` [s since 1970, or datetime64] and `pressure` [dbar] along one dimension.
    """
    pressure = samples["pressure"]
    time = seconds(samples["time"].values)
    number = np.zeros(time.size, dtype=np.int32)
    direction = np.zeros(time.size, dtype=np.int8)
    good = good_stamps(time)
    found = profiles_of(
        time, pressure.values.astype(np.float64), least_change=least_change, edge=edge, longest_gap=longest_gap
    )
    for profile in found:
        inside = slice(profile.first, profile.last + 1)
        number[inside] = np.where(good[inside], profile.number + 1, 0)
        direction[inside] = np.where(good[inside], profile.direction, 0)
    return _numbered(samples, number, direction)


def _numbered(samples: xr.Dataset, number: NDArray[np.int32], direction: NDArray[np.int8]) -> xr.Dataset:
    dims = samples["time"].dims
    about = {"long_name": "number of the profile, from 1; 0 between profiles"}
    flags = {
        "long_name": "way of the profile",
        "flag_values": np.array([UP, 0, DOWN], dtype=np.int8),
        "flag_meanings": "up none down",
    }
    return samples.assign(profile_number=(dims, number, about), profile_direction=(dims, direction, flags))


def seconds(time: NDArray[np.generic]) -> NDArray[np.float64]:
    """Time as seconds since 1970, whether it was that or datetime64; what is no time is not a number."""
    if not np.issubdtype(time.dtype, np.datetime64):
        return time.astype(np.float64)
    found: NDArray[np.float64] = time.astype("datetime64[ns]").astype(np.int64) / 1e9
    return np.where(np.isnat(time), np.nan, found)


def with_numbers(samples: xr.Dataset, profiles: Sequence[tuple[int, int, float, float]]) -> xr.Dataset:
    """Return samples as `with_profiles` does, with profiles that are known already.

    Parameters
    ----------
    samples
        `time` [s since 1970] along one dimension, in order.
    profiles
        Number, direction, and times of the first and the last sample [s since 1970], in order; those that lie outside
        of the samples do no harm.
    """
    time = seconds(samples["time"].values)
    number = np.zeros(time.size, dtype=np.int32)
    direction = np.zeros(time.size, dtype=np.int8)
    for count, way, begin, end in profiles:
        inside = slice(int(np.searchsorted(time, begin)), int(np.searchsorted(time, end, "right")))
        number[inside], direction[inside] = count, way
    return _numbered(samples, number, direction)
