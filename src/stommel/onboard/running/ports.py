"""Real ports of a vehicle: all are tried, and everything that is missing is told at once."""

from collections.abc import Mapping
from dataclasses import dataclass

from stommel.errors import StommelError
from stommel.messages.bus import CanBus
from stommel.messages.serial_port import PortSettings, PortState, SerialPort
from stommel.onboard.coordination.config import Configuration
from stommel.onboard.coordination.own_instruments import PORTS


class MissingPortsError(StommelError):
    """Ports that cannot be opened; the message has a line for each, with its key."""

    def __init__(self, origin: str, problems: list[str]) -> None:
        self.problems = problems
        super().__init__("\n".join(f"{origin}: {problem}" for problem in problems))


@dataclass
class RealPorts:
    """The bus, and the serial ports by the names of `stommel.onboard.coordination.own_instruments.PORTS`."""

    bus: CanBus
    serial: Mapping[str, SerialPort]
    bench: SerialPort | None = None
    """Where a person at the vehicle speaks to it; None where the configuration names no port."""

    def close(self) -> None:
        """Give everything back."""
        self.bus.close()
        for port in (*self.serial.values(), *([] if self.bench is None else [self.bench])):
            port.close()


def open_ports(configuration: Configuration, origin: str) -> RealPorts:
    """Open the bus and every serial port of a configuration; `origin` names its file in messages.

    Raises
    ------
    MissingPortsError
        At least one cannot be opened; none stays open.
    """
    problems: list[str] = []
    bus: CanBus | None = None
    try:
        bus = CanBus(configuration.adapter)
    except StommelError as error:
        problems.append(str(error))
    serial: dict[str, SerialPort] = {}
    for name in PORTS:
        try:
            table = getattr(configuration.file, name)
            serial[name] = SerialPort(PortSettings(f"{name}.port", table.port, table.baud))
            serial[name].connect()
        except StommelError as error:
            problems.append(str(error))
    if problems or bus is None:
        for port in serial.values():
            port.close()
        if bus is not None:
            bus.close()
        raise MissingPortsError(origin, problems)
    return RealPorts(bus, serial, _bench(configuration))


def _bench(configuration: Configuration) -> SerialPort | None:
    """The port of the bench; at sea nobody has plugged it in, and it is tried again now and then."""
    table = configuration.file.bench
    if table.port is None:
        return None
    port = SerialPort(PortSettings("bench.port", table.port, table.baud))
    try:
        port.connect()
    except StommelError as error:
        port.state, port.reason = PortState.LOST, str(error)
    return port
