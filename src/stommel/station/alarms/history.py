"""Alarms in the archive: one row for each raising."""

from collections.abc import Sequence
from dataclasses import replace

from sqlalchemy import Row, and_, insert, or_, select, update

from stommel.archive.archive import Archive
from stommel.archive.schema import alarms as table
from stommel.archive.times import microseconds, seconds
from stommel.errors import StommelError
from stommel.station.alarms.alarm import Alarm


class AlarmError(StommelError):
    """An alarm that is not there, or that somebody has acknowledged already."""

    def __init__(self, words: str, *, is_known: bool) -> None:
        super().__init__(words)
        self.is_known = is_known


class History:
    """The table of alarms."""

    def __init__(self, archive: Archive) -> None:
        self._archive = archive

    def open_alarms(self) -> list[Alarm]:
        """All that are not cleared, the oldest first."""
        return self._found(select(table).where(table.c.cleared_us.is_(None)).order_by(table.c.raised_us, table.c.id))

    def open_at(self, vehicle: int, t: float) -> list[Alarm]:
        """Those of a vehicle that were open at a time [s], as they were known then, the oldest first."""
        t_us = microseconds(t)
        query = select(table).where(
            table.c.vehicle_id == vehicle,
            table.c.raised_us <= t_us,
            or_(table.c.cleared_us.is_(None), table.c.cleared_us > t_us),
        )
        return [_as_of(alarm, t) for alarm in self._found(query.order_by(table.c.raised_us, table.c.id))]

    def listed(
        self,
        *,
        vehicle: int | None = None,
        is_open: bool | None = None,
        is_acknowledged: bool | None = None,
        before: int | None = None,
        limit: int = 200,
    ) -> list[Alarm]:
        """Alarms of a vehicle and of the station itself, or all; the newest first, before the one of a number.

        An alarm that is not there has none before it.
        """
        query = select(table).order_by(table.c.raised_us.desc(), table.c.id.desc()).limit(limit)
        if vehicle is not None:
            query = query.where(or_(table.c.vehicle_id == vehicle, table.c.vehicle_id.is_(None)))
        if is_open is not None:
            query = query.where(table.c.cleared_us.is_(None) if is_open else table.c.cleared_us.is_not(None))
        if is_acknowledged is not None:
            told = table.c.acknowledged_us
            query = query.where(told.is_not(None) if is_acknowledged else told.is_(None))
        if before is not None:
            last = select(table.c.raised_us).where(table.c.id == before).scalar_subquery()
            query = query.where(or_(table.c.raised_us < last, and_(table.c.raised_us == last, table.c.id < before)))
        return self._found(query)

    def add(self, alarm: Alarm) -> int:
        """Write an alarm that was raised; returns its number. One of the same key that is still open is the same one.

        Raises
        ------
        ArchiveError
            The archive does not take it.
        """
        same = select(table.c.id).where(
            table.c.vehicle_id.is_(None) if alarm.vehicle is None else table.c.vehicle_id == alarm.vehicle,
            table.c.key == alarm.key,
            table.c.cleared_us.is_(None),
        )
        with self._archive.writing() as connection:
            known = connection.execute(same).scalar()
            if known is not None:
                return int(known)
            row = insert(table).values(
                vehicle_id=alarm.vehicle, key=alarm.key, words=alarm.words, severity=alarm.severity,
                raised_us=microseconds(alarm.raised), value=alarm.value,
            )  # fmt: skip
            return int(connection.execute(row.returning(table.c.id)).scalar_one())

    def clear(self, number: int, t: float) -> None:
        """Write that an alarm is over since a time [s].

        Raises
        ------
        ArchiveError
            The archive does not take it.
        """
        with self._archive.writing() as connection:
            connection.execute(update(table).where(table.c.id == number).values(cleared_us=microseconds(t)))

    def acknowledge(self, number: int, user: str, note: str, t: float) -> Alarm:
        """Write who has seen an alarm, and what was said to it.

        Raises
        ------
        AlarmError
            There is no such alarm, or somebody has acknowledged it.
        ArchiveError
            The archive does not take it.
        """
        with self._archive.writing() as connection:
            seen = update(table).where(table.c.id == number, table.c.acknowledged_us.is_(None))
            done = connection.execute(
                seen.values(acknowledged_us=microseconds(t), acknowledged_by=user, note=note or None)
            ).rowcount
            row = connection.execute(select(table).where(table.c.id == number)).one_or_none()
        if row is None:
            raise AlarmError(f"alarm {number}: there is none of that number", is_known=False)
        if not done:
            raise AlarmError(f"alarm {number}: {row.acknowledged_by} has acknowledged it already", is_known=True)
        return _alarm(row)

    def alarm(self, number: int) -> Alarm | None:
        """Return the alarm of a number."""
        return next(iter(self._found(select(table).where(table.c.id == number))), None)

    def _found(self, query: object) -> list[Alarm]:
        with self._archive.reading() as connection:
            return _alarms(connection.execute(query).all())  # type: ignore[call-overload]


def _alarms(rows: Sequence[Row[tuple[object, ...]]]) -> list[Alarm]:
    return [_alarm(row) for row in rows]


def _alarm(row: Row[tuple[object, ...]]) -> Alarm:
    return Alarm(
        row.id, row.vehicle_id, row.key, row.words, row.severity, seconds(row.raised_us), row.value,
        _time(row.cleared_us), _time(row.acknowledged_us), row.acknowledged_by, row.note,
    )  # fmt: skip


def _as_of(alarm: Alarm, t: float) -> Alarm:
    """An open alarm without what became of it later."""
    if alarm.acknowledged is not None and alarm.acknowledged > t:
        alarm = replace(alarm, acknowledged=None, acknowledged_by=None, note=None)
    return replace(alarm, cleared=None)


def _time(us: int | None) -> float | None:
    return None if us is None else seconds(us)
