"""Notes of people, each of a time in the past; a note that is written stays as it is."""

import time
from typing import Any, NamedTuple

from sqlalchemy import Row, and_, insert, or_, select

from stommel.archive import Archive
from stommel.archive.schema import notes as table
from stommel.archive.times import as_kept, microseconds, seconds
from stommel.station.logbook.searching import has_words


class Note(NamedTuple):
    """What somebody wrote; `t` by the clock of the vehicle, `written` by that of the station [s since 1970]."""

    id: int
    vehicle: int | None
    """None: of the station."""
    t: float
    written: float
    user: str
    words: str

    def as_row(self) -> dict[str, Any]:
        """The note as the API tells it."""
        return self._asdict()


class Notes:
    """The table of notes."""

    def __init__(self, archive: Archive) -> None:
        self._archive = archive

    def add(self, vehicle: int | None, t: float, user: str, words: str) -> Note:
        """Write a note about a time [s since 1970].

        Raises
        ------
        ArchiveError
            The archive does not take it.
        """
        written = time.time()
        row = insert(table).values(
            vehicle_id=vehicle, t_us=microseconds(t), written_us=microseconds(written), user=user, words=words
        )
        with self._archive.writing() as connection:
            number = int(connection.execute(row.returning(table.c.id)).scalar_one())
        return Note(number, vehicle, as_kept(t), as_kept(written), user, words)

    def listed(
        self, *, vehicle: int | None = None, search: str = "", before: int | None = None, limit: int = 200
    ) -> list[Note]:
        """Notes, of the newest time first: of a vehicle, with all of some words, before the one of a number."""
        query = select(table).order_by(table.c.t_us.desc(), table.c.id.desc()).limit(limit)
        query = query.where(has_words(search, table.c.words, table.c.user))
        if vehicle is not None:
            query = query.where(table.c.vehicle_id == vehicle)
        if before is not None:
            last = select(table.c.t_us).where(table.c.id == before).scalar_subquery()
            query = query.where(or_(table.c.t_us < last, and_(table.c.t_us == last, table.c.id < before)))
        with self._archive.reading() as connection:
            return [note_of(row) for row in connection.execute(query)]


def note_of(row: Row[Any]) -> Note:
    """Return the note of a row of the table."""
    return Note(row.id, row.vehicle_id, seconds(row.t_us), seconds(row.written_us), row.user, row.words)
