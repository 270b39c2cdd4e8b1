"""Commands as people give them: on the disk with who and when before they are queued, followed to the last word."""

import secrets
from collections.abc import Callable, Mapping, Sequence
from typing import Any

from stommel.archive import Archive, ArchiveError
from stommel.link.commands.client import LEAST_VALID, MOST_VALID
from stommel.link.commands.states import When
from stommel.link.commands.table import CommandError, command_named, packed
from stommel.link.shore.shore_end import ShoreEnd
from stommel.station.live.events import Happening
from stommel.station.live.hub import Hub
from stommel.station.vehicles.asking import ask
from stommel.station.vehicles.command_follower import CommandFollower
from stommel.station.vehicles.command_rows import GIVEN, CommandRow, CommandRows
from stommel.station.vehicles.line import VehicleLine
from stommel.station.vehicles.opening import MissingError, VehicleError

ABORT_VALID = 86_400.0
"""How long an abort is tried [s of the vehicle]."""


class Commands:
    """Gives commands to the vehicles of a station.

    Parameters
    ----------
    archive, hub
        Of the station.
    lines
        By vehicle; those that come later too.
    """

    def __init__(self, archive: Archive, hub: Hub, lines: Mapping[int, VehicleLine]) -> None:
        self._rows, self._hub, self._lines = CommandRows(archive), hub, lines
        self._followers: dict[int, CommandFollower] = {}

    def follow(self, line: VehicleLine) -> None:
        """Take in a vehicle, before its line is started and before anybody can give it a command.

        Raises
        ------
        ArchiveError
            It cannot be read.
        """
        left = self._rows.open_ones(line.vehicle)
        follower = self._followers[line.vehicle] = CommandFollower(self._rows, self._tell, left)
        line.followers.append(follower)

    def give(
        self, vehicle: int, user: str, name: str, parameters: Mapping[str, float], *, valid_for_s: float, when: When
    ) -> CommandRow:
        """Give a command; it is written, and in the queue of the link, when this returns.

        Raises
        ------
        CommandError
            There is no such command, a value is not allowed, or too many are open.
        ArchiveError
            It cannot be written; nothing was given.
        """
        kind = command_named(name)
        packed(kind, parameters)
        if not LEAST_VALID <= valid_for_s <= MOST_VALID:
            raise CommandError(f"{name}: valid for {valid_for_s:g} s; must be from {LEAST_VALID:g} to {MOST_VALID:g} s")
        if name == "abort":
            return self.abort(vehicle, user, valid_for_s)
        line = self._lines[vehicle]
        row = self._row(line, user, name, parameters, valid_for_s, when)
        try:
            self._rows.add(row)
        except ArchiveError as error:  # it may be there all the same, its answer lost on the way
            self._followers[vehicle].unsent.append((row, str(error), row.given))
            raise
        id = int(row.id, 16)
        self._queue(line, row, lambda end, t: end.commands.give(
            name, parameters, t, valid_for=valid_for_s, when=when, id=id
        ))  # fmt: skip
        return self._found(vehicle, row)

    def abort(self, vehicle: int, user: str, valid_for_s: float = ABORT_VALID) -> CommandRow:
        """Give an abort, also while the archive takes nothing: its row is written as soon as it can be.

        Raises
        ------
        CommandError
            Too many commands are open, or the disk of the queue keeps nothing.
        """
        line = self._lines[vehicle]
        row = self._row(line, user, "abort", {}, valid_for_s, When.UNTIL_EXPIRY)
        complaint = self._followers[vehicle].add_now_or_later(row, line.archive_reason)
        id = int(row.id, 16)
        self._queue(line, row, lambda end, t: end.commands.abort(t, valid_for=valid_for_s, id=id))
        return row._replace(words=complaint) if complaint else self._found(vehicle, row)

    def cancel(self, vehicle: int, id: str) -> CommandRow:
        """Take a command back: for good if it was not sent, else if the vehicle has not begun it.

        Raises
        ------
        MissingError
            There is no such command.
        """
        row = self.find(vehicle, id)
        if not row.is_last:
            number = int(id, 16)
            ask(self._lines[vehicle], lambda end, t: end.commands.cancel(number, t))
        return self._found(vehicle, row)

    def list(self, vehicle: int, limit: int = 100, before: float | None = None) -> Sequence[CommandRow]:
        """The last commands, the newest first."""
        # those first: what is written meanwhile is in both
        unwritten = [] if before is not None else self._unwritten(vehicle)
        page = self._rows.page(vehicle, limit, before)
        written = {row.id for row in page}
        return [*(row for row in unwritten if row.id not in written), *page][:limit]

    def percent(self, row: CommandRow) -> int | None:
        """How far the execution of a command is; None where nobody knows."""
        follower = self._followers.get(row.vehicle)
        return None if follower is None else follower.percents.get(row.id)

    def find(self, vehicle: int, id: str) -> CommandRow:
        """A command of a vehicle.

        Raises
        ------
        MissingError
            There is no such command.
        """
        row = self._rows.find(vehicle, id) or next((each for each in self._unwritten(vehicle) if each.id == id), None)
        row = row or self._rows.find(vehicle, id)  # it may have been written between the two looks
        if row is None:
            raise MissingError(f"vehicle {vehicle} has no command {id}")
        return row

    def history(self, id: str) -> Sequence[tuple[float, str, str]]:
        """Time, state and words of each state of a command."""
        return self._rows.history(id)

    def told(self, row: CommandRow) -> dict[str, Any]:
        """A command as the API tells it."""
        return row._asdict() | {"is_last": row.is_last, "percent": self.percent(row)}

    def _unwritten(self, vehicle: int) -> Sequence[CommandRow]:
        """Aborts that the archive does not have yet, the newest first."""
        follower = self._followers.get(vehicle)
        return [] if follower is None else list(follower.unwritten)[::-1]

    def _row(
        self, line: VehicleLine, user: str, name: str, parameters: Mapping[str, float], valid_for: float, when: When
    ) -> CommandRow:
        now = line.clock.now()
        id = f"{secrets.randbits(64) or 1:016x}"
        return CommandRow(
            id, line.vehicle, user, now, now + valid_for, name, dict(parameters), when.name.lower(), GIVEN,
            "written down, not queued yet", now,
        )  # fmt: skip

    def _queue(self, line: VehicleLine, row: CommandRow, give: Callable[[ShoreEnd, float], object]) -> None:
        """Let the line take a command whose row is written; if it does not, the row says so."""
        follower = self._followers[line.vehicle]
        try:
            ask(line, lambda end, t: follower.queue(row, lambda: give(end, t), line.clock.of_link(t)))
        except VehicleError as error:  # the line has not done it, and will not
            follower.not_sent(row, str(error), line.clock.now())
            raise

    def _found(self, vehicle: int, row: CommandRow) -> CommandRow:
        return self._rows.find(vehicle, row.id) or row

    def _tell(self, row: CommandRow) -> None:
        self._hub.publish(Happening("command", row.vehicle, self.told(row)))
