"""Oracles: dives that are made here, so that each profile is known; a real flight of a Slocum; properties."""

import itertools

import numpy as np
import pytest
import xarray as xr
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray

from stommel.data.profiles import DOWN, UP, good_stamps, profiles_of, turning_points, with_profiles
from tests.support.shared_data import shared_data

BEGIN = 1_782_864_000.0
"""2026-07-01."""


def sawtooth(depths: list[float], rate: float = 0.2, wait: int = 0) -> NDArray[np.float64]:
    """Pressures at 1 Hz from one depth to the next, with waits at each."""
    parts = [np.full(wait + 1, depths[0])]
    for low, high in itertools.pairwise(depths):
        steps = max(2, int(abs(high - low) / rate))
        parts += [np.linspace(low, high, steps + 1)[1:], np.full(wait, high)]
    return np.concatenate(parts)


def seconds_of(p: NDArray[np.float64]) -> NDArray[np.float64]:
    return BEGIN + np.arange(p.size, dtype=np.float64)


@pytest.mark.parametrize("wait", [0, 30, 400])
def test_each_way_of_two_dives_is_a_profile(wait: int) -> None:
    p = sawtooth([0.0, 60.0, 0.0, 80.0, 0.0], wait=wait)
    found = profiles_of(seconds_of(p), p)
    assert [profile.direction for profile in found] == [DOWN, UP, DOWN, UP]
    assert [profile.number for profile in found] == [0, 1, 2, 3]
    for profile, (top, bottom) in zip(found, [(0, 60), (60, 0), (0, 80), (80, 0)], strict=True):
        assert p[profile.first] == pytest.approx(top, abs=0.5)
        assert p[profile.last] == pytest.approx(bottom, abs=0.5)


def test_waits_belong_to_no_profile() -> None:
    p = sawtooth([0.0, 60.0, 0.0], wait=300)
    for profile in profiles_of(seconds_of(p), p):
        inside = p[profile.first + 3 : profile.last - 2]
        assert ((inside > 0.5) & (inside < 59.5)).all()


def test_several_turns_under_water_are_profiles_of_one_dive() -> None:
    p = sawtooth([0.0, 60.0, 20.0, 60.0, 0.0])
    assert [profile.direction for profile in profiles_of(seconds_of(p), p)] == [DOWN, UP, DOWN, UP]


def test_noise_makes_no_profile() -> None:
    p = sawtooth([0.0, 60.0, 0.0, 80.0, 0.0], wait=200)
    noisy = p + np.random.default_rng(1).normal(0.0, 0.1, p.size)
    found = profiles_of(seconds_of(p), noisy)
    assert [profile.direction for profile in found] == [DOWN, UP, DOWN, UP]


def test_a_stamp_of_1970_harms_no_neighbour() -> None:
    """c-proof/pyglider#225: one sample at 1970 breaks gap filling for all."""
    p = sawtooth([0.0, 60.0, 0.0, 80.0, 0.0], wait=20)
    time = seconds_of(p)
    whole = with_profiles(samples(time, p))
    broken = time.copy()
    broken[[100, 433]] = [0.0, 4.2e9]
    found = with_profiles(samples(broken, p))
    others = np.delete(np.arange(p.size), [100, 433])
    for name in ("profile_number", "profile_direction"):
        assert (found[name].values[others] == whole[name].values[others]).all()
        assert (found[name].values[[100, 433]] == 0).all()


def test_a_stamp_that_jumps_ahead_and_back_is_the_false_one() -> None:
    time = BEGIN + np.arange(100.0)
    time[50] += 500.0
    assert np.flatnonzero(~good_stamps(time)).tolist() == [50]
    time[50] -= 1000.0
    assert np.flatnonzero(~good_stamps(time)).tolist() == [50]


def test_nothing_is_joined_over_a_gap() -> None:
    """Half a descent, an hour of nothing, half an ascent: two profiles, and none from the one to the other."""
    down, up = np.linspace(0.0, 40.0, 200), np.linspace(70.0, 0.0, 200)
    time = np.concatenate([BEGIN + np.arange(200.0), BEGIN + 3800.0 + np.arange(200.0)])
    found = profiles_of(time, np.concatenate([down, up]))
    assert [(profile.first, profile.direction) for profile in found] == [(2, DOWN), (202, UP)] or [
        profile.direction for profile in found
    ] == [DOWN, UP]
    assert all(not profile.first < 200 <= profile.last for profile in found)


