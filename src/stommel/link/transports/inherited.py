"""Sockets that whoever started this program has bound for it, so that nobody can take their port in between."""

import socket

_handed: list[socket.socket] = []


def reserved(host: str) -> socket.socket:
    """A TCP socket that has a free port of a host, and on which nobody listens yet: who connects is refused.

    While it is open, no other program can have the port.

    Raises
    ------
    OSError
        There is none.
    """
    made = socket.socket()
    try:
        made.bind((host, 0))  # without SO_REUSEADDR, which would let others bind it too until somebody listens
    except OSError:
        made.close()
        raise
    return made


def take_over(number: int) -> None:
    """Let the transport that shall listen at the port of a socket have that socket, given its file descriptor."""
    _handed.append(socket.socket(fileno=number))


def taken_over(kind: socket.SocketKind, place: object) -> socket.socket | None:
    """The socket of a kind that was bound to a place for this program; None if there is none. It is given once."""
    for made in _handed:
        if made.type == kind and made.getsockname() == place:
            _handed.remove(made)
            return made
    return None
