"""The guard of one end: signs what it says, and lets through what the other end has signed."""

import hmac
from collections.abc import Callable, Iterable, Mapping
from enum import StrEnum
from functools import cache
from typing import NamedTuple

from stommel.errors import StommelError
from stommel.files.storage import Storage
from stommel.link.frames import RawFrame
from stommel.link.signing.in_step import InStep
from stommel.link.signing.keys import Key, Keys, KeyStore
from stommel.link.signing.refusals import Refusal, Refusals
from stommel.link.signing.signature import holds, link_and_stamp, signed
from stommel.link.signing.stamps import MOST_STREAMS, Stamps, Stream, stamp_of
from stommel.messages.mavlink import message_named

NONCE = 16
"""Bytes of a question whose answer must be new."""
_COMMIT_AGAIN = 10.0
"""A key file that could not be written is tried again so late [s]."""


class KeyChangeError(StommelError):
    """No key can be taken now."""


class Mode(StrEnum):
    """How an end stands to signatures."""

    SIGNING = "signing"
    UNSIGNED = "unsigned"
    """Chosen: everybody may command."""
    NO_KEY = "no key"
    """The key is missing or damaged: nobody may, but on the bench."""


class Guard:
    """Keys, stamps and counts of an end; each of its ports has a `PortGuard`.

    Parameters
    ----------
    system
        Who speaks here.
    store, storage
        Where keys and stamps are kept; None for the unsigned mode, which has to be chosen so.
    clock
        The wall clock at the start [s of UTC since 1970]; it may be wrong.
    random
        Returns so many random bytes.
    others
        Keys of other vehicles by what they are called, so that a mistake is named.
    """

    def __init__(
        self,
        system: int,
        store: KeyStore | None,
        storage: Storage | None,
        clock: float,
        random: Callable[[int], bytes],
        others: Mapping[str, Key] | None = None,
    ) -> None:
        self.system = system
        self.refusals = Refusals()
        self.bench = 0
        """Frames that were let through on the bench without a signature that holds."""
        self.keys: Keys | None = None
        self.stamps: Stamps | None = None
        self.question = b""
        """What an end in doubt asks; the answer must repeat it."""
        self.in_step = InStep()
        self.asked: bytes | None = None
        """What the other end asks in its doubt."""
        self._store, self._storage, self._clock, self._random = store, storage, clock, random
        self._others = dict(others or {})
        self._heard_others: set[str] = set()
        self._problem = ""
        self._clocks: dict[Stream, float] = {}
        self._speaks_next = False
        self.peer_has_next = False
        """Whether the other end was heard with the new key, and the disk does not keep that yet."""
        self._commit_at = self._use_at = float("-inf")
        if store is not None and storage is not None:
            self._open(store, storage)

    @classmethod
    def unsigned(cls, system: int) -> "Guard":
        """A guard that lets everything through, and signs nothing."""
        return cls(system, None, None, 0.0, bytes)

    @property
    def mode(self) -> Mode:
        """How this end stands to signatures."""
        if self._store is None:
            return Mode.UNSIGNED
        return Mode.NO_KEY if self.keys is None else Mode.SIGNING

    @property
    def in_doubt(self) -> bool:
        """Whether the own stamps are lost, so that the other end must prove that what it says is new."""
        return self.stamps is not None and self.stamps.in_doubt

    @property
    def alarm(self) -> bool:
        """Whether somebody has to look after it."""
        unwritten = self.stamps is not None and not self.stamps.written
        return bool(self._problem) or self.in_doubt or unwritten

    @property
    def status(self) -> list[str]:
        """What there is to say, as lines."""
        return [*self._state_sentences(), *self._peer_sentences(), *self.refusals.sentences]

    def _state_sentences(self) -> Iterable[str]:
        if self.mode is Mode.UNSIGNED:
            yield "unsigned mode: whoever is heard may command"
        if self.mode is Mode.NO_KEY:
            yield f"no key: nothing is accepted but on the bench: {self._problem}"
        elif self._problem:
            yield self._problem
        if self.in_doubt:
            yield "the stamps are lost: nothing is accepted before the other end has proved to be there"
        if self.stamps is not None and not self.stamps.written:
            yield "the disk does not keep the stamps: what was heard may be accepted again after a restart"

    def _peer_sentences(self) -> Iterable[str]:
        for (system, component, _), ahead in self._clocks.items():
            side = "ahead of" if ahead > 0.0 else "behind"
            why = "its clock is wrong" if ahead > 0.0 else "its clock is wrong, or it has not heard us yet"
            yield f"stamps of {system}/{component} are {_span(abs(ahead))} {side} ours: {why}"
        for name in sorted(self._heard_others):
            yield f"heard frames signed with the key of {name}"

    # keys

    def _open(self, store: KeyStore, storage: Storage) -> None:
        try:
            keys = store.read()
        except StommelError as error:
            self._problem = str(error)
            return
        self._begin(keys, storage)

    def _begin(self, keys: Keys, storage: Storage) -> None:
        self.keys = keys
        self.stamps = Stamps(storage, stamp_of(keys.made), self._clock, fresh=keys.unused)
        self.question = self._random(NONCE)
        if self.stamps.in_doubt:
            return
        if keys.unused:
            self.stamps.keep_now()
            self._use(float("-inf"))

    def _use(self, t: float) -> None:
        """Note in the key file that the key is used, once the stamps are kept: without them it then needs proof."""
        if self.keys is None or not self.keys.unused or self.stamps is None or not self.stamps.written:
            return
        if t >= self._use_at and not self._write(self.keys._replace(unused=False)):
            self._use_at = t + _COMMIT_AGAIN

    def replace(self, key: Key, made: int) -> None:
        """Take a key that was given on the bench; nobody has used it.

        Raises
        ------
        StommelError
            It cannot be kept.
        """
        if self._store is None or self._storage is None:
            return
        vehicle = self.system if self.keys is None else self.keys.vehicle
        keys = Keys(vehicle, made, key, unused=True)
        self._store.write(keys)
        self._problem, self.peer_has_next, self._speaks_next = "", False, False
        self._begin(keys, self._storage)

    def hold(self, key: Key) -> None:
        """Keep a key beside the current one; frames signed with either are accepted from now on.

        Raises
        ------
        StommelError
            It cannot be kept.
        """
        if self.keys is None or self._store is None:
            raise KeyChangeError("there is no key that a new one could follow")
        if self.peer_has_next:  # to overwrite it would leave no key in common
            raise KeyChangeError(f"the last change is not on the disk: {self._problem}")
        keys = self.keys._replace(next=key)
        self._store.write(keys)
        self.keys, self._speaks_next = keys, False

    def _commit(self, t: float) -> None:
        """The other end speaks with the new key: drop the old one."""
        self.peer_has_next = True
        if self.keys is None or self.keys.next is None or t < self._commit_at:
            return
        if self._write(self.keys._replace(current=self.keys.next, next=None)):
            self.peer_has_next = False
        else:
            self._commit_at = t + _COMMIT_AGAIN

    def _write(self, keys: Keys) -> bool:
        if self._store is None:
            return False
        try:
            self._store.write(keys)
        except StommelError as error:
            self._problem = str(error)
            return False
        self.keys, self._problem = keys, ""
        return True

    # frames

    def sign(self, frame: bytes, link: int, t: float) -> bytes:
        """Return a frame, whose flag says that it is signed, with its signature."""
        if self.keys is None or self.stamps is None:
            return frame
        key = self.keys.current
        if self.keys.next is not None and (self._speaks_next or frame[7:10] == _confirmation()):
            key = self.keys.next
        out = signed(frame, key.secret, link, self.stamps.next(t))
        self._use(t)
        return out

    def judge(self, frame: RawFrame, t: float, *, bench: bool) -> Refusal | None:
        """Why a frame is refused; None if it is let through. Counts it."""
        refusal = self._judged(frame, t)
        if bench:
            self.bench += refusal is not None
            return None
        if refusal is None and frame.message.id == _key_in_clear():
            refusal = Refusal.KEY_IN_CLEAR
        if refusal is not None:
            self.refusals.add(refusal)
        return refusal

    def _judged(self, frame: RawFrame, t: float) -> Refusal | None:
        if self.mode is Mode.UNSIGNED:
            return None
        if self.keys is None or self.stamps is None:
            return Refusal.NO_KEY
        if not frame.is_signed:
            return Refusal.UNSIGNED
        if frame.system == self.system:
            return Refusal.REFLECTED
        with_next = False
        if not holds(frame.raw, self.keys.current.secret):
            with_next = self.keys.next is not None and holds(frame.raw, self.keys.next.secret)
            if not with_next:
                return self._foreign(frame)
        refusal = self._dated(frame, self.stamps, t)
        if with_next or refusal is None:
            # also of an old frame: who has ever said it holds the key, and may hold no other
            self._speaks_next = with_next
        if refusal is None and with_next:
            self._commit(t)
        return refusal

    def _dated(self, frame: RawFrame, stamps: Stamps, t: float) -> Refusal | None:
        """Why a rightly signed frame is refused for its stamp."""
        link, stamp = link_and_stamp(frame.raw)
        stream = (frame.system, frame.component, link)
        name = frame.message.name
        if name == "KEY_CHALLENGE":
            # harmless to answer, however old: and an end in doubt may know no better stamp
            self.asked = frame.payload.ljust(NONCE, b"\0")[:NONCE]
        refusal = stamps.check(stream, stamp, t)
        if refusal is None:
            stamps.accept(stream, stamp, t)
            self._clocks.pop(stream, None)
            self.in_step.accepted(stream)
            return None
        if refusal is Refusal.UNPROVED and name == "KEY_CHALLENGE_ANSWER" and self._is_answer(frame.payload):
            stamps.prove(stream, stamp, t)
            return None
        if refusal in (Refusal.STALE, Refusal.FAR_FUTURE) and len(self._clocks) < MOST_STREAMS:
            self._clocks[stream] = stamps.offset(stamp, t)
        if name == "KEY_CHALLENGE" and self.asked is not None:
            self.in_step.asked(stream, self.asked)
        return self.in_step.refused(stream, refusal)

    def _is_answer(self, payload: bytes) -> bool:
        return bool(self.question) and hmac.compare_digest(payload.ljust(NONCE, b"\0")[:NONCE], self.question)

    def _foreign(self, frame: RawFrame) -> Refusal:
        for name, key in self._others.items():
            if holds(frame.raw, key.secret):
                self._heard_others.add(name)
                return Refusal.OTHER_KEY
        return Refusal.WRONGLY_SIGNED


