"""Oracle: a log of all stamps that an end has ever said or accepted, kept by the test, over restarts at any point."""

import datetime
import random
from math import inf, nan

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from stommel.link.signing.refusals import Refusal
from stommel.link.signing.stamps import (
    AHEAD,
    BLOCK,
    EPOCH,
    FOLLOWED,
    LAG,
    LIMIT,
    MOST_STREAMS,
    NAME,
    PER_SECOND,
    Stamps,
    stamp_of,
)  # fmt: skip
from tests.link.signing.ends import CLOCK
from tests.onboard.coordination.disk import Disk, PowerCutError

SHORE = (255, 190, 0)
LEAST = stamp_of(CLOCK)
MINUTE = 60 * PER_SECOND


def fresh(disk: Disk | None = None, clock: float = CLOCK) -> Stamps:
    return Stamps(Disk() if disk is None else disk, LEAST, clock, fresh=True)


def test_a_stamp_is_10_us_since_2015() -> None:
    """Oracle: the calendar; MAVLink counts from 1 January 2015, GMT."""
    assert stamp_of(1_420_070_400.0 + 1.0) == 100_000
    assert stamp_of(0.0) == stamp_of(-inf) == stamp_of(nan) == 0
    assert stamp_of(1e30) == LIMIT - 1


EVENTS = st.lists(
    st.one_of(
        st.tuples(st.just("say"), st.integers(1, 40)),
        st.tuples(st.just("hear"), st.integers(-2 * LAG, 2 * MINUTE)),
        st.tuples(st.just("wait"), st.floats(0.0, 3000.0)),
        st.tuples(st.just("restart"), st.sampled_from([0.0, CLOCK, CLOCK + 1e5, CLOCK + 4e8, 1e300, nan, -5.0])),
        st.tuples(st.just("cut"), st.integers(1, 8)),
    ),
    max_size=60,
)


@settings(max_examples=300, deadline=None)
@given(EVENTS, st.randoms(use_true_random=False))
def test_no_stamp_is_said_or_accepted_twice(events: list[tuple[str, float]], draw: random.Random) -> None:
    """Over restarts, losses of power in the middle of any operation of the disk, and any wall clock."""
    disk = Disk()
    stamps, t, clock = fresh(disk), 0.0, CLOCK
    said, accepted = -1, -1
    stamps.keep_now()
    for kind, value in [*events, ("say", 1)]:
        try:
            if kind == "say":
                for _ in range(int(value)):
                    stamp = stamps.next(t)
                    assert stamp > said
                    said = stamp
            elif kind == "hear":
                stamp = stamps.now(t) + int(value)
                if stamps.check(SHORE, stamp, t) is None:
                    assert stamp > accepted
                    stamps.accept(SHORE, stamp, t)
                    accepted = stamp  # only now is the frame handed on
            elif kind == "wait":
                t += value
            elif kind == "cut":
                disk.operations_left = int(value)
            else:
                clock, disk.operations_left = value, 0
                disk.sizes()  # where the power goes
        except PowerCutError:
            disk.operations_left = None
            disk = disk.after_power_cut(draw, keeps_unsynced=draw.random() < 0.5)
            stamps, t = Stamps(disk, LEAST, clock, fresh=False), 0.0
            assert not stamps.in_doubt


def test_what_was_heard_before_a_restart_is_refused_after_it() -> None:
    """Field report ArduPilot/pymavlink#961: replays. Every stamp that was accepted, one by one, after a power cut."""
    disk = Disk()
    stamps = fresh(disk)
    heard = []
    for number in range(500):
        t = 0.37 * number
        stamp = LEAST + int(t * PER_SECOND) + number
        assert stamps.check(SHORE, stamp, t) is None
        stamps.accept(SHORE, stamp, t)
        heard.append(stamp)
        again = Stamps(Disk({NAME: bytes(disk.files[NAME].data)}), LEAST, 0.0, fresh=False)
        assert again.check(SHORE, stamp, 0.0) is Refusal.REPLAYED
    again = Stamps(disk, LEAST, 0.0, fresh=False)
    assert {again.check(SHORE, stamp, 0.0) for stamp in heard} == {Refusal.REPLAYED}


def test_a_sender_that_nobody_hears_is_deaf_for_a_block_at_most() -> None:
    """It goes on by its own clock; half a minute after the restart it is accepted again."""
    disk = Disk()
    stamps = fresh(disk)
    stamps.accept(SHORE, LEAST + 5, 0.0)
    again = Stamps(disk, LEAST, 0.0, fresh=False)
    assert again.check(SHORE, LEAST + 6, 0.0) is Refusal.REPLAYED
    assert again.check(SHORE, LEAST + 6 + BLOCK, 0.0) is None


@pytest.mark.parametrize("clock", [0.0, CLOCK - 1e7, nan, -inf])
def test_a_clock_that_is_set_back_is_not_followed(clock: float) -> None:
    """A vehicle whose clock begins at 1970 goes on where it was."""
    disk = Disk()
    first = fresh(disk)
    said = [first.next(float(t)) for t in range(100)]
    assert Stamps(disk, LEAST, clock, fresh=False).next(0.0) > said[-1]


