"""From words to frames and back: scaling and limits by cantools, counter and checksum by us."""

from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import lru_cache
from typing import TYPE_CHECKING, NamedTuple, cast

from stommel.errors import StommelError
from stommel.files.nearest import did_you_mean
from stommel.messages.database import database, guard_of, limits_of, message_named, message_of, sayable
from stommel.messages.frames import Frame
from stommel.messages.protection import checksum

if TYPE_CHECKING:
    from cantools.database.can import Message

TURNS = 16
"""Values of an alive counter."""
LATEST = 8
"""An alive counter that runs ahead by more than this has fallen behind: the frame was overtaken."""

_REMEMBERED = 4096
"""Frames whose words are remembered: on a quiet flight most differ from those before in their counter only."""

Values = dict[str, float]
"""Signals by name, SI units; enumerations as numbers."""

REASONS = {
    "unknown": "the database has no such identifier",
    "length": "it has another length than the database says",
    "checksum": "its checksum is wrong: bits were flipped, or it came under another identifier",
    "range": "a value is beyond what the database allows",
    "repeated": "its alive counter is that of the frame before",
    "overtaken": "its alive counter is behind that of a frame that came before",
}
"""Why frames are rejected."""


class Received(NamedTuple):
    """A frame that says something."""

    name: str
    """Of the message."""
    values: Values
    lost: int
    """Frames of this message that were lost before it, by its alive counter: 0 to 7."""


class Rejected(NamedTuple):
    """A frame that is not obeyed."""

    identifier: int
    reason: str
    """One of `REASONS`."""


class UnsayableError(StommelError):
    """A message or a value that the CAN database does not allow."""


class Encoder:
    """Makes frames of words, each message with its own alive counter, which begins at `first`."""

    def __init__(self, first: int = 0) -> None:
        self._first = first
        self._counters: Counter[str] = Counter()

    def frame(self, name: str, **values: float) -> Frame:
        """Return the next frame of a message.

        Raises
        ------
        UnsayableError
            There is no such message, a signal is missing, or a value is outside of what the database allows.
        """
        message = known_message(name)
        guard = guard_of(message.frame_id)
        if guard.counted:
            values["alive_counter"] = (self._first + self._counters[name]) % TURNS
        if guard.checked:
            values["checksum"] = 0
        # the limits are held here, by which cantools need not: it takes thrice the time
        if not _are_sayable(name, values):
            raise UnsayableError(f"CAN message {name}: {_objection(message, values)}")
        try:
            frame = _frame_of(name, tuple(values.items()))
        except Exception as error:
            raise UnsayableError(f"CAN message {name}: {_objection(message, values) or error}") from error
        self._counters[name] += 1
        return frame


def _are_sayable(name: str, values: Mapping[str, float]) -> bool:
    limits = sayable(name)
    if len(values) != len(limits):
        return False
    try:
        for signal, value in values.items():
            low, high = limits[signal]
            if not low <= value <= high:
                return False
    except (KeyError, TypeError):
        return False
    return True


def known_message(name: str) -> "Message":
    """Return a message by its name.

    Raises
    ------
    UnsayableError
        There is none; the sentence names the nearest.
    """
    try:
        return message_named(name)
    except KeyError:
        near = did_you_mean(name, [message.name for message in database().messages]).rstrip(";")
        raise UnsayableError(f"CAN message {name}: the database has none of this name{near}") from None


def _objection(message: "Message", values: Mapping[str, object]) -> str:
    """What is wrong with values that cannot be encoded; the first thing found."""
    known = {signal.name: signal for signal in message.signals}
    for name in values.keys() - known.keys():
        return f"{name}: it has no such signal{did_you_mean(name, known).rstrip(';')}"
    for name, signal in known.items():
        if name not in values:
            return f"{name}: not given"
        value, low, high = values[name], signal.minimum, signal.maximum
        if not isinstance(value, float | int):
            return f"{name} = {value!r}: must be a number"
        if low is not None and high is not None and not low <= value <= high:
            return f"{name} = {value:g}: must be between {low:g} and {high:g} {signal.unit or ''}".rstrip()
    return ""


@lru_cache(_REMEMBERED)
def _frame_of(name: str, values: tuple[tuple[str, float], ...]) -> Frame:
    """Frame of values that the database allows."""
    message = message_named(name)
    data = message.encode(dict(values), strict=False)
    if guard_of(message.frame_id).checked:
        data = data[:-1] + bytes((checksum(message.frame_id, data),))
    return Frame(message.frame_id, data)


@lru_cache(_REMEMBERED)
def said_by(frame: Frame) -> tuple[str, Values, bool] | Rejected:
    """Return what a frame says by itself: message, values and whether its alive counter counts; or why nothing."""
    identifier, data = frame
    message = message_of(identifier)
    if message is None:
        return Rejected(identifier, "unknown")
    if len(data) != message.length:
        return Rejected(identifier, "length")
    guard = guard_of(identifier)
    if guard.checked and data[-1] != checksum(identifier, data):
        return Rejected(identifier, "checksum")
    # no multiplexed messages, no containers: names with numbers
    values = cast("Values", message.decode(data, decode_choices=False))
    for name, low, high in limits_of(identifier):
        if not low <= values[name] <= high:
            return Rejected(identifier, "range")
    return message.name, values, guard.counted


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
    """Alive counter of the last good frame, by identifier."""
    _late: dict[int, int] = field(default_factory=dict)
    """Alive counter of an overtaken frame that came after it."""

    def take(self, frame: Frame) -> Received | Rejected:
        """Return what a frame says, or why it is not believed.

        A repeated frame has the counter of the one before it and is rejected; so is one that another has overtaken.
        A gap in the counter is counted as loss. After a node's restart, or after more than seven lost frames, one good
        frame may look repeated or overtaken, two at most; the next one is taken.
        """
        answer = self._take(frame)
        if isinstance(answer, Rejected):
            self.rejected[answer.identifier, answer.reason] += 1
        else:
            self.received[answer.name] += 1
            self.lost[answer.name] += answer.lost
        return answer

    def rejected_of(self, identifier: int) -> int:
        """How many frames of an identifier that the database knows were rejected."""
        rejected = self.rejected
        return sum(rejected.get((identifier, reason), 0) for reason in REASONS)

    def forget(self, identifiers: set[int]) -> None:
        """Begin to count anew, as after a node's restart."""
        for identifier in identifiers:
            self._last.pop(identifier, None)
            self._late.pop(identifier, None)

    def _take(self, frame: Frame) -> Received | Rejected:
        said = said_by(frame)
        if isinstance(said, Rejected):
            return said
        name, values, counted = said
        if not counted:
            return Received(name, values.copy(), 0)
        return self._in_turn(frame.identifier, name, values.copy())

    def _in_turn(self, identifier: int, name: str, values: Values) -> Received | Rejected:
        """Compare a frame's alive counter with that of the frame before it."""
        counter = int(values["alive_counter"])
        before = self._last.get(identifier, counter - 1)
        ahead = (counter - before) % TURNS
        if ahead == 0:
            return Rejected(identifier, "repeated")
        if ahead > LATEST:
            late = self._late.get(identifier)
            self._late[identifier] = counter
            if late is None or (counter - late) % TURNS != 1:
                return Rejected(identifier, "overtaken")
            ahead = 1  # the second in a row: its sender has begun anew
        self._last[identifier] = counter
        self._late.pop(identifier, None)
        return Received(name, values, ahead - 1)
