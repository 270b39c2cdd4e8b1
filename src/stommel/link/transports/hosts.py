"""Sockets of hosts, and errors of theirs in words."""

import errno
import socket
from typing import Any

from stommel.link.transports.address import Address
from stommel.link.transports.inherited import taken_over

_WORDS = {
    errno.ECONNREFUSED: "refused: no program listens there",
    errno.ECONNRESET: "the other end broke it off",
    errno.EPIPE: "the other end broke it off",
    errno.EHOSTUNREACH: "the host cannot be reached",
    errno.ENETUNREACH: "there is no way to its network",
    errno.ETIMEDOUT: "no answer",
    errno.EADDRINUSE: "another program listens there already",
    errno.EADDRNOTAVAIL: "this machine has no such address",
    errno.EACCES: "this user may not",
}


def looked_up(address: Address, kind: socket.SocketKind) -> tuple[socket.AddressFamily, Any]:
    """Return family and address of a host; this is the one call that may take a while.

    Raises
    ------
    TransportError
        It has none.
    """
    try:
        family, _, _, _, found = socket.getaddrinfo(address.host, address.number, type=kind)[0]
    except (OSError, UnicodeError) as error:
        raise address.error(f"no host of this name is known ({error})") from None
    return family, found


def in_words(error: OSError) -> str:
    """Say what an error of the network means."""
    return _WORDS.get(error.errno or 0, str(error))


def bound(address: Address, kind: socket.SocketKind) -> socket.socket:
    """Return a socket that has the address, and never waits; one that was bound for this program comes first.

    Raises
    ------
    TransportError
        It cannot have it.
    """
    family, place = looked_up(address, kind)
    if (handed := taken_over(kind, place)) is not None:
        handed.setblocking(False)
        return handed
    made = socket.socket(family, kind)
    try:
        if kind is socket.SOCK_STREAM:
            made.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        made.setblocking(False)
        made.bind(place)
    except OSError as error:
        made.close()
        raise address.error(in_words(error)) from None
    return made


def own_name(kind: str, made: socket.socket) -> str:
    """Address that a socket has, as one would write it."""
    host, number = made.getsockname()[:2]
    return f"{kind}:[{host}]:{number}" if ":" in host else f"{kind}:{host}:{number}"
