"""Values that people set, in the archive before the vehicle is asked, and what became of each."""

from dataclasses import dataclass
from typing import Any

from sqlalchemy import select

from stommel.archive import Archive
from stommel.archive.schema import parameter_writes
from stommel.archive.times import microseconds, seconds

WAITING, DONE, REFUSED, FAILED = "waiting", "done", "refused", "failed"


@dataclass
class Write:
    """A value that somebody sets."""

    id: int
    """In the archive."""
    component: int
    name: str
    value: float
    user: str
    t: float
    """When it was asked for, by the vehicle's clock [s since 1970]."""
    state: str = WAITING
    """waiting, done, refused or failed."""
    words: str = ""
    holds: float | None = None
    """Value that holds aboard, as far as the vehicle said."""
    ticket: int | None = None
    """Of the link; None if the station was started anew since: the link knows it no more."""

    def told(self) -> dict[str, Any]:
        """As the API tells it."""
        return {
            "ticket": self.id, "component": self.component, "name": self.name, "value": self.value,
            "user": self.user, "t": self.t, "state": self.state, "words": self.words, "holds": self.holds,
        }  # fmt: skip


class WriteRows:
    """The rows of what people set; each method that writes is one transaction."""

    def __init__(self, archive: Archive) -> None:
        self._archive = archive

    def add(self, vehicle: int, write: Write) -> None:
        """Write that a value is to be set, and give it its number."""
        told = {
            "vehicle_id": vehicle, "component": write.component, "name": write.name, "value": write.value,
            "user": write.user, "t_us": microseconds(write.t), "state": write.state, "words": write.words,
        }  # fmt: skip
        row = parameter_writes.insert().values(told).returning(parameter_writes.c.id)
        with self._archive.writing() as connection:
            write.id = int(connection.execute(row).scalar_one())

    def change(self, write: Write) -> None:
        """Write what became of it."""
        told = {"state": write.state, "words": write.words, "holds": write.holds}
        with self._archive.writing() as connection:
            connection.execute(parameter_writes.update().where(parameter_writes.c.id == write.id).values(told))

    def last(self, vehicle: int, limit: int) -> list[Write]:
        """The last of a vehicle, the oldest first, and before them all that wait."""
        of = parameter_writes.c
        mine = select(parameter_writes).where(of.vehicle_id == vehicle).order_by(of.id.desc())
        with self._archive.reading() as connection:
            rows = {row.id: row for row in connection.execute(mine.limit(limit))}
            rows |= {row.id: row for row in connection.execute(mine.where(of.state == WAITING).limit(limit))}
        return [_read(rows[id]) for id in sorted(rows)]


def _read(row: Any) -> Write:
    return Write(
        row.id, row.component, row.name, row.value, row.user, seconds(row.t_us), row.state, row.words, row.holds
    )
