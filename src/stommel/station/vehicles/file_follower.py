"""Transfers of files of one vehicle, over as many surfacings as they take, and over restarts of the station."""

import shutil
import time
from collections.abc import Callable, Sequence
from concurrent.futures import Future
from dataclasses import dataclass
from pathlib import Path

from stommel.files.folder_storage import FolderStorage
from stommel.files.storage import replace_whole
from stommel.files.whole import sync_names
from stommel.link.files.download import Download
from stommel.link.files.folder_disk import FolderDisk
from stommel.link.files.listing import Listing
from stommel.link.files.port import Entry
from stommel.link.files.progress import Progress, State
from stommel.link.files.upload import Upload
from stommel.link.shore.shore_end import ShoreEnd
from stommel.station.vehicles.file_rows import (
    CANCELLED,
    FAILED,
    GOING,
    PAUSED,
    REFUSED,
    UPLOAD,
    WHOLE,
    FileRow,
    FileRows,
)
from stommel.station.vehicles.line import VehicleLine
from stommel.station.vehicles.opening import MissingError, VehicleError

EVERY, TOLD_EVERY = 0.2, 1.0
"""Between two looks, and between two words about the same transfer [s]."""
MOST_OPEN = 50
LOCAL = "file"
SILENT = "the vehicle is not heard; it goes on by itself"
DISK_AGAIN = 10.0
"""After which a disk that failed is tried again [s]."""


@dataclass
class Transfer:
    """A transfer that is not over."""

    row: FileRow
    service: Download | Upload
    disk: FolderDisk | None
    """Of a download."""
    told_at: float = 0.0
    """When it was told last, by the station's clock [s]."""
    ended: FileRow | None = None
    """What became of it, until the archive has that."""
    trouble: str = ""
    """What the disk here said, for which it waits."""
    again_at: float = 0.0
    """When the disk is tried again, by the station's clock [s]."""

    @property
    def progress(self) -> Progress:
        """How far it is."""
        return self.service.progress

    @property
    def waits_for_disk(self) -> str:
        """What the disk here said, for which it waits; empty if it does not."""
        failed = isinstance(self.service, Download) and self.service.has_disk_failed
        return self.trouble or (self.service.reason if failed else "")


