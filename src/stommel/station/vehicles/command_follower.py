"""Follows the commands of one vehicle until their last word, also over a restart of the station."""

import time
from collections import deque
from collections.abc import Callable, Sequence

from sqlalchemy.exc import IntegrityError

from stommel.archive import ArchiveError
from stommel.link.commands.report import Report
from stommel.link.commands.states import UNKNOWN_PERCENT, State
from stommel.link.commands.table import CommandError, command_named
from stommel.station.vehicles.command_rows import GIVEN, NOT_SENT, QUEUED, CommandRow, CommandRows
from stommel.station.vehicles.line import VehicleLine

EVERY = 0.2
"""Between two looks [s]."""
MOST_UNWRITTEN = 100
LOST = "the station's queue of commands was lost; what became of it is not known"
NEVER = "the station stopped before it was queued; it was not sent"
NOT_YET = "not sent yet"
_ABORT = "abort"


def state_of(report: Report) -> str:
    """State of a report as the archive has it."""
    return QUEUED if report.state is State.NOT_KNOWN else report.state.name.lower()


class CommandFollower:
    """Brings what the link knows of commands into the archive, and tells it.

    A row says `queued` before its command comes into the queue of the link, from which alone it can be sent; so a row
    that says `given` was not sent, but for an abort, which waits for no archive. Everything happens in the line's
    thread, but for `add_now_or_later` and `not_sent`.

    Parameters
    ----------
    rows
        Of the archive.
    tell
        Is called with each row that has changed.
    left
        Commands without a last word when the station began, before anybody could give others.
    """

    def __init__(self, rows: CommandRows, tell: Callable[[CommandRow], None], left: Sequence[CommandRow]) -> None:
        self._rows, self._tell = rows, tell
        self._due = 0.0
        self._left = list(left)
        self._written: dict[int, tuple[str, str]] = {}
        """What the archive has of what the queue knows, by id."""
        self.unsent: deque[tuple[CommandRow, str, float]] = deque(maxlen=MOST_UNWRITTEN)
        """What was not sent, why, and since when, while the archive took nothing; of some it may have a row."""
        self.percents: dict[str, int] = {}
        """Of commands in execution, by their ids."""
        self.unwritten: deque[CommandRow] = deque(maxlen=MOST_UNWRITTEN)
        """Aborts that were given while the archive took nothing."""

    # giving

    def queue(self, row: CommandRow, give: Callable[[], object], t: float) -> None:
        """Bring a command whose row is written into the queue of the link, at a time of the vehicle.

        Raises
        ------
        CommandError
            The queue does not take it.
        ArchiveError
            The row cannot be written; the command is not given, but for an abort.
        """
        if not self._is_unwritten(row):
            try:
                self._rows.change(row.id, QUEUED, NOT_YET, t)
                self._written[int(row.id, 16)] = QUEUED, NOT_YET
            except ArchiveError as error:
                if row.name != _ABORT:
                    self.unsent.append((row, str(error), t))
                    raise
        try:
            give()
        except CommandError as error:
            self.not_sent(row, str(error), t)
            raise

    def not_sent(self, row: CommandRow, words: str, t: float) -> None:
        """Write that a command never came into the queue, now or as soon as the archive takes it; from any thread."""
        try:
            if not self._is_unwritten(row):
                self._end(row, NOT_SENT, words, t)
                return
        except ArchiveError:
            pass
        self.unsent.append((row, words, t))

    def _is_unwritten(self, row: CommandRow) -> bool:
        return any(each.id == row.id for each in list(self.unwritten))

    def add_now_or_later(self, row: CommandRow, archive_reason: str) -> str:
        """Write the row of an abort now, or as soon as the archive takes it; why not now, in words.

        Nobody waits for an archive of which it is known that it takes nothing.
        """
        try:
            if not archive_reason:
                self._rows.add(row)
                return ""
        except ArchiveError as error:
            archive_reason = str(error)
        self.unwritten.append(row)
        return archive_reason

    # following

    def look(self, line: VehicleLine, t: float) -> None:
        """Write what has changed."""
        real = time.monotonic()
        if real < self._due:
            return
        self._due = real + EVERY
        self._add_unwritten()
        while self.unsent:
            row, words, since = self.unsent[0]
            self._end(row, NOT_SENT, words, since)
            self.unsent.popleft()
        reports = line.end.commands.reports(t)
        self._end_left({report.id for report in reports}, line.clock.of_link(t))
        for report in reports:
            told = (state_of(report), report.words)
            if self._written.get(report.id) != told:
                self._write(line, report, told, t)
        known = {report.id for report in reports}
        self._written = {id: told for id, told in self._written.items() if id in known}
        self.percents = {f"{each.id:016x}": each.percent for each in reports if each.percent != UNKNOWN_PERCENT}

    def _add_unwritten(self) -> None:
        while self.unwritten:
            row = self.unwritten[0]
            try:
                self._rows.add(row)
            except IntegrityError:  # no later try would help
                self._drop(row)
                raise
            self._drop(row)

    def _drop(self, row: CommandRow) -> None:
        """Keep an abort no longer; others may have pushed it out already."""
        if self.unwritten and self.unwritten[0] is row:
            self.unwritten.popleft()

    def _end_left(self, known: set[int], now: float) -> None:
        """End what was open when the station began, and the queue of the link does not know."""
        while self._left:
            row = self._left[-1]
            if int(row.id, 16) not in known:
                is_never = row.state == GIVEN and row.name != _ABORT
                self._end(row, *((NOT_SENT, NEVER) if is_never else ("forgotten", LOST)), now)
            self._left.pop()

    def _end(self, row: CommandRow, state: str, words: str, t: float) -> None:
        if (ended := self._rows.change(row.id, state, words, t)) is not None:
            self._tell(ended)

    def _write(self, line: VehicleLine, report: Report, told: tuple[str, str], t: float) -> None:
        id, now = f"{report.id:016x}", line.clock.now()
        row = before = self._rows.find(line.vehicle, id)
        if before is None:
            row = _foreign(line, report, now)
            self._rows.add(row)
        elif before.state == NOT_SENT and not report.sent and not report.is_last:
            line.end.commands.cancel(report.id, t)  # a disk that seemed not to keep it has kept it
            return  # the next look sees whether the disk has that
        elif (before.state, before.words) != told:
            row = self._rows.change(id, *told, now)
        self._written[report.id] = told
        if row is not None and row != before:
            self._tell(row)


def _foreign(line: VehicleLine, report: Report, now: float) -> CommandRow:
    """A row of a command that the queue has and the archive has not: the archive is another one, or an older copy."""
    try:
        names = [parameter.name for parameter in command_named(report.name).parameters]
    except Exception:  # noqa: BLE001 - of another version
        names = []
    return CommandRow(
        f"{report.id:016x}", line.vehicle, "unknown", line.clock.of_link(report.given),
        line.clock.of_link(report.expires), report.name, dict(zip(names, report.parameters, strict=False)),
        "until_expiry", state_of(report), report.words, now,
    )  # fmt: skip
