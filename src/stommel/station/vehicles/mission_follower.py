"""Brings missions to one vehicle, one at a time, and knows which one it holds."""

import hashlib
import time
from collections import deque
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

from stommel.link.endings import Ending, Progress
from stommel.link.files.download import Download
from stommel.link.files.folder_disk import FolderDisk
from stommel.link.files.progress import State
from stommel.link.missions.orders_client import OrdersOutcome
from stommel.link.missions.port import HeldOrders
from stommel.messages.mavlink import enumeration
from stommel.station.vehicles.line import VehicleLine
from stommel.station.vehicles.mission_rows import (
    ABOARD,
    FAILED,
    INTERRUPTED,
    REFUSED,
    REPLACED,
    SENDING,
    WAITING,
    MissionRow,
    MissionRows,
)

EVERY = 0.2
"""Between two looks [s]."""
ASK_WITHIN = 600.0
"""Time within which the vehicle says which orders it holds [s]."""
MOST_WAITING = 10
LOCAL = "active.orders"
ABOARD_PATH = "missions/active.orders"
STOPPED = "the station stopped while it was on its way; what is aboard is old or new, whole: look, and send it again"


AGAIN = 10.0
"""Between two tries of what was refused under water [s]."""
UNDER_WATER = "send it at the surface"
"""How the vehicle refuses a mission under water."""
_PHASES = frozenset(
    enumeration("GLIDER_PHASE")[f"GLIDER_PHASE_{name}"] for name in ("DESCENT", "INFLECTION", "ASCENT", "DRIFT")
)


def is_under_water(line: VehicleLine) -> bool:
    """Whether the vehicle has told last that it dives."""
    said = line.end.heard.last.get("GLIDER_STATE")
    return said is not None and said.values["phase"] in _PHASES


@dataclass
class Task:
    """One request to the vehicle."""

    kind: str
    """ask, upload or roll-back."""
    user: str | None = None
    row: MissionRow | None = None
    """Of an upload."""
    within: float = ASK_WITHIN
    until: float | None = None
    """When its time is over, by the clock of the link [s]; set when it is first looked at."""


