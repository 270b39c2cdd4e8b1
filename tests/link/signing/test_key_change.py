"""Oracle: whether both ends understand each other afterwards, and with which key; whatever was lost, cut or refused."""

import itertools
import random

import pytest
from cryptography.hazmat.primitives.asymmetric.x25519 import X25519PrivateKey

from stommel.link.signing.guard import Guard, PortGuard
from stommel.link.signing.key_change import ChangeState, KeyAnswer, derived_key
from stommel.link.signing.refusals import Refusal
from stommel.link.signing.signature import holds, signed
from stommel.messages.mavlink import enumeration, message_named
from tests.link.signing.ends import CLOCK, KEY, OTHER, VEHICLE, End, raw_frame, shore, talk, understand, vehicle
from tests.onboard.coordination.disk import PowerCutError

CHANGES = ("KEY_CHANGE_OFFER", "KEY_CHANGE_ANSWER", "KEY_CHANGE_CONFIRM", "KEY_CHANGE_REFUSED")


def pair() -> tuple[End, End, float]:
    """A vehicle and its shore that have talked."""
    boat, land = vehicle(), shore()
    return boat, land, talk(boat, land, 0.0)


class Air:
    """Frames between both ends, some of which are lost by their number."""

    def __init__(self, lost: set[int] | None = None, share: float = 0.0, seed: int = 0) -> None:
        self.lost, self.share, self.count = lost or set(), share, 0
        self.heard: list[bytes] = []
        self._draw = random.Random(seed)

    def carry(self, one: End, other: End, t: float) -> None:
        for frame in one.poll(t):
            self.count += 1
            if self.count - 1 not in self.lost and self._draw.random() >= self.share:
                self.heard.append(frame)
                other.hear(frame, t)

    def change(self, boat: End, land: End, t: float, seconds: int = 100) -> float:
        """Let the shore ask for a new key, and both talk."""
        land.offer.start(t, seconds - 5.0)
        for _ in range(seconds):
            t += 1.0
            self.carry(land, boat, t)
            self.carry(boat, land, t)
        return t


def test_a_change_ends_with_a_new_key_that_nobody_else_has() -> None:
    boat, land, t = pair()
    air = Air()
    t = air.change(boat, land, t, 10)
    assert land.offer.outcome.state is ChangeState.DONE
    assert boat.keys.keys == land.keys.keys
    (new, held) = (land.keys.read().current, land.keys.read().next)
    assert new not in (KEY, OTHER)
    assert held is None
    assert understand(boat, land, t)
    assert not boat.hears(shore(land.keys.keys._replace(current=KEY)).say(t + 9.0), t + 9.0)  # type: ignore[union-attr]
    for frame in air.heard:  # the new key follows from nothing that was said
        assert new.secret not in frame
    assert not [frame for frame in air.heard if boat.hears(frame, t) or land.hears(frame, t)]


def test_the_same_new_key_follows_at_both_ends_and_another_from_another_old_one() -> None:
    """Oracle: Diffie and Hellman's symmetry."""
    one, other = (X25519PrivateKey.from_private_bytes(bytes((number,)) * 32) for number in (1, 2))
    publics = [private.public_key().public_bytes_raw() for private in (one, other)]
    said = b"".join(publics)
    assert derived_key(one, publics[1], KEY, said) == derived_key(other, publics[0], KEY, said)
    assert derived_key(one, publics[1], KEY, said) != derived_key(one, publics[1], OTHER, said)
    with pytest.raises(ValueError, match=r"."):
        derived_key(one, bytes(32), KEY, said)  # a point of small order, whose secret everybody knows


@pytest.mark.parametrize("number", range(24))
def test_any_lost_frame_leaves_both_ends_talking(number: int) -> None:
    """Each frame in turn, of changes and heartbeats alike; the change is repeated and ends."""
    boat, land, t = pair()
    t = Air({number}).change(boat, land, t)
    assert land.offer.outcome.state is ChangeState.DONE
    assert boat.keys.keys == land.keys.keys
    assert understand(boat, land, t)


