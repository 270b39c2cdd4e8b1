"""Commands ashore, on the disk: what was given, what was sent, what became of it."""

import math
from dataclasses import dataclass
from typing import Any

from stommel.files.storage import Storage
from stommel.link.commands.states import MOST_WORDS, Command, Progress, State, When
from stommel.link.commands.table import ABORT, CommandError
from stommel.link.keeping import DamagedError, keep, kept
from stommel.link.words import fitted

FILE = "commands"
MOST_OPEN = 64
"""Commands without a last word."""
MOST = 256
"""Commands that are remembered; the oldest with a last word are forgotten first."""


@dataclass
class Waiting:
    """A command ashore."""

    command: Command
    sent: bool = False
    """Whether it may have left; is on the disk before it does."""
    cancel: bool = False
    """Whether it was taken back."""
    last: Progress | None = None
    """The last word."""

    # not kept: it is asked for again
    heard: Progress | None = None
    """What the vehicle said last."""
    tries: int = 0
    """How often it was said or asked for since the vehicle was last silent."""
    asking: int = 0
    """Number of the last question, 1 to 255."""
    asked_at: float = 0.0
    """When that was [s]."""
    due: float = -math.inf
    """When it is asked again [s]."""

    @property
    def is_aboard(self) -> bool:
        """Whether the vehicle has said that it has it."""
        return self.heard is not None and self.heard.state in (State.WAITING, State.IN_PROGRESS)


class ShoreQueue:
    """Commands in the order in which they were given."""

    def __init__(self, storage: Storage) -> None:
        self._storage = storage
        self.notes: list[str] = []
        """What was found damaged, in words."""
        self.waiting: dict[int, Waiting] = {}
        self.kept_at = 0
        """The clock when it was last kept [ms]."""
        self.is_kept = True
        """Whether the disk has taken it as it is."""
        try:
            told = kept(storage, FILE)
            if told is not None:
                self._restore(told)
        except DamagedError as error:
            self.notes.append(f"{error}; commands that were given before are not followed any more")
            self.waiting = {}

    def add(self, waiting: Waiting, now: int) -> None:
        """Take a new command; an abort is taken also where the disk does not keep it.

        Raises
        ------
        CommandError
            Too many are open, or the disk does not keep it; nothing has changed.
        """
        if sum(entry.last is None for entry in self.waiting.values()) >= MOST_OPEN:
            raise CommandError(f"queue of commands: {MOST_OPEN} are open; wait, or cancel some")
        self.waiting[waiting.command.id] = waiting
        try:
            self.keep(now)
        except OSError as error:
            if waiting.command.number == ABORT:
                return  # twice is better than not at all
            del self.waiting[waiting.command.id]
            raise CommandError(f"queue of commands: cannot be kept: {error.strerror or error}") from error
        over = [id for id, entry in self.waiting.items() if entry.last is not None]
        for id in over[: max(len(self.waiting) - MOST, 0)]:
            del self.waiting[id]

    def keep(self, now: int) -> None:
        """Bring it to the disk.

        Raises
        ------
        OSError
            The disk does not keep it.
        """
        told = [_told(entry) for entry in self.waiting.values()]
        self.is_kept = False
        keep(self._storage, FILE, {"kept_at": now, "commands": told})
        self.kept_at, self.is_kept = now, True

    def _restore(self, told: Any) -> None:
        try:
            found = [_waiting_of(*row) for row in told["commands"]]
            self.kept_at = int(told["kept_at"])
        except (ValueError, KeyError, TypeError) as error:
            raise DamagedError(f"{FILE}: is no queue of commands: {error}") from error
        self.waiting = {entry.command.id: entry for entry in found}


def _told(entry: Waiting) -> list[Any]:
    command, last = entry.command, entry.last
    return [
        command.id, command.number, list(command.parameters), int(command.when), command.given, command.expires,
        int(entry.sent), int(entry.cancel), last and [int(last.state), last.percent, fitted(last.words, MOST_WORDS)],
    ]  # fmt: skip


def _waiting_of(
    id: int, number: int, parameters: list[float], when: int, given: int, expires: int, sent: int, cancel: int,
    last: list[Any] | None,
) -> Waiting:  # fmt: skip
    command = Command(id, number, tuple(map(float, parameters)), When(when), given, expires)
    word = None if last is None else Progress(State(last[0]), int(last[1]), str(last[2]))
    return Waiting(command, bool(sent), bool(cancel), word)
