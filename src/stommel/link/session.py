"""One end of the link: bytes in, bytes out, services in between."""

from collections import deque
from collections.abc import Sequence
from zlib import crc32

from stommel.link.frames import CHECKSUM, HEAD, SIGNATURE, FrameSplitter, RawFrame, frame_bytes
from stommel.link.guard import Guard
from stommel.link.line_watch import LineWatch
from stommel.link.outbox import Outbox, Outgoing
from stommel.link.rate import LineRate
from stommel.link.sequence import SequenceCounts, SequenceWatch
from stommel.link.service import Peer, Received, Service
from stommel.messages.mavlink import MOST_PAYLOAD, message_named

LONGEST_FRAME = HEAD + MOST_PAYLOAD + CHECKSUM + SIGNATURE
SILENCE = 0.5
"""After which the rest of a frame is expected no longer [s]."""
_MOST_PEERS = 32
_NOTES = 32
_ROUNDS = 64
"""Times that services are asked again in one poll, at most."""


class Session:
    """Splits, checks, and hands on what comes; packs what services say, the most urgent first.

    Nothing that comes from outside makes it raise: what a service cannot bear is a note.

    Parameters
    ----------
    system, component
        Who speaks here.
    services
        Each takes every message that was accepted.
    guard
        Who is believed; without one everybody is, and nothing is signed.
    rate
        Of the line; without one as much is sent as there is room for.
    """

    def __init__(
        self,
        system: int,
        component: int,
        services: Sequence[Service],
        guard: Guard | None = None,
        rate: LineRate | None = None,
    ) -> None:
        self.system, self.component = system, component
        self.services = list(services)
        self.guard, self.rate = guard, rate
        self.outbox = Outbox()
        self.line = LineWatch()
        self.notes: deque[str] = deque(maxlen=_NOTES)
        """What services could not bear, the newest last; the same again is not noted again."""
        self.failures = 0
        """How often a service raised."""
        self.refused = 0
        """Frames that the guard did not believe."""
        self.echoes = 0
        """Frames of our own that came back."""
        self._splitter = FrameSplitter()
        self._watches: dict[Peer, SequenceWatch] = {}
        self._sequences: dict[int, int] = {}
        """Of the next frame of each component: whoever listens counts what is missing of each by itself."""
        self._last_bytes = float("-inf")

    @property
    def bad(self) -> int:
        """Frames with a wrong checksum, and stretches of bytes without any frame."""
        return self._splitter.bad

    @property
    def unknown(self) -> int:
        """Frames of a message that neither dialect has."""
        return self._splitter.unknown

    @property
    def versions(self) -> str:
        """That the other end has another version of some messages, in words; empty if it has not."""
        return self._splitter.versions.sentence

    def peers(self) -> dict[Peer, SequenceCounts]:
        """Everybody who was heard, with the counts of their frames."""
        return {peer: watch.counts for peer, watch in self._watches.items()}

    def take(self, data: bytes, t: float) -> list[Received]:
        """Take bytes that came until a time [s], and return the messages that were accepted.

        Only a look that finds no bytes tells a silence: of those that came while nobody looked, it is not known when.
        """
        if not data:
            return self._settle(t)
        self._last_bytes = t
        if self.rate is not None:
            self.rate.heard(len(data))
        frames = self._splitter.take(data)
        self.line.heard(len(data), len(frames), t)
        return self._accept(frames, t)

    def poll(self, t: float, room: int) -> bytes:
        """Return at most so many bytes to send at a time [s]."""
        self._settle(t)
        if self.rate is not None:
            room = min(room, self.rate.allowance(t))
        out = bytearray()
        for _ in range(_ROUNDS):
            self._ask_services(t)
            before = len(out)
            while room - len(out) >= LONGEST_FRAME and (outgoing := self.outbox.next()) is not None:
                out += self._frame(outgoing, t)
            if len(out) == before or self.outbox.waiting:
                break
        if self.rate is not None:
            self.rate.sent(len(out))
        return bytes(out)

    def note(self, words: str) -> None:
        """Keep a sentence for whoever looks after the link."""
        if words not in self.notes:
            self.notes.append(words)

    def _settle(self, t: float) -> list[Received]:
        """Expect the rest of a frame no longer if the line was silent."""
        if not self._splitter.pending or t - self._last_bytes <= SILENCE:
            return []
        return self._accept(self._splitter.forget(), t)

    def _accept(self, frames: list[RawFrame], t: float) -> list[Received]:
        accepted = []
        for frame in frames:
            if not self._is_believed(frame, t):
                continue
            received = Received(frame.system, frame.component, frame.message.name, frame.message.unpack(frame.payload))
            for service in self.services:
                try:
                    service.take(received, t)
                except Exception as error:  # noqa: BLE001 - one service's weakness shall not end the link
                    self._failed(service, f"cannot bear {received.name}", error)
            accepted.append(received)
        return accepted

    def _is_believed(self, frame: RawFrame, t: float) -> bool:
        peer, content = (frame.system, frame.component), crc32(frame.raw)
        if peer == (self.system, self.component):
            self.echoes += 1
            return False
        watch = self._watches.get(peer)
        if watch is not None and watch.is_duplicate(frame.sequence, content, t):
            return False
        if self.guard is not None and not self.guard.accept(frame, t):
            self.refused += 1
            return False
        if watch is None:
            if len(self._watches) >= _MOST_PEERS:
                del self._watches[next(iter(self._watches))]
            watch = self._watches[peer] = SequenceWatch()
        watch.take(frame.sequence, content, t)
        return True

    def _ask_services(self, t: float) -> None:
        for service in self.services:
            try:
                service.poll(t, self.outbox)
            except Exception as error:  # noqa: BLE001 - as above
                self._failed(service, "cannot speak", error)

    def _failed(self, service: Service, what: str, error: Exception) -> None:
        self.failures += 1
        self.note(f"{type(service).__name__}: {what} ({type(error).__name__}: {error})"[:200])

    def _frame(self, outgoing: Outgoing, t: float) -> bytes:
        component = self.component if outgoing.component is None else outgoing.component
        sequence = self._sequences.get(component, 0)
        guard = self.guard if self.guard is not None and self.guard.signs else None
        frame = frame_bytes(
            message_named(outgoing.name), outgoing.payload, self.system, component, sequence,
            signed=guard is not None,
        )  # fmt: skip
        self._sequences[component] = (sequence + 1) % 256
        return frame if guard is None else guard.sign(frame, t)
