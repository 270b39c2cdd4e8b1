"""Ends that have not heard each other yet, told from recordings. Oracle: what was said when, which the test knows."""

import pytest

from stommel.link.signing.challenge import SOONEST
from stommel.link.signing.refusals import Refusal
from stommel.link.signing.stamps import NAME
from tests.link.signing.ends import CLOCK, End, keys_of, raw_frame, shore, talk, understand, vehicle

DAY = 86_400.0
NOT_NEW = (Refusal.STALE, Refusal.REPLAYED)


def behind(offset: float) -> End:
    """A vehicle whose clock is behind; its key is older still."""
    return vehicle(keys_of()._replace(made=int(CLOCK - 20 * DAY)), CLOCK - offset)


def ahead() -> End:
    return shore(keys_of()._replace(made=int(CLOCK - 20 * DAY)))


def of_time(end: End) -> int:
    return sum(end.guard.refusals.by_reason[reason] for reason in NOT_NEW)


@pytest.mark.parametrize("offset", [3600.0, 3 * DAY, 19 * DAY])
def test_a_vehicle_that_started_later_is_counted_apart_and_heard_when_it_has_heard_us(offset: float) -> None:
    boat, land = behind(offset), ahead()
    early = [boat.say(0.1 * k) for k in range(50)]
    assert not any(land.hears(raw, 5.0) for raw in early)
    assert land.guard.refusals.by_reason == {Refusal.OUT_OF_STEP: 50}
    assert (land.guard.refusals.out_of_step, land.guard.refusals.replayed) == (50, 0)
    for frame in land.poll(5.1):
        boat.hear(frame, 5.1)
    assert understand(boat, land, 5.2)
    assert not any(land.hears(raw, 6.0) for raw in early), "nothing old is accepted now either"
    assert of_time(land) == 50, "and of a sender that is in step they are recordings"


def test_a_vehicle_that_lost_its_stamps_on_the_way_is_counted_apart_again() -> None:
    boat, land = vehicle(), shore()
    t = talk(boat, land, 0.0)
    boat.disk.remove(NAME)
    boat.start(0.0)
    said = boat.poll(t + 1.0)
    assert raw_frame(said[0]).message.name == "KEY_CHALLENGE"
    said += [boat.say(t + 1.0) for _ in range(20)]
    assert not any(land.hears(raw, t + 1.0) for raw in said)
    assert land.guard.refusals.out_of_step == len(said)
    assert of_time(land) == 0
    t = talk(boat, land, t + 2.0)
    assert understand(boat, land, t)
    for _ in range(3):
        assert not any(land.hears(raw, t + 1.0) for raw in said), "recordings, the question among them"
    assert of_time(land) == 3 * len(said)


def test_recordings_of_a_vehicle_that_is_silent_are_told_as_such() -> None:
    boat, land = vehicle(), shore()
    recorded = [boat.say(0.1 * k) for k in range(20)]
    assert all(land.hears(raw, 2.0) for raw in recorded)
    assert not any(land.hears(raw, 5000.0) for raw in recorded)
    assert land.guard.refusals.by_reason == {Refusal.REPLAYED: 20}


@pytest.mark.parametrize("lost", [False, True])
def test_who_hears_an_old_frame_asks_at_once_and_not_more_than_once_a_second(lost: bool) -> None:
    """However many recordings somebody plays, they buy no more frames of ours than that."""
    boat, land = behind(3600.0), ahead()
    if lost:
        land.disk.remove(NAME)
        land.start(CLOCK)
        land.poll(-0.5)
    recorded = [boat.say(0.001 * k) for k in range(1000)]
    asked = 0
    for k, raw in enumerate(recorded):
        t = 1.0 + 0.01 * k
        assert not land.hears(raw, t)
        questions = [said for said in land.poll(t) if raw_frame(said).message.name == "KEY_CHALLENGE"]
        assert questions or k > 0, "the first old frame is answered with a question"
        asked += len(questions)
    assert asked == 10.0 / SOONEST
    land.poll(30.0)
    assert lost or [raw_frame(said).message.name for said in land.poll(40.0)] == ["HEARTBEAT"]


def test_an_end_in_step_asks_nothing() -> None:
    boat, land = vehicle(), shore()
    recorded = [boat.say(0.1 * k) for k in range(20)]
    t = talk(boat, land, 5.0)
    for raw in recorded:
        assert not land.hears(raw, t)
    assert [raw_frame(said).message.name for said in land.poll(t)] == ["HEARTBEAT"]