def test_a_clock_that_is_set_forward_is_followed_to_a_bound() -> None:
    """Field report ArduPilot/ardupilot#13860: a GPS that says 2036. It moves by 30 days, at a start only."""
    disk = Disk()
    first = fresh(disk)
    said = first.next(0.0)
    again = Stamps(disk, LEAST, CLOCK + 10 * 365 * 86400.0, fresh=False)
    assert again.next(0.0) == said + BLOCK + FOLLOWED + 1
    assert again.next(1000.0) - again.next(0.0) <= 1
    right = Stamps(Disk(dict.fromkeys([])), LEAST, CLOCK + 7 * 86400.0, fresh=True)
    assert right.next(0.0) == LEAST + 7 * 86400 * PER_SECOND + 1


def test_the_disk_is_written_twice_a_minute_at_most() -> None:
    class Counting(Disk):
        renames = 0

        def rename(self, old: str, new: str) -> None:
            self.renames += 1
            super().rename(old, new)

    disk = Counting()
    stamps = fresh(disk)
    for number in range(36_000):
        stamps.next(0.1 * number)
        stamp = LEAST + number * PER_SECOND // 10
        if stamps.check(SHORE, stamp, 0.1 * number) is None:
            stamps.accept(SHORE, stamp, 0.1 * number)
    assert 60 <= disk.renames <= 2 * 60 + 2


def test_bounds_of_past_and_future() -> None:
    stamps = fresh()
    assert stamps.check(SHORE, LEAST - LAG, 0.0) is None
    assert stamps.check(SHORE, LEAST - LAG - 1, 0.0) is Refusal.STALE
    assert stamps.check(SHORE, LEAST + AHEAD, 0.0) is None
    assert stamps.check(SHORE, LEAST + AHEAD + 1, 0.0) is Refusal.FAR_FUTURE
    assert stamps.check(SHORE, LEAST - LAG, 1.0) is Refusal.STALE
    late = Stamps(Disk(), LIMIT - AHEAD - 10, 0.0, fresh=True)
    assert late.check(SHORE, LIMIT - AHEAD, 0.0) is Refusal.FAR_FUTURE


def test_the_last_stamp_is_not_spent_by_a_sender() -> None:
    """However often a key holder jumps by the bound, this end keeps a year of stamps for itself."""
    stamps = fresh()
    for _ in range(200):
        stamp = stamps.now(0.0) + AHEAD
        if stamps.check(SHORE, stamp, 0.0) is None:
            stamps.accept(SHORE, stamp, 0.0)
    assert stamps.next(0.0) <= LIMIT - AHEAD


def test_senders_are_bounded_and_old_ones_make_room() -> None:
    stamps = fresh()
    for system in range(MOST_STREAMS):
        assert stamps.check((system, 1, 0), LEAST + 1, 0.0) is None
        stamps.accept((system, 1, 0), LEAST + 1, 0.0)
    assert stamps.check((200, 1, 0), LEAST + 1, 0.0) is Refusal.TOO_MANY
    assert stamps.check((3, 1, 0), LEAST + 2, 0.0) is None
    later = 2.0 * LAG / PER_SECOND
    assert stamps.check((200, 1, 0), LEAST + 2 * LAG, later) is None
    assert stamps.check((3, 1, 0), LEAST + 1, later) is Refusal.STALE


def test_any_damage_is_doubt_and_nothing_is_accepted() -> None:
    disk = Disk()
    fresh(disk).next(0.0)
    sound = bytes(disk.files[NAME].data)
    for at in range(len(sound)):
        damaged = sound[:at] + bytes((sound[at] ^ 1,)) + sound[at + 1 :]
        stamps = Stamps(Disk({NAME: damaged}), LEAST, CLOCK, fresh=False)
        assert stamps.in_doubt
        assert len(stamps.notes) == 1
        assert stamps.check(SHORE, LEAST + MINUTE, 0.0) is Refusal.UNPROVED
    assert Stamps(Disk(), LEAST, CLOCK, fresh=False).in_doubt


def test_a_proof_ends_the_doubt_and_lets_no_older_frame_in() -> None:
    """Also not of another sender, whose clock was ten minutes ahead of the one that has proved to be there."""
    stamps = Stamps(Disk(), LEAST, 0.0, fresh=False)
    stamps.prove(SHORE, LEAST + MINUTE, 0.0)
    assert not stamps.in_doubt
    assert stamps.check((254, 190, 0), LEAST + 11 * MINUTE, 0.0) is Refusal.REPLAYED
    assert stamps.check((254, 190, 0), stamps.next(0.0) + 1, 0.0) is None


def test_a_full_disk_is_told_and_the_link_goes_on() -> None:
    disk = Disk()
    disk.room = 0
    stamps = fresh(disk)
    said = [stamps.next(0.01 * number) for number in range(1000)]
    assert sorted(set(said)) == said
    assert not stamps.written
    disk.room = None
    stamps.next(20.0)
    assert stamps.written
    assert Stamps(disk, LEAST, 0.0, fresh=False).next(0.0) > said[-1]


def test_epoch_is_the_standard_s() -> None:
    """Oracle: pymavlink's own constant, in its setup_signing: 1st January 2015, 10 us."""
    assert datetime.datetime.fromtimestamp(EPOCH, datetime.UTC).isoformat() == "2015-01-01T00:00:00+00:00"