class PortGuard(NamedTuple):
    """The guard at one port: what a session asks."""

    guard: Guard
    link: int = 0
    """Number of the port in signatures, 0 to 255."""
    bench: bool = False
    """Whoever is at this port is at the vehicle: everything is let through."""

    @property
    def signs(self) -> bool:
        """Whether frames that are sent carry a signature."""
        return self.guard.keys is not None

    def accept(self, frame: RawFrame, t: float) -> bool:
        """Whether a frame that came at a time [s] is let through."""
        return self.guard.judge(frame, t, bench=self.bench) is None

    def sign(self, frame: bytes, t: float) -> bytes:
        """Return a frame, whose flag says that it is signed, with its signature."""
        return self.guard.sign(frame, self.link, t)


@cache
def _confirmation() -> bytes:
    """What a frame of the message that is signed with the new key has in its head."""
    return message_named("KEY_CHANGE_CONFIRM").id.to_bytes(3, "little")


@cache
def _key_in_clear() -> int:
    return message_named("SETUP_SIGNING").id


def _span(seconds: float) -> str:
    """A time in its largest unit."""
    for size, unit in ((31_557_600.0, "years"), (86_400.0, "days"), (3600.0, "h"), (60.0, "min")):
        if seconds >= 2.0 * size:
            return f"{seconds / size:.0f} {unit}"
    return f"{seconds:.0f} s"
