"""From words to frames and back: scaling and limits by cantools, counter and checksum by us."""

from collections import Counter
from dataclasses import dataclass, field
from typing import NamedTuple

from stommel.errors import StommelError
from stommel.messages.database import guard_of, message_named, message_of
from stommel.messages.frames import Frame
from stommel.messages.protection import checksum

TURNS = 16
"""Values of an alive counter."""

Values = dict[str, float]
"""Signals by name, SI units; enumerations as numbers."""


class Received(NamedTuple):
    """A frame that says something."""

    name: str
    """Of the message."""
    values: Values
    lost: int
    """Frames of this message that were lost before it, by its alive counter: 0 to 14."""


class Rejected(NamedTuple):
    """A frame that is not obeyed."""

    identifier: int
    reason: str
    """`unknown`, `length`, `checksum`, `repeated` or `range`."""


class UnsayableError(StommelError):
    """A message or a value that the CAN database does not allow."""


class Encoder:
    """Makes frames of words, each message with its own alive counter."""

    def __init__(self) -> None:
        self._counters: Counter[str] = Counter()

    def frame(self, name: str, **values: float) -> Frame:
        """Return the next frame of a message.

        Raises
        ------
        UnsayableError
            There is no such message, a signal is missing, or a value is outside of what the database allows.
        """
        from cantools.database.errors import EncodeError  # noqa: PLC0415 - loaded with the database

        try:
            message = message_named(name)
            guard = guard_of(message.frame_id)
            if guard.counted:
                values["alive_counter"] = self._counters[name] % TURNS
            if guard.checked:
                values["checksum"] = 0
            data = message.encode(values)
        except KeyError as error:
            raise UnsayableError(f"CAN message {name}: the database has no {error}") from None
        except EncodeError as error:
            raise UnsayableError(f"CAN message {name}: {error}") from None
        self._counters[name] += 1
        if guard.checked:
            data = data[:-1] + bytes((checksum(message.frame_id, data),))
        return Frame(message.frame_id, data)


@dataclass
class Decoder:
    """Makes words of frames, and counts what it rejects and what was lost."""

    received: Counter[str] = field(default_factory=Counter)
    """Good frames by message."""
    lost: Counter[str] = field(default_factory=Counter)
    """Missing frames by message, told by gaps of the alive counter."""
    rejected: Counter[tuple[int, str]] = field(default_factory=Counter)
    """Rejected frames by identifier and reason."""
    _last: dict[int, int] = field(default_factory=dict)

    def take(self, frame: Frame) -> Received | Rejected:
        """Return what a frame says, or why it is not believed.

        A repeated frame has the counter of the one before it and is rejected; a gap in the counter is counted as loss.
        After a node's restart its first frame may look like a repeat once.
        """
        answer = self._take(frame)
        if isinstance(answer, Rejected):
            self.rejected[answer.identifier, answer.reason] += 1
        else:
            self.received[answer.name] += 1
            self.lost[answer.name] += answer.lost
        return answer

    def forget(self, identifiers: set[int]) -> None:
        """Begin to count anew, as after a node's restart."""
        for identifier in identifiers:
            self._last.pop(identifier, None)

    def _take(self, frame: Frame) -> Received | Rejected:
        identifier, data = frame
        message = message_of(identifier)
        if message is None:
            return Rejected(identifier, "unknown")
        if len(data) != message.length:
            return Rejected(identifier, "length")
        guard = guard_of(identifier)
        if guard.checked and data[-1] != checksum(identifier, data):
            return Rejected(identifier, "checksum")
        values = message.decode(data, decode_choices=False)
        lost = 0
        if guard.counted:
            counter, before = int(values["alive_counter"]), self._last.get(identifier)
            self._last[identifier] = counter
            if counter == before:
                return Rejected(identifier, "repeated")
            lost = 0 if before is None else (counter - before - 1) % TURNS
        return Received(message.name, values, lost)
