"""Oracle: a sender that numbers its frames, and a list of which of them were dropped."""

import random

import pytest

from stommel.link.sequence import SequenceWatch


def hear(watch: SequenceWatch, number: int, content: int, t: float) -> None:
    if not watch.is_duplicate(number % 256, content, t):
        watch.take(number % 256, content, t)


@pytest.mark.parametrize("loss", [0.0, 0.1, 0.4, 0.8])
@pytest.mark.parametrize("every", [0.002, 0.025, 1.0])
def test_losses_are_counted_over_many_rounds_of_the_numbers(loss: float, every: float) -> None:
    draw, watch = random.Random(1), SequenceWatch()
    heard = [number for number in range(5000) if draw.random() >= loss]
    for number in heard:
        hear(watch, number, number, every * number)
    assert watch.counts.good == len(heard)
    assert watch.counts.lost == pytest.approx(heard[-1] - heard[0] + 1 - len(heard), rel=0.1 if loss > 0.5 else 0.0)
    assert watch.counts.restarts <= (10 if loss > 0.5 else 0)


def test_a_fade_of_a_second_is_counted() -> None:
    watch = SequenceWatch()
    heard = [number for number in range(400) if not 200 <= number < 240]
    for number in heard:
        hear(watch, number, number, 0.025 * number)
    assert watch.counts.lost == 40


@pytest.mark.parametrize("last", [3, 40, 57, 100, 200, 250])
@pytest.mark.parametrize("first", [0, 1, 3])
@pytest.mark.parametrize("away", [0.5, 2.0, 60.0])
def test_a_restart_is_no_loss(last: int, first: int, away: float) -> None:
    watch = SequenceWatch()
    for number in range(last + 1):
        hear(watch, number, number, 0.1 * number)
    for number in range(first, 100):
        hear(watch, number, 1000 + number, 0.1 * (last + number) + away)
    assert watch.counts.lost < 16  # so few may be a loss
    assert watch.counts.good == last + 1 + 100 - first
    assert watch.counts.duplicate == 0


def test_a_frame_that_comes_twice_is_told_from_one_that_comes_late() -> None:
    watch = SequenceWatch()
    for number in (0, 1, 2, 2, 4, 3, 3, 5, 1):
        hear(watch, number, number, 0.1 * number)
    counts = watch.counts
    assert (counts.good, counts.duplicate, counts.lost, counts.restarts) == (6, 3, 0, 0)


@pytest.mark.parametrize("every", [0.002, 0.025])
def test_numbers_that_come_round_are_no_duplicates(every: float) -> None:
    watch = SequenceWatch()
    for number in range(1024):
        hear(watch, number, 7, every * number)  # the same content every time
    assert watch.counts.good == 1024
    assert watch.counts.duplicate == 0


def test_a_restart_whose_first_frames_were_lost_is_told_by_the_pace() -> None:
    watch = SequenceWatch()
    for number in range(101):
        hear(watch, number, number, 0.1 * number)
    for number in range(60, 100):  # after a second, in which ten can have been sent, not 215
        hear(watch, number, 1000 + number, 5.1 + 0.1 * number)
    assert (watch.counts.lost, watch.counts.restarts, watch.counts.good) == (0, 1, 141)
