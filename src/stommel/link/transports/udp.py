"""UDP, from either side."""

import socket
from typing import Any

from stommel.link.transports.address import Address
from stommel.link.transports.hosts import bound, in_words, looked_up, own_name
from stommel.link.transports.transport import TransportState

_DATAGRAM = 1400
"""Bytes at once, so that a datagram is not cut on its way."""
_LONGEST = 65_536
_AT_ONCE = 64
"""Datagrams that are read in one look."""
_MOST_PEERS, _FORGOTTEN = 4, 60.0
"""Whom a listener answers: the last so many, those that were heard within so long [s], and always the last one."""


class UdpClient:
    """Speaks to one address. Nobody tells whether anyone hears it, but a machine may say that no one listens."""

    def __init__(self, address: Address) -> None:
        self.name = address.text
        family, place = looked_up(address, socket.SOCK_DGRAM)
        self._socket = socket.socket(family, socket.SOCK_DGRAM)
        self._socket.setblocking(False)
        try:
            self._socket.connect(place)
        except OSError as error:
            self._socket.close()
            raise address.error(in_words(error)) from None
        self.state, self.reason = TransportState.OPEN, ""

    def read(self, t: float) -> bytes:  # noqa: ARG002 - as every transport
        """Return what has come."""
        data = bytearray()
        for _ in range(_AT_ONCE if self.state is not TransportState.CLOSED else 0):
            try:
                data += self._socket.recv(_LONGEST)
            except (BlockingIOError, InterruptedError):
                break
            except OSError as error:  # what was sent before was refused
                self.state, self.reason = TransportState.WAITING, in_words(error)
        if data:
            self.state, self.reason = TransportState.OPEN, ""
        return bytes(data)

    def write(self, data: bytes, t: float) -> int:  # noqa: ARG002 - as every transport
        """Send bytes as one datagram; return how many were taken."""
        if self.state is TransportState.CLOSED:
            return 0
        try:
            return self._socket.send(data) if data else 0
        except (BlockingIOError, InterruptedError):
            return 0
        except OSError as error:
            self.state, self.reason = TransportState.WAITING, in_words(error)
            return 0

    def room(self, t: float) -> int:  # noqa: ARG002 - as every transport
        """Bytes that are taken at once."""
        return 0 if self.state is TransportState.CLOSED else _DATAGRAM

    def waiting(self, t: float) -> int:  # noqa: ARG002 - as every transport
        """Nothing waits here."""
        return 0

    def close(self) -> None:
        """Speak no more."""
        self._socket.close()
        self.state, self.reason = TransportState.CLOSED, "closed"


class UdpListener:
    """Answers those who have spoken to it."""

    def __init__(self, address: Address) -> None:
        self._socket = bound(address, socket.SOCK_DGRAM)
        self.name = own_name("udp", self._socket)
        self.state, self.reason = TransportState.WAITING, "nobody has spoken"
        self._peers: dict[Any, float] = {}

    def read(self, t: float) -> bytes:
        """Return what has come."""
        data = bytearray()
        for _ in range(_AT_ONCE if self.state is not TransportState.CLOSED else 0):
            try:
                datagram, peer = self._socket.recvfrom(_LONGEST)
            except (BlockingIOError, InterruptedError):
                break
            except OSError:  # somebody is gone; the others are not
                continue
            data += datagram
            self._peers.pop(peer, None)
            self._peers[peer] = t
        if data:
            last = list(self._peers)[-_MOST_PEERS:]
            self._peers = {peer: self._peers[peer] for peer in last}
            self.state, self.reason = TransportState.OPEN, ""
        return bytes(data)

    def write(self, data: bytes, t: float) -> int:
        """Send bytes as one datagram to everybody who is there; return how many were taken."""
        if self.state is not TransportState.OPEN or not data:
            return 0
        last = next(reversed(self._peers))
        for peer, heard in self._peers.items():
            if peer == last or t - heard <= _FORGOTTEN:
                self._send(data, peer)
        return len(data)

    def room(self, t: float) -> int:  # noqa: ARG002 - as every transport
        """Bytes that are taken at once."""
        return _DATAGRAM if self.state is TransportState.OPEN else 0

    def waiting(self, t: float) -> int:  # noqa: ARG002 - as every transport
        """Nothing waits here."""
        return 0

    def close(self) -> None:
        """Listen no more."""
        self._socket.close()
        self.state, self.reason = TransportState.CLOSED, "closed"

    def _send(self, data: bytes, peer: Any) -> None:
        try:
            self._socket.sendto(data, peer)
        except OSError as error:  # UDP may lose anything
            self.reason = in_words(error)
