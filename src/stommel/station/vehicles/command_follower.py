"""Follows the commands of one vehicle until their last word, also over a restart of the station."""

import time
from collections import deque
from collections.abc import Callable

from stommel.archive import ArchiveError
from stommel.link.commands.report import Report
from stommel.link.commands.states import UNKNOWN_PERCENT, State
from stommel.link.commands.table import command_named
from stommel.station.vehicles.command_rows import GIVEN, NOT_SENT, CommandRow, CommandRows
from stommel.station.vehicles.line import VehicleLine

EVERY = 0.2
"""Between two looks [s]."""
MOST_UNWRITTEN = 100
QUEUED = "queued"
"""In the queue of the link; the vehicle has said nothing of it."""
LOST = "the station's queue of commands was lost; what became of it is not known"
NEVER = "the station stopped before it was queued; it was not sent"


def state_of(report: Report) -> str:
    """State of a report as the archive has it."""
    return QUEUED if report.state is State.NOT_KNOWN else report.state.name.lower()


class CommandFollower:
    """Brings what the link knows of commands into the archive, and tells it.

    Parameters
    ----------
    rows
        Of the archive.
    tell
        Is called with each row that has changed.
    """

    def __init__(self, rows: CommandRows, tell: Callable[[CommandRow], None]) -> None:
        self._rows, self._tell = rows, tell
        self._due = 0.0
        self._written: dict[int, tuple[str, str]] | None = None
        """What the archive has, by id; None before it was read."""
        self.percents: dict[str, int] = {}
        """Of commands in execution, by their ids."""
        self.unwritten: deque[CommandRow] = deque(maxlen=MOST_UNWRITTEN)
        """Aborts that were given while the archive took nothing."""

    def queued(self, row: CommandRow, t: float) -> None:
        """A command whose row is written has come into the queue of the link. In the line's thread."""
        if self._written is None:
            return  # the first look finds it
        told = (QUEUED, "not sent yet")
        self._written[int(row.id, 16)] = (row.state, row.words)
        try:
            self._rows.change(row.id, *told, t)
        except ArchiveError:
            return  # the next look does it
        self._written[int(row.id, 16)] = told

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

    def look(self, line: VehicleLine, t: float) -> None:
        """Write what has changed."""
        real = time.monotonic()
        if real < self._due:
            return
        self._due = real + EVERY
        while self.unwritten:
            row = self.unwritten[0]
            self._rows.add(row)
            if self._written is not None:
                self._written[int(row.id, 16)] = (row.state, row.words)
            self.unwritten.popleft()
        reports = line.end.commands.reports(t)
        if self._written is None:
            self._written = self._reconciled(line, reports, t)
        for report in reports:
            told = (state_of(report), report.words)
            if self._written.get(report.id) != told:
                self._write(line, report, told)
        self.percents = {f"{each.id:016x}": each.percent for each in reports if each.percent != UNKNOWN_PERCENT}

    def _write(self, line: VehicleLine, report: Report, told: tuple[str, str]) -> None:
        id, now = f"{report.id:016x}", line.clock.now()
        assert self._written is not None
        if report.id not in self._written and self._rows.find(line.vehicle, id) is None:
            self._rows.add(_foreign(line, report, now))
        else:
            self._rows.change(id, *told, now)
        self._written[report.id] = told
        row = self._rows.find(line.vehicle, id)
        if row is not None:
            self._tell(row)

    def _reconciled(self, line: VehicleLine, reports: list[Report], t: float) -> dict[int, tuple[str, str]]:
        """End what the archive has as open and the queue of the link does not know; return what the archive has."""
        known = {report.id for report in reports}
        written: dict[int, tuple[str, str]] = {}
        for row in self._rows.open_ones(line.vehicle):
            number = int(row.id, 16)
            written[number] = (row.state, row.words)
            if number not in known:
                state, words = (NOT_SENT, NEVER) if row.state == GIVEN else ("forgotten", LOST)
                self._rows.change(row.id, state, words, line.clock.of_link(t))
        for report in reports:
            row_now = self._rows.find(line.vehicle, f"{report.id:016x}")
            if row_now is not None:
                written[report.id] = (row_now.state, row_now.words)
        return written


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
