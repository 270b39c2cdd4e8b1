"""Commands aboard: taken once, begun when they may be, never after their expiry; and what became of them."""

import math
from collections.abc import Iterable
from contextlib import suppress

from stommel.errors import StommelError
from stommel.files.storage import Storage
from stommel.link.commands.answers import Answers
from stommel.link.commands.ledger import Entry, Ledger, LedgerError
from stommel.link.commands.port import CommandPort, PeerClock, Readiness
from stommel.link.commands.states import (
    LATEST,
    MOST_AHEAD,
    Command,
    Progress,
    State,
    When,
    command_of,
)
from stommel.link.commands.table import ABORT, command_numbered, refusal
from stommel.link.outbox import Outbox
from stommel.link.service import SHORE_SYSTEM, Received

EVERY = 1.0
"""Between two reports of a command in progress [s]."""
DISK_PATIENCE = 10.0
"""After which a disk that took nothing is tried again [s]."""
NOT_COMPARED = Progress(State.RECEIVED, words="clock of the sender is not compared yet")
OVERTAKEN = Progress(State.CANCELLED, words="an abort overtook it")
TOO_LATE = Progress(State.EXPIRED)
LOST_ABOARD = Progress(State.OUTCOME_UNKNOWN, words="what executes it does not know it any more")


