"""Oracle: what was signed with which key and said when, which the test knows and the guard does not."""

import os
import random
from collections.abc import Callable

import pytest

from stommel.link.frames import frame_bytes
from stommel.link.outbox import Outbox, Priority
from stommel.link.service import Received
from stommel.link.session import Session
from stommel.link.signing.guard import Guard, Mode, PortGuard
from stommel.link.signing.refusals import Refusal
from stommel.link.signing.signature import signed
from stommel.link.signing.stamps import AHEAD, LIMIT, NAME, PER_SECOND, stamp_of
from stommel.messages.mavlink import message_named
from tests.link.signing.ends import (
    CLOCK,
    HEARTBEAT,
    KEY,
    OTHER,
    VEHICLE,
    End,
    keys_of,
    raw_frame,
    seeded,
    shore,
    talk,
    understand,
    vehicle,
)  # fmt: skip

HOSTILE = int(os.environ.get("STOMMEL_HOSTILE_FRAMES", "20000")) // 10
"""Frames of each kind; the figure of 1 000 000 is measured by setting the variable to ten times as many."""
DAY = 86400.0
PAYLOAD = b"\2\0\0\0\x0a\0\0\4\3"


def forged(secret: bytes, stamp: int, link: int = 0, system: int = 255) -> bytes:
    frame = frame_bytes(HEARTBEAT, PAYLOAD, system, 190, 5, signed=True)
    return signed(frame, secret, link, stamp)


Attack = Callable[[list[bytes], random.Random, int], bytes]


def replayed(heard: list[bytes], draw: random.Random, now: int) -> bytes:
    return draw.choice(heard[-5:]) if draw.random() < 0.5 else draw.choice(heard)


def unsigned(heard: list[bytes], draw: random.Random, now: int) -> bytes:
    return frame_bytes(HEARTBEAT, PAYLOAD, draw.choice((255, 254, 1)), 190, draw.randrange(256))


def any_stamp(draw: random.Random, now: int) -> int:
    return draw.choice((0, now + 1, now + draw.randrange(1 << 30), draw.randrange(LIMIT), LIMIT - 1, now + AHEAD))


def wrongly_signed(heard: list[bytes], draw: random.Random, now: int) -> bytes:
    """The frame heard last, its signature changed and its stamp any."""
    raw = bytearray(heard[-1])
    raw[-12:-6] = any_stamp(draw, now).to_bytes(6, "little")
    raw[-6:] = draw.randbytes(6)
    return bytes(raw)


def other_key(heard: list[bytes], draw: random.Random, now: int) -> bytes:
    return forged(OTHER.secret, any_stamp(draw, now), draw.randrange(2), draw.choice((255, 254)))


@pytest.mark.parametrize(
    ("attack", "reasons"),
    [
        (replayed, {Refusal.REPLAYED}),
        (unsigned, {Refusal.UNSIGNED}),
        (wrongly_signed, {Refusal.WRONGLY_SIGNED}),
        (other_key, {Refusal.WRONGLY_SIGNED}),
    ],
    ids=["replayed", "unsigned", "wrongly signed", "other vehicle's key"],
)
def test_none_is_accepted_and_the_next_genuine_frame_is(attack: Attack, reasons: set[Refusal]) -> None:
    """Field report ArduPilot/pymavlink#961: after each hostile frame, with any stamp, a genuine one is accepted."""
    draw = random.Random(3)
    end, sender = vehicle(), shore()
    heard = [sender.say(0.0)]
    assert end.hears(heard[0], 0.0)
    for number in range(HOSTILE):
        t = 0.01 * number
        assert not end.hears(attack(heard, draw, stamp_of(CLOCK + t)), t)
        genuine = sender.say(t)
        assert end.hears(genuine, t)
        heard = [*heard[-200:], genuine]
    assert set(end.guard.refusals.by_reason) == reasons
    assert end.guard.refusals.by_reason.total() == HOSTILE


def test_each_frame_is_accepted_once_and_in_its_order() -> None:
    """Stamps rise strictly, as MAVLink says: what overtakes makes what it has overtaken a replay."""
    end, sender = vehicle(), shore()
    first, second, third = (sender.say(0.1 * number) for number in range(3))
    assert [end.hears(raw, 1.0) for raw in (first, third, second, third, first)] == [True, True, False, False, False]


