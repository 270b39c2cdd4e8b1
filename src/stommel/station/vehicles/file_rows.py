"""Files of vehicles in the archive: transfers, and what lies whole ashore."""

from collections.abc import Sequence
from typing import Any, NamedTuple

from sqlalchemy import select

from stommel.archive import Archive
from stommel.archive.schema import files
from stommel.archive.times import microseconds, seconds

GOING, PAUSED = "going", "paused"
OPEN = (GOING, PAUSED)
WHOLE, REFUSED, FAILED, CANCELLED = "whole", "refused", "failed", "cancelled"
DOWNLOAD, UPLOAD = "download", "upload"
_AT_ONCE, _MOST = 500, 10_000
"""Paths that are looked up by one query, and rows of them."""


class FileRow(NamedTuple):
    """A transfer of a file; times are of the vehicle's clock [s since 1970]."""

    id: int
    vehicle: int
    path: str
    """Aboard."""
    direction: str
    """download or upload."""
    user: str | None
    """Who asked for it; None: it came by itself."""
    t: float
    """When it was asked for; of a whole file, since when it is."""
    state: str
    """going or paused; at the end whole, refused, failed or cancelled."""
    reason: str = ""
    size: int | None = None
    sha256: str | None = None
    stored_as: str | None = None
    """Below the station's folder."""

    @property
    def is_over(self) -> bool:
        """Whether nothing more will happen."""
        return self.state not in OPEN


class FileRows:
    """The rows of files; each method that writes is one transaction."""

    def __init__(self, archive: Archive) -> None:
        self._archive = archive

    def add(self, row: FileRow) -> FileRow:
        """Write a new transfer, and return it with its number."""
        told = row._asdict() | {"vehicle_id": row.vehicle, "t_us": microseconds(row.t)}
        for name in ("id", "vehicle", "t"):
            del told[name]
        with self._archive.writing() as connection:
            number = connection.execute(files.insert().values(told).returning(files.c.id)).scalar_one()
        return row._replace(id=number)

    def change(self, row: FileRow) -> None:
        """Write what became of a transfer."""
        told = {
            "t_us": microseconds(row.t), "state": row.state, "reason": row.reason, "size": row.size,
            "sha256": row.sha256, "stored_as": row.stored_as,
        }  # fmt: skip
        with self._archive.writing() as connection:
            connection.execute(files.update().where(files.c.id == row.id).values(told))

    def find(self, id: int) -> FileRow | None:
        """A transfer; None if there is none."""
        found = self._rows(files.c.id == id, limit=1)
        return found[0] if found else None

    def open_ones(self, vehicle: int) -> list[FileRow]:
        """Transfers of a vehicle that are not over, the newest first."""
        return self._rows(files.c.vehicle_id == vehicle, files.c.state.in_(OPEN), limit=1000)

    def transfers(self, vehicle: int, limit: int) -> list[FileRow]:
        """The last transfers of a vehicle, the newest first."""
        return self._rows(files.c.vehicle_id == vehicle, limit=limit)

    def whole(self, vehicle: int, limit: int) -> list[FileRow]:
        """Files of a vehicle that lie whole ashore, the newest first."""
        chosen = files.c.vehicle_id == vehicle, files.c.state == WHOLE, files.c.direction == DOWNLOAD
        return self._rows(*chosen, limit=limit)

    def last_downloads(self, vehicle: int, paths: Sequence[str]) -> dict[str, FileRow]:
        """The last download of each of these files of a vehicle, by the path aboard; without those that had none."""
        found: dict[str, FileRow] = {}
        mine = files.c.vehicle_id == vehicle, files.c.direction == DOWNLOAD
        for first in range(0, len(paths), _AT_ONCE):
            some = files.c.path.in_(paths[first : first + _AT_ONCE])
            found |= {row.path: row for row in reversed(self._rows(*mine, some, limit=_MOST))}
        return found

    def _rows(self, *conditions: Any, limit: int) -> list[FileRow]:
        chosen = select(files).where(*conditions).order_by(files.c.id.desc()).limit(limit)
        with self._archive.reading() as connection:
            return [
                FileRow(
                    row.id, row.vehicle_id, row.path, row.direction, row.user, seconds(row.t_us), row.state,
                    row.reason or "", row.size, row.sha256, row.stored_as,
                )
                for row in connection.execute(chosen)
            ]  # fmt: skip
