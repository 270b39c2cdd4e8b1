"""The rows of logs: what was taken in, how far it is, and what was refused."""

import time
from collections.abc import Sequence
from typing import Any, NamedTuple

from sqlalchemy import func, select, update

from stommel.archive.archive import Archive
from stommel.archive.log_tables import logs
from stommel.archive.schema import channels, dives, samples
from stommel.archive.times import microseconds, seconds

GOING, TAKEN, REFUSED = "going", "taken", "refused"
"""It is being taken in, or was interrupted; what it holds is in the archive; it is no log, or cannot be dated."""


class LogRow(NamedTuple):
    """A file of a log; times are of the vehicle's clock [s since 1970]."""

    id: int
    vehicle: int
    sha256: str
    name: str
    size: int
    series: str = ""
    software: str = ""
    state: str = GOING
    words: str = ""
    """Whether it was whole; why it was refused."""
    offset: int = 0
    """Up to where it is in the archive [byte]."""
    records: int = 0
    samples: int = 0
    """Values of channels."""
    dives: int = 0
    begin: float | None = None
    end: float | None = None
    texts: int = 0
    """What happened aboard, in words."""
    left_out: int = 0
    """Rows that no archive takes; the file has them."""


class LogRows:
    """Reads and writes them; each method that writes is one transaction."""

    def __init__(self, archive: Archive) -> None:
        self._archive = archive

    def begun(self, row: LogRow) -> LogRow:
        """The row of a file of this content, of this vehicle; a new one if there is none."""
        there = self.of(row.vehicle, [row.sha256])
        if there:
            return there[0]
        with self._archive.writing() as connection:
            number = connection.execute(logs.insert().values(_told(row)).returning(logs.c.id)).scalar_one()
        return row._replace(id=number)

    def change(self, row: LogRow) -> None:
        """Write how far it is, or what became of it."""
        with self._archive.writing() as connection:
            connection.execute(update(logs).where(logs.c.id == row.id).values(_told(row)))

    def of(self, vehicle: int, contents: Sequence[str]) -> list[LogRow]:
        """Those of a vehicle with these SHA-256."""
        query = select(logs).where(logs.c.vehicle_id == vehicle, logs.c.sha256.in_(contents))
        with self._archive.reading() as connection:
            return [_row(dict(row._mapping)) for row in connection.execute(query)]

    def deepen(self, row: LogRow) -> None:
        """Give the dives of a log their greatest depth from the depths in the archive, which another file may tell."""
        if row.begin is None or row.end is None:
            return
        span = microseconds(row.begin), microseconds(row.end)
        with self._archive.writing() as connection:
            number = connection.execute(select(channels.c.id).where(channels.c.key == "depth_m")).scalar()
            found = connection.execute(
                select(dives).where(
                    dives.c.vehicle_id == row.vehicle, dives.c.log_id.is_not(None), dives.c.t_end_us.is_not(None),
                    dives.c.t_begin_us <= span[1], dives.c.t_end_us >= span[0],
                )
            ).all()  # fmt: skip
            for dive in found:
                deepest = connection.execute(
                    select(func.max(samples.c.value)).where(
                        samples.c.vehicle_id == row.vehicle, samples.c.channel_id == number,
                        samples.c.t_us.between(dive.t_begin_us, dive.t_end_us),
                    )
                ).scalar()  # fmt: skip
                if deepest is not None and deepest > (dive.greatest_depth_m or 0.0):
                    connection.execute(
                        update(dives)
                        .where(
                            dives.c.vehicle_id == row.vehicle, dives.c.dive == dive.dive,
                            dives.c.t_begin_us == dive.t_begin_us,
                        )
                        .values(greatest_depth_m=deepest)
                    )  # fmt: skip


def _told(row: LogRow) -> dict[str, Any]:
    told = row._asdict() | {"vehicle_id": row.vehicle, "changed_us": round(time.time() * 1e6)}
    for name in ("begin", "end"):
        told[f"{name}_us"] = None if row[LogRow._fields.index(name)] is None else microseconds(told[name])
    for name in ("id", "vehicle", "begin", "end"):
        del told[name]
    return told


def _row(found: dict[str, Any]) -> LogRow:
    begin, end = (None if found[name] is None else seconds(found[name]) for name in ("begin_us", "end_us"))
    for name in ("begin_us", "end_us", "changed_us"):
        del found[name]
    return LogRow(vehicle=found.pop("vehicle_id"), begin=begin, end=end, **found)
