"""Values of parameters in the archive: what each was, since when, and who wrote it."""

from collections.abc import Sequence
from typing import Any, NamedTuple

from sqlalchemy import and_, func, select

from stommel.archive import Archive
from stommel.archive.schema import parameters
from stommel.archive.times import microseconds, seconds


class ParameterRow(NamedTuple):
    """A value that a parameter had from a time on [s since 1970, by the vehicle's clock]."""

    component: int
    name: str
    value: float
    kind: str
    t: float
    user: str | None
    """Who wrote it; None: the vehicle told it."""
    source: str
    """vehicle or written."""


class ParameterRows:
    """The history of parameters; each method that writes is one transaction."""

    def __init__(self, archive: Archive) -> None:
        self._archive = archive

    def add(self, vehicle: int, rows: Sequence[ParameterRow]) -> None:
        """Write values that are new."""
        if rows:
            told: list[dict[str, Any]] = [
                {
                    "vehicle_id": vehicle, "component": row.component, "name": row.name, "value": row.value,
                    "kind": row.kind, "t_us": microseconds(row.t), "user": row.user, "source": row.source,
                }
                for row in rows
            ]  # fmt: skip
            with self._archive.writing() as connection:
                connection.execute(parameters.insert(), told)

    def latest(self, vehicle: int) -> dict[tuple[int, str], ParameterRow]:
        """The last value of each parameter, by component and name."""
        of = parameters.c
        last = (
            select(func.max(of.id).label("id")).where(of.vehicle_id == vehicle).group_by(of.component, of.name)
        ).subquery()
        with self._archive.reading() as connection:
            found = [_read(row) for row in connection.execute(select(parameters).join(last, of.id == last.c.id))]
        return {(row.component, row.name): row for row in found}

    def history(self, vehicle: int, component: int, name: str, limit: int) -> list[ParameterRow]:
        """Values of a parameter, the newest first."""
        of = parameters.c
        chosen = select(parameters).where(and_(of.vehicle_id == vehicle, of.component == component, of.name == name))
        with self._archive.reading() as connection:
            return [_read(row) for row in connection.execute(chosen.order_by(of.id.desc()).limit(limit))]


def _read(row: Any) -> ParameterRow:
    return ParameterRow(row.component, row.name, row.value, row.kind, seconds(row.t_us), row.user, row.source)
