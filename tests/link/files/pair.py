"""Two ends and a radio channel between them, on virtual time; frames carry the 13 bytes of a signature."""

from collections.abc import Callable, Sequence

from stommel.link.channel.channel import Channel, ChannelEnd
from stommel.link.channel.settings import ChannelSettings
from stommel.link.frames import frame_bytes
from stommel.link.service import SHORE_COMPONENT, SHORE_SYSTEM, VEHICLE_COMPONENT, Service
from stommel.link.session import Session
from stommel.messages.mavlink import message_named

VEHICLE = (1, VEHICLE_COMPONENT)
SHORE = (SHORE_SYSTEM, SHORE_COMPONENT)
STEP = 0.01
IN_MODEM = 600
"""Bytes that an end keeps waiting in its modem: two frames."""


class SignedSession(Session):
    """Frames are as long as signed ones, and nothing else of signing."""

    frames = 0

    def poll(self, t: float, room: int) -> bytes:
        out = bytearray()
        while room - len(out) >= 293:
            for service in self.services:
                service.poll(t, self.outbox)
            outgoing = self.outbox.next()
            if outgoing is None:
                break
            kind = message_named(outgoing.name)
            sequence = self.frames % 256
            out += frame_bytes(kind, outgoing.payload, self.system, self.component, sequence, signed=True) + bytes(13)
            self.frames += 1
        return bytes(out)


class Pair:
    """A vehicle and a shore."""

    def __init__(self, settings: ChannelSettings, seed: int = 0, linked: Callable[[float], bool] | None = None) -> None:
        self.channel = Channel(settings, seed, linked)
        self.t = 0.0
        self.pace = self.usual = STEP
        self.vehicle = SignedSession(*VEHICLE, [])
        self.shore = SignedSession(*SHORE, [])

    def serve(self, *services: Service) -> None:
        self.vehicle.services = services

    def ask(self, *services: Service) -> None:
        self.shore.services = services

    def step(self) -> None:
        self._turn(self.vehicle, self.channel.vehicle)
        self._turn(self.shore, self.channel.shore)
        self.t += self.pace

    def _turn(self, session: Session, end: ChannelEnd) -> None:
        session.take(end.read(self.t), self.t)
        room = IN_MODEM - end.modem.waiting
        if room > 0:
            end.write(session.poll(self.t, min(room, end.room(self.t))), self.t)

    def wait(self, seconds: float) -> None:
        """Let time pass in which nobody hears anybody."""
        end, self.pace = self.t + seconds, 0.5
        while self.t < end:
            self.step()
        self.pace = self.usual

    def run(self, until: Callable[[], bool], most: float) -> bool:
        """Let time pass until something is so, and say whether it is."""
        end = self.t + most
        while self.t < end:
            self.step()
            if until():
                return True
        return until()


def is_over(services: Sequence[object]) -> Callable[[], bool]:
    return lambda: all(service.state.is_over for service in services)  # type: ignore[attr-defined]
