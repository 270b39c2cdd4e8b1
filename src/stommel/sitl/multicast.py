"""Frames between processes of this machine in real time: python-can's multicast, which does not leave it."""

import os
import time
from collections.abc import Callable, Iterable
from dataclasses import dataclass

from stommel.messages.adapters import Adapter, BusError
from stommel.messages.bus import CanBus
from stommel.messages.database import COORDINATOR
from stommel.messages.frames import Frame
from stommel.sitl.can_bus import BITRATE, bits_of

UNDER_WAY = 0.004
"""Time that a frame is given to reach the other processes [s]."""
_FIRST_PORT, _PORTS = 43200, 20000


def own_bus() -> Adapter:
    """Return a bus that no other flight on this machine has: address and port follow from the process."""
    number = os.getpid()
    address = f"239.74.{163 + number // 250 % 90}.{1 + number % 250}"
    channel = f"{address}:{_FIRST_PORT + number % _PORTS}"
    return Adapter("udp_multicast", channel, stays_here=True, keys="separate nodes: ")


@dataclass
class CoordinatorsBus:
    """The coordinator's end of a bus on which the nodes speak for themselves."""

    can: CanBus
    sleep: Callable[[float], None] = time.sleep
    bits: int = 0
    """Heard and sent so far."""

    def send(self, sender: int, frames: Iterable[Frame]) -> None:
        """Put frames on the bus; the nodes' own went by themselves."""
        if sender != COORDINATOR:
            return
        for frame in sorted(frames, key=lambda frame: frame.identifier):
            self.bits += bits_of(frame)
            self.can.send(frame)
        self.sleep(UNDER_WAY)

    def receive(self, node: int) -> list[Frame]:
        """Take what the coordinator has heard; the nodes hear for themselves."""
        if node != COORDINATOR:
            return []
        self.sleep(UNDER_WAY)
        frames = self.can.receive()
        self.bits += sum(bits_of(frame) for frame in frames)
        return frames

    def load(self, seconds: float) -> float:
        """Share of a time for which a bus of the vehicle's bit rate would have been busy."""
        return self.bits / (BITRATE * seconds) if seconds > 0.0 else 0.0


def works(multicast: Adapter, wait: float = 0.5) -> str:
    """Say why multicast does not work on this machine; nothing if it does."""
    try:
        with CanBus(multicast) as one, CanBus(multicast) as other:
            one.send(Frame(0x7FF, b"\x01"))
            until = time.monotonic() + wait
            while time.monotonic() < until:
                if other.receive():
                    return ""
                time.sleep(0.005)
    except BusError as error:
        return str(error)
    return "what is sent to a multicast address does not come back"
