"""One look at a port: hear, then speak."""

from typing import Protocol

from stommel.link.service import Received
from stommel.link.session import Session


class Port(Protocol):
    """Where bytes come from and go to: a transport, or one end of a simulated channel. It never waits."""

    def read(self, t: float) -> bytes:
        """Return what has come until a time [s]."""

    def write(self, data: bytes, t: float) -> int:
        """Take bytes at a time [s], and return how many found room."""

    def room(self, t: float) -> int:
        """Bytes that find room at a time [s]."""

    def waiting(self, t: float) -> int:
        """Bytes that were taken and have not left at a time [s], as far as that is known."""


def exchange(session: Session, port: Port, t: float, ahead: int = 65_536) -> list[Received]:
    """Let a session hear and speak at a time [s]; no more than `ahead` bytes wait in the port. Return what it heard."""
    accepted = session.take(port.read(t), t)
    if out := session.poll(t, min(port.room(t), ahead - port.waiting(t))):
        port.write(out, t)
    return accepted