def test_our_own_frames_sent_back_are_refused() -> None:
    """Both ends have the same key: a mirror would else command the vehicle with its own words."""
    end = vehicle()
    mirrored = [end.say(float(number)) for number in range(5)]
    assert not any(end.hears(raw, 6.0) for raw in mirrored)
    assert end.guard.refusals.by_reason == {Refusal.REFLECTED: 5}


def test_a_frame_that_nobody_heard_is_worth_nothing_a_quarter_of_an_hour_later() -> None:
    """Held back while the vehicle was submerged."""
    end, sender = vehicle(), shore()
    talk(sender, end, 0.0)
    held = sender.say(10.0)
    assert not end.hears(held, 1000.0)
    assert end.guard.refusals.by_reason == {Refusal.STALE: 1}
    assert understand(sender, end, 1000.0)


CLOCKS = [CLOCK, CLOCK - 600.0, CLOCK + 600.0, CLOCK + 20 * DAY, 0.0]


@pytest.mark.parametrize("vehicle_clock", CLOCKS)
@pytest.mark.parametrize("shore_clock", CLOCKS)
@pytest.mark.parametrize("vehicle_first", [True, False])
def test_start_order_and_clocks_do_not_matter(vehicle_clock: float, shore_clock: float, vehicle_first: bool) -> None:
    """Field reports mavlink/qgroundcontrol#14375 and ArduPilot/ardupilot#13860; also after each has started again."""
    boat, land = vehicle(clock=vehicle_clock), shore(clock=shore_clock)
    one, other = (boat, land) if vehicle_first else (land, boat)
    t = 0.0
    for _ in range(3):
        one.say(t)
        one.say(t + 500.0)
        t = talk(one, other, t + 500.0, 2.0)
        assert understand(boat, land, t)
        boat.start(vehicle_clock)
        t = talk(one, other, t, 2.0)
        assert understand(boat, land, t)
        land.start(shore_clock)


@pytest.mark.parametrize("days", [1, 25, 300])
def test_a_vehicle_that_lay_in_its_box_talks_again(days: int) -> None:
    """Its clock stopped, and the shore has gone on."""
    boat, land = vehicle(), shore()
    t = talk(boat, land, 0.0)
    boat.start(0.0)
    later = t + days * DAY
    for step in range(3):
        for frame in boat.poll(t + step):
            land.hear(frame, later + step)
        for frame in land.poll(later + step):
            boat.hear(frame, t + step)
    assert boat.hears(land.say(later + 5.0), t + 5.0)
    assert land.hears(boat.say(t + 6.0), later + 6.0)


def test_a_station_whose_clock_is_wrong_by_years_is_named_and_harms_nobody() -> None:
    """It holds the key, so its signature is right; what it says of the time is not taken."""
    end, sender = vehicle(), shore()
    assert not end.hears(forged(KEY.secret, stamp_of(CLOCK + 10 * 366 * DAY), system=254), 0.0)
    assert "stamps of 254/190 are 10 years ahead of ours: its clock is wrong" in end.guard.status
    assert end.hears(sender.say(0.0), 0.0)
    assert end.hears(forged(KEY.secret, stamp_of(CLOCK + 1.0), system=254), 1.0)
    assert not [line for line in end.guard.status if line.startswith("stamps of")]


def test_a_clock_that_was_ahead_and_is_set_right_locks_nobody_out() -> None:
    """A station says stamps of next month, and then of now: it hears the vehicle and is above it again."""
    end, sender = vehicle(), shore(clock=CLOCK + 29 * DAY)
    assert end.hears(sender.say(0.0), 0.0)
    again = shore(clock=CLOCK)
    assert not end.hears(again.say(1.0), 1.0)
    assert again.hears(end.say(2.0), 2.0)
    assert end.hears(again.say(3.0), 3.0)


# no key, bench, unsigned


