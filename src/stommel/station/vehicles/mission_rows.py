"""Missions in the archive: the orders of each, by whom, and what became of them."""

from collections.abc import Mapping
from typing import Any, NamedTuple

from sqlalchemy import Connection, select

from stommel.archive import Archive
from stommel.archive.schema import mission_history, missions
from stommel.archive.times import microseconds, seconds

WAITING, SENDING, ABOARD, REPLACED = "waiting", "sending", "aboard", "replaced"
REFUSED, FAILED, INTERRUPTED = "refused", "failed", "interrupted"
CANCELLED, SUPERSEDED, EXPIRED = "cancelled", "superseded", "expired"
"""Taken back; another one came in its place before the vehicle had it; its time was over."""
OPEN = (WAITING, SENDING)


class MissionRow(NamedTuple):
    """A mission; times are of the vehicle's clock [s since 1970]."""

    id: int
    vehicle: int
    t: float
    """When it was given, or found aboard."""
    user: str | None
    """Who gave it; None: it was found aboard."""
    name: str
    sha256: str
    orders: str
    plan: Mapping[str, Any] | None
    state: str
    """waiting, sending, aboard, replaced, refused, failed, interrupted, cancelled, superseded or expired."""
    until: float | None = None
    """Until when it is tried, by the clock of the link [s]; None: that is not known."""


class MissionState(NamedTuple):
    """What a mission was from a time on."""

    t: float
    user: str | None
    state: str
    words: str


class MissionRows:
    """The rows of missions; each method that writes is one transaction."""

    def __init__(self, archive: Archive) -> None:
        self._archive = archive

    def add(
        self,
        row: MissionRow,
        words: str,
        preview: Mapping[str, Any] | None = None,
        ended: Mapping[int, MissionState] | None = None,
    ) -> MissionRow:
        """Write a new mission, and what becomes of those that it ends; return it with its number."""
        told = {
            "vehicle_id": row.vehicle, "t_us": microseconds(row.t), "user": row.user, "name": row.name,
            "sha256": row.sha256, "orders": row.orders, "plan": row.plan, "preview": preview, "state": row.state,
            "until_us": None if row.until is None else round(1e6 * row.until),  # by a clock that may be far ahead
        }  # fmt: skip
        with self._archive.writing() as connection:
            number = connection.execute(missions.insert().values(told).returning(missions.c.id)).scalar_one()
            _note(connection, number, MissionState(row.t, row.user, row.state, words))
            _change_all(connection, ended or {})
        return row._replace(id=number)

    def change(self, id: int, state: str, words: str, t: float, user: str | None = None) -> None:
        """Write what became of a mission; the same state again is not noted again."""
        self.change_all({id: MissionState(t, user, state, words)})

    def change_all(self, states: Mapping[int, MissionState]) -> None:
        """Write what became of missions, by their numbers, as `change` does, all or nothing."""
        with self._archive.writing() as connection:
            _change_all(connection, states)

    def find(self, vehicle: int, id: int) -> MissionRow | None:
        """A mission of a vehicle; None if there is none."""
        return self._first(missions.c.vehicle_id == vehicle, missions.c.id == id)

    def of_hash(self, vehicle: int, sha256: str) -> MissionRow | None:
        """The last mission of a vehicle with these orders; None if there is none."""
        return self._first(missions.c.vehicle_id == vehicle, missions.c.sha256 == sha256)

    def held_at(self, vehicle: int, t: float) -> MissionRow | None:
        """The mission to which the vehicle had switched last at a time [s since 1970]; None if that is not known."""
        of = mission_history.c
        chosen = (
            select(missions)
            .join(mission_history, of.mission_id == missions.c.id)
            .where(missions.c.vehicle_id == vehicle, of.state == ABOARD, of.t_us <= microseconds(t))
            .order_by(of.t_us.desc(), of.id.desc())
            .limit(1)
        )
        with self._archive.reading() as connection:
            row = connection.execute(chosen).first()
        return None if row is None else _read(row)

    def in_states(self, vehicle: int, *states: str) -> list[MissionRow]:
        """Missions of a vehicle in these states, the newest first."""
        chosen = select(missions).where(missions.c.vehicle_id == vehicle, missions.c.state.in_(states))
        with self._archive.reading() as connection:
            return [_read(row) for row in connection.execute(chosen.order_by(missions.c.id.desc()))]

    def page(self, vehicle: int, limit: int) -> list[MissionRow]:
        """The last missions of a vehicle, the newest first."""
        chosen = select(missions).where(missions.c.vehicle_id == vehicle).order_by(missions.c.id.desc()).limit(limit)
        with self._archive.reading() as connection:
            return [_read(row) for row in connection.execute(chosen)]

    def history(self, id: int) -> list[MissionState]:
        """What became of a mission."""
        chosen = select(mission_history).where(mission_history.c.mission_id == id).order_by(mission_history.c.id)
        with self._archive.reading() as connection:
            return [
                MissionState(seconds(row.t_us), row.user, row.state, row.words or "")
                for row in connection.execute(chosen)
            ]

    def _first(self, *conditions: Any) -> MissionRow | None:
        chosen = select(missions).where(*conditions).order_by(missions.c.id.desc()).limit(1)
        with self._archive.reading() as connection:
            row = connection.execute(chosen).first()
        return None if row is None else _read(row)


def _change_all(connection: Connection, states: Mapping[int, MissionState]) -> None:
    for id, new in states.items():
        before = connection.execute(select(missions.c.state).where(missions.c.id == id)).scalar_one_or_none()
        if before is not None and before != new.state:
            connection.execute(missions.update().where(missions.c.id == id).values(state=new.state))
            _note(connection, id, new)


def _note(connection: Connection, id: int, new: MissionState) -> None:
    told = {"mission_id": id, "t_us": microseconds(new.t), "user": new.user, "state": new.state, "words": new.words}
    connection.execute(mission_history.insert().values(told))


def _read(row: Any) -> MissionRow:
    return MissionRow(
        row.id, row.vehicle_id, seconds(row.t_us), row.user, row.name, row.sha256, row.orders, row.plan, row.state,
        None if row.until_us is None else seconds(row.until_us),
    )  # fmt: skip