@pytest.mark.parametrize("first", range(12))
def test_silence_from_any_frame_on_leaves_both_ends_talking(first: int) -> None:
    """Everything from a frame on is lost until the change has failed; afterwards both hear each other at once or soon,
    and another change ends."""
    boat, land, t = pair()
    t = Air(set(range(first, 10_000))).change(boat, land, t)
    assert land.offer.outcome.state in (ChangeState.FAILED, ChangeState.DONE)
    t = talk(boat, land, t, 2.0)
    assert understand(boat, land, t)
    t = Air().change(boat, land, t, 10)
    assert land.offer.outcome.state is ChangeState.DONE
    assert understand(boat, land, t)


def test_a_message_of_one_kind_that_never_arrives_leaves_the_old_key() -> None:
    """Field report mavlink/qgroundcontrol#14250: a station that changes before the vehicle has agreed is deaf."""
    for kind in CHANGES[:3]:
        boat, land, t = pair()
        land.offer.start(t, 60.0)
        for _ in range(70):
            t += 1.0
            for one, other in ((land, boat), (boat, land)):
                for frame in one.poll(t):
                    if raw_frame(frame).message.name != kind:
                        other.hear(frame, t)
        assert land.offer.outcome.state is ChangeState.FAILED
        assert land.offer.outcome.reason
        assert boat.keys.read().current == land.keys.read().current == KEY
        assert understand(boat, land, t)


@pytest.mark.parametrize(
    ("who", "writes", "after", "both"),
    list(itertools.product(("boat", "land"), range(3), (False, True), (False, True))),
)
def test_either_end_killed_at_any_write_of_its_key_file(who: str, writes: int, after: bool, both: bool) -> None:
    """Before and after the write has taken place; the other end goes on, or is started again as well."""
    boat, land, t = pair()
    victim, other = (boat, land) if who == "boat" else (land, boat)
    victim.keys.writes_left, victim.keys.cut_after_write = writes, after
    try:
        t = Air().change(boat, land, t, 20)
    except PowerCutError:
        t += 20.0
    victim.keys.writes_left = None
    victim.start(0.0)
    if both:
        other.start(0.0)
    t = talk(boat, land, t, 3.0)
    assert understand(boat, land, t)
    t = Air().change(boat, land, t, 20)
    assert land.offer.outcome.state is ChangeState.DONE
    assert boat.keys.keys == land.keys.keys
    assert understand(boat, land, t)


@pytest.mark.parametrize(("who", "at"), list(itertools.product(("boat", "land", "both"), range(16))))
def test_either_end_killed_between_any_two_frames(who: str, at: int) -> None:
    boat, land, t = pair()
    land.offer.start(t, 60.0)
    count = 0
    for _ in range(8):
        t += 1.0
        for one, other in ((land, boat), (boat, land)):
            for frame in one.poll(t):
                if count == at:
                    for end in (boat, land):
                        if who in ("both", "boat" if end is boat else "land"):
                            end.start(0.0)
                count += 1
                other.hear(frame, t)
    t = talk(boat, land, t, 3.0)
    assert understand(boat, land, t)
    t = Air().change(boat, land, t, 20)
    assert land.offer.outcome.state is ChangeState.DONE
    assert understand(boat, land, t)


def test_anything_at_random_leaves_both_ends_talking() -> None:
    """Losses of half the frames, restarts, full disks and held-back frames, many changes in a row."""
    for seed in range(60):
        draw = random.Random(seed)
        boat, land, t = pair()
        air = Air(share=0.5, seed=seed)
        for _ in range(120):
            t += 1.0
            if draw.random() < 0.1:
                land.offer.start(t, 30.0)
            for end in (boat, land):
                if draw.random() < 0.03:
                    end.start(draw.choice((0.0, CLOCK, CLOCK + 1e6)))
                end.keys.broken = draw.random() < 0.1
            for one, other in ((land, boat), (boat, land)):
                air.carry(one, other, t)
                if air.heard and draw.random() < 0.3:
                    other.hear(draw.choice(air.heard[-10:]), t)
        boat.keys.broken = land.keys.broken = False
        t = talk(boat, land, t, 15.0)
        assert understand(boat, land, t), seed
        Air().change(boat, land, t, 20)
        assert boat.keys.keys == land.keys.keys, seed