def test_missing_pressures_are_passed_over() -> None:
    p = sawtooth([0.0, 60.0, 0.0])
    p[::7] = np.nan
    assert [profile.direction for profile in profiles_of(seconds_of(p), p)] == [DOWN, UP]


@pytest.mark.parametrize("size", [0, 1, 2])
def test_nearly_nothing_has_no_profile(size: int) -> None:
    assert profiles_of(BEGIN + np.arange(float(size)), np.zeros(size)) == []


@pytest.mark.parametrize(("least_change", "edge"), [(0.0, 0.1), (1.0, 0.6), (1.0, 0.0), (-1.0, -2.0)])
def test_impossible_thresholds_are_refused(least_change: float, edge: float) -> None:
    with pytest.raises(ValueError, match="least_change"):
        profiles_of(np.zeros(3), np.zeros(3), least_change=least_change, edge=edge)


def test_a_real_flight_of_a_slocum() -> None:
    """Half the flight of *comet*: its operator told nine dives to about 40 m, each down in 5 min and up in 5."""
    path = shared_data("slocum-comet-2016", "flight_first_half.csv")
    table = np.genfromtxt(path, delimiter=",", names=True)
    p = 10.0 * table["pressure_bar"]
    found = profiles_of(table["time_s"], p)
    assert [profile.direction for profile in found] == [DOWN, UP] * 9
    assert all(40.0 < max(p[each.first], p[each.last]) < 42.0 for each in found)
    assert all(min(p[each.first], p[each.last]) < 1.5 for each in found)
    deep = p > 2.0
    covered = np.zeros(p.size, dtype=bool)
    for each in found:
        covered[each.first : each.last + 1] = True
    assert (deep & ~covered & (p < 38.0)).sum() == 0  # under way and not at a turn, every sample is in a profile


walks = st.lists(st.integers(-40, 40), min_size=2, max_size=80).map(
    lambda steps: np.cumsum(np.array(steps, dtype=np.float64)) / 8.0
)


@given(walks)
def test_turning_points_alternate_and_change_enough(p: NDArray[np.float64]) -> None:
    turns = turning_points(p, 3.0)
    changes = np.diff(p[turns])
    assert (np.abs(changes) >= 3.0).all()
    assert (np.sign(changes[1:]) == -np.sign(changes[:-1])).all()
    assert turns == sorted(set(turns))
    if not turns:
        assert p.max() - p.min() < 3.0


@given(walks)
def test_between_turning_points_nothing_comes_back_by_so_much(p: NDArray[np.float64]) -> None:
    turns = turning_points(p, 3.0)
    for begin, end in itertools.pairwise(turns):
        way = (p[begin : end + 1] - p[begin]) * np.sign(p[end] - p[begin])
        assert (np.maximum.accumulate(way) - way).max() < 3.0
        assert way.min() == 0.0
        assert way.max() == way[-1]


@given(walks)
def test_the_way_back_in_time_is_the_same_with_other_directions(p: NDArray[np.float64]) -> None:
    time = seconds_of(p)
    ahead = profiles_of(time, p)
    back = profiles_of(time, p[::-1].copy())
    extremes = [sorted((p[each.first], p[each.last])) for each in ahead]
    mirrored = [sorted((p[::-1][each.first], p[::-1][each.last])) for each in back][::-1]
    assert len(ahead) == len(back)
    assert [each.direction for each in ahead] == [-each.direction for each in back][::-1]
    for one, other in zip(extremes, mirrored, strict=True):
        assert one == pytest.approx(other, abs=1.0)  # within both edges


@given(walks)
def test_each_sample_is_in_one_profile_at_most(p: NDArray[np.float64]) -> None:
    found = profiles_of(seconds_of(p), p)
    for one, next_ in itertools.pairwise(found):
        assert one.first < one.last <= next_.first
    assert [each.number for each in found] == list(range(len(found)))


def samples(time: NDArray[np.float64], p: NDArray[np.float64]) -> xr.Dataset:
    return xr.Dataset({"pressure": ("obs", p), "time": ("obs", time)})
