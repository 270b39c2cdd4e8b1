"""A frame of the CAN bus, as everything above the adapter knows it."""

from typing import NamedTuple


class Frame(NamedTuple):
    """A classic CAN data frame with an 11-bit identifier."""

    identifier: int
    """The lower, the earlier on the bus; 0 to 0x7FF."""
    data: bytes
    """At most 8 bytes."""
