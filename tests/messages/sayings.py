"""Values that a message can say."""

import random
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from cantools.database.can import Message

ADDED = ("alive_counter", "checksum")
"""Signals that the encoder fills in."""


def sayable(message: "Message", chosen: random.Random) -> dict[str, float]:
    """Values at random within the limits."""
    values: dict[str, float] = {}
    for signal in message.signals:
        if signal.name not in ADDED:
            low, high = signal.minimum or 0, signal.maximum or 0
            values[signal.name] = (
                chosen.randint(int(low), int(high)) if signal.scale == 1 else chosen.uniform(low, high)
            )
    return values
