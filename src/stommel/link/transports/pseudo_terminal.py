"""A pseudo-terminal: a serial port for a program on the same machine, without any wire."""

import os

from stommel.link.transports.address import Address
from stommel.link.transports.outgoing import OutgoingBytes
from stommel.link.transports.transport import BUFFER, READ_AT_ONCE, TransportState


class PseudoTerminal:
    """Our end; `name` is the port that the other program opens."""

    reason = ""

    def __init__(self, address: Address) -> None:
        try:
            import tty  # noqa: PLC0415 - Windows has none

            self._ours, self._theirs = os.openpty()
            tty.setraw(self._theirs)
        except (ImportError, AttributeError, OSError) as error:
            raise address.error(f"there are no pseudo-terminals here ({error})") from None
        os.set_blocking(self._ours, False)
        self.name = os.ttyname(self._theirs)
        self.state = TransportState.OPEN
        self._outgoing = OutgoingBytes(BUFFER)

    def read(self, t: float) -> bytes:
        """Return what has come."""
        if self.state is TransportState.CLOSED:
            return b""
        self._flush(t)
        try:
            return os.read(self._ours, READ_AT_ONCE)
        except OSError:  # nothing there
            return b""

    def write(self, data: bytes, t: float) -> int:
        """Take bytes, all or none, and return how many were taken."""
        if self.state is TransportState.CLOSED:
            return 0
        taken = self._outgoing.put(data, t)
        self._flush(t)
        return taken

    def room(self, t: float) -> int:
        """Bytes that would be taken."""
        if self.state is TransportState.CLOSED:
            return 0
        self._flush(t)
        return self._outgoing.room

    def waiting(self, t: float) -> int:  # noqa: ARG002 - as every transport
        """Bytes that nobody has taken."""
        return len(self._outgoing)

    def close(self) -> None:
        """Remove the port."""
        if self.state is not TransportState.CLOSED:
            os.close(self._ours)
            os.close(self._theirs)
            self.state, self.reason = TransportState.CLOSED, "closed"

    def _flush(self, t: float) -> None:
        try:
            self._outgoing.flush(lambda data: os.write(self._ours, data), t)
        except OSError:  # a terminal in a state that we did not make
            self._outgoing.clear()
