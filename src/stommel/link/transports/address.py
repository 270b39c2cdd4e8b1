"""Addresses of transports, as a user writes them."""

from typing import NamedTuple

from stommel.link.transports.transport import TransportError

FORMS = (
    "serial:/dev/ttyUSB0:115200",
    "tcp:HOST:PORT",
    "tcp-listen:HOST:PORT",
    "udp:HOST:PORT",
    "udp-listen:HOST:PORT",
    "pty",
)
_NETWORK = ("tcp", "tcp-listen", "udp", "udp-listen")
_MOST_PORT = 65_535


class Address(NamedTuple):
    """Where a transport leads."""

    key: str
    """Of a configuration or option, which errors name."""
    text: str
    """As it was written."""
    kind: str
    """`serial`, `tcp`, `tcp-listen`, `udp`, `udp-listen` or `pty`."""
    host: str = ""
    """Host, or the serial port's name."""
    number: int = 0
    """Port of the host, or the serial port's bits per second."""

    @property
    def bit_rate(self) -> int | None:
        """Of a serial line; None where the line is not known to be slow."""
        return self.number if self.kind == "serial" else None

    def error(self, words: str) -> TransportError:
        """Return an error that names this address."""
        return TransportError(f"{self.key} = {self.text}: {words}")


def read_address(text: str, key: str = "link.port") -> Address:
    """Return the address that a text says.

    Raises
    ------
    TransportError
        It says none; the message names the key.
    """
    kind, _, rest = text.partition(":")
    address = Address(key, text, kind)
    if kind == "pty" and not rest:
        return address
    if kind not in (*_NETWORK, "serial"):
        raise address.error(f"must be one of {', '.join(FORMS)}")
    host, _, last = rest.rpartition(":")
    if kind == "serial":
        if not host or not last.isdecimal():
            raise address.error(f"name of the port or its speed is missing; must be like {FORMS[0]}")
        return address._replace(host=host, number=int(last[:9]))
    host = host.removeprefix("[").removesuffix("]")
    if not host or not last.isdecimal():
        raise address.error(f"host or port is missing; must be like {kind}:HOST:PORT")
    low = 0 if kind.endswith("listen") else 1  # 0: any that is free
    if not low <= int(last[:9]) <= _MOST_PORT:
        raise address.error(f"port {last}: must be from {low} to {_MOST_PORT}")
    return address._replace(host=host, number=int(last[:9]))
