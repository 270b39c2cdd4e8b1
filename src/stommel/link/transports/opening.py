"""Opens what an address names."""

from stommel.link.transports.address import Address, read_address
from stommel.link.transports.pseudo_terminal import PseudoTerminal
from stommel.link.transports.serial_line import SerialLine
from stommel.link.transports.tcp import TcpClient, TcpListener
from stommel.link.transports.transport import Transport
from stommel.link.transports.udp import UdpClient, UdpListener


def open_transport(address: str | Address, key: str = "link.port") -> Transport:
    """Open the transport that an address names: `serial:/dev/ttyUSB0:115200`, `tcp:HOST:PORT`, `tcp-listen:HOST:PORT`,
    `udp:HOST:PORT`, `udp-listen:HOST:PORT`, or `pty` for a pseudo-terminal.

    A peer that is not there yet is no error: it is tried again and again, and `reason` says why.

    Raises
    ------
    TransportError
        The address says nothing, or cannot be had here: no such serial port, a host without an address, a port that
        another program has.
    """  # noqa: D205 - the addresses belong into the first sentence
    found = read_address(address, key) if isinstance(address, str) else address
    match found.kind:
        case "serial":
            return SerialLine(found)
        case "tcp":
            return TcpClient(found)
        case "tcp-listen":
            return TcpListener(found)
        case "udp":
            return UdpClient(found)
        case "udp-listen":
            return UdpListener(found)
        case _:
            return PseudoTerminal(found)
