"""A plot shows exactly what the archive holds of its window: oracle is a search of all samples, written out here.

Field report nasa/openmct#4777, #6831: a plot joined the points beside a gap, or showed another window's data.
"""

import math
from collections.abc import Iterator
from itertools import count, pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from stommel.archive import Archive, ArchiveRequestError, Batch, Series

T = 1_700_000_000.0
Sample = tuple[float, float]


@pytest.fixture(scope="module")
def shared(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Archive]:
    with Archive.open(str(tmp_path_factory.mktemp("series") / "archive.sqlite")) as opened:
        yield opened


_keys = count(1)


def stored(archive: Archive, samples: list[Sample]) -> str:
    key = f"channel_{next(_keys)}"
    archive.store(1, Batch(samples=[(key, t, value) for t, value in samples]))
    return key


@st.composite
def recordings(draw: st.DrawFn) -> list[Sample]:
    """Stretches of regular samples with silence between them, a few of them ragged."""
    t, samples = T + draw(st.integers(0, 7200)), []
    for _ in range(draw(st.integers(1, 5))):
        period = draw(st.sampled_from([0.25, 1.0, 1.0, 10.0, 47.0, 400.0]))
        for _ in range(draw(st.integers(1, 120))):
            samples.append((round(t, 6), float(draw(st.integers(-50, 50)))))
            t += period
        t += draw(st.sampled_from([0.0, 3.0, 30.0, 200.0, 5000.0, 40000.0]))
    return samples


@st.composite
def windows(draw: st.DrawFn) -> tuple[float, float]:
    begin = draw(st.floats(-2000, 60000).map(lambda t: round(T + t, 3)))
    return begin, begin + draw(st.sampled_from([0.0, 1.0, 30.0, 600.0, 7200.0, 90000.0, 1e6, 1e7]))


