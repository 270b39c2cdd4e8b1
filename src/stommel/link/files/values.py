"""Fields of received messages, with the types that the dialect gives them."""

from stommel.link.service import Received


def whole(received: Received, name: str) -> int:
    """A whole number."""
    value = received.values[name]
    assert isinstance(value, int)
    return value


def octets(received: Received, name: str) -> bytes:
    """Bytes."""
    value = received.values[name]
    assert isinstance(value, bytes)
    return value


def text(received: Received, name: str) -> str:
    """Text."""
    value = received.values[name]
    assert isinstance(value, str)
    return value
