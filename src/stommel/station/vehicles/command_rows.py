"""Commands in the archive: given by whom, when, and what became of them."""

from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

from sqlalchemy import Connection, select

from stommel.archive import Archive
from stommel.archive.schema import command_history, commands
from stommel.archive.times import microseconds, seconds

GIVEN = "given"
"""On the disk of the station, and not in the queue of the link yet."""
QUEUED = "queued"
"""In the queue of the link, or about to come there; the vehicle has said nothing of it."""
NOT_SENT = "not_sent"
"""It never came into the queue."""
LAST = frozenset((
    NOT_SENT, "done", "failed", "refused", "expired", "cancelled", "outcome_unknown", "forgotten"
))  # fmt: skip
"""States after which nothing comes."""


class CommandRow(NamedTuple):
    """A command; times are of the vehicle's clock [s since 1970]."""

    id: str
    vehicle: int
    user: str
    given: float
    expires: float
    name: str
    parameters: Mapping[str, float]
    when: str
    """at_once, at_next_surfacing or until_expiry."""
    state: str
    words: str
    """Why, and what is known."""
    changed: float

    @property
    def is_last(self) -> bool:
        """Whether nothing comes after this state."""
        return self.state in LAST


class CommandRows:
    """The rows of commands; each method that writes is one transaction."""

    def __init__(self, archive: Archive) -> None:
        self._archive = archive

    def add(self, row: CommandRow) -> None:
        """Write a new command; one that is there already is the same, of which the answer was lost on the way."""
        with self._archive.writing() as connection:
            if connection.execute(select(commands.c.id).where(commands.c.id == row.id)).scalar() is not None:
                return
            connection.execute(commands.insert().values(_stored(row)))
            _note(connection, row.id, row.changed, row.state, row.words)

    def change(self, id: str, state: str, words: str, t: float) -> CommandRow | None:
        """Write what became of a command, a new state to its history too; the row as it is then, None if there is none.

        What is said of a command comes after what was said of it before, though the vehicle's clock be set back
        meanwhile: who follows it takes the row that changed last.
        """
        mine = commands.c.id == id
        with self._archive.writing() as connection:
            before = connection.execute(select(commands.c.state, commands.c.changed_us).where(mine)).one_or_none()
            if before is None:
                return None
            changed_us = max(microseconds(t), before.changed_us + 1)
            told = {"state": state, "outcome": words, "changed_us": changed_us}
            row = connection.execute(commands.update().where(mine).values(told).returning(commands)).one()
            if before.state != state:
                _note(connection, id, seconds(changed_us), state, words)
            return _read(row)

    def find(self, vehicle: int, id: str) -> CommandRow | None:
        """A command of a vehicle; None if there is none."""
        chosen = select(commands).where(commands.c.vehicle_id == vehicle, commands.c.id == id)
        with self._archive.reading() as connection:
            found = connection.execute(chosen).one_or_none()
        return None if found is None else _read(found)

    def open_ones(self, vehicle: int) -> list[CommandRow]:
        """Commands without a last word."""
        chosen = select(commands).where(commands.c.vehicle_id == vehicle, commands.c.state.not_in(LAST))
        with self._archive.reading() as connection:
            return [_read(found) for found in connection.execute(chosen)]

    def page(self, vehicle: int, limit: int, before: float | None = None) -> list[CommandRow]:
        """The last commands of a vehicle, the newest first, given before a time [s since 1970]."""
        chosen = select(commands).where(commands.c.vehicle_id == vehicle)
        if before is not None:
            chosen = chosen.where(commands.c.given_us < microseconds(before))
        with self._archive.reading() as connection:
            found = connection.execute(chosen.order_by(commands.c.given_us.desc()).limit(limit))
            return [_read(row) for row in found]

    def history(self, id: str) -> Sequence[tuple[float, str, str]]:
        """Time, state and words of each state of a command."""
        chosen = select(command_history).where(command_history.c.command_id == id).order_by(command_history.c.id)
        with self._archive.reading() as connection:
            return [(seconds(row.t_us), row.state, row.words or "") for row in connection.execute(chosen)]


def _note(connection: Connection, id: str, t: float, state: str, words: str) -> None:
    told = {"command_id": id, "t_us": microseconds(t), "state": state, "words": words}
    connection.execute(command_history.insert().values(told))


def _stored(row: CommandRow) -> dict[str, Any]:
    return {
        "id": row.id, "vehicle_id": row.vehicle, "user": row.user, "given_us": microseconds(row.given),
        "expires_us": microseconds(row.expires), "name": row.name, "parameters": dict(row.parameters),
        "occasion": row.when, "state": row.state, "outcome": row.words, "changed_us": microseconds(row.changed),
    }  # fmt: skip


def _read(row: Any) -> CommandRow:
    return CommandRow(
        row.id, row.vehicle_id, row.user, seconds(row.given_us), seconds(row.expires_us), row.name, row.parameters,
        row.occasion, row.state, row.outcome or "", seconds(row.changed_us),
    )  # fmt: skip
