"""What the vehicle remembers of commands, through any loss of power: the reason why none is executed twice.

An entry is on the disk before anybody hears of it, and before its execution begins. Entries are forgotten only when
their command has expired and room is needed; from then on no unknown command with that expiry or an earlier one is
taken, so that a late copy of a forgotten one is not either.
"""

from collections.abc import Iterable
from dataclasses import dataclass, field
from typing import Any, NamedTuple

from stommel.errors import StommelError
from stommel.files.storage import Storage
from stommel.link.commands.states import LATEST, MOST_WORDS, Command, Progress, State, When
from stommel.link.keeping import DamagedError, keep, kept
from stommel.link.words import fitted

FILE = "commands"
MOST = 256
"""Commands that are remembered."""
FOR_ABORTS = 16
"""Of these, places that only an abort takes."""
POWER_FAILED = "power failed while it was executed; not executed again"


class LedgerError(StommelError):
    """A command cannot be remembered, and so not be taken; nothing has changed."""


class Entry(NamedTuple):
    """A command, and what became of it."""

    command: Command
    progress: Progress
    dived: bool = False
    """Whether the vehicle has been under water since: of one that waits for a surfacing."""


@dataclass
class _Content:
    entries: dict[int, Entry] = field(default_factory=dict)
    expired_until: int = 0
    """Nothing unknown is taken that expires until then [ms]."""
    given_until: int = 0
    """Nothing unknown is taken that was given until then [ms]."""
    aborted: int = 0
    """When the last abort was given [ms]."""
    lost: bool = False
    """Whether a ledger was lost, and it is not known yet until when."""


class Ledger:
    """Entries by id, on a disk.

    Parameters
    ----------
    storage
        Where they are kept.
    most
        How many.
    """

    def __init__(self, storage: Storage, most: int = MOST) -> None:
        self._storage, self._most = storage, most
        self.notes: list[str] = []
        """What was found damaged, in words."""
        try:
            told = kept(storage, FILE)
            self._content = _Content() if told is None else _content_of(told)
        except DamagedError as error:
            self.notes.append(f"{error}; no command that was given before now is executed any more")
            self._content = _Content(lost=True)
        self._interrupt()
        self.open = self._open()
        """Entries without a last word, in the order in which they were given."""

    def _interrupt(self) -> None:
        """What was being executed when the power failed has an unknown outcome; read anew it says the same again."""
        for id, entry in self._content.entries.items():
            if entry.progress.state is State.IN_PROGRESS:
                interrupted = entry._replace(progress=Progress(State.OUTCOME_UNKNOWN, words=POWER_FAILED))
                self._content.entries[id] = interrupted

    def get(self, id: int) -> Entry | None:
        """Return the entry of an id; None if it is not remembered."""
        return self._content.entries.get(id)

    def _open(self) -> list[Entry]:
        found = [entry for entry in self._content.entries.values() if not entry.progress.state.is_last]
        return sorted(found, key=lambda entry: (entry.command.given, entry.command.id))

    @property
    def aborted(self) -> int:
        """When the last abort was given, by its sender's clock [ms]; 0 for never."""
        return self._content.aborted

    def may_be_forgotten(self, given: int, expires: int) -> bool:
        """Whether an unknown command of these times may have been here before."""
        content = self._content
        return expires <= content.expired_until or given <= content.given_until

    def bound_loss(self, latest: int) -> None:
        """After a loss: what was given until now may have been executed, what is given later has not.

        Raises
        ------
        LedgerError
            The disk does not keep it.
        """
        if self._content.lost:
            self._write(_Content(given_until=latest))

    def put(self, changed: Iterable[Entry], latest: int, *, abort: int = 0) -> None:
        """Remember entries, new or changed, all or none.

        Parameters
        ----------
        changed
            The entries.
        latest
            The latest that the sender's clock can show [ms]; what has expired by then may give way.
        abort
            When an abort was given that is among them [ms].

        Raises
        ------
        LedgerError
            There is no room, or the disk does not keep it.
        """
        old = self._content
        if old.lost:
            raise LedgerError("ledger was lost, and clocks are not compared yet")
        entries = old.entries | {entry.command.id: entry for entry in changed}
        room = self._most if abort else self._most - FOR_ABORTS
        forgotten = _to_forget(entries, len(entries) - max(room, len(old.entries)), latest)
        until = max((entries.pop(id).command.expires for id in forgotten), default=0)
        # a mark that lies ahead is from before the sender's clock was set back
        aborted = max(abort, old.aborted if old.aborted <= latest else 0) if abort else old.aborted
        self._write(_Content(entries, max(old.expired_until, until), old.given_until, aborted))

    def _write(self, content: _Content) -> None:
        told = {
            "entries": [_told(entry) for entry in content.entries.values()],
            "expired_until": content.expired_until,
            "given_until": content.given_until,
            "aborted": content.aborted,
        }
        try:
            keep(self._storage, FILE, told)
        except OSError as error:
            raise LedgerError(f"disk does not keep it: {error.strerror or error}") from error
        self._content = content
        self.open = self._open()


def _to_forget(entries: dict[int, Entry], excess: int, latest: int) -> list[int]:
    """Ids that give way: those with a last word that expired first."""
    if excess <= 0:
        return []
    over = [id for id, entry in entries.items() if entry.progress.state.is_last and entry.command.expires <= latest]
    over.sort(key=lambda id: entries[id].command.expires)
    if len(over) < excess:
        raise LedgerError("ledger is full: no command in it has expired")
    return over[:excess]


def _told(entry: Entry) -> list[Any]:
    command, progress = entry.command, entry.progress
    return [
        command.id, command.number, [repr(value) for value in command.parameters], int(command.when), command.given,
        command.expires, int(progress.state), progress.percent, fitted(progress.words, MOST_WORDS), int(entry.dived),
    ]  # fmt: skip


def _content_of(told: Any) -> _Content:
    """Content of a ledger that was kept; a DamagedError where it is none."""
    try:
        entries = [_entry_of(*row) for row in told["entries"]]
        times = [range(LATEST)[told[name]] for name in ("expired_until", "given_until", "aborted")]
        return _Content({entry.command.id: entry for entry in entries}, *times)
    except (ValueError, LookupError, TypeError, AttributeError) as error:
        raise DamagedError(f"{FILE}: is no ledger: {error}") from error


def _entry_of(
    id: int, number: int, parameters: list[str], when: int, given: int, expires: int, state: int, percent: int,
    words: str, dived: int,
) -> Entry:  # fmt: skip
    command = Command(id, number, tuple(map(float, parameters)), When(when), given, expires)
    return Entry(command, Progress(State(state), percent, words), bool(dived))