@pytest.mark.parametrize("signature", [None, KEY, OTHER])
def test_without_a_key_nothing_is_accepted_but_on_the_bench(signature: object) -> None:
    """Field report PX4/PX4-Autopilot#26847: there everything was accepted."""
    end = vehicle()
    end.keys.keys = None
    end.start(CLOCK)
    sender = shore(None if signature is not OTHER else keys_of(OTHER))
    raw = sender.say(0.0) if signature else unsigned([], random.Random(1), 0)
    assert end.guard.mode is Mode.NO_KEY
    assert end.guard.alarm
    assert not end.hears(raw, 0.0)
    assert PortGuard(end.guard, 1, bench=True).accept(raw_frame(raw), 0.0)
    assert end.guard.status[0] == (
        "no key: nothing is accepted but on the bench: zju-1.key: cannot be read: No such file or directory"
    )
    assert end.guard.refusals.wrongly_signed == 1
    assert not end.port.signs


def test_unsigned_mode_is_chosen_and_visible() -> None:
    guard = Guard.unsigned(VEHICLE)
    port = PortGuard(guard)
    assert guard.mode is Mode.UNSIGNED
    assert not port.signs
    assert port.accept(raw_frame(unsigned([], random.Random(1), 0)), 0.0)
    assert guard.status == ["unsigned mode: whoever is heard may command"]


@pytest.mark.parametrize("guard", [vehicle().guard, Guard.unsigned(VEHICLE)], ids=["signing", "unsigned"])
def test_a_key_in_clear_is_refused_off_the_bench(guard: Guard) -> None:
    end = shore()
    values = {"target_system": VEHICLE, "target_component": 1, "secret_key": OTHER.secret, "initial_timestamp": 1}
    raw = end.say(0.0, "SETUP_SIGNING", message_named("SETUP_SIGNING").pack(values))
    assert not PortGuard(guard).accept(raw_frame(raw), 0.0)
    assert guard.refusals.by_reason == {Refusal.KEY_IN_CLEAR: 1}


def test_a_key_in_clear_is_taken_on_the_bench() -> None:
    """Also where there was none."""
    end = vehicle()
    end.keys.keys = None
    end.start(CLOCK)
    end.port = PortGuard(end.guard, 0, bench=True)
    setup = message_named("SETUP_SIGNING")
    for secret in (bytes(32), OTHER.secret):
        values = {"target_system": 1, "target_component": 1, "secret_key": secret, "initial_timestamp": 37 * 10**12}
        end.hear(frame_bytes(setup, setup.pack(values), 255, 190, 0), 0.0)
        assert end.guard.mode is (Mode.SIGNING if any(secret) else Mode.NO_KEY)
    assert end.answer.notes == ["no key was taken: zeros are none, and signing is not ended over the link"]
    end.port = PortGuard(end.guard)
    assert understand(end, shore(keys_of(OTHER)), 1.0)


def test_counts_are_those_of_link_statistics() -> None:
    end, sender = vehicle(), shore()
    raw = sender.say(0.0)
    draw = random.Random(1)
    for frame in (raw, raw, other_key([], draw, 1), other_key([], draw, 1), unsigned([], draw, 1)):
        end.hear(frame, 0.0)
    counts = end.guard.refusals
    assert (counts.replayed, counts.wrongly_signed, counts.unsigned) == (1, 2, 1)
    assert "1 refused: unsigned" in counts.sentences


def test_a_frame_signed_for_another_vehicle_is_named_where_its_key_is_known() -> None:
    end = shore()
    end.guard = Guard(255, end.keys, end.disk, CLOCK, seeded(1), {"zju-2": OTHER})
    end.port = PortGuard(end.guard)
    assert not end.hears(forged(OTHER.secret, stamp_of(CLOCK), system=2), 0.0)
    assert end.guard.refusals.by_reason == {Refusal.OTHER_KEY: 1}
    assert "heard frames signed with the key of zju-2" in end.guard.status


# stamps lost


def lost(end: End, *, damaged: bool) -> None:
    """The file of stamps is gone, and the clock is at 1970."""
    if damaged:
        end.disk.files[NAME].data[10] ^= 1
    else:
        end.disk.remove(NAME)
    end.start(0.0)


