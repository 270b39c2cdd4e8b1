"""Two ends of a link with keys, stamps and disks, that can be killed at any point and started from their disks."""

import itertools
import random
from collections.abc import Callable

from stommel.errors import OutputError, StommelError
from stommel.link.frames import FrameSplitter, RawFrame, frame_bytes
from stommel.link.outbox import Outbox
from stommel.link.service import SHORE_COMPONENT, SHORE_SYSTEM, VEHICLE_COMPONENT, Received
from stommel.link.signing.challenge import Challenge
from stommel.link.signing.guard import Guard, PortGuard
from stommel.link.signing.key_change import KeyAnswer, KeyOffer
from stommel.link.signing.keys import Key, Keys
from stommel.link.signing.stamps import EPOCH
from stommel.messages.mavlink import message_named
from tests.onboard.coordination.disk import Disk, PowerCutError

VEHICLE = 1
CLOCK = EPOCH + 370_000_000.0
"""A day in 2026 [s of UTC since 1970]."""
KEY = Key(bytes(range(32)))
OTHER = Key(bytes(range(1, 33)))
HEARTBEAT = message_named("HEARTBEAT")


class KeyDisk:
    """A key file in memory."""

    def __init__(self, keys: Keys | None) -> None:
        self.keys = keys
        self.broken = False
        self.writes_left: int | None = None
        """Until the power goes; half of one more is before the write, a whole one after it."""
        self.cut_after_write = False

    def read(self) -> Keys:
        if self.keys is None:
            raise StommelError("zju-1.key: cannot be read: No such file or directory")
        return self.keys

    def write(self, keys: Keys) -> None:
        if self.broken:
            raise OutputError("zju-1.key: cannot be written: No space left on device")
        cut = False
        if self.writes_left is not None:
            self.writes_left -= 1
            cut = self.writes_left < 0
        if cut and not self.cut_after_write:
            raise PowerCutError
        self.keys = keys
        if cut:
            raise PowerCutError


def keys_of(key: Key = KEY, *, unused: bool = True) -> Keys:
    return Keys(VEHICLE, int(CLOCK), key, unused=unused)


def seeded(seed: int) -> Callable[[int], bytes]:
    return random.Random(seed).randbytes


_SEEDS = itertools.count()


class End:
    """What a session does with a guard, without its rates and queues."""

    def __init__(self, system: int, keys: KeyDisk, disk: Disk, clock: float = CLOCK, link: int = 0) -> None:
        self.system, self.keys, self.disk, self.link = system, keys, disk, link
        self.component = SHORE_COMPONENT if system == SHORE_SYSTEM else VEHICLE_COMPONENT
        self.start(clock)

    def start(self, clock: float) -> None:
        """Forget all but the disks."""
        draw = seeded(next(_SEEDS))
        self.guard = Guard(self.system, self.keys, self.disk, clock, draw)
        self.port = PortGuard(self.guard, self.link)
        self.offer = KeyOffer(self.guard, VEHICLE, draw)
        self.answer = KeyAnswer(self.guard, draw)
        self.challenge = Challenge(self.guard)
        self.services = [self.challenge, self.offer if self.system == SHORE_SYSTEM else self.answer]
        self._splitter, self._outbox, self._sequence = FrameSplitter(), Outbox(), 0

    def say(self, t: float, name: str = "HEARTBEAT", payload: bytes = b"\2\0\0\0\x0a\0\0\4\3") -> bytes:
        signs = self.port.signs
        self._sequence = (self._sequence + 1) % 256
        frame = frame_bytes(
            message_named(name), payload, self.system, self.component, self._sequence, signed=signs
        )  # fmt: skip
        return self.port.sign(frame, t) if signs else frame

    def poll(self, t: float) -> list[bytes]:
        """Frames of the services, and a heartbeat."""
        for service in self.services:
            service.poll(t, self._outbox)
        frames = []
        while (outgoing := self._outbox.next()) is not None:
            frames.append(self.say(t, outgoing.name, outgoing.payload))
        return [*frames, self.say(t)]

    def hear(self, data: bytes, t: float) -> list[str]:
        """Names of the messages that were let through."""
        names = []
        for frame in self._splitter.take(data):
            if not self.port.accept(frame, t):
                continue
            received = Received(
                frame.system, frame.component, frame.message.name, frame.message.unpack(frame.payload)
            )  # fmt: skip
            for service in self.services:
                service.take(received, t)
            names.append(received.name)
        return names

    def hears(self, data: bytes, t: float) -> bool:
        """Whether a frame was let through."""
        return bool(self.hear(data, t))


def vehicle(keys: Keys | None = None, clock: float = CLOCK) -> End:
    return End(VEHICLE, KeyDisk(keys_of() if keys is None else keys), Disk(), clock)


def shore(keys: Keys | None = None, clock: float = CLOCK) -> End:
    return End(SHORE_SYSTEM, KeyDisk(keys_of() if keys is None else keys), Disk(), clock)


def raw_frame(data: bytes) -> RawFrame:
    (frame,) = FrameSplitter().take(data)
    return frame


def talk(one: End, other: End, t: float, seconds: float = 3.0) -> float:
    """Let both speak every second, the vehicle first; the time after it."""
    for _ in range(int(seconds)):
        t += 1.0
        for frame in one.poll(t):
            other.hear(frame, t)
        for frame in other.poll(t):
            one.hear(frame, t)
    return t


def understand(one: End, other: End, t: float) -> bool:
    """Whether each lets through what the other says."""
    return other.hears(one.say(t), t) and one.hears(other.say(t), t)
