"""A serial port as a transport."""

from stommel.link.transports.address import Address
from stommel.link.transports.transport import RETRY, TransportError, TransportState
from stommel.messages.serial_port import PortError, PortSettings, PortState, SerialPort

_STATES = {
    PortState.OPEN: TransportState.OPEN,
    PortState.LOST: TransportState.LOST,
    PortState.CLOSED: TransportState.CLOSED,
}


class SerialLine:
    """A serial port; it opens again after unplugging."""

    def __init__(self, address: Address, retry: float = RETRY) -> None:
        self.name = address.text
        try:
            self._port = SerialPort(PortSettings(address.key, address.host, address.number, retry))
            self._port.connect()
        except PortError as error:
            raise TransportError(str(error)) from None

    @property
    def state(self) -> TransportState:
        """Whether bytes can go through."""
        return _STATES[self._port.state]

    @property
    def reason(self) -> str:
        """Why not, in words."""
        return self._port.reason

    def read(self, t: float) -> bytes:
        """Return what has come."""
        return self._port.read(t)

    def write(self, data: bytes, t: float) -> int:
        """Take bytes, all or none, and return how many were taken."""
        return self._port.write(data, t) if len(data) <= self._port.room else 0

    def room(self, t: float) -> int:
        """Bytes that would be taken; looks for a port that was lost."""
        self._port.write(b"", t)
        return self._port.room

    def waiting(self, t: float) -> int:  # noqa: ARG002 - as every transport
        """Bytes that have not left."""
        return self._port.waiting

    def close(self) -> None:
        """Give the port back."""
        self._port.close()