@pytest.mark.parametrize("damaged", [False, True])
@pytest.mark.parametrize("who", ["vehicle", "shore", "both"])
def test_an_end_without_stamps_asks_for_proof_and_obeys_no_recording(damaged: bool, who: str) -> None:
    boat, land = vehicle(), shore()
    recorded = []
    t = 0.0
    for _ in range(20):
        t += 1.0
        for frame in land.poll(t):
            recorded.append(frame)
            boat.hear(frame, t)
        for frame in boat.poll(t):
            land.hear(frame, t)
    for end in (boat, land):
        if who in ("both", "vehicle" if end is boat else "shore"):
            lost(end, damaged=damaged)
            assert end.guard.alarm
    if who != "shore":
        assert not [raw for raw in recorded if boat.hears(raw, t)]
    t = talk(boat, land, t, 12.0)
    assert not boat.guard.alarm
    assert not land.guard.alarm
    assert understand(boat, land, t)
    assert not [raw for raw in recorded if boat.hears(raw, t)]
    boat.start(0.0)
    assert not [raw for raw in recorded if boat.hears(raw, t)]
    assert understand(boat, land, talk(boat, land, t, 2.0))


def test_an_answer_to_an_older_question_is_no_proof() -> None:
    boat, land = vehicle(), shore()
    talk(boat, land, 0.0)
    lost(boat, damaged=True)
    (question, _) = boat.poll(10.0)
    land.hear(question, 10.0)
    (answer,) = [raw for raw in land.poll(10.0) if raw_frame(raw).message.name == "KEY_CHALLENGE_ANSWER"]
    boat.start(0.0)
    assert boat.guard.in_doubt
    assert not boat.hears(answer, 11.0)
    assert boat.guard.in_doubt


def test_an_old_question_is_answered_but_not_accepted() -> None:
    """Nobody gains by it: the answer is good for who asks now, and that was the recorded one then."""
    boat, land = vehicle(), shore()
    talk(boat, land, 0.0)
    lost(boat, damaged=True)
    question = boat.poll(10.0)[0]
    talk(boat, land, 10.0, 10.0)
    count = land.guard.refusals.by_reason[Refusal.REPLAYED]
    for number in range(50):
        assert not land.hears(question, 30.0 + 0.01 * number)
    assert land.guard.refusals.by_reason[Refusal.REPLAYED] == count + 50
    said = [frame for number in range(50) for frame in land.poll(31.0 + 0.001 * number)]
    assert sum(raw_frame(frame).message.name == "KEY_CHALLENGE_ANSWER" for frame in said) == 1


def test_a_key_copied_before_its_first_use_needs_no_proof() -> None:
    """So that ordinary ground software, which knows no questions of ours, is understood from the first frame on."""
    boat = vehicle()
    assert boat.hears(forged(KEY.secret, int((CLOCK - 1_420_070_400) * PER_SECOND) + 7), 0.0)
    assert boat.keys.read().unused is False
    boat.disk.remove(NAME)
    boat.start(CLOCK)
    assert boat.guard.in_doubt


def test_two_sessions_with_guards_talk_and_a_stranger_is_not_heard() -> None:
    """Through the session itself: every frame that leaves is signed, and a session of another key is refused whole."""
    boat, land = vehicle(), shore()
    stranger = shore(keys_of(OTHER))
    ends = {}
    for end in (boat, land, stranger):
        ends[end] = Session(end.system, end.component, [end.challenge, Beating()], end.port)
    for t in range(1, 20):
        said = {end: session.poll(float(t), 1000) for end, session in ends.items()}
        assert ends[boat].take(said[land], float(t))
        assert not ends[boat].take(said[stranger], float(t))
        assert ends[land].take(said[boat], float(t))
        assert not ends[stranger].take(said[boat], float(t))
    assert boat.guard.refusals.by_reason == {Refusal.WRONGLY_SIGNED: 19}


class Beating:
    """Says one heartbeat a second."""

    def __init__(self) -> None:
        self._said = -1.0

    def take(self, received: Received, t: float) -> None:
        pass

    def poll(self, t: float, outbox: Outbox) -> None:
        if t > self._said:
            outbox.put(Priority.STATE, "HEARTBEAT", {"type": 2, "mavlink_version": 3})
            self._said = t