def test_a_confirmation_that_is_held_back_for_an_hour_locks_nobody_out() -> None:
    """An attacker keeps it while the shore gives up. Played in time it is obeyed; an hour later it is too old to be,
    yet tells that the shore holds the new key. Either way the change that the shore gave up ends with the new key."""
    for later in (5.0, 3600.0):
        boat, land, t = pair()
        land.offer.start(t, 20.0)
        held: list[bytes] = []
        for _ in range(30):
            t += 1.0
            for frame in land.poll(t):
                if raw_frame(frame).message.name == "KEY_CHANGE_CONFIRM":
                    held.append(frame)
                elif not held:
                    boat.hear(frame, t)
            for frame in boat.poll(t):
                land.hear(frame, t)
        assert held
        assert land.offer.outcome.state is ChangeState.FAILED
        assert boat.hears(held[-1], t + later) is (later < 900.0)
        t = talk(boat, land, t + later, 3.0)
        assert understand(boat, land, t)
        assert boat.keys.keys == land.keys.keys
        assert boat.keys.read().current != KEY


def test_an_offer_that_is_repeated_before_its_answer_came_changes_nothing() -> None:
    """A round trip of 20 s, longer than the first time-outs: the vehicle says one public key, however often."""
    boat, land, t = pair()
    land.offer.start(t)
    under_way: list[tuple[float, End, bytes]] = []
    for _ in range(100):
        t += 1.0
        for one, other in ((land, boat), (boat, land)):
            under_way += [(t + 10.0, other, frame) for frame in one.poll(t)]
        for due, end, frame in under_way:
            if due == t:
                end.hear(frame, t)
    assert land.offer.outcome.state is ChangeState.DONE
    answers = [raw_frame(frame) for _, _, frame in under_way if raw_frame(frame).message.name == "KEY_CHANGE_ANSWER"]
    assert len(answers) > 1
    assert len({answer.payload for answer in answers}) == 1


def test_a_vehicle_that_restarts_and_answers_again_is_believed() -> None:
    """It has forgotten its first answer, and holds the key of the second alone."""
    boat, land, t = pair()
    land.offer.start(t)
    answers = []
    for later in (1.0, 60.0):
        offer = land.poll(t + later)[0]
        assert boat.hears(offer, t + later)
        answers.append(boat.poll(t + later)[0])
        if later == 1.0:
            boat.start(0.0)
    t += 61.0
    for answer in answers:
        assert land.hear(answer, t) == ["KEY_CHANGE_ANSWER"]
        boat.hear(land.poll(t)[0], t)
    talk(boat, land, t)
    assert land.offer.outcome.state is ChangeState.DONE


# refusals


@pytest.mark.parametrize("broken", ["boat", "land"])
def test_a_key_file_that_cannot_be_written_ends_the_change_with_a_reason(broken: str) -> None:
    boat, land, t = pair()
    (boat if broken == "boat" else land).keys.broken = True
    t = Air().change(boat, land, t, 20)
    outcome = land.offer.outcome
    assert outcome.state is ChangeState.FAILED
    words = "the vehicle refuses: its disk does not keep the key" if broken == "boat" else "No space left on device"
    assert words in outcome.reason
    assert (boat if broken == "boat" else land).guard.keys.next is None  # type: ignore[union-attr]
    assert boat.keys.read().current == land.keys.read().current == KEY
    assert understand(boat, land, t)


@pytest.mark.parametrize("broken", ["boat", "land"])
def test_a_disk_that_fails_at_the_last_write_leaves_both_talking(broken: str) -> None:
    boat, land, t = pair()
    end = boat if broken == "boat" else land
    land.offer.start(t, 40.0)
    for _ in range(50):
        t += 1.0
        for one, other in ((land, boat), (boat, land)):
            for frame in one.poll(t):
                other.hear(frame, t)
                end.keys.broken = end.keys.read().next is not None
        assert understand(boat, land, t)
    assert end.guard.alarm
    assert "key file here cannot be written" in land.offer.outcome.reason or broken == "boat"
    for _ in range(2):
        end.start(0.0)
        end.keys.broken = True
        t = talk(boat, land, t, 3.0)
        assert understand(boat, land, t)
        land.offer.start(t, 5.0)  # may not overwrite the one key in common
        t = talk(boat, land, t, 8.0)
        assert understand(boat, land, t)
    end.keys.broken = False
    Air().change(boat, land, talk(boat, land, t, 15.0), 20)
    assert land.offer.outcome.state is ChangeState.DONE
    assert boat.keys.keys == land.keys.keys
    assert not end.guard.alarm


