"""A new key over the radio, in two phases, after which no end is ever without a key that the other one holds.

Both ends send a public key of X25519 in frames signed with the old key, and derive the new key from what they then
share and from the old one. Each keeps it beside the old one before it says so, and drops the old one only when it has
heard a frame signed with the new one. The offerer's confirmation is the first such frame; whatever the vehicle says
after it is the next. Until then every frame but the confirmation is signed with the old key.
"""

from collections.abc import Callable
from enum import StrEnum
from typing import NamedTuple

from cryptography.hazmat.primitives.asymmetric.x25519 import X25519PrivateKey, X25519PublicKey
from cryptography.hazmat.primitives.hashes import SHA256
from cryptography.hazmat.primitives.kdf.hkdf import HKDF

from stommel.errors import StommelError
from stommel.link.outbox import Outbox, Priority
from stommel.link.service import VEHICLE_COMPONENT, Received, is_for
from stommel.link.signing.guard import Guard, Mode
from stommel.link.signing.keys import FIRST_MADE, LAST_MADE, SIZE, Key
from stommel.link.signing.stamps import EPOCH, PER_SECOND
from stommel.link.timing import RetransmissionTimer
from stommel.link.values import octets, whole
from stommel.messages.mavlink import Fields, FieldValue, enumeration

TIME_LIMIT = 300.0
"""A change that takes longer has failed [s]."""
_REFUSALS = {
    "KEY_CHANGE_REFUSAL_NOT_SIGNING": "it has no key, or signs nothing",
    "KEY_CHANGE_REFUSAL_NOT_KEPT": "its disk does not keep the key",
    "KEY_CHANGE_REFUSAL_BAD_KEY": "our public key is none",
}


class ChangeState(StrEnum):
    """How far a change is."""

    IDLE = "idle"
    OFFERED = "offered"
    CONFIRMED = "confirmed"
    """Both ends hold the new key; the vehicle has not spoken with it yet."""
    DONE = "done"
    FAILED = "failed"


class ChangeOutcome(NamedTuple):
    """Where a change stands."""

    state: ChangeState
    reason: str = ""
    """Why it failed; the old key works then."""


def derived_key(private: X25519PrivateKey, public: bytes, old: Key, said: bytes) -> Key:
    """Return the key that follows from the own private key, the other's public one, the old key, and what was said.

    Raises
    ------
    ValueError
        The public key is none.
    """
    shared = private.exchange(X25519PublicKey.from_public_bytes(public))
    return Key(HKDF(SHA256(), SIZE, old.secret, b"stommel link key" + said).derive(shared))


def new_private(random: Callable[[int], bytes]) -> X25519PrivateKey:
    """Make a private key of X25519 for one change."""
    return X25519PrivateKey.from_private_bytes(random(SIZE))


def _public(private: X25519PrivateKey) -> bytes:
    return private.public_key().public_bytes_raw()


def _said(vehicle: int, offered: bytes, answered: bytes) -> bytes:
    return bytes((vehicle,)) + offered + answered


class KeyOffer:
    """The shore's side: asks a vehicle for a new key."""

    def __init__(self, guard: Guard, vehicle: int, random: Callable[[int], bytes]) -> None:
        self._guard, self._vehicle, self._random = guard, vehicle, random
        self.outcome = ChangeOutcome(ChangeState.IDLE)
        self._private = new_private(random)
        self._number = 0
        self._old: Key | None = None
        self._answer = b""
        self._due = self._deadline = 0.0
        self._timer = RetransmissionTimer()

    def start(self, t: float, limit: float = TIME_LIMIT) -> None:
        """Begin a change, which ends within a time [s]."""
        if self._guard.mode is not Mode.SIGNING or self._guard.keys is None:
            self.outcome = ChangeOutcome(ChangeState.FAILED, "this end has no key, or signs nothing")
            return
        self._private = new_private(self._random)
        self._number = int.from_bytes(self._random(4), "little")
        self._old, self._answer = self._guard.keys.current, b""
        self._due, self._deadline, self._timer = t, t + limit, RetransmissionTimer()
        self.outcome = ChangeOutcome(ChangeState.OFFERED)

    @property
    def _runs(self) -> bool:
        return self.outcome.state in (ChangeState.OFFERED, ChangeState.CONFIRMED)

    def take(self, received: Received, t: float) -> None:
        """Take what the vehicle says; the guard has seen which key it was signed with."""
        if not self._runs or (received.system, received.component) != (self._vehicle, VEHICLE_COMPONENT):
            return
        if received.values.get("change") != self._number:
            return
        if received.name == "KEY_CHANGE_ANSWER":
            self._take_answer(octets(received.values, "public_key"), t)
        elif received.name == "KEY_CHANGE_REFUSED":
            names = {number: name for name, number in enumeration("KEY_CHANGE_REFUSAL").items()}
            reason = _REFUSALS.get(names.get(whole(received.values, "reason"), ""), "for a reason unknown here")
            self.outcome = ChangeOutcome(ChangeState.FAILED, f"the vehicle refuses: {reason}")

    def _take_answer(self, answer: bytes, t: float) -> None:
        """Hold the key that follows; a vehicle that has restarted meanwhile answers with another one, which counts."""
        if answer == self._answer or self._old is None:
            return
        said = _said(self._vehicle, _public(self._private), answer)
        try:
            self._guard.hold(derived_key(self._private, answer, self._old, said))
        except ValueError:
            self.outcome = ChangeOutcome(ChangeState.FAILED, "the vehicle's public key is none")
        except StommelError as error:
            self.outcome = ChangeOutcome(ChangeState.FAILED, str(error))
        else:
            self._answer, self._due, self._timer = answer, t, RetransmissionTimer()
            self.outcome = ChangeOutcome(ChangeState.CONFIRMED)

    def poll(self, t: float, outbox: Outbox) -> None:
        """Say what is due."""
        if not self._runs:
            return
        if self._guard.keys is not None and self._guard.keys.current != self._old:
            self.outcome = ChangeOutcome(ChangeState.DONE)
        elif t >= self._deadline:
            self.outcome = ChangeOutcome(ChangeState.FAILED, self._why_late())
        elif t >= self._due:
            self._say(t, outbox)

    def _why_late(self) -> str:
        if self.outcome.state is ChangeState.OFFERED:
            return "the vehicle did not answer in time"
        if self._guard.peer_has_next:
            return (
                "the vehicle speaks with the new key, but the key file here cannot be written; both keys are accepted"
            )
        return "the vehicle did not speak with the new key in time; both keys are accepted"

    def _say(self, t: float, outbox: Outbox) -> None:
        values: dict[str, FieldValue] = {
            "change": self._number, "target_system": self._vehicle, "target_component": VEHICLE_COMPONENT,
        }  # fmt: skip
        if self.outcome.state is ChangeState.OFFERED:
            outbox.put(Priority.COMMAND, "KEY_CHANGE_OFFER", values | {"public_key": _public(self._private)})
        else:
            outbox.put(Priority.COMMAND, "KEY_CHANGE_CONFIRM", values)
        self._due = t + self._timer.time_out
        self._timer.back_off()


