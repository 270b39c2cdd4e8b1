"""Brings missions to one vehicle, one at a time, and knows which one it holds."""

import time
from collections import deque
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from stommel.archive import ArchiveError
from stommel.link.endings import Ending, Progress
from stommel.link.missions.orders_client import OrdersOutcome
from stommel.link.missions.port import HeldOrders
from stommel.messages.mavlink import enumeration
from stommel.station.vehicles.line import VehicleLine
from stommel.station.vehicles.mission_fetch import MissionFetch
from stommel.station.vehicles.mission_rows import (
    ABOARD,
    CANCELLED,
    EXPIRED,
    FAILED,
    INTERRUPTED,
    OPEN,
    REFUSED,
    REPLACED,
    SENDING,
    SUPERSEDED,
    WAITING,
    MissionRow,
    MissionRows,
    MissionState,
)
from stommel.station.vehicles.mission_task import HAS_NOT, MAYBE, EndedTask, Task
from stommel.station.vehicles.missions_left import HELD_BEFORE, Left

EVERY = 0.2
"""Between two looks [s]."""
WAITS = "waits until the vehicle is heard at the surface"
NOT_KEPT = "not sent: the archive had not said that it keeps it"
GOES_ON = "goes on: the archive had not said that it keeps what should have ended it"
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


