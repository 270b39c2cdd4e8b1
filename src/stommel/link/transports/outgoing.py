"""Bytes that wait for somebody to take them."""

from collections.abc import Callable

from stommel.link.transports.transport import BUFFER, STALE


class OutgoingBytes:
    """A bounded queue. What nobody takes for long is dropped: a command of before is none after."""

    def __init__(self, most: int = BUFFER) -> None:
        self._most = most
        self._bytes = bytearray()
        self._moved = 0.0
        self.dropped = 0
        """Bytes that were dropped."""

    def __len__(self) -> int:
        return len(self._bytes)

    @property
    def room(self) -> int:
        """Bytes that find room."""
        return self._most - len(self._bytes)

    def put(self, data: bytes, t: float) -> int:
        """Take bytes at a time [s], all or none, and return how many were taken."""
        if len(data) > self.room:
            return 0
        if not self._bytes:
            self._moved = t
        self._bytes += data
        return len(data)

    def flush(self, send: Callable[[bytes], int], t: float) -> bool:
        """Send what is taken now, and return whether anybody takes it still.

        `send` returns how much it took, and raises BlockingIOError if nothing.
        """
        while self._bytes:
            try:
                taken = send(bytes(self._bytes[:65_536]))
            except (BlockingIOError, InterruptedError):
                taken = 0
            if taken <= 0:
                break
            del self._bytes[:taken]
            self._moved = t
        if not self._bytes or t - self._moved <= STALE:
            return True
        self.clear()
        return False

    def clear(self) -> None:
        """Drop all."""
        self.dropped += len(self._bytes)
        self._bytes.clear()
