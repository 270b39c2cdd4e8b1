"""One end of the link: bytes in, bytes out, services in between."""

from collections.abc import Sequence

from stommel.link.frames import FrameSplitter, frame_bytes
from stommel.link.outbox import Outbox
from stommel.link.service import Received, Service
from stommel.messages.mavlink import message_named


class Session:
    """Splits, checks, and hands on what comes; packs what services say, the most urgent first.

    Parameters
    ----------
    system, component
        Who speaks here.
    services
        Each takes every message that was accepted.
    """

    def __init__(self, system: int, component: int, services: Sequence[Service]) -> None:
        self.system, self.component = system, component
        self.services = services
        self.outbox = Outbox()
        self._splitter = FrameSplitter()
        self._sequence = 0

    def take(self, data: bytes, t: float) -> list[Received]:
        """Take bytes that came until a time [s], and return the messages that were accepted."""
        accepted = []
        for frame in self._splitter.take(data):
            received = Received(frame.system, frame.component, frame.message.name, frame.message.unpack(frame.payload))
            for service in self.services:
                service.take(received, t)
            accepted.append(received)
        return accepted

    def poll(self, t: float, room: int) -> bytes:
        """Return at most so many bytes to send at a time [s]."""
        out = bytearray()
        while room - len(out) >= 280:
            for service in self.services:
                service.poll(t, self.outbox)
            outgoing = self.outbox.next()
            if outgoing is None:
                break
            component = self.component if outgoing.component is None else outgoing.component
            out += frame_bytes(message_named(outgoing.name), outgoing.payload, self.system, component, self._sequence)
            self._sequence = (self._sequence + 1) % 256
        return bytes(out)