def check(answer: Series, samples: list[Sample], begin: float, end: float, points: int, period: float) -> None:
    """Hold an answer against all samples of the window."""
    inside = [(t, value) for t, value in samples if begin <= t <= end]
    shown = [(t, v) for t, v in zip(answer.t.tolist(), answer.value.tolist(), strict=True) if not math.isnan(v)]
    marks = [t for t, v in zip(answer.t.tolist(), answer.value.tolist(), strict=True) if math.isnan(v)]
    assert set(shown) <= set(inside)
    assert len(set(shown)) == len(shown)
    assert answer.t.tolist() == sorted(answer.t.tolist())
    assert answer.samples == len(inside)
    assert answer.reduced == (len(shown) < len(inside))
    if len(inside) <= points:
        assert not answer.reduced
    if not inside:
        return
    assert {inside[0], inside[-1]} <= set(shown)
    values = [value for _, value in inside]
    shown_values = [value for _, value in shown]
    assert (min(shown_values), max(shown_values)) == (min(values), max(values))
    bucket = (end - begin) / (points // 2)
    widest_bucket = bucket + 60 if bucket < 749 else bucket + 600  # rounded to whole cells, tens from 750 s on
    must, may = 5 * period, max(5 * period, widest_bucket if answer.reduced else 0)
    for (t, before), (later, after) in pairwise(inside):
        marked = [mark for mark in marks if t < mark < later]
        if later - t > may + 1e-6:
            assert len(marked) == 1, "a gap is drawn as a gap"
            assert {(t, before), (later, after)} <= set(shown), "and ends where the samples end"
        if later - t <= must:
            assert marked == [], "and nothing else is"
    assert len(marks) <= sum(later - t > must for (t, _), (later, _) in pairwise(inside))
    assert len(shown) <= points + 2 * len(marks) + 4


@given(recordings(), windows(), st.integers(4, 60), st.sampled_from([1.0, 10.0, 47.0]))
@settings(max_examples=600, deadline=None)
def test_displayed_points_are_the_query_of_the_displayed_window(
    shared: Archive, samples: list[Sample], window: tuple[float, float], points: int, period: float
) -> None:
    key = stored(shared, samples)
    answer = shared.series(1, key, *window, points=points, period=period)
    check(answer, samples, *window, points, period)


@given(recordings(), windows(), st.integers(4, 60), st.sampled_from([1.0, 10.0, 47.0]))
@settings(max_examples=40, deadline=None)
def test_the_shape_keeps_its_ends_and_its_gaps(
    shared: Archive, samples: list[Sample], window: tuple[float, float], points: int, period: float
) -> None:
    key = stored(shared, samples)
    answer = shared.series(1, key, *window, points=points, method="lttb", period=period)
    inside = [(t, value) for t, value in samples if window[0] <= t <= window[1]]
    shown = [(t, v) for t, v in zip(answer.t.tolist(), answer.value.tolist(), strict=True) if not math.isnan(v)]
    marks = np.isnan(answer.value).sum()
    assert set(shown) <= set(inside)
    assert answer.samples == len(inside)
    assert len(shown) <= points + 2 * marks + 2
    if inside:
        assert {inside[0], inside[-1]} <= set(shown)
    reference = shared.series(1, key, *window, points=points, period=period)
    assert np.array_equal(answer.t[np.isnan(answer.value)], reference.t[np.isnan(reference.value)])


@given(recordings(), st.integers(4, 30), st.integers(1, 40), st.integers(-3000, 9000))
@settings(max_examples=60, deadline=None)
def test_minutes_and_tens_draw_what_the_samples_draw(
    shared: Archive, samples: list[Sample], points: int, cells: int, shift: int
) -> None:
    """The lowest and highest of each bucket, found from cells, are those that a search of it finds."""
    width = 60.0 * cells if cells <= 12 else 600.0 * (cells - 11)  # whole cells of those that are used
    key = stored(shared, samples)
    begin = T + shift
    end = begin + width * (points // 2) - 1e-6
    answer = shared.series(1, key, begin, end, points=points, period=1e6)
    inside = [(t, value) for t, value in samples if begin <= t <= end]
    buckets: dict[int, list[Sample]] = {}
    for t, value in inside:
        buckets.setdefault(round(t * 1e6) // round(width * 1e6), []).append((t, value))
    expected = set(inside[:1] + inside[-1:])
    for members in buckets.values():
        expected.add(min(members, key=lambda sample: (sample[1], sample[0])))
        expected.add(min(members, key=lambda sample: (-sample[1], sample[0])))
    if len(inside) <= points:
        expected = set(inside)
    assert list(zip(answer.t.tolist(), answer.value.tolist(), strict=True)) == sorted(expected)


def wave(t: float) -> float:
    return math.sin(t / 700.0)


def test_the_same_in_both_databases(archive: Archive) -> None:
    samples = [(T + k, wave(k)) for k in range(4000) if not 1000 < k < 1900]
    archive.store(1, Batch(samples=[("depth_m", t, value) for t, value in samples]))
    for points in (8, 40, 400, 5000):
        check(
            archive.series(1, "depth_m", T + 0.5, T + 3900, points, period=1.0), samples, T + 0.5, T + 3900, points, 1
        )
    assert np.isnan(archive.series(1, "depth_m", T, T + 4000, 40).value).sum() == 1
    assert archive.series(1, "depth_m", T, T + 4000, 40, "raw").samples == len(samples)


def test_a_silence_of_hours_is_not_joined(sqlite_archive: Archive) -> None:
    samples = [("depth_m", T + k, float(k)) for k in range(60)]
    samples += [("depth_m", T + 20_000 + k, float(k)) for k in range(60)]
    sqlite_archive.store(1, Batch(samples=samples))
    for points in (4, 100, 2000):
        found = sqlite_archive.series(1, "depth_m", T - 100, T + 30_000, points)
        (place,) = np.flatnonzero(np.isnan(found.value))
        assert found.t[place - 1 : place + 2].tolist() == [T + 59, (T + 59 + T + 20_000) / 2, T + 20_000]


def test_another_window_shows_nothing_of_this_one(sqlite_archive: Archive) -> None:
    sqlite_archive.store(1, Batch(samples=[("depth_m", T + k, float(k)) for k in range(100)]))
    for key, vehicle, begin in (("depth_m", 1, T + 100), ("depth_m", 2, T), ("pitch_deg", 1, T)):
        empty = sqlite_archive.series(vehicle, key, begin, begin + 90)
        assert (empty.t.size, empty.value.size, empty.samples, empty.reduced) == (0, 0, 0, False)


def test_a_fast_channel_is_drawn_finely_for_two_hours_and_by_minutes_beyond(
    sqlite_archive: Archive, monkeypatch: pytest.MonkeyPatch
) -> None:
    """An hour is read as it is, however many samples it has; three hours of too many are drawn from minutes."""
    monkeypatch.setattr("stommel.archive.series._READ_AT_ONCE", 9000)
    values = np.random.default_rng(5).normal(size=3 * 10_800)
    batch = [("rate", T + k / 3, value) for k, value in enumerate(values.tolist())]
    sqlite_archive.store(1, Batch(samples=batch))
    hour = sqlite_archive.series(1, "rate", T, T + 3600, 2000)
    assert hour.samples == 10_801
    assert 1900 < hour.t.size <= 2004
    whole = sqlite_archive.series(1, "rate", T, T + 3 * 3600, 2000)
    assert whole.samples == len(values)
    assert 300 < whole.t.size <= 400
    assert (whole.value.min(), whole.value.max()) == (values.min(), values.max())


@pytest.mark.parametrize(
    ("asked", "words"),
    [
        ({"begin": T + 1, "end": T}, "ends before it begins"),
        ({"begin": math.nan}, "a time of nan s"),
        ({"end": math.inf}, "a time of inf s"),
        ({"begin": -1.0}, "allowed are 0 to 4102444800"),
        ({"points": 3}, "allowed are 4 to 20000"),
        ({"points": 20_001}, "allowed are 4 to 20000"),
        ({"method": "mean"}, "allowed are minmax, lttb, raw"),
        ({"period": 0.0}, "a period of 0.0 s"),
        ({"period": math.nan}, "a period of nan s"),
    ],
)
def test_values_outside_their_range_are_refused(sqlite_archive: Archive, asked: dict[str, float], words: str) -> None:
    with pytest.raises(ArchiveRequestError, match=words):
        sqlite_archive.series(1, "depth_m", **{"begin": T, "end": T + 1, **asked})


def test_values_that_begin_anew_keep_how_far_they_go_to_either_side(sqlite_archive: Archive) -> None:
    """A heading that swings 20 deg about north: oracle is the swing itself, which lowest and highest hide."""
    swing = [20.0 * math.sin(k / 37.0) for k in range(3600)]
    key = stored(sqlite_archive, [(T + k, value % 360.0) for k, value in enumerate(swing)])
    bucket = math.ceil((3_600_000_001) / 100) / 1e6

    def shown(turn: float | None) -> list[tuple[float, float]]:
        found = sqlite_archive.series(1, key, T, T + 3600.0, 200, turn=turn)
        return [(t, (v + 180.0) % 360.0 - 180.0) for t, v in zip(found.t.tolist(), found.value.tolist(), strict=True)]

    for turn, wanted in ((360.0, True), (None, False)):
        points = shown(turn)
        kept = []
        for number in range(math.floor(T / bucket) + 1, math.floor((T + 3600.0) / bucket)):
            inside = [v for k, v in enumerate(swing) if (T + k) // bucket == number]
            seen = [v for t, v in points if t // bucket == number]
            kept.append(
                min(seen) == pytest.approx(min(inside), abs=1e-9) and max(seen) == pytest.approx(max(inside), abs=1e-9)
            )
        assert len(kept) > 90
        assert all(kept) is wanted