def asked(answer: KeyAnswer, port: PortGuard, raw: bytes) -> list[tuple[str, dict[str, object]]]:
    """What a vehicle says to an offer."""
    from stommel.link.outbox import Outbox
    from stommel.link.service import Received

    frame = raw_frame(raw)
    if port.accept(frame, 0.0):
        values = frame.message.unpack(frame.payload)
        answer.take(Received(frame.system, frame.component, frame.message.name, values), 0.0)
    outbox = Outbox()
    answer.poll(0.0, outbox)
    said = []
    while (outgoing := outbox.next()) is not None:
        said.append((outgoing.name, dict(message_named(outgoing.name).unpack(outgoing.payload))))
    return said


def test_the_unsigned_mode_changes_no_key() -> None:
    """Whoever is heard could."""
    guard, land = Guard.unsigned(VEHICLE), shore()
    land.offer.start(0.0)
    said = asked(KeyAnswer(guard, random.Random(1).randbytes), PortGuard(guard), land.poll(0.0)[0])
    reason = enumeration("KEY_CHANGE_REFUSAL")["KEY_CHANGE_REFUSAL_NOT_SIGNING"]
    assert [(name, values["reason"]) for name, values in said] == [("KEY_CHANGE_REFUSED", reason)]


def test_an_offer_of_a_bad_point_is_refused() -> None:
    boat, land, t = pair()
    values = {"change": 7, "target_system": VEHICLE, "target_component": 1, "public_key": bytes(32)}
    raw = land.say(t, "KEY_CHANGE_OFFER", message_named("KEY_CHANGE_OFFER").pack(values))
    ((name, said),) = asked(boat.answer, boat.port, raw)
    assert (name, said["change"]) == ("KEY_CHANGE_REFUSED", 7)
    assert said["reason"] == enumeration("KEY_CHANGE_REFUSAL")["KEY_CHANGE_REFUSAL_BAD_KEY"]
    assert boat.keys.read().next is None


def test_an_offer_that_is_not_signed_with_the_key_changes_nothing() -> None:
    boat, land, _ = pair()
    land.offer.start(5.0)
    raw = land.poll(5.0)[0]
    for frame in (signed(raw[:-13], OTHER.secret, 0, 37 * 10**12 + 10**7), raw[:2] + b"\0" + raw[3:-13]):
        boat.hear(frame, 5.0)
    assert boat.keys.read().next is None
    assert boat.guard.refusals.by_reason[Refusal.WRONGLY_SIGNED] == 1


def test_without_a_key_no_change_begins() -> None:
    land = shore()
    land.keys.keys = None
    land.start(CLOCK)
    land.offer.start(0.0)
    assert land.offer.outcome == (ChangeState.FAILED, "this end has no key, or signs nothing")


def test_all_but_the_confirmation_is_signed_with_the_old_key_until_the_vehicle_has_spoken() -> None:
    boat, land, t = pair()
    land.offer.start(t)
    said: list[bytes] = []
    for _ in range(3):
        t += 1.0
        frames = land.poll(t)
        said += frames
        for frame in frames:
            if raw_frame(frame).message.name != "KEY_CHANGE_CONFIRM":
                boat.hear(frame, t)
        for frame in boat.poll(t):
            said.append(frame)
            land.hear(frame, t)
    names = {raw_frame(frame).message.name: holds(frame, KEY.secret) for frame in said}
    assert names == {
        "HEARTBEAT": True, "KEY_CHANGE_OFFER": True, "KEY_CHANGE_ANSWER": True, "KEY_CHANGE_CONFIRM": False,
    }  # fmt: skip
