"""A command, when it may be executed, and what can become of it."""

from collections.abc import Mapping
from enum import IntEnum
from math import isfinite
from typing import NamedTuple

from stommel.link.values import whole
from stommel.messages.mavlink import FieldValue

MOST_AHEAD = 31 * 86_400_000
"""How far ahead a command may expire [ms]."""
MOST_WORDS = 60
"""Bytes of the words of an answer."""
UNKNOWN_PERCENT = 255
LATEST = 1 << 53
"""No time that is told lies behind this one [ms]."""


class When(IntEnum):
    """When a command may be executed, as `WHEN_WORDS` says; never after its expiry."""

    AT_ONCE = 0
    AT_NEXT_SURFACING = 1
    UNTIL_EXPIRY = 2


class State(IntEnum):
    """What became of a command, as `MEANINGS` says. From `DONE` on it is the last word, which the vehicle remembers."""

    NOT_KNOWN = 0
    RECEIVED = 1
    WAITING = 2
    IN_PROGRESS = 3
    DONE = 10
    FAILED = 11
    REFUSED = 12
    EXPIRED = 13
    CANCELLED = 14
    OUTCOME_UNKNOWN = 15
    FORGOTTEN = 16

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

MEANINGS = {
    State.NOT_KNOWN: "the vehicle has not heard of it; ashore: the vehicle has said nothing",
    State.RECEIVED: "heard, and not taken: the words say why; not executed unless it is sent again, as it is",
    State.WAITING: "the vehicle has it, and will execute it when it may",
    State.IN_PROGRESS: "begun, with a percentage where it is known",
    State.DONE: "executed",
    State.FAILED: "begun, and did not succeed",
    State.REFUSED: "not begun, and will not be",
    State.EXPIRED: "its time was over before it began; it will not be executed",
    State.CANCELLED: "taken back, or overtaken by an abort, before it began; it will not be executed",
    State.OUTCOME_UNKNOWN: "begun, then the power failed: it may have had its effect; not executed again",
    State.FORGOTTEN: "so old that the vehicle does not remember whether it was executed; not executed now",
}
WHEN_WORDS = {
    When.AT_ONCE: "as it arrives, or not at all",
    When.AT_NEXT_SURFACING: "after the dive that follows, or in which it arrives",
    When.UNTIL_EXPIRY: "as soon as the vehicle can",
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
    id, given, expires, when = (whole(values, name) for name in ("id", "given", "expires", "when"))
    parameters = values["parameters"]
    assert isinstance(parameters, tuple)
    if not id or not 0 <= given < expires < LATEST or when not in list(When) or not all(map(isfinite, parameters)):
        return None
    return Command(id, whole(values, "command"), tuple(map(float, parameters)), When(when), given, expires)
