"""A link on its serial port: nothing that goes wrong in it ends the vehicle's software."""

from collections.abc import Callable
from typing import Protocol

from stommel.errors import one_line
from stommel.link.rate import bytes_ahead
from stommel.onboard.radio.vehicle_link import VehicleLink

_MOST_TOLD = 64
"""Different troubles that are told; a link that finds ever new ones must not fill the log."""

Tell = Callable[[float, str, str], None]


class Port(Protocol):
    """A serial port, as `stommel.messages.serial_port.SerialPort`."""

    @property
    def room(self) -> int:
        """Bytes that find room to wait in."""

    @property
    def waiting(self) -> int:
        """Bytes that have not left."""

    def read(self, t: float) -> bytes:
        """Return what has come."""

    def write(self, data: bytes, t: float) -> int:
        """Take bytes, and return how many."""


class PortLink:
    """A vehicle's end of the link, with its port.

    Parameters
    ----------
    name
        For those who read the log.
    link, port
        Joined here.
    bit_rate
        Of the port [bit/s].
    tell
        Takes time, code and words for the log.
    """

    def __init__(self, name: str, link: VehicleLink, port: Port, bit_rate: float, tell: Tell) -> None:
        self.link, self.failures = link, 0
        self._name, self._port, self._tell = name, port, tell
        self._ahead = round(bytes_ahead(bit_rate))
        self._told: set[str] = set()

    def look(self, t: float, *, on: bool = True) -> None:
        """Hear and speak at a time [s]; without power on the radio, what its port says is noise."""
        try:
            data = self._port.read(t)
            if on and (data or self._port.room):
                self.link.take(data, t)
                if out := self.link.poll(t, min(self._port.room, self._ahead - self._port.waiting)):
                    self._port.write(out, t)
        except Exception as error:  # noqa: BLE001 - a dive goes on without any link
            self._failed(t, error)

    def observe(self, t: float, *, on: bool = True) -> None:
        """Look at what the coordinator has decided at a time [s]."""
        try:
            self.link.observe(t)
            if not on:
                self.link.rest(t)
            for words in self.link.notes:
                self._say(t, words)
        except Exception as error:  # noqa: BLE001 - as above
            self._failed(t, error)

    def _failed(self, t: float, error: Exception) -> None:
        self.failures += 1
        self._say(t, f"failed: {type(error).__name__}: {one_line(str(error), 200)}")

    def _say(self, t: float, words: str) -> None:
        """Tell what was not told before."""
        if words not in self._told and len(self._told) < _MOST_TOLD:
            self._told.add(words)
            self._tell(t, self._name, f"{self._name}: {words}")
