"""One side of a limit: never missed, no chatter inside the hysteresis, the delay kept, samples in any order."""

from math import inf, isnan, nan

import pytest
from hypothesis import given
from hypothesis import strategies as st

from stommel.station.alarms.threshold import Threshold, Transition

LIMIT, BAND = 100.0, 5.0
values = st.one_of(st.floats(60.0, 140.0), st.sampled_from([nan, inf, -inf, 100.0, 95.0]))
series = st.lists(st.tuples(st.integers(1, 50), values), max_size=60).map(
    lambda steps: [(float(sum(step for step, _ in steps[: n + 1])), value) for n, (_, value) in enumerate(steps)]
)


def told_of(threshold: Threshold, samples: list[tuple[float, float]]) -> list[Transition]:
    return [told for t, value in samples for told in threshold.take(t, value)]


def numbers(samples: list[tuple[float, float]]) -> list[tuple[float, float]]:
    return [(t, value) for t, value in samples if not isnan(value)]


@given(series)
def test_without_delay_it_is_raised_exactly_when_the_story_says_so(samples: list[tuple[float, float]]) -> None:
    """Oracle: the two rules written as one pass over the numbers."""
    expected, raised = [], False
    for t, value in numbers(samples):
        if not raised and value > LIMIT:
            raised = True
            expected.append(Transition(True, t, value))
        elif raised and value <= LIMIT - BAND:
            raised = False
            expected.append(Transition(False, t, value))
    assert told_of(Threshold(LIMIT, above=True, hysteresis=BAND), samples) == expected


@given(series)
def test_below_is_above_in_a_mirror(samples: list[tuple[float, float]]) -> None:
    above = told_of(Threshold(LIMIT, above=True, hysteresis=BAND, delay=30.0), samples)
    below = told_of(Threshold(-LIMIT, above=False, hysteresis=BAND, delay=30.0), [(t, -v) for t, v in samples])
    assert [(told.raised, told.t, -told.value) for told in below] == [tuple(told) for told in above]


@given(st.lists(st.floats(LIMIT - BAND, LIMIT + 40.0, exclude_min=True), min_size=1, max_size=50))
def test_no_chatter_within_the_hysteresis(wobble: list[float]) -> None:
    """Values that never come inside by the hysteresis raise at most one alarm and clear none."""
    told = told_of(Threshold(LIMIT, above=True, hysteresis=BAND), [(float(n), v) for n, v in enumerate(wobble)])
    assert [t.raised for t in told] == ([True] if max(wobble) > LIMIT else [])


@given(series, st.floats(0.0, 120.0))
def test_the_delay_is_kept_and_no_long_excess_missed(samples: list[tuple[float, float]], delay: float) -> None:
    """Oracle: every run of samples beyond the limit, found by looking back from each sample."""
    threshold = Threshold(LIMIT, above=True, hysteresis=BAND, delay=delay)
    plain = numbers(samples)
    for n, (t, value) in enumerate(plain):
        before = threshold.raised
        told = threshold.take(t, value)
        begun = n
        while begun > 0 and plain[begun - 1][1] > LIMIT:
            begun -= 1
        long_enough = value > LIMIT and t - plain[begun][0] >= delay
        if told and told[0].raised:
            assert long_enough
        if long_enough:
            assert threshold.raised
        if value > LIMIT:
            assert threshold.raised or not before


@given(st.permutations([(1.0, 90.0), (2.0, 99.0), (3.0, 101.0), (4.0, 97.0), (5.0, 80.0), (6.0, nan)]))
def test_in_any_order_an_excess_is_told_once(samples: list[tuple[float, float]]) -> None:
    """One excess among six samples: one alarm, and it ends, whatever comes first."""
    told = told_of(Threshold(LIMIT, above=True, hysteresis=BAND), samples)
    assert [t.raised for t in told] in ([True, False], [True])
    assert told[0] == Transition(True, 3.0, 101.0)
    if samples.index((5.0, 80.0)) > samples.index((3.0, 101.0)):
        assert len(told) == 2


def test_what_comes_late_from_before_the_last_end_is_not_told_again() -> None:
    """A backlog between live samples: its first excess is told, and none of the others."""
    threshold = Threshold(LIMIT, above=True)
    threshold.take(1000.0, 50.0)
    told = [
        told
        for n in range(1, 6)
        for told in (*threshold.take(100.0 + n, 120.0), *threshold.take(1000.0 + n, 50.0))
    ]  # fmt: skip
    assert told == [Transition(True, 101.0, 120.0), Transition(False, 1000.0, 50.0)]


@given(st.lists(st.tuples(st.floats(0.0, 100.0), values), max_size=40))
def test_raised_and_cleared_always_take_turns(samples: list[tuple[float, float]]) -> None:
    """Samples in any order: an alarm never begins twice without an end, and no excess is left untold."""
    told = told_of(Threshold(LIMIT, above=True, hysteresis=BAND), samples)
    assert [t.raised for t in told] == [n % 2 == 0 for n in range(len(told))]
    assert bool(told) == any(value > LIMIT for _, value in samples)


def test_a_delay_is_over_though_no_sample_comes() -> None:
    threshold = Threshold(LIMIT, above=True, delay=60.0)
    assert threshold.take(0.0, 120.0) == ()
    assert threshold.look(59.0) == ()
    assert threshold.look(75.0) == (Transition(True, 60.0, 120.0),)
    assert threshold.look(200.0) == ()


def test_a_dip_inside_the_limit_starts_the_delay_anew() -> None:
    threshold = Threshold(LIMIT, above=True, hysteresis=BAND, delay=10.0)
    assert told_of(threshold, [(0.0, 101.0), (9.0, 100.0), (10.0, 101.0), (19.0, 101.0)]) == []
    assert told_of(threshold, [(20.0, 101.0)]) == [Transition(True, 20.0, 101.0)]


def test_a_clock_that_was_set_back_is_believed_after_some_samples() -> None:
    threshold = Threshold(LIMIT, above=True)
    threshold.take(1e9, 120.0)
    told = told_of(threshold, [(float(n), 50.0) for n in range(30)])
    assert [t.raised for t in told] == [False]
    assert told_of(threshold, [(31.0, 120.0)]) == [Transition(True, 31.0, 120.0)]


@pytest.mark.parametrize("raised", [False, True])
def test_what_was_raised_before_a_restart_is_not_raised_again(raised: bool) -> None:
    told = told_of(Threshold(LIMIT, above=True, hysteresis=BAND, raised=raised), [(0.0, 110.0), (1.0, 90.0)])
    assert [t.raised for t in told] == ([False] if raised else [True, False])
