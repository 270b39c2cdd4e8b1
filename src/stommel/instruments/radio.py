"""The radio as a transparent serial port: bytes in, bytes out, no faster than it can, no more than it holds."""

from typing import NamedTuple

from stommel.instruments.settings import require_positive

_BITS_A_BYTE = 10
"""Of a serial port with one start and one stop bit."""


class RadioCounts(NamedTuple):
    """What went through since the start."""

    sent: int
    """Bytes."""
    received: int
    """Bytes."""
    overflowed: int
    """Bytes that found no room and were refused or lost."""
    waiting: int
    """Bytes that wait to be sent."""


class _Pipe:
    """A bounded buffer that is emptied at a bit rate."""

    def __init__(self, bit_rate: float, room: int) -> None:
        self._rate = bit_rate / _BITS_A_BYTE
        self._room = room
        self._bytes = bytearray()
        self._credit = 0.0
        self._t: float | None = None
        self.passed = self.lost = 0

    def __len__(self) -> int:
        return len(self._bytes)

    def put(self, data: bytes) -> int:
        """Take in what there is room for, and return how much that was."""
        taken = min(len(data), self._room - len(self._bytes))
        self._bytes += data[:taken]
        self.lost += len(data) - taken
        return taken

    def get(self, t: float) -> bytes:
        """Return what has had time to pass since the last call. Time that was not used is not saved up."""
        if self._t is not None and t > self._t:
            self._credit += (t - self._t) * self._rate
        self._t = t
        count = min(int(self._credit), len(self._bytes))
        out = bytes(self._bytes[:count])
        del self._bytes[:count]
        self._credit = self._credit - count if self._bytes else 0.0
        self.passed += count
        return out

    def clear(self) -> None:
        self.lost += len(self._bytes)
        self._bytes.clear()


class Radio:
    """The vehicle's side. What is above it learns from `room` how much it may write; more is refused and counted."""

    def __init__(self, bit_rate: float = 115_200.0, buffer: int = 8192) -> None:
        require_positive("radio.bit_rate", bit_rate)
        require_positive("radio.buffer", buffer)
        self._out = _Pipe(bit_rate, buffer)
        self._buffer = buffer
        self._received = 0
        self.heard_at = float("-inf")
        """When bytes last came [s]."""

    @property
    def room(self) -> int:
        """Bytes that can be written now."""
        return self._buffer - len(self._out)

    def write(self, data: bytes) -> int:
        """Queue bytes for sending, and return how many found room."""
        return self._out.put(data)

    def poll(self, t: float) -> bytes:
        """Bytes to send now: as many as the bit rate has had time for."""
        return self._out.get(t)

    def take(self, data: bytes, t: float) -> bytes:
        """Bytes that came, as they came."""
        if data:
            self._received += len(data)
            self.heard_at = t
        return data

    def counts(self) -> RadioCounts:
        """Return what went through."""
        return RadioCounts(self._out.passed, self._received, self._out.lost, len(self._out))


class RadioTruth(NamedTuple):
    """What is in the air at the vehicle."""

    heard: bytes
    """What the other station has sent since the last step, as it came through."""
    linked: bool
    """Whether the two radios hear each other."""


class RadioDevice:
    """A simulated modem: what the vehicle writes comes out at `on_air`, at the pace of the air."""

    def __init__(self, bit_rate: float = 115_200.0, buffer: int = 8192) -> None:
        self._up = _Pipe(bit_rate, buffer)
        self._down = _Pipe(bit_rate, buffer)
        self._sent = bytearray()

    def take(self, data: bytes, truth: RadioTruth, t: float) -> bytes:
        """Bytes for the vehicle. Without a link the modem holds what it has room for."""
        self._up.put(data)
        self._down.put(truth.heard if truth.linked else b"")
        passed = self._up.get(t) if truth.linked else b""
        self._sent += passed
        return self._down.get(t)

    def on_air(self) -> bytes:
        """What has gone out since the last call."""
        out = bytes(self._sent)
        self._sent.clear()
        return out

    def restart(self) -> None:
        """Lose power and come back: what was on its way is lost."""
        self._up.clear()
        self._down.clear()
        self._sent.clear()