class CommandServer:
    """Takes commands from one shore station, executes each once, and answers as often as it is asked.

    Parameters
    ----------
    system, component
        Who is commanded.
    port
        Executes.
    clock
        Of the shore station: the expiry is by it.
    storage
        Keeps the ledger.
    shore
        System number of the shore station; others are not obeyed.
    most
        Commands that are remembered.
    """

    def __init__(
        self,
        system: int,
        component: int,
        port: CommandPort,
        clock: PeerClock,
        storage: Storage,
        *,
        shore: int = SHORE_SYSTEM,
        most: int | None = None,
    ) -> None:
        self._me, self._shore = (system, component), shore
        self._port, self._clock = port, clock
        self._ledger = Ledger(storage) if most is None else Ledger(storage, most)
        self.notes = self._ledger.notes
        """What was found damaged, in words."""
        self.passed_over = 0
        """Commands that contradict themselves, or what is known of their number."""
        self._answers = Answers(shore)
        self._running: dict[int, tuple[Progress, float]] = {}
        self._deadlines: dict[int, float] = {}
        self._disk_rests_until = -math.inf
        self._abort_came = False

    # what comes

    def take(self, received: Received, t: float) -> None:
        """Take a message at a time [s]."""
        values = received.values
        if received.name not in ("GLIDER_COMMAND", "GLIDER_COMMAND_ASK") or received.system != self._shore:
            return
        if (values["target_system"], values["target_component"]) != self._me:
            return
        asks = received.name == "GLIDER_COMMAND_ASK"
        command = command_of(values | {"parameters": (), "command": 0, "when": 0} if asks else values)
        asking = values["asking"]
        assert isinstance(asking, int)
        entry = None if command is None else self._ledger.get(command.id)
        if command is None or (entry is not None and not _same(entry.command, command)):
            self.passed_over += 1
            return
        if entry is None:
            progress = self._met(command, t, asks=asks, cancel=bool(values.get("cancel", 0)))
        elif values.get("cancel", 0) and entry.progress.state is State.WAITING:
            progress = self._taken_back(entry, t)
        else:
            progress = self._running.get(command.id, (entry.progress,))[0]
        self._answers.put(command.id, progress, received.component, asking)

    def _taken_back(self, entry: Entry, t: float) -> Progress:
        try:
            return self._changed(entry, Progress(State.CANCELLED, words="taken back by its sender"), t)
        except LedgerError as error:
            return entry.progress._replace(words=str(error))

    def _met(self, command: Command, t: float, *, asks: bool, cancel: bool) -> Progress:
        """What becomes of a command that was not known, or of a question for one."""
        latest = self._latest(t)
        if latest is None:
            return NOT_COMPARED
        try:
            self._ledger.bound_loss(latest)
            return self._taken(command, latest, t, asks=asks, cancel=cancel)
        except LedgerError as error:
            return Progress(State.RECEIVED, words=str(error))

    def _taken(self, command: Command, latest: int, t: float, *, asks: bool, cancel: bool) -> Progress:
        if command.given > latest:
            return Progress(State.RECEIVED, words="given later than the clock of its sender can show")
        if self._ledger.may_be_forgotten(command.given, command.expires):
            return Progress(State.FORGOTTEN, words="older than what the vehicle remembers")
        if latest >= command.expires:
            return self._remember(command, TOO_LATE, latest)
        if cancel:
            return self._remember(command, Progress(State.CANCELLED, words="taken back before it came"), latest)
        if asks:
            return Progress(State.NOT_KNOWN)
        if refused := self._refusal(command, latest):
            return self._remember(command, refused, latest)
        if command.when is When.AT_NEXT_SURFACING:
            return self._remember(command, Progress(State.WAITING, words="waits for the next surfacing"), latest)
        return self._begun_if_ready(Entry(command, Progress(State.RECEIVED)), latest, t)

    def _refusal(self, command: Command, latest: int) -> Progress | None:
        """What forbids a command for good."""
        kind = command_numbered(command.number)
        if kind is None:
            return Progress(State.REFUSED, words=f"command {command.number}: there is none")
        if problem := refusal(kind, command.parameters):
            return Progress(State.REFUSED, words=problem)
        if command.expires - latest > MOST_AHEAD:
            return Progress(State.REFUSED, words=f"expires in more than {MOST_AHEAD // 86_400_000} days")
        # a mark that lies ahead is from before the sender's clock was set back
        if command.number != ABORT and command.given <= self._ledger.aborted <= latest:
            return OVERTAKEN
        return None

    # what goes on

    def poll(self, t: float, outbox: Outbox) -> None:
        """Begin what may be begun, follow what is in progress, and say what has changed."""
        latest = self._latest(t)
        if t >= self._disk_rests_until:
            try:
                self._advance(latest, t)
            except LedgerError:
                self._disk_rests_until = t + DISK_PATIENCE
        self._answers.poll(outbox)

    def _advance(self, latest: int | None, t: float) -> None:
        self._overtake_later(latest)
        if self._abort_came:
            return
        for entry in self._ledger.open:
            if self._ledger.get(entry.command.id) is not entry:
                continue  # an abort has overtaken it just now
            if entry.progress.state is State.IN_PROGRESS:
                self._follow(entry, t)
            elif latest is not None:
                self._wait(entry, latest, t)

    def _follow(self, entry: Entry, t: float) -> None:
        """Look at a command that is in progress."""
        id = entry.command.id
        progress = self._port.progress(id) or LOST_ABOARD
        if progress.state.is_last:
            self._changed(entry, progress, t)
            return
        progress = progress._replace(state=State.IN_PROGRESS)
        known, said = self._running.get(id, (entry.progress, -math.inf))
        if progress != known and t - said >= EVERY:
            self._running[id] = (progress, t)
            self._answers.put(id, progress)

    def _wait(self, entry: Entry, latest: int, t: float) -> None:
        """Look at a command that waits."""
        command = entry.command
        # a clock that is compared anew, or set back, never gives more time than there was
        deadline = min(self._deadlines.get(command.id, math.inf), t + (command.expires - latest) / 1000.0)
        self._deadlines[command.id] = deadline
        if latest >= command.expires or t >= deadline:
            self._changed(entry, TOO_LATE, t)
            return
        if command.when is When.AT_NEXT_SURFACING:
            if self._port.is_submerged and not entry.dived:
                self._ledger.put([entry._replace(dived=True)], latest)
            if self._port.is_submerged or not entry.dived:
                return
        self._begun_if_ready(entry, latest, t)

    def _begun_if_ready(self, entry: Entry, latest: int, t: float) -> Progress:
        """Begin a command, if it can be; what it waits for is remembered once."""
        readiness, words = self._port.check(entry.command)
        is_new = entry.progress.state is not State.WAITING
        if readiness is Readiness.READY:
            return self._begin(entry, latest, t)
        if readiness is Readiness.NEVER or entry.command.when is When.AT_ONCE:
            progress = Progress(State.REFUSED, words=words)
            return self._remember(entry.command, progress, latest) if is_new else self._changed(entry, progress, t)
        return self._remember(entry.command, Progress(State.WAITING, words=words), latest) if is_new else entry.progress

    def _begin(self, entry: Entry, latest: int, t: float) -> Progress:
        """Remember that a command begins, then begin it."""
        begun = entry._replace(progress=Progress(State.IN_PROGRESS, 0))
        if entry.command.number == ABORT:
            self._overtake([begun], entry.command.given, latest)
        else:
            self._ledger.put([begun], latest)
        try:
            progress = self._port.begin(entry.command)
        except StommelError as error:
            progress = Progress(State.FAILED, words=str(error))
        self._deadlines.pop(entry.command.id, None)
        if not progress.state.is_last:
            progress = progress._replace(state=State.IN_PROGRESS)
            self._running[entry.command.id] = (progress, t)
            self._answers.put(entry.command.id, progress)
            return progress
        try:
            return self._changed(begun, progress, t)
        except LedgerError:
            # it is said again by the port, and remembered when the disk takes it
            return begun.progress

    def abort_came(self, t: float) -> None:
        """An abort came by another way: what waits is cancelled, and what was given before it is not taken."""
        self._abort_came = True
        self._overtake_later(self._latest(t))

    def _overtake_later(self, latest: int | None) -> None:
        """What an abort by another way overtakes: now, or when the disk takes it."""
        if self._abort_came:
            with suppress(LedgerError):
                self._overtake([], latest or 0, latest or 0)
                self._abort_came = False

    def _overtake(self, begun: list[Entry], given: int, latest: int) -> None:
        waiting = [entry for entry in self._ledger.open if entry.progress.state is not State.IN_PROGRESS]
        cancelled = [entry._replace(progress=OVERTAKEN) for entry in waiting if entry.command.number != ABORT]
        self._ledger.put([*begun, *cancelled], latest, abort=given)
        self._say_all(cancelled)

    # words

    def _latest(self, t: float) -> int | None:
        """The latest that the sender's clock can show [ms]."""
        latest = self._clock.latest(t)
        if latest is None or not 0.0 <= latest < LATEST / 1000.0:
            return None
        return math.ceil(latest * 1000.0)

    def _remember(self, command: Command, progress: Progress, latest: int) -> Progress:
        self._ledger.put([Entry(command, progress)], latest)
        return progress

    def _changed(self, entry: Entry, progress: Progress, t: float) -> Progress:
        """Remember what has become of a command, then say it."""
        changed = entry._replace(progress=progress)
        self._ledger.put([changed], self._latest(t) or 0)
        self._say_all([changed])
        return progress

    def _say_all(self, changed: Iterable[Entry]) -> None:
        for entry in changed:
            self._deadlines.pop(entry.command.id, None)
            self._running.pop(entry.command.id, None)
            self._answers.put(entry.command.id, entry.progress)


def _same(known: Command, said: Command) -> bool:
    """Whether a command is the one that is known, as far as both are told."""
    if 0 in (known.number, said.number):
        return known[-2:] == said[-2:]
    return known == said
