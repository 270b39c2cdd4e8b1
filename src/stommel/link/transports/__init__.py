"""The edge of the link: real ports, by one syntax of addresses. They never wait, and say why nothing goes through."""

from stommel.link.transports.opening import open_transport
from stommel.link.transports.transport import Transport, TransportError, TransportState

__all__ = ["Transport", "TransportError", "TransportState", "open_transport"]
