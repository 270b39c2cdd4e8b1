"""Limits in the archive; one that was taken away leaves a row without ends, so that no default comes back."""

import time
from collections.abc import Iterable

from sqlalchemy import delete, insert, select

from stommel.archive.archive import Archive
from stommel.archive.schema import limits as table
from stommel.archive.times import microseconds, seconds
from stommel.station.alarms.limits import Limit, SetLimit


class LimitTable:
    """The table of limits."""

    def __init__(self, archive: Archive) -> None:
        self._archive = archive

    def limits_of(self, vehicle: int) -> list[Limit]:
        """Limits of a vehicle, by channel."""
        return [kept.limit for kept in self.set_limits(vehicle)]

    def set_limits(self, vehicle: int) -> list[SetLimit]:
        """Limits of a vehicle, by channel, and who set each."""
        with self._archive.reading() as connection:
            rows = connection.execute(select(table).where(table.c.vehicle_id == vehicle).order_by(table.c.channel))
            return [
                SetLimit(
                    Limit(
                        channel=row.channel, low=row.low, high=row.high, hysteresis=row.hysteresis,
                        delay_s=row.delay_s, severity=row.severity,
                    ),
                    seconds(row.changed_us), row.changed_by,
                )
                for row in rows
                if row.low is not None or row.high is not None
            ]  # fmt: skip

    def add_new(self, vehicle: int, limits: Iterable[Limit], user: str) -> None:
        """Write limits of channels that never had one.

        Raises
        ------
        ArchiveError
            The archive does not take them.
        """
        known = select(table.c.channel).where(table.c.vehicle_id == vehicle)
        with self._archive.writing() as connection:
            channels = set(connection.execute(known).scalars())
            for limit in limits:
                if limit.channel not in channels:
                    connection.execute(insert(table).values(_row(vehicle, limit, user)))

    def put(self, vehicle: int, limit: Limit, user: str) -> None:
        """Write a limit in place of the channel's limit before.

        Raises
        ------
        ArchiveError
            The archive does not take it.
        """
        self._replace(vehicle, limit.channel, _row(vehicle, limit, user))

    def remove(self, vehicle: int, channel: str, user: str) -> None:
        """Write that a channel has no limit any more.

        Raises
        ------
        ArchiveError
            The archive does not take it.
        """
        gone = _row(vehicle, Limit(channel=channel, low=0.0), user)
        self._replace(vehicle, channel, {**gone, "low": None})

    def _replace(self, vehicle: int, channel: str, row: dict[str, object]) -> None:
        with self._archive.writing() as connection:
            connection.execute(delete(table).where(table.c.vehicle_id == vehicle, table.c.channel == channel))
            connection.execute(insert(table).values(row))


def _row(vehicle: int, limit: Limit, user: str) -> dict[str, object]:
    return {"vehicle_id": vehicle, **limit.model_dump(), "changed_us": microseconds(time.time()), "changed_by": user}
