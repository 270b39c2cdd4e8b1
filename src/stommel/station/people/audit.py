"""The audit log: who changed what, when and from where. Rows are added and never changed."""

from collections import deque
from collections.abc import Callable, Mapping
from contextlib import suppress
from threading import Lock
from typing import Any, NamedTuple

from sqlalchemy import select

from stommel.archive.errors import ArchiveError, ArchiveRequestError
from stommel.archive.schema import audit
from stommel.archive.times import microseconds, seconds
from stommel.station.people.users import Database

MOST_LATE = 1000
"""Rows that wait for the archive; beyond, the oldest is forgotten."""


class Entry(NamedTuple):
    """One action; `t` in seconds since 1970."""

    entry: int
    t: float
    user: str | None
    address: str | None
    action: str
    vehicle: int | None
    detail: Any


class Audit:
    """The log of a station."""

    def __init__(self, archive: Database, clock: Callable[[], float]) -> None:
        self._archive, self._clock = archive, clock
        self._late: deque[dict[str, Any]] = deque(maxlen=MOST_LATE)
        self._writing = Lock()

    def record(
        self,
        action: str,
        *,
        user: str | None,
        address: str | None = None,
        vehicle: int | None = None,
        detail: Mapping[str, Any] | None = None,
    ) -> None:
        """Add a row; it is on disk when this returns.

        Raises
        ------
        ArchiveError
            The archive does not take it now; it is written before the next row, or before the log is read.
        """
        self._late.append(
            {
                "t_us": microseconds(self._clock()), "user": user, "address": address, "action": action,
                "vehicle_id": vehicle, "detail": None if detail is None else dict(detail),
            }
        )  # fmt: skip
        self.write_late()

    def write_late(self) -> None:
        """Write the rows that the archive did not take when they were told.

        Raises
        ------
        ArchiveError
            It does not take them now.
        """
        with self._writing:
            while self._late:
                try:
                    with self._archive.writing() as connection:
                        connection.execute(audit.insert().values(**self._late[0]))
                except Exception as error:
                    if not isinstance(error, ArchiveError) or isinstance(error, ArchiveRequestError):
                        self._late.popleft()  # no later try would help
                    raise
                self._late.popleft()

    def entries(
        self, *, before: int | None = None, limit: int = 200, user: str | None = None, vehicle: int | None = None
    ) -> list[Entry]:
        """The newest rows first, older than the row `before`."""
        if not self._archive.is_written:  # whoever reads waits for nobody
            with suppress(ArchiveError):
                self.write_late()
        query = select(audit).order_by(audit.c.id.desc()).limit(limit)
        if before is not None:
            query = query.where(audit.c.id < before)
        if user is not None:
            query = query.where(audit.c.user == user)
        if vehicle is not None:
            query = query.where(audit.c.vehicle_id == vehicle)
        with self._archive.reading() as connection:
            return [
                Entry(row.id, seconds(row.t_us), row.user, row.address, row.action, row.vehicle_id, row.detail)
                for row in connection.execute(query)
            ]