class KeyAnswer:
    """The vehicle's side; it also takes a key in clear, which the guard lets through on the bench alone."""

    def __init__(self, guard: Guard, random: Callable[[int], bytes], component: int = VEHICLE_COMPONENT) -> None:
        self._guard, self._random, self._component = guard, random, component
        self._waiting: list[tuple[str, Fields]] = []
        self._answered: tuple[int, bytes] | None = None
        self._answer = b""
        self.notes: list[str] = []
        """What became of keys that were given on the bench, the last few."""

    def take(self, received: Received, t: float) -> None:  # noqa: ARG002
        """Take an offer, or a key on the bench."""
        if not is_for(received, self._guard.system, self._component):
            return
        if received.name == "KEY_CHANGE_OFFER":
            self._take_offer(received)
        elif received.name == "SETUP_SIGNING":
            self._take_key_in_clear(received.values)

    def poll(self, t: float, outbox: Outbox) -> None:  # noqa: ARG002
        """Answer."""
        for name, values in self._waiting:
            outbox.put(Priority.COMMAND, name, values)
        self._waiting.clear()

    def _take_offer(self, received: Received) -> None:
        number, offered = whole(received.values, "change"), octets(received.values, "public_key")
        to: Fields = {
            "change": number, "target_system": received.system, "target_component": received.component,
        }  # fmt: skip
        if self._answered == (number, offered):
            self._say("KEY_CHANGE_ANSWER", to | {"public_key": self._answer})
            return
        reason = self._refusal(number, offered)
        if reason:
            self._say("KEY_CHANGE_REFUSED", to | {"reason": enumeration("KEY_CHANGE_REFUSAL")[reason]})
        else:
            self._say("KEY_CHANGE_ANSWER", to | {"public_key": self._answer})

    def _refusal(self, number: int, offered: bytes) -> str:
        """Hold the key that an offer leads to; why not, or nothing."""
        keys = self._guard.keys
        if self._guard.mode is not Mode.SIGNING or keys is None:
            return "KEY_CHANGE_REFUSAL_NOT_SIGNING"
        private = new_private(self._random)
        answer = _public(private)
        try:
            said = _said(self._guard.system, offered, answer)
            self._guard.hold(derived_key(private, offered, keys.current, said))
        except ValueError:
            return "KEY_CHANGE_REFUSAL_BAD_KEY"
        except StommelError:
            return "KEY_CHANGE_REFUSAL_NOT_KEPT"
        self._answered, self._answer = (number, offered), answer
        return ""

    def _say(self, name: str, values: Fields) -> None:
        self._waiting = [*self._waiting, (name, values)][-4:]

    def _take_key_in_clear(self, values: Fields) -> None:
        secret = octets(values, "secret_key")
        if not any(secret):
            self.notes = [*self.notes, "no key was taken: zeros are none, and signing is not ended over the link"][-4:]
            return
        made = EPOCH + whole(values, "initial_timestamp") // PER_SECOND
        try:
            self._guard.replace(Key(secret), min(max(made, FIRST_MADE), LAST_MADE))
        except StommelError as error:
            self.notes = [*self.notes, f"no key was taken: {error}"][-4:]