class FileFollower:
    """Everything of it happens in the line's thread, but for reading `transfers`.

    Parameters
    ----------
    rows
        Of the archive.
    folder
        Of the station.
    vehicle
        Its folder below that, by name.
    tell
        Is called when a transfer has changed.
    left
        Transfers that were not over when the station stopped; they go on.
    """

    def __init__(
        self, rows: FileRows, folder: Path, vehicle: str, tell: Callable[[FileRow], None], left: Sequence[FileRow]
    ) -> None:
        self._rows, self._folder, self._vehicle, self._tell = rows, folder, vehicle, tell
        self._due = 0.0
        self._left, self._left_at = list(left), 0.0
        self.transfers: dict[int, Transfer] = {}
        """By number."""
        self._listings: list[tuple[Listing, Future[Sequence[Entry]]]] = []

    # what is asked for

    def begin(self, end: ShoreEnd, row: FileRow, content: bytes | None = None) -> None:
        """Begin a transfer whose row is written, or go on with one.

        Raises
        ------
        VehicleError
            Too many are open.
        """
        if len(self.transfers) >= MOST_OPEN:
            raise VehicleError(f"vehicle {row.vehicle}: {MOST_OPEN} transfers are open; wait, or cancel some")
        place = self._place(row.id)
        if row.direction == UPLOAD:
            if content is None:
                content = (place / LOCAL).read_bytes()
            transfer = Transfer(row, end.upload(content, row.path), None)
        else:
            transfer = self._download(end, row)
        if row.state == PAUSED:
            transfer.service.pause()
        self.transfers[row.id] = transfer

    def _download(self, end: ShoreEnd, row: FileRow) -> Transfer:
        disk = FolderDisk(self._place(row.id))
        return Transfer(row, end.download(row.path, disk, LOCAL), disk)

    def keep_content(self, id: int, content: bytes) -> None:
        """Keep what is to be sent, so that it goes on after a restart; in any thread.

        Raises
        ------
        OSError
            The disk does not take it.
        """
        replace_whole(FolderStorage(self._place(id)), LOCAL, content)

    def drop_content(self, id: int) -> None:
        """Keep nothing of a transfer that is not begun; in any thread."""
        shutil.rmtree(self._place(id), ignore_errors=True)

    def pause(self, id: int) -> None:
        """Let a transfer rest until somebody resumes it."""
        transfer = self._found(id)
        self._write(transfer, PAUSED)
        transfer.service.pause()
        self._tell(transfer.row)

    def resume(self, id: int, t: float) -> None:
        """Let a transfer go on."""
        transfer = self._found(id)
        self._write(transfer, GOING)
        transfer.service.resume(t)
        self._tell(transfer.row)

    def cancel(self, end: ShoreEnd, id: int) -> None:
        """End a transfer; what has come of it is dropped."""
        transfer = self._found(id)
        self._over(end, transfer, transfer.row._replace(state=CANCELLED, reason="cancelled by a person"))

    def list(self, end: ShoreEnd, folder: str) -> "Future[Sequence[Entry]]":
        """Begin to list a folder aboard."""
        found: Future[Sequence[Entry]] = Future()
        self._listings.append((end.listing(folder), found))
        return found

    def _write(self, transfer: Transfer, state: str) -> None:
        row = transfer.row._replace(state=state)
        self._rows.change(row)
        transfer.row = row

    def _found(self, id: int) -> Transfer:
        if id not in self.transfers:
            raise MissingError(f"transfer {id}: is over, or there is none")
        return self.transfers[id]

    # how it goes on

    def look(self, line: VehicleLine, t: float) -> None:
        """Go on."""
        real = time.monotonic()
        if real < self._due:
            return
        self._due = real + EVERY
        self._take_up(line, real)
        for transfer in list(self.transfers.values()):
            if transfer.ended is None and transfer.service.state.is_over and real >= transfer.again_at:
                transfer = self._looked_after(line, transfer, real)  # noqa: PLW2901 - another service of the same row
            if transfer.ended is not None:
                self._over(line.end, transfer, transfer.ended)
            else:
                if transfer.row.state == PAUSED and not transfer.service.is_paused:
                    transfer.service.pause()  # the end resumes all when the vehicle is heard again
                if real - transfer.told_at >= TOLD_EVERY:
                    transfer.told_at = real
                    self._tell(transfer.row)
        self._look_at_listings(line, t)

    def _take_up(self, line: VehicleLine, real: float) -> None:
        """Take up what was not over when the station stopped; a disk that fails is tried again."""
        while self._left and real >= self._left_at:
            row = self._left[-1]
            try:
                self.begin(line.end, row)
            except (FileNotFoundError, VehicleError) as error:
                self._rows.change(row._replace(state=FAILED, reason=f"cannot go on: {error}"[:300]))
            except OSError:
                self._left_at = real + DISK_AGAIN
                return
            self._left.pop()

    def _looked_after(self, line: VehicleLine, transfer: Transfer, real: float) -> Transfer:
        """End a transfer whose service is over; where only the disk here has failed, go on with it after a while.

        What has come stays where it is meanwhile, and is not asked for again.
        """
        service = transfer.service
        try:
            if not (isinstance(service, Download) and service.has_disk_failed):
                transfer.ended, transfer.trouble = self._ended(line, transfer), ""
                return transfer
            if transfer.trouble:
                again = self._download(line.end, transfer.row)
                line.end.drop(service)
                if transfer.disk is not None:
                    transfer.disk.close()
                if transfer.row.state == PAUSED:
                    again.service.pause()
                self.transfers[transfer.row.id] = again
                return again
            trouble = service.reason
        except OSError as error:
            trouble = f"cannot be stored: {error.strerror or error}"
        transfer.trouble, transfer.again_at = trouble, real + DISK_AGAIN
        return transfer

    def _ended(self, line: VehicleLine, transfer: Transfer) -> FileRow:
        """What became of a transfer; a file that is whole is brought to its place. OSError: the disk fails."""
        service, row, now = transfer.service, transfer.row, line.clock.now()
        state = {State.WHOLE: WHOLE, State.REFUSED: REFUSED}.get(service.state, FAILED)
        row = row._replace(state=state, reason=service.reason, t=now)
        if isinstance(service, Download) and state == WHOLE:
            assert service.file is not None
            identity = service.file.identity
            row = row._replace(size=identity.size, sha256=identity.sha256)
            row = row._replace(stored_as=self._store(row, service.file.kept_as or LOCAL))
        return row

    def _store(self, row: FileRow, name: str) -> str:
        """Bring a whole file to its place by its hash, and return the place below the station's folder."""
        assert row.sha256 is not None
        place = Path(self._vehicle) / "files" / row.sha256[:2] / row.sha256
        target = self._folder / place
        target.parent.mkdir(parents=True, exist_ok=True)
        came = self._place(row.id) / name
        if came.exists() or not target.exists():  # it is there where only the last word of the disk was missing
            came.replace(target)
        sync_names(target.parent)
        return place.as_posix()

    def _over(self, end: ShoreEnd, transfer: Transfer, row: FileRow) -> None:
        self._rows.change(row)
        end.drop(transfer.service)
        if transfer.disk is not None:
            transfer.disk.close()
        del self.transfers[row.id]
        shutil.rmtree(self._place(row.id), ignore_errors=True)
        self._tell(row)

    def _look_at_listings(self, line: VehicleLine, t: float) -> None:
        for listing, found in list(self._listings):
            if found.cancelled() or not line.end.is_heard(t):
                reason = line.status().reason or "it went out of reach"
                _fail(found, f"vehicle {line.vehicle} is not heard: {reason}")
            elif not listing.state.is_over:
                continue
            elif listing.state is State.WHOLE:
                if found.set_running_or_notify_cancel():
                    found.set_result(listing.entries)
            else:
                _fail(found, listing.reason or f"{listing.folder or '/'}: cannot be listed")
            line.end.drop(listing)
            self._listings.remove((listing, found))

    def _place(self, id: int) -> Path:
        return self._folder / self._vehicle / "transfers" / str(id)


