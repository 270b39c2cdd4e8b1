"""Stretches of bytes. Oracle: Python's sets of numbers."""

from itertools import pairwise

from hypothesis import given
from hypothesis import strategies as st

from stommel.link.files.ranges import Range, Ranges

PLACES = st.integers(0, 40)
STEPS = st.lists(st.tuples(st.sampled_from(["add", "remove"]), PLACES, PLACES))


def numbers(ranges: Ranges) -> set[int]:
    return {number for first, last in ranges for number in range(first, last)}


@given(STEPS, PLACES, PLACES)
def test_ranges_are_sets_of_numbers(steps: list[tuple[str, int, int]], low: int, high: int) -> None:
    ranges, expected = Ranges(), set[int]()
    for step, first, last in steps:
        changed = set(range(first, last))
        before = set(expected)
        expected = expected | changed if step == "add" else expected - changed
        count = ranges.add(first, last) if step == "add" else ranges.remove(first, last)
        assert count == len(before ^ expected)
        assert numbers(ranges) == expected
        assert ranges.bytes == len(expected)
        stretches = list(ranges)
        assert all(a.last < b.first for a, b in pairwise(stretches))
        assert all(each.size > 0 for each in stretches)
    assert numbers(ranges.missing(30)) == set(range(30)) - expected
    assert numbers(Ranges(ranges.within(low, high))) == expected & set(range(low, high))


@given(STEPS, st.integers(1, 50))
def test_pop_takes_the_first_bytes(steps: list[tuple[str, int, int]], most: int) -> None:
    ranges = Ranges()
    for step, first, last in steps:
        (ranges.add if step == "add" else ranges.remove)(first, last)
    if not ranges:
        return
    before = numbers(ranges)
    taken = ranges.pop(most)
    assert taken.first == min(before)
    assert 0 < taken.size <= most
    assert numbers(ranges) == before - set(range(*taken))


def test_equality_is_of_bytes() -> None:
    assert Ranges([(0, 3), (3, 5)]) == Ranges([(0, 5)])
    assert Ranges([(0, 3)]) != Ranges([(0, 4)])
    assert list(Ranges([(4, 6), (0, 2)])) == [Range(0, 2), Range(4, 6)]
