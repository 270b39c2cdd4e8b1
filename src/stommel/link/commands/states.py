"""A command, when it may be executed, and what can become of it."""

from collections.abc import Mapping
from enum import IntEnum
from math import isfinite
from typing import NamedTuple

from stommel.messages.mavlink import FieldValue

MOST_AHEAD = 31 * 86_400_000
"""How far ahead a command may expire [ms]."""
MOST_WORDS = 60
"""Bytes of the words of an answer."""
UNKNOWN_PERCENT = 255
LATEST = 1 << 53
"""No time that is told lies behind this one [ms]."""


class When(IntEnum):
    """When a command may be executed; never after its expiry."""

    AT_ONCE = 0
    """As it arrives, or not at all."""
    AT_NEXT_SURFACING = 1
    """After the dive that follows, or in which it arrives."""
    UNTIL_EXPIRY = 2
    """As soon as the vehicle can."""


class State(IntEnum):
    """What became of a command. From `DONE` on it is the last word, which the vehicle remembers."""

    NOT_KNOWN = 0
    """The vehicle has not heard of it."""
    RECEIVED = 1
    """It was heard and is not taken yet: the words say why. It is not executed unless it is sent again."""
    WAITING = 2
    """The vehicle has it, and will execute it when it may."""
    IN_PROGRESS = 3
    DONE = 10
    FAILED = 11
    """It was begun, and did not succeed."""
    REFUSED = 12
    """It was not begun, and will not be."""
    EXPIRED = 13
    """Its time was over before it began; it will not be executed."""
    CANCELLED = 14
    """It was taken back, or an abort overtook it; it will not be executed."""
    OUTCOME_UNKNOWN = 15
    """It was begun, then the power failed: it may have had its effect, and will not be executed again."""
    FORGOTTEN = 16
    """So old that the vehicle does not remember whether it was executed; it will not be executed now."""

    @property
    def is_last(self) -> bool:
        """Whether nothing comes after it."""
        return self >= State.DONE

    @property
    def is_not_executed(self) -> bool:
        """Whether it says that the command was not executed and never will be."""
        return self in (State.REFUSED, State.EXPIRED, State.CANCELLED)

    @property
    def words(self) -> str:
        """The state as a user reads it."""
        return _WORDS[self]


_WORDS = {
    State.NOT_KNOWN: "not known to the vehicle",
    State.RECEIVED: "received, not taken yet",
    State.WAITING: "waiting aboard",
    State.IN_PROGRESS: "in progress",
    State.DONE: "done",
    State.FAILED: "failed",
    State.REFUSED: "refused, not executed",
    State.EXPIRED: "expired, not executed",
    State.CANCELLED: "cancelled, not executed",
    State.OUTCOME_UNKNOWN: "begun, outcome unknown",
    State.FORGOTTEN: "forgotten, outcome unknown",
}


class Progress(NamedTuple):
    """How far a command is."""

    state: State
    percent: int = UNKNOWN_PERCENT
    """0 to 100, or `UNKNOWN_PERCENT`."""
    words: str = ""


class Command(NamedTuple):
    """A command as it is sent; times by the sender's clock [ms]."""

    id: int
    number: int
    parameters: tuple[float, ...]
    when: When
    given: int
    expires: int

    def values(self, system: int, component: int, asking: int) -> dict[str, FieldValue]:
        """Fields of GLIDER_COMMAND."""
        return {
            "id": self.id, "given": self.given, "expires": self.expires, "parameters": self.parameters,
            "command": self.number, "when": int(self.when), "target_system": system, "target_component": component,
            "asking": asking,
        }  # fmt: skip


def command_of(values: Mapping[str, FieldValue]) -> Command | None:
    """Return the command of a GLIDER_COMMAND; None if it is none that can be remembered."""
    id, given, expires, when = (_whole(values, name) for name in ("id", "given", "expires", "when"))
    parameters = values["parameters"]
    assert isinstance(parameters, tuple)
    if not id or not 0 <= given < expires < LATEST or when not in list(When) or not all(map(isfinite, parameters)):
        return None
    return Command(id, _whole(values, "command"), tuple(map(float, parameters)), When(when), given, expires)


def _whole(values: Mapping[str, FieldValue], name: str) -> int:
    value = values[name]
    assert isinstance(value, int)
    return value


def short(words: str) -> str:
    """Words as they fit into an answer."""
    return words.encode()[:MOST_WORDS].decode("utf-8", "ignore")