def told(row: FileRow, transfer: Transfer | None) -> dict[str, object]:
    """A transfer as the API tells it."""
    found: dict[str, object] = {
        "id": row.id, "vehicle": row.vehicle, "path": row.path, "direction": row.direction, "user": row.user,
        "t": row.t, "state": row.state, "is_over": row.is_over, "is_paused": row.state == PAUSED,
        "reason": row.reason, "size": row.size, "sha256": row.sha256, "rate": None, "seconds_left": None,
        "loss_share": None, "done": row.size or 0 if row.state == WHOLE else 0,
    }  # fmt: skip
    if transfer is not None:
        now = transfer.progress
        found |= {
            "done": now.done, "size": now.size if now.size is not None else row.size, "rate": now.rate,
            "seconds_left": now.seconds_left, "loss_share": now.loss,
        }  # fmt: skip
        if trouble := transfer.waits_for_disk:
            found["reason"] = f"{trouble}; it goes on by itself when the disk is well again"
        elif now.is_paused and row.state != PAUSED:
            found["reason"] = SILENT
        elif row.state != PAUSED:
            found["reason"] = now.state.value
    return found


def _fail(found: "Future[Sequence[Entry]]", words: str) -> None:
    if found.set_running_or_notify_cancel():
        found.set_exception(VehicleError(words))
