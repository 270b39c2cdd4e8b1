"""A line between two ends in memory: messages as bytes, with latency, speed and loss, on virtual time."""

import random
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import NamedTuple

from stommel.link.outbox import Outbox, Priority
from stommel.link.service import Received, Service
from stommel.messages.mavlink import Fields, message_named

STEP = 0.02
_OVERHEAD = 12
_HEARTBEAT: Fields = {"type": 6, "autopilot": 8, "mavlink_version": 3}


class Sent(NamedTuple):
    """A message on the line."""

    t: float
    to_vehicle: bool
    received: Received


@dataclass
class End:
    system: int
    component: int
    services: Sequence[Service]
    outbox: Outbox = field(default_factory=Outbox)
    free_at: float = 0.0
    """When the line has taken what it was given."""
    next_heartbeat: float = 0.0


@dataclass
class Line:
    """Shore and vehicle, and what is between them.

    `loses` decides of each message whether it is lost; heartbeats never are unless `is_silent`.
    """

    shore: End
    vehicle: End
    loses: Callable[[Sent], bool] = lambda sent: False
    latency: float = 0.05
    rate: float = 11520.0
    """[B/s]"""
    t: float = 0.0
    is_silent: bool = False
    """Whether all is lost: the vehicle is under water."""
    sent: list[Sent] = field(default_factory=list)
    """All messages but heartbeats, those too that were lost."""
    flying: list[tuple[float, Sent]] = field(default_factory=list)

    def run(self, until: Callable[[], bool], within: float) -> float:
        """Let time pass until something holds; return how long it took."""
        began = self.t
        while not until():
            assert self.t - began < within, f"still not after {within} s"
            self.step()
        return self.t - began

    def wait(self, seconds: float) -> None:
        ends = self.t + seconds
        while self.t < ends:
            self.step()

    def step(self) -> None:
        self.t += STEP
        arrived = [sent for due, sent in self.flying if due <= self.t]
        self.flying = [(due, sent) for due, sent in self.flying if due > self.t]
        for sent in arrived:
            for service in (self.vehicle if sent.to_vehicle else self.shore).services:
                service.take(sent.received, self.t)
        for end, other in ((self.shore, self.vehicle), (self.vehicle, self.shore)):
            self._speak(end, to_vehicle=other is self.vehicle)

    def _speak(self, end: End, to_vehicle: bool) -> None:
        if self.t >= end.next_heartbeat:
            end.next_heartbeat = self.t + 1.0
            if not self.is_silent:
                received = Received(end.system, end.component, "HEARTBEAT", _HEARTBEAT)
                self.flying.append((self.t + self.latency, Sent(self.t, to_vehicle, received)))
        while end.free_at <= self.t:
            for service in end.services:
                service.poll(self.t, end.outbox)
            outgoing = end.outbox.next()
            if outgoing is None:
                return
            end.free_at = max(end.free_at, self.t - STEP) + (len(outgoing.payload) + _OVERHEAD) / self.rate
            component = end.component if outgoing.component is None else outgoing.component
            values = message_named(outgoing.name).unpack(outgoing.payload)
            sent = Sent(self.t, to_vehicle, Received(end.system, component, outgoing.name, values))
            self.sent.append(sent)
            if not self.is_silent and not self.loses(sent):
                self.flying.append((end.free_at + self.latency, sent))

    def counted(self, name: str) -> int:
        return sum(sent.received.name == name for sent in self.sent)


def losing(draw: random.Random, share: float) -> Callable[[Sent], bool]:
    return lambda sent: draw.random() < share


def losing_number(number: int) -> Callable[[Sent], bool]:
    """Lose one message, by its number from 0."""
    left = [number]

    def loses(sent: Sent) -> bool:
        left[0] -= 1
        return left[0] == -1

    return loses


class Echo:
    """A service that only listens."""

    def __init__(self) -> None:
        self.heard: list[Received] = []

    def take(self, received: Received, t: float) -> None:
        self.heard.append(received)

    def poll(self, t: float, outbox: Outbox) -> None: ...


class Says:
    """Messages that somebody says once."""

    def __init__(self, *messages: tuple[str, Fields]) -> None:
        self.waiting = list(messages)
        self.heard: list[Received] = []

    def take(self, received: Received, t: float) -> None:
        if received.name != "HEARTBEAT":
            self.heard.append(received)

    def poll(self, t: float, outbox: Outbox) -> None:
        while self.waiting:
            outbox.put(Priority.COMMAND, *self.waiting.pop(0))
