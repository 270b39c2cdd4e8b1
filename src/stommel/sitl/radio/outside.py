"""An end of the link outside of the loop: a shore behind a transport, or software behind a port."""

from typing import Protocol

MOST_WAITING = 65_536
"""Bytes that wait for the channel; more are refused, as by a modem."""


class Wire(Protocol):
    """What bytes go through, such as a transport; it never waits."""

    def read(self, t: float) -> bytes:
        """Return what has come."""

    def write(self, data: bytes, t: float) -> int:
        """Take bytes, and return how many were taken."""


class Outside:
    """Carries bytes between a simulated radio and whoever is behind a wire."""

    def __init__(self, wire: Wire) -> None:
        self._wire = wire
        self._waiting = bytearray()
        self.refused = 0
        """Bytes that found no room."""

    def take(self, data: bytes, t: float) -> None:
        """Hand on what the radio has received."""
        if data:
            self._wire.write(data, t)

    def poll(self, t: float, room: int) -> bytes:
        """Return what there is to send."""
        data = self._wire.read(t)
        fits = data[: MOST_WAITING - len(self._waiting)]
        self.refused += len(data) - len(fits)
        self._waiting += fits
        out = bytes(self._waiting[: max(0, room)])
        del self._waiting[: len(out)]
        return out