class MissionFollower:
    """Everything of it happens in the line's thread, but for reading `held`, `words`, `open` and `underway`.

    Parameters
    ----------
    rows
        Of the archive.
    folder
        Of the vehicle, for orders that are fetched from it.
    tell
        Is called when a mission has changed.
    left
        What was not over when the station stopped.
    """

    def __init__(self, rows: MissionRows, folder: Path, tell: Callable[[int, int | None], None], left: Left) -> None:
        self._rows, self._tell = rows, tell
        self._fetch = MissionFetch(folder)
        self._due = 0.0
        self._queue: deque[Task] = deque([] if left.task is None else [left.task])
        self.current: Task | None = None
        self.underway: tuple[Task | None, Progress | None] = None, None
        """The request that is on its way, and of an upload how far it is [bytes], when the line looked last."""
        self.open: tuple[Task, ...] = ()
        """Requests of people that are not over, the one that is on its way first."""
        self._ended: deque[EndedTask] = deque(left.ended)
        """Not written yet."""
        self._is_doubtful = False
        """Whether the archive may have something that it has not said that it keeps."""
        self.held: HeldOrders | None = None
        """What the vehicle said that it holds; None before."""
        self.held_at = 0.0
        """When that was, by the vehicle's clock [s since 1970]."""
        self.words = "the vehicle has not been asked yet"
        """Why it is not known which orders it holds, or what the last request came to."""
        self._again_at = float("-inf")
        """When what was refused under water is tried again [s]."""
        self._asked_for: object = ()
        """Number of the mission that the vehicle told when it was asked last; () before."""
        self._note_open()

    @property
    def waiting(self) -> int:
        """Requests that are not over."""
        return len(self._queue) + (self.current is not None)

    # what is asked for

    def put(self, line: VehicleLine, task: Task, t: float, preview: Mapping[str, Any] | None = None) -> Task:
        """Take a request of a person in place of all before it, so that nobody flies what was corrected meanwhile.

        Returns it, with the number of its mission in the archive.

        Raises
        ------
        ArchiveError
            It cannot be written; those before it go on.
        """
        task.until = t + task.within
        now, before = line.clock.now(), f"{task.title} of {task.user} came in its place"
        ended = [
            EndedTask(other, SUPERSEDED, f"{before}; {self._truth(line, other)}", task.user, now)
            for other in self._of_people(line)
        ]
        states = {each.task.row.id: each.as_state for each in ended if each.task.row is not None}
        with self._in_doubt():
            if task.row is None:
                self._rows.change_all(states)
            else:  # one transaction: a station that is killed here goes on with the one or with the other
                task.row = self._rows.add(task.row._replace(until=task.until), WAITS, preview, states)
        for each in ended:
            self._let_go(line, each.task)
            self._tell_ended(line, each)
        self._queue.append(task)
        self._note_open()
        if task.row is not None:
            self._tell(line.vehicle, task.row.id)
        return task

    def take_back(self, line: VehicleLine, wanted: Callable[[Task], bool], user: str) -> bool:
        """Take a request back; whether there was one that is not over.

        Raises
        ------
        ArchiveError
            It cannot be written; the request goes on.
        """
        task = next((each for each in self._of_people(line) if wanted(each)), None)
        if task is None:
            return False
        words = f"taken back by {user}; {self._truth(line, task)}"
        with self._in_doubt():
            self._write(line, EndedTask(task, CANCELLED, words, user, line.clock.now()))
        self._let_go(line, task)
        self._note_open()
        return True

    def _of_people(self, line: VehicleLine) -> list[Task]:
        """Requests that can still be taken back; one that the vehicle has answered is over, also if not written yet."""
        is_answered = line.end.orders.outcome is not None
        going = [] if self.current is None or is_answered else [self.current]
        return [each for each in (*going, *self._queue) if each.is_of_people]

    def _truth(self, line: VehicleLine, task: Task) -> str:
        """What is known of the vehicle when a request ends before its answer."""
        is_told = task is self.current and line.end.orders.is_told
        return MAYBE if is_told or task.may_be_aboard else HAS_NOT

    def _let_go(self, line: VehicleLine, task: Task) -> None:
        if task is not self.current:
            self._queue.remove(task)
            return
        line.end.orders.drop()
        self.current = None
        if line.end.orders.is_told:
            self._queue.appendleft(Task("ask"))

    def _write(self, line: VehicleLine, ended: EndedTask) -> None:
        """Write what became of a request, and tell it."""
        if ended.task.row is not None:
            self._rows.change(ended.task.row.id, ended.state, ended.words, ended.t, ended.user)
        self._tell_ended(line, ended)

    def _tell_ended(self, line: VehicleLine, ended: EndedTask) -> None:
        row = ended.task.row
        if row is None:
            self.words = f"not rolled back: {ended.words}"
        self._tell(line.vehicle, None if row is None else row.id)

    def _note_open(self) -> None:
        self.open = tuple(each for each in (self.current, *self._queue) if each is not None and each.is_of_people)

    # what goes on

    def look(self, line: VehicleLine, t: float) -> None:
        """Go on."""
        real = time.monotonic()
        if real < self._due:
            return
        self._due = real + EVERY
        if self._is_doubtful:
            self._clear_doubt(line)
        while self._ended:
            self._write(line, self._ended[0])
            self._ended.popleft()
        if self.current is not None and (outcome := line.end.orders.outcome) is not None:
            self._finish(line, self.current, outcome, t)
            self.current = None  # not before the archive has it
        self._expire(line, t)
        if self.current is None and not self._queue and line.end.is_heard(t):
            self._ask_if_new(line)
        if self.current is None and self._queue and not self._waits(line, self._queue[0], t):
            self._begin(line, self._queue[0], t)
        self._look_at_fetch(line)
        is_upload = self.current is not None and self.current.row is not None
        self._note_open()
        self.underway = self.current, line.end.orders.progress(t) if is_upload else None

    @contextmanager
    def _in_doubt(self) -> Iterator[None]:
        """What is written here may be kept although the archive does not say so."""
        try:
            yield
        except ArchiveError:
            self._is_doubtful = True
            raise

    def _clear_doubt(self, line: VehicleLine) -> None:
        """Let the archive say of missions what is so, whatever it has kept of a request that was told as not kept."""
        now, tasks = line.clock.now(), (self.current, *self._queue)
        mine = {task.row.id: task for task in tasks if task is not None and task.row is not None}
        strays = [row.id for row in self._rows.in_states(line.vehicle, *OPEN) if row.id not in mine]
        states = {id: MissionState(now, None, FAILED, NOT_KEPT) for id in strays}
        for id, task in mine.items():
            is_on_its_way = task is self.current or task.may_be_aboard
            states[id] = MissionState(now, None, SENDING if is_on_its_way else WAITING, GOES_ON)
        self._rows.change_all(states)
        self._is_doubtful = False
        for id in states:
            self._tell(line.vehicle, id)

    def _ask_if_new(self, line: VehicleLine) -> None:
        """Ask what is held when the vehicle is first heard, and when it tells another mission."""
        said = line.end.heard.last.get("GLIDER_STATE")
        number = None if said is None else said.values["mission"]
        if number != self._asked_for:
            self._asked_for = number
            self._queue.append(Task("ask"))

    def _expire(self, line: VehicleLine, t: float) -> None:
        """End what waits for longer than it may."""
        for task in [each for each in self._queue if t >= each.until]:
            words = f"its time was over; {self._truth(line, task)}"
            self._write(line, EndedTask(task, EXPIRED, words, None, line.clock.now()))
            self._queue.remove(task)

    def _waits(self, line: VehicleLine, task: Task, t: float) -> bool:
        """Whether a request rests until the vehicle, which takes no other mission under water, is at the surface."""
        return task.is_of_people and (t < self._again_at or not line.end.is_heard(t) or is_under_water(line))

    def _begin(self, line: VehicleLine, task: Task, t: float) -> None:
        if task.may_be_aboard:
            task = Task("ask")
            self._queue.appendleft(task)
        orders = line.end.orders
        within = min(task.within, task.until - t)
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
        if outcome.ending is Ending.REFUSED and words.endswith(UNDER_WATER) and t < task.until:
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
                if state == FAILED and t >= task.until:
                    state, words = EXPIRED, f"its time was over; {MAYBE if line.end.orders.is_told else HAS_NOT}"
                self._write(line, EndedTask(task, state, words, None, now))
        elif outcome.ending is not Ending.WHOLE:
            self.words = f"not rolled back: {words}"
            self._tell(line.vehicle, None)
        self._queue.appendleft(Task("ask"))

    def _take_held(self, line: VehicleLine, held: HeldOrders, now: float) -> None:
        """Note which orders the vehicle holds; fetch them if nobody here has seen them."""
        self.held, self.held_at, self.words = held, now, ""
        left = self._settle_left(line, held, now)
        if held.sha256:
            row = left or self._rows.of_hash(line.vehicle, held.sha256.hex())
            if row is not None:
                self._be_aboard(line, row, now, "the vehicle says that it holds it")
            else:
                self._fetch.want(line.end, held.sha256)
        self._tell(line.vehicle, None)

    def _settle_left(self, line: VehicleLine, held: HeldOrders, now: float) -> MissionRow | None:
        """End what was on its way when the station stopped, if the vehicle has, or had, switched to it.

        Returns the mission if the vehicle holds it; if it never came to hold it, it is sent.
        """
        task = next((each for each in self._queue if each.may_be_aboard), None)
        if task is None or task.row is None:
            return None
        sha256 = bytes.fromhex(task.row.sha256)
        if sha256 == held.sha256:
            self._be_aboard(line, task.row, now, "the vehicle says that it holds it")
        elif sha256 == held.previous:
            self._write(line, EndedTask(task, INTERRUPTED, HELD_BEFORE, None, now))
        else:
            task.may_be_aboard = False
            return None
        self._queue.remove(task)
        return task.row if sha256 == held.sha256 else None

    def _be_aboard(self, line: VehicleLine, row: MissionRow, now: float, words: str) -> None:
        for other in self._rows.in_states(line.vehicle, ABOARD):
            if other.id != row.id:
                self._rows.change(other.id, REPLACED, "the vehicle holds another one", now)
        self._rows.change(row.id, ABOARD, words, now)
        self._tell(line.vehicle, row.id)

    def _look_at_fetch(self, line: VehicleLine) -> None:
        came = self._fetch.look()
        if came is None:
            return
        if came.reason:
            self.words = f"its orders could not be fetched: {came.reason}"
        else:
            self._keep_fetched(line, came.content, came.sha256)
        self._fetch.done(line.end)

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
