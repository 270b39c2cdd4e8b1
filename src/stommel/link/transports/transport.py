"""What every transport is."""

from enum import StrEnum
from typing import Protocol

from stommel.errors import StommelError

BUFFER = 65_536
"""Bytes that wait to be sent at most."""
READ_AT_ONCE = 65_536
RETRY = 1.0
"""Between two attempts to connect [s]."""
STALE = 5.0
"""Bytes that nobody takes for so long are dropped [s]: they would be old news."""


class TransportError(StommelError):
    """A transport cannot be; the message names the key and the address."""


class TransportState(StrEnum):
    """Whether bytes can go through."""

    OPEN = "open"
    WAITING = "nobody at the other end"
    """It listens, or tries to connect."""
    LOST = "lost"
    """It was open, and is tried again."""
    CLOSED = "closed"


class Transport(Protocol):
    """Bytes in and out. Nothing here waits, and nothing but opening raises: `state` and `reason` say what is wrong."""

    @property
    def state(self) -> TransportState:
        """Whether bytes can go through."""

    @property
    def reason(self) -> str:
        """Why not, in words; empty while they can."""

    @property
    def name(self) -> str:
        """Address, as others reach it."""

    def read(self, t: float) -> bytes:
        """Return what has come."""

    def write(self, data: bytes, t: float) -> int:
        """Take bytes, all or none, and return how many were taken."""

    def room(self, t: float) -> int:
        """Bytes that would be taken."""

    def waiting(self, t: float) -> int:
        """Bytes that were taken and have not left, as far as that is known."""

    def close(self) -> None:
        """Give all back."""
