"""The last of everything that a vehicle has said, and when."""

from collections import deque
from typing import NamedTuple

from stommel.link.outbox import Outbox
from stommel.link.service import Received
from stommel.link.values import text, whole
from stommel.messages.mavlink import Fields

MOST_TEXTS, MOST_SUMMARIES, MOST_SAMPLES = 200, 1000, 10_000
_MOST_PARTS = 16
_TEXT = 50
"""Bytes of a STATUSTEXT."""


class Said(NamedTuple):
    """A message, and when it came."""

    t: float
    """[s]"""
    component: int
    values: Fields


class Text(NamedTuple):
    """A sentence of the vehicle."""

    t: float
    severity: int
    """MAV_SEVERITY: 0 emergency to 7 debug."""
    words: str


class Heard:
    """Listens to one vehicle.

    Parameters
    ----------
    system
        The vehicle.
    """

    def __init__(self, system: int) -> None:
        self._system = system
        self.last: dict[str, Said] = {}
        """By name of the message."""
        self.texts: deque[Text] = deque(maxlen=MOST_TEXTS)
        self.summaries: dict[int, Fields] = {}
        """The last summary of each dive, by the time at which it began [ms]."""
        self.samples: deque[Fields] = deque(maxlen=MOST_SAMPLES)
        """Of the CTD, as they came."""
        self._parts: dict[int, dict[int, str]] = {}

    def take(self, received: Received, t: float) -> None:
        """Take a message at a time [s]."""
        if received.system != self._system:
            return
        name, values = received.name, received.values
        self.last[name] = Said(t, received.component, values)
        if name == "STATUSTEXT":
            self._take_text(values, t)
        elif name == "DIVE_SUMMARY":
            self.summaries[whole(values, "time_begin_unix_ms")] = values
            while len(self.summaries) > MOST_SUMMARIES:
                del self.summaries[next(iter(self.summaries))]
        elif name == "CTD_SAMPLE":
            self.samples.append(values)

    def poll(self, t: float, outbox: Outbox) -> None:
        """Say nothing."""

    def _take_text(self, values: Fields, t: float) -> None:
        """Put the parts of a long sentence together; one of which a part is lost is told as far as it came."""
        number, chunk, severity = (whole(values, name) for name in ("id", "chunk_seq", "severity"))
        words = text(values, "text")
        if number:
            parts = self._parts.setdefault(number, {})
            if chunk in parts:
                parts.clear()  # of a text whose end was lost, before the vehicle began to count anew
            parts[chunk] = words
            while len(self._parts) > _MOST_PARTS:
                del self._parts[next(iter(self._parts))]
            if len(words.encode("utf-8", "replace")) >= _TEXT:  # not shorter where a letter was cut
                return  # more of it follows
            del self._parts[number]
            words = "".join(parts.get(k, " ... ") for k in range(max(parts) + 1))
        self.texts.append(Text(t, severity, words))
