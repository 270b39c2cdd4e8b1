"""The edge: a serial port of the operating system, by pyserial. It never waits, and comes back after unplugging."""

import os
from dataclasses import dataclass
from enum import StrEnum
from pathlib import Path
from typing import Any

import serial
from serial.tools import list_ports

from stommel.errors import StommelError

BAUD_RATES = (1200, 2400, 4800, 9600, 19_200, 38_400, 57_600, 115_200, 230_400, 460_800, 921_600)
_SHOWN = 8
_READ_AT_ONCE = 65_536


class PortError(StommelError):
    """A serial port cannot be used; the message names the key that says which port it is."""


class PortState(StrEnum):
    """Whether bytes can go through."""

    CLOSED = "closed"
    OPEN = "open"
    LOST = "lost"
    """It was open, and is unplugged; it is tried again."""


@dataclass(frozen=True)
class PortSettings:
    """Which port, and how fast."""

    key: str
    """Of the configuration, as `compass.port`: errors name it."""
    port: str
    """As the operating system names it, such as /dev/ttyUSB0 or COM3."""
    baud: int
    """Bits per second."""
    retry: float = 1.0
    """Between two attempts to open it again [s]."""
    buffer: int = 65_536
    """Bytes that wait to be written at most; older ones are kept, newer ones refused."""

    def __post_init__(self) -> None:
        if self.baud not in BAUD_RATES:
            rates = ", ".join(map(str, BAUD_RATES))
            raise PortError(f"{_beside(self.key, 'baud')} = {self.baud}: must be one of {rates}")


class SerialPort:
    """Bytes in and out of one port."""

    def __init__(self, settings: PortSettings) -> None:
        self.settings = settings
        self.state = PortState.CLOSED
        self.reason = "not opened yet"
        """Why it is not open; empty while it is."""
        self.reopened = 0
        """Times that it came back."""
        self.refused = 0
        """Bytes that found no room to wait in."""
        self._port: Any = None
        self._waiting = b""
        self._tried = float("-inf")

    def connect(self) -> None:
        """Open the port.

        Raises
        ------
        PortError
            There is no such port, it is another program's, or it may not be read.
        """
        try:
            self._port = serial.Serial(
                self.settings.port, self.settings.baud, timeout=0, write_timeout=0, exclusive=True
            )
        except (OSError, ValueError) as error:  # SerialException is an OSError
            raise PortError(_sentence(self.settings, error)) from None
        self.state, self.reason = PortState.OPEN, ""

    def read(self, t: float) -> bytes:
        """Return what has come; nothing while the port is away."""
        if not self._there(t):
            return b""
        try:
            data: bytes = self._port.read(_READ_AT_ONCE)
        except (OSError, TypeError) as error:  # pyserial raises a TypeError where the file is gone
            self._lose(error, t)
            return b""
        return data

    def write(self, data: bytes, t: float) -> int:
        """Write what the port takes now, keep the rest for the next call, and return how much was accepted."""
        if not self._there(t):
            self._waiting = b""  # a command of before is none after
            self.refused += len(data)
            return 0
        accepted = min(len(data), self.settings.buffer - len(self._waiting))
        self.refused += len(data) - accepted
        self._waiting += data[:accepted]
        if self._waiting:
            try:
                self._waiting = self._waiting[_written(self._port, self._waiting) :]
            except (OSError, TypeError) as error:
                self._lose(error, t)
        return accepted

    @property
    def room(self) -> int:
        """Bytes that find room to wait in; none while the port is away."""
        return self.settings.buffer - len(self._waiting) if self.state is PortState.OPEN else 0

    @property
    def waiting(self) -> int:
        """Bytes that were accepted and have not left, as far as the operating system says."""
        try:
            return len(self._waiting) + (self._port.out_waiting if self.state is PortState.OPEN else 0)
        except (OSError, TypeError, AttributeError):  # a port that cannot say it
            return len(self._waiting)

    def close(self) -> None:
        """Give the port back."""
        self._drop()
        self.state, self.reason = PortState.CLOSED, "closed"

    def _there(self, t: float) -> bool:
        """Whether the port is open; one that was lost is tried again now and then."""
        if self.state is PortState.LOST and t - self._tried >= self.settings.retry:
            self._tried = t
            try:
                self.connect()
            except PortError as error:
                self.reason = str(error)
            else:
                self.reopened += 1
        return self.state is PortState.OPEN

    def _lose(self, error: Exception, t: float) -> None:
        self._drop()
        self._tried = t
        self._waiting = b""
        self.state, self.reason = PortState.LOST, f"{self.settings.key} = {self.settings.port}: unplugged ({error})"

    def _drop(self) -> None:
        port, self._port = self._port, None
        if port is not None:
            try:
                port.close()
            except OSError:
                return  # it is gone already


def present_ports() -> tuple[str, ...]:
    """Serial ports that the operating system has."""
    return tuple(sorted(port.device for port in list_ports.comports()))


def _written(port: Any, data: bytes) -> int:  # of pyserial, which has no types
    """Write what the port takes now, and return how much that was.

    On POSIX pyserial's own `write` without a timeout does not return before the port takes more.
    """
    if os.name == "nt":
        return port.write(data) or 0
    try:
        return os.write(port.fileno(), data)
    except BlockingIOError:
        return 0


def _sentence(settings: PortSettings, error: Exception) -> str:
    where = f"{settings.key} = {settings.port}"
    if isinstance(error, PermissionError) or "Permission" in str(error):
        return f"{where}: may not be opened; on Linux the user must be in the group that owns it (dialout)"
    if "exclusively lock" in str(error) or "busy" in str(error):
        return f"{where}: another program has it open"
    if not Path(settings.port).exists():
        there = present_ports()
        named = ", ".join(there[:_SHOWN]) + (" ..." if len(there) > _SHOWN else "")
        return f"{where}: there is no such port; there {'are' if len(there) > 1 else 'is'} {named or 'none'}"
    return f"{where}: cannot be opened as a serial port ({error})"


def _beside(key: str, name: str) -> str:
    return f"{key.rpartition('.')[0]}.{name}".lstrip(".")
