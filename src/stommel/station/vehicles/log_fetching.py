"""Logs of one vehicle that come ashore by themselves: at each surfacing, what is aboard and not ashore yet."""

import time
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import Future

from stommel.errors import StommelError
from stommel.link.files.port import Entry
from stommel.messages.log.layout import SERIES
from stommel.messages.log.names import LogName, log_name
from stommel.station.vehicles.file_follower import MOST_OPEN, FileFollower
from stommel.station.vehicles.file_rows import CANCELLED, DOWNLOAD, FAILED, GOING, OPEN, WHOLE, FileRow, FileRows
from stommel.station.vehicles.line import VehicleLine
from stommel.station.vehicles.mission_follower import is_under_water

FOLDER = "log"
"""Of the log aboard."""
NOTHING = "nothing"
EVERY = 0.5
"""Between two looks [s]."""
AT_LEAST, AGAIN = 60.0, 1800.0
"""Between two listings, and between later ones of a vehicle that stays at the surface [s]."""
MOST_AT_ONCE = 2
"""Logs that are on their way by themselves: what people ask for finds room."""
MOST_LISTED = 5000
"""Of the newest files, that are looked at."""


class LogFetching:
    """Asks which logs are aboard when the vehicle is at the surface, and begins to fetch what is new, the newest first.

    Files of the log go behind commands, states and reports of dives, as all files do. The newest file of a series may
    still be written: it is left until it was listed twice with the same size. What a person has cancelled is not begun
    again, and while one is paused, no other is begun. What failed is tried again at the next surfacing.

    Parameters
    ----------
    wanted
        The least important series that is wanted; those that matter more come too.
    rows
        Of the archive.
    files
        Carries the transfers, and lists folders.
    tell
        Is called with each transfer that has begun.
    """

    def __init__(self, wanted: str, rows: FileRows, files: FileFollower, tell: Callable[[FileRow], None]) -> None:
        self._series = SERIES[: SERIES.index(wanted) + 1]
        self._rows, self._files, self._tell = rows, files, tell
        self._due = 0.0
        self._is_there = False
        self._listed_at = float("-inf")
        """When the vehicle was asked last, by the clock of the link [s]."""
        self._count = 0
        """Listings of this surfacing."""
        self._asked: Future[Sequence[Entry]] | None = None
        self._sizes: Mapping[LogName, int] = {}
        """As they were listed last."""
        self._queue: list[str] = []
        """Paths that are still to be begun, the next one last."""
        self._tried: set[str] = set()
        """In this surfacing."""

    def look(self, line: VehicleLine, t: float) -> None:
        """List when it is time, and begin what is due."""
        real = time.monotonic()
        if real < self._due:
            return
        self._due = real + EVERY
        was_there, self._is_there = self._is_there, line.end.is_heard(t) and not is_under_water(line)
        if not self._is_there:
            return
        if not was_there:
            self._count, self._tried = 0, set()
        self._list(line, t)
        mine = [transfer.row for transfer in self._files.transfers.values() if _is_mine(transfer.row)]
        while self._queue and self._has_room(mine):
            mine += self._begin(line, self._queue.pop())

    def _has_room(self, mine: Sequence[FileRow]) -> bool:
        """Whether another may be begun beside those that are on their way by themselves."""
        is_free = len(mine) < MOST_AT_ONCE and len(self._files.transfers) < MOST_OPEN
        return is_free and all(row.state == GOING for row in mine)

    def _list(self, line: VehicleLine, t: float) -> None:
        """Ask which logs are aboard, at the begin of a surfacing, once more soon, and then now and then."""
        if self._asked is None:
            if t - self._listed_at >= (AT_LEAST if self._count < 2 else AGAIN):
                self._listed_at, self._count = t, self._count + 1
                self._asked = self._files.list(line.end, FOLDER)
        elif self._asked.done():
            asked, self._asked = self._asked, None
            if asked.exception() is None:
                self._take(line, asked.result())

    def _take(self, line: VehicleLine, entries: Sequence[Entry]) -> None:
        """Queue what is not ashore."""
        named = {name: entry.size for entry in entries if not entry.is_folder and (name := log_name(entry.name))}
        wanted = sorted(name for name in named if name.series in self._series and not name.sent)[-MOST_LISTED:]
        last = {name.series: name for name in wanted}
        ended = [name for name in wanted if last[name.series] != name or self._sizes.get(name) == named[name]]
        known = self._rows.last_downloads(line.vehicle, [_path(name) for name in ended])
        new = [name for name in ended if self._is_new(known.get(_path(name)), _path(name), named[name])]
        new.sort(key=lambda name: (-SERIES.index(name.series), name.run, name.number))
        self._queue, self._sizes = [_path(name) for name in new], named

    def _is_new(self, known: FileRow | None, path: str, size: int) -> bool:
        if path in self._tried or size == 0:
            return False
        if known is None:
            return True
        if known.state in (*OPEN, CANCELLED):
            return False
        return known.state != WHOLE or known.size != size

    def _begin(self, line: VehicleLine, path: str) -> list[FileRow]:
        """Begin to fetch a log; nothing if that cannot be."""
        row = self._rows.add(FileRow(0, line.vehicle, path, DOWNLOAD, None, line.clock.now(), GOING))
        self._tried.add(path)
        try:
            self._files.begin(line.end, row)
        except (OSError, StommelError) as error:
            row = row._replace(state=FAILED, reason=f"not begun: {error}"[:300])
            self._rows.change(row)
        self._tell(row)
        return [row] if row.state == GOING else []


def _is_mine(row: FileRow) -> bool:
    """Whether nobody asked for a transfer."""
    return row.user is None and row.direction == DOWNLOAD


def _path(name: LogName) -> str:
    return f"{FOLDER}/{name.text}"
