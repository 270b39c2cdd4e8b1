"""The CAN bus on virtual time: frames in the order of their identifiers, to every node but their sender."""

from collections.abc import Callable, Iterable
from dataclasses import dataclass, field

from stommel.messages.frames import Frame

BITRATE = 250_000
"""Bits a second of the vehicle's bus."""

OVERHEAD_BITS = 47
"""Of a classic frame with 11-bit identifier and the gap behind it, without stuffed bits (ISO 11898-1)."""

Spoil = Callable[[int, Frame], Iterable[Frame]]
"""What becomes of a frame of a node on its way: nothing, itself, or others."""


def bits_of(frame: Frame) -> int:
    """Bits that a frame takes on the wire with the most stuffed bits that there can be."""
    bits = OVERHEAD_BITS + 8 * len(frame.data)
    return bits + (34 + 8 * len(frame.data) - 1) // 4


@dataclass
class SimulatedBus:
    """Everything that is said reaches everyone else at once."""

    nodes: tuple[int, ...]
    """Numbers of those that listen."""
    spoil: Spoil | None = None
    deaf: set[int] = field(default_factory=set)
    """Numbers of those that hear nothing."""
    bits: int = 0
    """Sent so far."""
    frames: int = 0
    _waiting: dict[int, list[Frame]] = field(default_factory=dict)

    def __post_init__(self) -> None:
        self._waiting = {node: [] for node in self.nodes}

    def send(self, sender: int, frames: Iterable[Frame]) -> None:
        """Put the frames of a node on the bus."""
        for sent in sorted(frames, key=_identifier):
            for frame in (sent,) if self.spoil is None else self.spoil(sender, sent):
                self.deliver(sender, frame)

    def deliver(self, sender: int, frame: Frame) -> None:
        """Let everyone else hear a frame, whatever becomes of others on their way."""
        self.bits += bits_of(frame)
        self.frames += 1
        for node, waiting in self._waiting.items():
            if node != sender and node not in self.deaf:
                waiting.append(frame)

    def receive(self, node: int) -> list[Frame]:
        """Take what a node has heard since it asked last."""
        heard = self._waiting[node]
        self._waiting[node] = []
        return heard

    def load(self, seconds: float) -> float:
        """Share of a time for which the bus was busy."""
        return self.bits / (BITRATE * seconds) if seconds > 0.0 else 0.0


def _identifier(frame: Frame) -> int:
    return frame.identifier