class MissionFollower:
    """Everything of it happens in the line's thread, but for reading `held`, `words` and `underway`.

    Parameters
    ----------
    rows
        Of the archive.
    folder
        Of the vehicle, for orders that are fetched from it.
    tell
        Is called when a mission has changed.
    left
        Missions that were on their way when the station stopped; they are told as interrupted.
    """

    def __init__(
        self, rows: MissionRows, folder: Path, tell: Callable[[int, int | None], None], left: Sequence[MissionRow]
    ) -> None:
        self._rows, self._folder, self._tell = rows, folder, tell
        self._due = 0.0
        self._queue: deque[Task] = deque()
        self.current: Task | None = None
        self.underway: tuple[Task | None, Progress | None] = None, None
        """The request that is on its way, and of an upload how far it is [bytes], when the line looked last."""
        self.held: HeldOrders | None = None
        """What the vehicle said that it holds; None before."""
        self.held_at = 0.0
        """When that was, by the vehicle's clock [s since 1970]."""
        self.words = "the vehicle has not been asked yet"
        """Why it is not known which orders it holds, or what the last request came to."""
        self._left = list(left)
        self._again_at = float("-inf")
        """When what was refused under water is tried again [s]."""
        self._asked_for: object = ()
        """Number of the mission that the vehicle told when it was asked last; () before."""
        self._fetch: tuple[Download, FolderDisk, bytes] | None = None
        self._vain: bytes = b""
        """Hash of orders that could not be fetched."""

    @property
    def waiting(self) -> int:
        """Requests that are not over."""
        return len(self._queue) + (self.current is not None)

    def put(self, task: Task) -> None:
        """Take a request."""
        self._queue.append(task)

    def look(self, line: VehicleLine, t: float) -> None:
        """Go on."""
        real = time.monotonic()
        if real < self._due:
            return
        self._due = real + EVERY
        while self._left:
            self._rows.change(self._left[-1].id, INTERRUPTED, STOPPED, line.clock.now())
            self._left.pop()
        if self.current is not None and (outcome := line.end.orders.outcome) is not None:
            self._finish(line, self.current, outcome, t)
            self.current = None  # not before the archive has it
        if self.current is None and not self._queue and line.end.is_heard(t):
            self._ask_if_new(line)
        if self.current is None and self._queue and not self._waits(line, self._queue[0], t):
            self._begin(line, self._queue[0], t)
        self._look_at_fetch(line)
        is_upload = self.current is not None and self.current.row is not None
        self.underway = self.current, line.end.orders.progress(t) if is_upload else None

    def _ask_if_new(self, line: VehicleLine) -> None:
        """Ask what is held when the vehicle is first heard, and when it tells another mission."""
        said = line.end.heard.last.get("GLIDER_STATE")
        number = None if said is None else said.values["mission"]
        if number != self._asked_for:
            self._asked_for = number
            self._queue.append(Task("ask"))

    def _waits(self, line: VehicleLine, task: Task, t: float) -> bool:
        """Whether a request rests until the vehicle, which takes no other mission under water, is at the surface."""
        task.until = t + task.within if task.until is None else task.until
        if task.kind == "ask" or t >= task.until:
            return False
        return t < self._again_at or is_under_water(line)

    def _begin(self, line: VehicleLine, task: Task, t: float) -> None:
        orders = line.end.orders
        within = task.within if task.until is None else max(task.until - t, 1.0)
        if task.kind == "roll-back" and (self.held is None or not self.held.previous):
            self._queue.popleft()
            self.words = "the vehicle holds no orders before the present ones"
            self._tell(line.vehicle, None)
            return
        if task.row is not None:
            self._rows.change(task.row.id, SENDING, "on its way", line.clock.now())
            orders.send(task.row.orders.encode(), t, within)
        elif task.kind == "roll-back":
            assert self.held is not None
            orders.roll_back(self.held.previous, t, within)
        else:
            orders.ask(t, within)
        self.current = self._queue.popleft()
        if task.row is not None:
            self._tell(line.vehicle, task.row.id)

    def _finish(self, line: VehicleLine, task: Task, outcome: OrdersOutcome, t: float) -> None:
        """Write what a request came to; done again as a whole if the archive fails in its middle."""
        now, words = line.clock.now(), "; ".join(outcome.words)
        if task.kind == "ask":
            if outcome.held is not None:
                self._take_held(line, outcome.held, now)
            else:
                self.words, self._asked_for = words, ()
            return
        if outcome.ending is Ending.REFUSED and words.endswith(UNDER_WATER) and t < (task.until or t):
            if task.row is not None:
                self._rows.change(task.row.id, WAITING, "the vehicle is under water; sent at the surface", now)
                self._tell(line.vehicle, task.row.id)
            self._again_at = t + AGAIN
            self._queue.appendleft(task)
            return
        if task.row is not None:
            if outcome.ending is Ending.WHOLE:
                self._be_aboard(line, task.row, now, "taken by the vehicle, whole")
                if self.held is not None:  # orders before, still being fetched, are not aboard any more
                    new = bytes.fromhex(task.row.sha256)
                    self.held = self.held._replace(name=task.row.name, sha256=new, previous=self.held.sha256)
            else:
                state = REFUSED if outcome.ending is Ending.REFUSED else FAILED
                self._rows.change(task.row.id, state, words, now)
                self._tell(line.vehicle, task.row.id)
        elif outcome.ending is not Ending.WHOLE:
            self.words = f"not rolled back: {words}"
            self._tell(line.vehicle, None)
        self._queue.appendleft(Task("ask"))

    def _take_held(self, line: VehicleLine, held: HeldOrders, now: float) -> None:
        """Note which orders the vehicle holds; fetch them if nobody here has seen them."""
        self.held, self.held_at, self.words = held, now, ""
        if held.sha256:
            row = self._rows.of_hash(line.vehicle, held.sha256.hex())
            if row is not None:
                self._be_aboard(line, row, now, "the vehicle says that it holds it")
            elif self._fetch is None and held.sha256 != self._vain:
                disk = FolderDisk(self._folder)
                self._fetch = line.end.download(ABOARD_PATH, disk, LOCAL), disk, held.sha256
        self._tell(line.vehicle, None)

    def _be_aboard(self, line: VehicleLine, row: MissionRow, now: float, words: str) -> None:
        for other in self._rows.in_states(line.vehicle, ABOARD):
            if other.id != row.id:
                self._rows.change(other.id, REPLACED, "the vehicle holds another one", now)
        self._rows.change(row.id, ABOARD, words, now)
        self._tell(line.vehicle, row.id)

    def _look_at_fetch(self, line: VehicleLine) -> None:
        if self._fetch is None or not self._fetch[0].state.is_over:
            return
        download, disk, sha256 = self._fetch
        content = self._fetched(download)
        if hashlib.sha256(content).digest() == sha256:
            self._keep_fetched(line, content, sha256)
        else:
            self._vain = sha256
            self.words = f"its orders could not be fetched: {download.reason or 'they have changed meanwhile'}"
        self._fetch = None
        line.end.drop(download)
        for left in disk.sizes():
            disk.remove(left)
        disk.close()

    def _fetched(self, download: Download) -> bytes:
        """What was fetched; nothing if it did not come whole."""
        name = (download.file.kept_as if download.file is not None else None) or LOCAL
        try:
            return (self._folder / name).read_bytes() if download.state is State.WHOLE else b""
        except OSError:
            return b""

    def _keep_fetched(self, line: VehicleLine, content: bytes, sha256: bytes) -> None:
        """Write down orders that were found aboard."""
        held = self.held.name if self.held is not None else ""
        row = MissionRow(
            0, line.vehicle, line.clock.now(), None, held, sha256.hex(), content.decode("utf-8", "replace"), None,
            REPLACED,
        )  # fmt: skip
        kept = self._rows.of_hash(line.vehicle, row.sha256) or self._rows.add(row, "found aboard")
        if self.held is not None and self.held.sha256 == sha256:
            self._be_aboard(line, kept, line.clock.now(), "found aboard")
