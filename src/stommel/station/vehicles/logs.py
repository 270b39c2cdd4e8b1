"""Logs of vehicles that came whole: a thread of its own takes them into the archive, one after the other."""

import hashlib
from pathlib import Path, PurePosixPath
from threading import Event, Thread
from time import monotonic
from typing import Any

from sqlalchemy import exists, select

from stommel.archive import Archive, ArchiveError
from stommel.archive.log_tables import logs
from stommel.archive.logs.rows import REFUSED, TAKEN, LogRow, LogRows
from stommel.archive.logs.taking import take_log
from stommel.archive.schema import files
from stommel.errors import StommelError
from stommel.files.opening import read_bytes
from stommel.messages.log.names import log_name
from stommel.station.live.events import Happening
from stommel.station.live.hub import Hub
from stommel.station.vehicles.file_rows import DOWNLOAD, WHOLE, FileRow

AGAIN, TOLD_EVERY = 2.0, 0.5
"""Between two tries while the archive fails, and between two words about the same log [s]."""
_MOST_MIB = 256
_STOPS_WITHIN = 10.0


class VehicleLogs:
    """Finds by itself what is not in the archive yet, also after a restart.

    Parameters
    ----------
    archive, hub
        Of the station.
    folder
        Of the station, in which the files lie.
    """

    def __init__(self, archive: Archive, hub: Hub, folder: Path) -> None:
        self._archive, self._hub, self._folder = archive, hub, folder
        self._rows = LogRows(archive)
        self._passed_over: dict[int, str] = {}
        """Files that cannot be read, by their number, and why."""
        self._news, self._ends = Event(), Event()
        self._thread = Thread(target=self._run, name="logs", daemon=True)
        self._told_at = 0.0

    def start(self) -> None:
        """Begin with what is there."""
        self._news.set()
        self._thread.start()

    def stop(self) -> None:
        """End within a batch; the next start goes on from there."""
        self._ends.set()
        self._news.set()
        if self._thread.ident is not None:
            self._thread.join(_STOPS_WITHIN)

    def came(self, row: FileRow) -> None:
        """Hear that a file came whole; in any thread."""
        if log_name(PurePosixPath(row.path).name):
            self._news.set()

    def told(self, vehicle: int, stored: list[FileRow]) -> dict[int, dict[str, Any]]:
        """How far the logs among these files are, by the number of the file, as the API tells it."""
        named = [row for row in stored if row.sha256 and log_name(PurePosixPath(row.path).name)]
        known = {row.sha256: row for row in self._rows.of(vehicle, [str(row.sha256) for row in named])}
        found: dict[int, dict[str, Any]] = {}
        for row in named:
            if row.id in self._passed_over:
                found[row.id] = _told(None) | {"state": REFUSED, "words": self._passed_over[row.id]}
            else:
                found[row.id] = _told(known.get(str(row.sha256)))
        return found

    # the thread

    def _run(self) -> None:
        while not self._ends.is_set():
            self._news.wait()
            self._news.clear()
            try:
                while not self._ends.is_set() and (row := self._next()) is not None:
                    self._take(row)
            except ArchiveError:
                self._ends.wait(AGAIN)
                self._news.set()

    def _next(self) -> FileRow | None:
        """The oldest log that is not in the archive."""
        over = exists().where(
            logs.c.vehicle_id == files.c.vehicle_id, logs.c.sha256 == files.c.sha256,
            logs.c.state.in_((TAKEN, REFUSED)),
        )  # fmt: skip
        query = select(files).where(
            files.c.state == WHOLE, files.c.direction == DOWNLOAD, files.c.path.like("%.log"), ~over
        )
        with self._archive.reading() as connection:
            for each in connection.execute(query.order_by(files.c.id)):
                if each.id not in self._passed_over and log_name(PurePosixPath(each.path).name) and each.stored_as:
                    return FileRow(
                        each.id, each.vehicle_id, each.path, each.direction, each.user, 0.0, each.state,
                        sha256=each.sha256, stored_as=each.stored_as,
                    )  # fmt: skip
        return None

    def _take(self, row: FileRow) -> None:
        name = PurePosixPath(row.path).name
        try:
            data = self._read(row)
            self._tell(take_log(self._archive, row.vehicle, data, name, self._step, rest=self._rest), at_once=True)
        except ArchiveError:
            raise
        except Exception as error:  # noqa: BLE001 - one file shall not keep the others out
            self._passed_over[row.id] = str(error)[:300]

    def _read(self, row: FileRow) -> bytes:
        """The file as it came; not one that has changed since."""
        assert row.stored_as is not None
        data = read_bytes(self._folder / row.stored_as, _MOST_MIB)
        if hashlib.sha256(data).hexdigest() != row.sha256:
            raise LogChangedError(f"{row.stored_as}: is not what came: its SHA-256 has changed; fetch it again")
        return data

    def _step(self, row: LogRow) -> bool:
        self._tell(row)
        return not self._ends.is_set()

    def _rest(self, seconds: float) -> None:
        self._ends.wait(seconds)

    def _tell(self, row: LogRow, *, at_once: bool = False) -> None:
        if at_once or monotonic() - self._told_at >= TOLD_EVERY:
            self._told_at = monotonic()
            self._hub.publish(Happening("log", row.vehicle, {"name": row.name, "sha256": row.sha256} | _told(row)))


class LogChangedError(StommelError):
    """A file ashore is not what it was."""


def _told(row: LogRow | None) -> dict[str, Any]:
    counts = {name: 0 if row is None else getattr(row, name) for name in ("samples", "dives", "texts", "left_out")}
    if row is None:
        return {"state": "waiting", "words": "", "share": 0.0, **counts, "begin": None, "end": None}
    share = 1.0 if row.state == TAKEN else min(1.0, row.offset / max(1, row.size))
    return {"state": row.state, "words": row.words, "share": share, **counts, "begin": row.begin, "end": row.end}
