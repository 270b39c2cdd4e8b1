"""Oracles: the true offset of simulated clocks, which only the test knows, and pymavlink's TIMESYNC."""

import math
import random

import pytest
from hypothesis import given
from hypothesis import strategies as st

from stommel.link.channel.channel import Channel
from stommel.link.channel.conversation import Conversation
from stommel.link.channel.settings import ChannelSettings
from stommel.link.outbox import Outbox
from stommel.link.service import Received
from stommel.link.session import Session
from stommel.link.time_sync import DRIFT, PeerClock, TimeSync

EPOCH = 1_800_000_000.0


def asked(sync: TimeSync, t: float) -> int:
    outbox = Outbox()
    sync.poll(t, outbox)
    while (outgoing := outbox.next()) is not None:
        return int.from_bytes(outgoing.payload[8:16].ljust(8, b"\0"), "little")
    raise AssertionError


def answer(sync: TimeSync, clock: float, number: int, t: float, system: int = 1) -> None:
    sync.take(Received(system, 1, "TIMESYNC", {"tc1": round(clock * 1e9), "ts1": number}), t)


def hear(sync: TimeSync, t: float) -> None:
    sync.take(Received(1, 1, "HEARTBEAT", {}), t)


@pytest.mark.parametrize(("latency", "jitter", "loss"), [(0.05, 0.0, 0.0), (0.5, 0.5, 0.4)])
def test_both_ends_enclose_each_others_clock(latency: float, jitter: float, loss: float) -> None:
    pace, offset = 1.0 + 50e-6, 612.5
    vehicle = TimeSync(lambda t: EPOCH + offset + pace * t)
    shore = TimeSync(lambda t: EPOCH + t)
    settings = ChannelSettings(latency=latency, jitter=jitter, loss=loss, whole_frames=True)
    talk = Conversation(Session(1, 1, [vehicle]), Session(255, 190, [shore]), Channel(settings, 2), step=0.02)
    hear(vehicle, 0.0)
    hear(shore, 0.0)
    for _ in range(60):
        talk.run(lambda: False, 5.0)
        true = offset + (pace - 1.0) * talk.t
        for sync, peer, expected in ((shore, (1, 1), true), (vehicle, (255, 190), -true)):
            found = sync.offset(peer, talk.t)
            if found is not None:
                assert found.low <= expected <= found.high
    final = shore.offset((1, 1), talk.t)
    assert final is not None
    assert final.high - final.low <= 2.0 * latency + 2.0 * jitter + 0.1
    timer = shore.timer((1, 1))
    assert timer is not None
    assert timer.round_trip == pytest.approx(2.0 * latency + jitter, abs=0.08 + jitter)
    assert shore.jumps((1, 1)) == vehicle.jumps((255, 190)) == 0


@given(
    st.lists(st.tuples(st.floats(0.0, 5.0), st.floats(0.0, 5.0), st.floats(1.0, 600.0)), min_size=1, max_size=30),
    st.floats(-DRIFT, DRIFT),
    st.floats(-1e6, 1e6),
)
def test_no_asymmetry_and_no_drift_puts_the_truth_outside(
    ways: list[tuple[float, float, float]], drift: float, offset: float
) -> None:
    peer, t = PeerClock(), 0.0
    for there, back, pause in ways:
        heard = t + there
        peer.answered(t, offset + heard * (1.0 + drift), heard + back)
        t = heard + back + pause
        low, high = peer.bounds(t)
        assert low - 1e-6 <= offset + drift * t <= high + 1e-6
    assert peer.jumps == 0


def test_the_best_round_trip_bounds_the_offset_and_age_widens_it() -> None:
    peer = PeerClock()
    peer.answered(0.0, 100.0 + 0.9, 1.0)
    peer.answered(10.0, 100.0 + 10.05, 10.1)
    low, high = peer.bounds(10.1)
    assert high - low <= 0.1 + 1e-3
    later = peer.bounds(10.1 + 3600.0)
    assert later[0] == pytest.approx(low - 0.36)
    assert later[1] == pytest.approx(high + 0.36)


def test_a_clock_that_was_set_is_believed_anew() -> None:
    sync = TimeSync()
    hear(sync, 0.0)
    answer(sync, 500.0, asked(sync, 0.0), 0.1)
    answer(sync, 900.0, asked(sync, 1.0), 1.1)
    found = sync.offset((1, 1), 1.1)
    assert found is not None
    assert found.low == pytest.approx(898.9)
    assert sync.jumps((1, 1)) == 1


def test_our_own_clock_may_be_set() -> None:
    ours = [0.0]
    sync = TimeSync(lambda t: ours[0] + t)
    hear(sync, 0.0)
    answer(sync, 500.0, asked(sync, 0.0), 0.1)
    ours[0] = 400.0
    found = sync.offset((1, 1), 0.1)
    assert found is not None
    assert found.low == pytest.approx(99.9)


def test_answers_that_nobody_asked_for_change_nothing() -> None:
    sync = TimeSync()
    hear(sync, 0.0)
    number = asked(sync, 5.0)
    answer(sync, 77.0, number + 1, 5.1)
    answer(sync, 77.0, number, 5.0 + 1000.0)
    assert sync.offset((1, 1), 6.0) is None


def test_questions_are_answered_with_our_clock_and_never_with_a_question() -> None:
    for clock, expected in ((2.5, 2_500_000_000), (0.0, 1), (-3.0, 1), (1e300, 9_200_000_000 * 10**9)):
        sync, outbox = TimeSync(lambda t, clock=clock: clock), Outbox()  # type: ignore[misc]
        sync.take(Received(1, 1, "TIMESYNC", {"tc1": 0, "ts1": 42}), 1.0)
        sync.poll(1.0, outbox)
        first = outbox.next()
        assert first is not None
        payload = first.payload.ljust(16, b"\0")
        assert int.from_bytes(payload[:8], "little", signed=True) == pytest.approx(expected, rel=1e-15)
        assert payload[8:] == (42).to_bytes(8, "little")


def test_who_does_not_know_the_time_does_not_answer() -> None:
    sync, outbox = TimeSync(lambda t: math.nan), Outbox()
    sync.take(Received(1, 1, "TIMESYNC", {"tc1": 0, "ts1": 42}), 1.0)
    sync.poll(1.0, outbox)
    first = outbox.next()
    assert first is not None
    assert first.payload[:8] == bytes(8)  # its own question
    assert outbox.next() is None


def test_a_silent_line_is_not_asked_for_ever() -> None:
    sync, outbox = TimeSync(), Outbox(most=10**6)
    hear(sync, 0.0)
    for t in range(86_400):
        sync.poll(float(t), outbox)
    assert outbox.waiting <= 130 * 16
    hear(sync, 86_400.0)
    before = outbox.waiting
    sync.poll(86_400.0, outbox)
    assert outbox.waiting > before


def test_a_flood_of_questions_is_answered_in_part() -> None:
    sync, outbox, draw = TimeSync(), Outbox(), random.Random(1)
    for _ in range(1000):
        sync.take(Received(1, 1, "TIMESYNC", {"tc1": 0, "ts1": draw.getrandbits(63)}), 1.0)
    sync.poll(1.0, outbox)
    assert outbox.waiting <= 9 * 16
