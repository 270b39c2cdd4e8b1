"""A shore outside of the loop: whoever is at the other end of a transport."""

from stommel.link.transports.transport import Transport

MOST_WAITING = 65_536
"""Bytes of the shore that wait for the channel; more are refused, as by a modem."""


class Outside:
    """Carries bytes between the simulated radio ashore and a transport."""

    def __init__(self, transport: Transport) -> None:
        self.transport = transport
        self._waiting = bytearray()
        self.refused = 0
        """Bytes that found no room."""

    def take(self, data: bytes, t: float) -> None:
        """Hand on what the radio ashore has received."""
        if data:
            self.transport.write(data, t)

    def poll(self, t: float, room: int) -> bytes:
        """Return what the shore has to send."""
        data = self.transport.read(t)
        fits = data[: MOST_WAITING - len(self._waiting)]
        self.refused += len(data) - len(fits)
        self._waiting += fits
        out = bytes(self._waiting[: max(0, room)])
        del self._waiting[: len(out)]
        return out
