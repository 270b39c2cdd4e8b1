"""What is asked for, and when. Oracle: a model of who sends, which answers in order, and sets of numbers."""

import math
import random

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from stommel.link.files.loss import MOST_SEGMENT, OVERHEAD, LossBySize, best_segment
from stommel.link.files.pace import Pace
from stommel.link.files.ranges import Range, Ranges
from stommel.link.files.recovery import OVERTAKEN, REORDERED, Recovery
from stommel.link.files.request_words import LONGEST, MOST_RANGES, packed_ranges, transfer_number, unpacked_ranges

SEGMENT = 10


@settings(deadline=None, max_examples=60)
@given(st.integers(0, 2**32 - 1), st.integers(1, 300), st.floats(0.0, 0.8))
def test_nothing_that_is_on_its_way_is_asked_for(seed: int, segments: int, loss: float) -> None:
    """In order and without time-outs: every byte that comes is new, and all come."""
    draw = random.Random(seed)
    size = segments * SEGMENT - 3
    recovery, there = Recovery([(0, size)]), set[int]()
    queue: list[tuple[int, Range]] = []
    serial, t = 0, 0.0
    for _ in range(100_000):
        t += 0.01
        if draw.random() < 0.1 or not queue:
            serial += 1
            asked = recovery.ask(serial, 6, 70, 1000)
            if draw.random() >= loss:
                queue += [(serial, each) for each in asked]
        if queue:
            number, (first, last) = queue.pop(0)
            end = min(first + SEGMENT, last)
            if end < last:
                queue.insert(0, (number, Range(end, last)))
            if draw.random() >= loss:
                assert not there & set(range(first, end))
                assert recovery.take(number, first, end - first, t) == end - first
                there |= set(range(first, end))
        elif not recovery.to_ask:
            recovery.give_up()
        assert recovery.missing.bytes == size - len(there)
        if not recovery.missing:
            break
    assert there == set(range(size))


def test_a_loss_is_seen_by_what_comes_after_it() -> None:
    recovery = Recovery([(0, 100)])
    recovery.ask(1, 60, 1000, 1000)
    recovery.take(1, 0, 10, 0.0)
    for k in range(1, REORDERED):
        recovery.take(1, 10 + 10 * k, 10, 0.0)
        assert not recovery.to_ask
    recovery.take(1, 60, 10, 0.0)
    assert list(recovery.to_ask) == [(10, 20)]
    assert recovery.take(1, 10, 10, 0.0) == 10, "it was late only"
    assert (10, 20) not in list(recovery.to_ask)


def test_where_no_more_comes_a_short_time_is_enough() -> None:
    recovery = Recovery([(0, 100)])
    recovery.ask(1, 60, 1000, 1000)
    recovery.take(1, 10, 10, 5.0)
    recovery.settle(5.0)
    assert not recovery.to_ask
    recovery.settle(5.0 + 1.01 * OVERTAKEN)
    assert list(recovery.to_ask) == [(0, 10)]


def test_a_request_that_was_lost_is_seen_by_the_answer_to_the_next() -> None:
    recovery = Recovery([(0, 100)])
    recovery.ask(1, 1, 50, 1000)
    recovery.ask(2, 1, 50, 1000)
    recovery.take(2, 50, 50, 0.0)
    assert list(recovery.to_ask) == [(0, 50)]


def test_a_copy_that_is_still_to_come_is_waited_for() -> None:
    recovery = Recovery([(0, 20)])
    asked = recovery.ask(1, 60, 100, 1000)
    recovery.ask_again(2, asked)
    recovery.take(1, 10, 10, 0.0)
    recovery.settle(10.0)
    assert not recovery.to_ask
    assert recovery.take(2, 0, 10, 11.0) == 10
    assert not recovery.missing


RANGES = st.lists(st.tuples(st.integers(1, LONGEST), st.integers(1, LONGEST)), max_size=MOST_RANGES)


@given(st.integers(0, 0x7FFFFFFF), RANGES)
def test_ranges_come_through_a_request(base: int, pairs: list[tuple[int, int]]) -> None:
    ranges, at = [], base
    for skip, size in pairs:
        ranges.append(Range(at + skip, at + skip + size))
        at += skip + size
    start, packed = packed_ranges(ranges)
    assert len(packed) <= 240
    assert list(unpacked_ranges(start, len(ranges), packed)) == ranges


@given(st.integers(0, 2**32 - 1), st.integers(0, 255), st.binary(max_size=240))
def test_no_request_asks_for_more_than_it_can(base: int, count: int, packed: bytes) -> None:
    ranges = unpacked_ranges(base, count, packed)
    assert len(ranges) <= MOST_RANGES
    assert all(0 <= first < last <= 0xFFFFFFFF for first, last in ranges)


def test_numbers_of_transfers_are_the_same_after_a_restart_and_never_0() -> None:
    assert transfer_number("download", (255, 190), "a") == transfer_number("download", (255, 190), "a")
    numbers = {transfer_number("download", (255, 190), str(k)) for k in range(300)}
    assert len(numbers) > 290
    assert all(0 < number <= 0xFFFF for number in numbers)


@pytest.mark.parametrize("loss_by_byte", [1e-5, 8e-4, 2e-3, 8e-3, 0.05])
def test_the_best_segment_is_the_maximum(loss_by_byte: float) -> None:
    """Against the largest of all segments, counted through."""
    carried = {s: s / (s + OVERHEAD) * math.exp(-loss_by_byte * (s + OVERHEAD)) for s in range(32, MOST_SEGMENT + 1)}
    assert abs(best_segment(loss_by_byte) - max(carried, key=lambda s: carried[s])) <= 1


def test_lost_frames_are_counted_by_their_numbers() -> None:
    loss = LossBySize()
    for number in [65_530, 65_533, 65_534, 1, 2]:
        loss.note(number)
    assert (loss.frames_came, loss.frames_lost) == (5, 4)
    loss.note(0)  # late
    assert (loss.frames_came, loss.frames_lost) == (5, 4)
    loss.forget_number()
    loss.note(500)
    assert loss.frames_lost == 4


def test_silence_means_nothing_until_the_pace_is_known() -> None:
    pace = Pace()
    assert pace.silence(0.0, 100.0) > 1.0
    for k in range(50):
        pace.note(244, 0.02 * k)
    assert pace.frame_time(0.0) == pytest.approx(0.02, rel=0.01)
    assert pace.rate == pytest.approx(244 / 0.02, rel=0.3)
    assert 0.15 < pace.silence(0.4, 100.0) < 0.5
    pace.note(244, 1000.0)
    assert pace.frame_time(0.0) < 0.04, "a dive is no pace"


def test_ranges_never_touch() -> None:
    assert list(Ranges([(0, 10), (10, 20)])) == [(0, 20)]
