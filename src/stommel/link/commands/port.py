"""What commands need of the vehicle, and of its comparison of clocks."""

from enum import Enum
from typing import NamedTuple, Protocol

from stommel.link.commands.states import Command, Progress


class Readiness(Enum):
    """Whether a command can be begun."""

    READY = "ready"
    NOT_YET = "not yet"
    NEVER = "never"


class Answer(NamedTuple):
    """Whether a command can be begun, and why not."""

    readiness: Readiness
    words: str = ""


class CommandPort(Protocol):
    """The vehicle, as far as it is commanded. Parameters have been held against the table of commands before."""

    @property
    def is_submerged(self) -> bool:
        """Whether the vehicle is under water."""

    def check(self, command: Command) -> Answer:
        """Say whether a command can be begun now, without any effect; an abort always can."""

    def begin(self, command: Command) -> Progress:
        """Begin a command; is called once for an id. A `StommelError` says that it failed."""

    def progress(self, id: int) -> Progress | None:
        """Say how far a command is that was begun; None: it is not known here."""


class PeerClock(Protocol):
    """What is known of the clock of the shore station, the one that its TIMESYNC tells."""

    def latest(self, t: float) -> float | None:
        """The latest that its clock can show at a time [s] of ours [s]; None before they were compared."""
