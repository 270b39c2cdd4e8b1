"""The audit log: who changed what, when and from where. Rows are added and never changed."""

from collections.abc import Callable, Mapping
from typing import Any, NamedTuple

from sqlalchemy import select

from stommel.archive.schema import audit
from stommel.archive.times import microseconds, seconds
from stommel.station.people.users import Database


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

    def record(
        self,
        action: str,
        *,
        user: str | None,
        address: str | None = None,
        vehicle: int | None = None,
        detail: Mapping[str, Any] | None = None,
    ) -> None:
        """Add a row; it is on disk when this returns."""  # fmt: skip
        with self._archive.writing() as connection:
            connection.execute(
                audit.insert().values(
                    t_us=microseconds(self._clock()), user=user, address=address, action=action, vehicle_id=vehicle,
                    detail=None if detail is None else dict(detail),
                )
            )  # fmt: skip

    def entries(
        self, *, before: int | None = None, limit: int = 200, user: str | None = None, vehicle: int | None = None
    ) -> list[Entry]:
        """The newest rows first, older than the row `before`."""
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
