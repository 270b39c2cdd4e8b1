"""Which CAN adapter, by configuration, and what is said where it cannot be opened."""

import errno
import os
import socket
import sys
from collections.abc import Mapping
from contextlib import suppress
from dataclasses import dataclass
from ipaddress import ip_address
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

from stommel.errors import StommelError, one_line
from stommel.files.nearest import did_you_mean

if TYPE_CHECKING:
    from can import BusABC

INTERFACES = {
    "socketcan": "an adapter that Linux knows, as can0; its bit rate is set with `ip link`",
    "slcan": "a serial adapter, as /dev/ttyACM0, with a bit rate",
    "udp_multicast": "no adapter: programs on one network, at a multicast address",
    "virtual": "no adapter: within one program",
}
"""Interfaces of python-can that are used, and what they reach."""
DEFAULT_CHANNELS: Mapping[str, str] = MappingProxyType(
    {"socketcan": "can0", "slcan": "/dev/ttyACM0", "udp_multicast": "239.74.163.2", "virtual": "vehicle"}
)
_IP_MULTICAST_ALL, _IPV6_MULTICAST_ALL = 49, 29
"""Of Linux (linux/in.h, linux/in6.h); Python has no names for them."""
BITRATES = (10_000, 20_000, 50_000, 100_000, 125_000, 250_000, 500_000, 750_000, 1_000_000)
"""Of the slcan protocol [bit/s]."""


class BusError(StommelError):
    """A bus that cannot be opened as it was asked for; the message names the key of the configuration."""


@dataclass(frozen=True)
class Adapter:
    """What python-can shall open.

    Raises
    ------
    BusError
        It is impossible.
    """

    interface: str
    """One of `INTERFACES`."""
    channel: str = ""
    """Name of the adapter, port or address; the usual one of the interface if empty."""
    bitrate: int | None = None
    """[bit/s], of slcan only."""
    stays_here: bool = False
    """Whether frames stay on this machine, of udp_multicast only."""
    keys: str = "can."
    """What stands before the key in messages: the table of a file, or `--` on the command line."""

    def __post_init__(self) -> None:
        if self.interface not in INTERFACES:
            near = did_you_mean(self.interface, INTERFACES)
            raise BusError(
                f"{self.keys}interface = {self.interface!r}: must be one of {', '.join(INTERFACES)}{near.rstrip(';')}"
            )
        if not self.channel:
            object.__setattr__(self, "channel", DEFAULT_CHANNELS[self.interface])
        if not self.channel.isprintable() or len(self.channel) > 200:
            shown = one_line(repr(self.channel), 80)
            raise BusError(f"{self.keys}channel = {shown}: must be a name of up to 200 letters")
        if self.interface == "udp_multicast" and multicast_of(self.channel) is None:
            allowed = "a multicast address, 224.0.0.0 to 239.255.255.255 or ff00::/8, with or without :PORT"
            raise BusError(f"{self.keys}channel = {self.channel!r}: must be {allowed}")
        self._check_bitrate()

    def _check_bitrate(self) -> None:
        if self.interface == "slcan":
            if self.bitrate not in BITRATES:
                told = "not given" if self.bitrate is None else str(self.bitrate)
                allowed = ", ".join(str(rate) for rate in BITRATES)
                raise BusError(f"{self.keys}bitrate = {told}: slcan needs one of {allowed} bit/s")
        elif self.bitrate is not None:
            set_with = f"it is set with: ip link set {self.channel} type can bitrate {self.bitrate}"
            why = set_with if self.interface == "socketcan" else f"{self.interface} has none"
            raise BusError(f"{self.keys}bitrate = {self.bitrate}: leave it out; {why}")

    def __str__(self) -> str:
        return f"{self.interface} {self.channel}"


def multicast_of(channel: str) -> tuple[str, int | None] | None:
    """Address and port of `ADDRESS` or `ADDRESS:PORT` (IPv6: `[ADDRESS]:PORT`); None where it is no multicast.

    Two buses of one machine need two ports: the system gives datagrams of any group to every program on the port.
    """
    address, colon, port = channel.rpartition(":")
    if not colon or (":" in address and not address.endswith("]")):
        address, port = channel, ""  # no port, or an IPv6 address
    elif not port:
        return None
    try:
        found = ip_address(address.strip("[]"))
    except ValueError:
        return None
    if not found.is_multicast or (port and not (port.isascii() and port.isdigit() and 1024 <= int(port) <= 65535)):
        return None
    return str(found), int(port) if port else None


def open_adapter(adapter: Adapter) -> "BusABC":
    """Open an adapter.

    Raises
    ------
    BusError
        It cannot be opened; the message names the key that is to be looked at.
    """
    from can import Bus  # noqa: PLC0415 - only programs on real ports need it

    options: dict[str, Any] = {"interface": adapter.interface, "channel": adapter.channel}
    if adapter.bitrate is not None:
        options["bitrate"] = adapter.bitrate
    multicast = multicast_of(adapter.channel) if adapter.interface == "udp_multicast" else None
    if multicast is not None:
        address, port = multicast
        options |= {"channel": address, "fd": False} | ({} if port is None else {"port": port})
        options |= {"hop_limit": 0} if adapter.stays_here else {}
    try:
        bus = Bus(ignore_config=True, **options)
        if adapter.interface == "udp_multicast":
            hear_own_address_only(bus)
    except Exception as error:  # drivers' errors come as they are (hardbyte/python-can#907)
        raise BusError(_objection(adapter, error)) from error
    return bus


def hear_own_address_only(bus: "BusABC") -> None:
    """Keep a multicast bus from hearing the buses of other programs on this machine, which have other addresses.

    By default Linux hands a socket what comes to any address that any program has joined (ip(7), IP_MULTICAST_ALL).
    """
    if sys.platform != "linux":
        return
    # the family is that of the descriptor; a kernel that has no such option goes on as it is
    with socket.socket(fileno=os.dup(bus.fileno())) as port, suppress(OSError):
        if port.family == socket.AF_INET6:
            port.setsockopt(socket.IPPROTO_IPV6, _IPV6_MULTICAST_ALL, 0)
        else:
            port.setsockopt(socket.IPPROTO_IP, _IP_MULTICAST_ALL, 0)


def _objection(adapter: Adapter, error: Exception) -> str:
    """What is to be looked at, by the error's number."""
    number = _number(error)
    channel = f"{adapter.keys}channel = {adapter.channel!r}"
    if number in (errno.EAFNOSUPPORT, errno.EPROTONOSUPPORT):
        return f"{adapter.keys}interface = {adapter.interface!r}: this system has none ({_words(error)})"
    if number in (errno.ENODEV, errno.ENOENT, errno.ENXIO):
        return f"{channel}: there is no such adapter; is it plugged in?"
    if number in (errno.EACCES, errno.EPERM):
        return f"{channel}: not permitted to this user"
    if number == errno.ENETDOWN:
        return f"{channel}: it is down; set it up with: ip link set {adapter.channel} up"
    return f"{channel}: cannot be opened: {_words(error)}"


def _number(error: BaseException | None) -> int | None:
    """Number of the system's error below those of the driver."""
    while error is not None:
        number = getattr(error, "errno", None) or getattr(error, "error_code", None)
        if isinstance(number, int):
            return number
        error = error.__cause__ or error.__context__
    return None


def _words(error: Exception) -> str:
    return one_line(str(getattr(error, "strerror", None) or error or type(error).__name__), 160)
