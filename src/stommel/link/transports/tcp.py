"""TCP, from either side."""

import errno
import select
import socket

from stommel.link.transports.address import Address
from stommel.link.transports.hosts import bound, in_words, looked_up, own_name
from stommel.link.transports.outgoing import OutgoingBytes
from stommel.link.transports.transport import READ_AT_ONCE, RETRY, TransportState

_LONGEST_ATTEMPT = 10.0
"""To connect [s]."""


class _Stream:
    """One connection, or none."""

    def __init__(self) -> None:
        self.state = TransportState.WAITING
        self.reason = ""
        self.reopened = 0
        """Times that it came back."""
        self._socket: socket.socket | None = None
        self._outgoing = OutgoingBytes()
        self._was_open = False

    def look(self, t: float) -> None:
        """Connect, or let connect, if there is no connection."""
        raise NotImplementedError

    def read(self, t: float) -> bytes:
        """Return what has come."""
        self.look(t)
        if self.state is not TransportState.OPEN or self._socket is None:
            return b""
        self._flush(t)
        try:
            data = self._socket.recv(READ_AT_ONCE) if self._socket is not None else b""
        except (BlockingIOError, InterruptedError):
            return b""
        except OSError as error:
            self._lose(in_words(error))
            return b""
        if not data and self._socket is not None:
            self._lose("the other end closed it")
        return data

    def write(self, data: bytes, t: float) -> int:
        """Take bytes, all or none, and return how many were taken; none while there is no connection."""
        self.look(t)
        if self.state is not TransportState.OPEN:
            return 0
        taken = self._outgoing.put(data, t)
        self._flush(t)
        return taken

    def room(self, t: float) -> int:
        """Bytes that would be taken."""
        self.look(t)
        return self._outgoing.room if self.state is TransportState.OPEN else 0

    def waiting(self, t: float) -> int:  # noqa: ARG002 - as every transport
        """Bytes that the other end has not taken, beyond what the operating system holds."""
        return len(self._outgoing)

    def close(self) -> None:
        """End the connection."""
        self._drop()
        self.state, self.reason = TransportState.CLOSED, "closed"

    def _opened(self, connected: socket.socket) -> None:
        connected.setblocking(False)
        connected.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        connected.setsockopt(socket.SOL_SOCKET, socket.SO_KEEPALIVE, 1)
        self._socket = connected
        self.reopened += self._was_open
        self._was_open = True
        self.state, self.reason = TransportState.OPEN, ""

    def _flush(self, t: float) -> None:
        if self._socket is None:
            return
        try:
            is_taken = self._outgoing.flush(self._socket.send, t)
        except OSError as error:
            self._lose(in_words(error))
            return
        if not is_taken:
            self._lose("the other end takes no bytes")

    def _lose(self, why: str) -> None:
        self._drop()
        self.state, self.reason = TransportState.LOST, why

    def _drop(self) -> None:
        self._outgoing.clear()
        if self._socket is not None:
            self._socket.close()
            self._socket = None


class TcpClient(_Stream):
    """Connects, and connects again."""

    def __init__(self, address: Address, retry: float = RETRY) -> None:
        super().__init__()
        self.name, self.reason = address.text, "not tried yet"
        self._family, self._place = looked_up(address, socket.SOCK_STREAM)
        self._retry, self._tried = retry, float("-inf")
        self._attempt: socket.socket | None = None

    def look(self, t: float) -> None:
        """Begin to connect, or see what has become of it."""
        if self.state in (TransportState.OPEN, TransportState.CLOSED):
            return
        if self._attempt is None:
            if t - self._tried >= self._retry:
                self._begin(t)
            return
        if t - self._tried > _LONGEST_ATTEMPT:
            self._failed(OSError(errno.ETIMEDOUT, "no answer"))
        elif select.select([], [self._attempt], [], 0.0)[1]:
            self._see(self._attempt)

    def close(self) -> None:
        """End the connection, also one that is only being made."""
        if self._attempt is not None:
            self._attempt.close()
            self._attempt = None
        super().close()

    def _begin(self, t: float) -> None:
        self._tried = t
        self._attempt = socket.socket(self._family, socket.SOCK_STREAM)
        self._attempt.setblocking(False)
        number = self._attempt.connect_ex(self._place)
        if number not in (0, errno.EINPROGRESS, errno.EWOULDBLOCK):
            self._failed(OSError(number, "cannot connect"))

    def _see(self, attempt: socket.socket) -> None:
        number = attempt.getsockopt(socket.SOL_SOCKET, socket.SO_ERROR)
        if number:
            self._failed(OSError(number, "cannot connect"))
            return
        self._attempt = None
        self._opened(attempt)

    def _failed(self, error: OSError) -> None:
        if self._attempt is not None:
            self._attempt.close()
            self._attempt = None
        self.reason = in_words(error)


class TcpListener(_Stream):
    """Waits for one to connect. A newer one takes the place of an older one, which may be long gone without a word."""

    def __init__(self, address: Address) -> None:
        super().__init__()
        self._listening = bound(address, socket.SOCK_STREAM)
        try:
            self._listening.listen(4)
        except OSError as error:
            self._listening.close()
            raise address.error(in_words(error)) from None
        self.name = own_name("tcp", self._listening)
        self.reason = "nobody has connected"

    def look(self, t: float) -> None:  # noqa: ARG002 - as every transport
        """Take in whoever connects."""
        if self.state is TransportState.CLOSED:
            return
        for _ in range(16):
            try:
                connected, _ = self._listening.accept()
            except OSError:  # nobody
                return
            self._drop()
            self._opened(connected)

    def close(self) -> None:
        """Listen no more."""
        self._listening.close()
        super().close()
