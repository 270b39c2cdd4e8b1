"""Files of vehicles as people fetch and send them; what came whole lies ashore by its hash."""

import hashlib
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import TimeoutError as TooLate
from pathlib import Path
from typing import Any

from stommel.archive import Archive
from stommel.errors import StommelError
from stommel.link.files.paths import file_path, plain_path
from stommel.link.files.port import Entry
from stommel.station.live.events import Happening
from stommel.station.live.hub import Hub
from stommel.station.vehicles.asking import ask
from stommel.station.vehicles.file_follower import MOST_OPEN, FileFollower, told
from stommel.station.vehicles.file_rows import DOWNLOAD, FAILED, GOING, UPLOAD, WHOLE, FileRow, FileRows
from stommel.station.vehicles.line import VehicleLine
from stommel.station.vehicles.log_fetching import NOTHING, LogFetching
from stommel.station.vehicles.opening import LateError, MissingError, VehicleError, vehicle_folder

LISTED_WITHIN = 20.0
"""Time in which a vehicle that is heard has told a folder [s]."""
MOST_CONTENT = 8 << 20
"""Bytes of a file that is sent to a vehicle."""


class TransferError(StommelError):
    """A transfer cannot be begun."""


class Files:
    """Files of the vehicles of a station.

    Parameters
    ----------
    archive, hub
        Of the station.
    lines
        By vehicle; those that come later too.
    folder
        Of the station.
    """

    def __init__(self, archive: Archive, hub: Hub, lines: Mapping[int, VehicleLine], folder: Path) -> None:
        self._rows, self._hub, self._lines, self._folder = FileRows(archive), hub, lines, folder
        self._followers: dict[int, FileFollower] = {}
        self.arrivals: list[Callable[[FileRow], None]] = []
        """Are told of each file that came whole, in the line's thread."""

    def follow(self, line: VehicleLine) -> None:
        """Take in a vehicle, before its line is started."""
        name = vehicle_folder(Path(), line.vehicle).name
        left = self._rows.open_ones(line.vehicle)
        follower = self._followers[line.vehicle] = FileFollower(self._rows, self._folder, name, self._tell, left)
        line.followers.append(follower)
        if line.settings.fetch != NOTHING:
            line.followers.append(LogFetching(line.settings.fetch, self._rows, follower, self._tell))

    def listing(self, vehicle: int, folder: str) -> Sequence[Entry]:
        """What stands in a folder aboard; the vehicle is asked, and must be heard.

        Raises
        ------
        StommelError
            The path is none, or the vehicle does not tell it.
        """
        plain_path(folder)
        line, follower = self._lines[vehicle], self._followers[vehicle]
        status = line.status()
        if not status.heard:
            raise VehicleError(f"vehicle {vehicle} is not heard: {status.reason}")
        found = ask(line, lambda end, _t: follower.list(end, folder))
        try:
            return found.result(LISTED_WITHIN)
        except TooLate:
            found.cancel()
            raise VehicleError(f"vehicle {vehicle} has not told this folder within {LISTED_WITHIN:g} s") from None

    def download(self, vehicle: int, user: str, path: str) -> FileRow:
        """Begin to fetch a file; one that is on its way already goes on.

        Raises
        ------
        StommelError
            The path is none, or too many transfers are open.
        """
        file_path(path)
        for transfer in list(self._followers[vehicle].transfers.values()):
            if (transfer.row.path, transfer.row.direction) == (path, DOWNLOAD):
                return transfer.row
        return self._begin(FileRow(0, vehicle, path, DOWNLOAD, user, self._now(vehicle), GOING), None)

    def upload(self, vehicle: int, user: str, path: str, content: bytes) -> FileRow:
        """Begin to send a file.

        Raises
        ------
        StommelError
            The path is none, the file is empty or too large, or too many transfers are open.
        """
        file_path(path)
        if not 1 <= len(content) <= MOST_CONTENT:
            raise TransferError(f"{path}: has {len(content)} bytes; must be from 1 to {MOST_CONTENT} bytes")
        sha256 = hashlib.sha256(content).hexdigest()
        row = FileRow(0, vehicle, path, UPLOAD, user, self._now(vehicle), GOING, "", len(content), sha256)
        return self._begin(row, content)

    def pause(self, id: int) -> FileRow:
        """Let a transfer rest until somebody resumes it."""
        line, follower = self._of(id)
        ask(line, lambda _end, _t: follower.pause(id))
        return self._row(id)

    def resume(self, id: int) -> FileRow:
        """Let a transfer go on."""
        line, follower = self._of(id)
        ask(line, lambda _end, t: follower.resume(id, t))
        return self._row(id)

    def cancel(self, id: int) -> FileRow:
        """End a transfer."""
        line, follower = self._of(id)
        ask(line, lambda end, _t: follower.cancel(end, id))
        return self._row(id)

    def open(self, vehicle: int) -> int:
        """How many transfers are not over, and do not rest."""
        return sum(each.row.state == GOING for each in list(self._followers[vehicle].transfers.values()))

    def transfers(self, vehicle: int, limit: int) -> list[dict[str, Any]]:
        """The last transfers, the newest first, as the API tells them."""
        return [self.told(row) for row in self._rows.transfers(vehicle, limit)]

    def whole(self, vehicle: int, limit: int) -> list[FileRow]:
        """Files that lie whole ashore, the newest first."""
        return self._rows.whole(vehicle, limit)

    def stored(self, vehicle: int, id: int) -> tuple[FileRow, Path]:
        """A file that lies whole ashore, and where.

        Raises
        ------
        MissingError
            There is none, or somebody has taken it away.
        """
        row = self._rows.find(id)
        if row is None or row.vehicle != vehicle or row.stored_as is None:
            raise MissingError(f"vehicle {vehicle}: there is no file {id} ashore")
        place = self._folder / row.stored_as
        if not place.is_file():
            raise MissingError(f"{row.path}: was stored as {row.stored_as}, and is not there any more")
        return row, place

    def told(self, row: FileRow) -> dict[str, Any]:
        """A transfer as the API tells it."""
        follower = self._followers.get(row.vehicle)
        return told(row, None if follower is None else follower.transfers.get(row.id))

    def _begin(self, row: FileRow, content: bytes | None) -> FileRow:
        line, follower = self._lines[row.vehicle], self._followers[row.vehicle]
        if len(follower.transfers) >= MOST_OPEN:
            raise TransferError(f"vehicle {row.vehicle}: {MOST_OPEN} transfers are open; wait, or cancel some")
        row = self._rows.add(row)
        try:
            if content is not None:
                follower.keep_content(row.id, content)
            ask(line, lambda end, _t: follower.begin(end, row, content))
        except LateError:  # it may have begun
            raise
        except (OSError, StommelError) as error:
            follower.drop_content(row.id)
            self._rows.change(row._replace(state=FAILED, reason=str(error)))
            raise TransferError(f"{row.path}: {error}") from None
        self._tell(row)
        return row

    def _of(self, id: int) -> tuple[VehicleLine, FileFollower]:
        vehicle = self._row(id).vehicle
        if vehicle not in self._lines:
            raise MissingError(f"transfer {id}: its vehicle {vehicle} is not at this station")
        return self._lines[vehicle], self._followers[vehicle]

    def _row(self, id: int) -> FileRow:
        row = self._rows.find(id)
        if row is None:
            raise MissingError(f"transfer {id}: there is none")
        return row

    def _now(self, vehicle: int) -> float:
        return self._lines[vehicle].clock.now()

    def _tell(self, row: FileRow) -> None:
        self._hub.publish(Happening("transfer", row.vehicle, self.told(row)))
        if row.state == WHOLE and row.direction == DOWNLOAD:
            for told in self.arrivals:
                told(row)
