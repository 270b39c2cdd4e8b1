"""The shore's side of orders files: one at a time, over as many surfacings as it takes, held against its hash."""

import hashlib
import random
from collections import deque
from typing import NamedTuple

from stommel.errors import StommelError
from stommel.link.endings import Ending, Progress, progress
from stommel.link.missions.orders_server import CHECK, DONE, NOT_HERE, ROLL_BACK, SWITCH, TAG
from stommel.link.missions.port import HeldOrders
from stommel.link.once import SESSIONS
from stommel.link.outbox import Outbox, Priority
from stommel.link.patience import WITHIN, Patience
from stommel.link.question import Pace, Question
from stommel.link.service import SHORE_COMPONENT, SHORE_SYSTEM, VEHICLE_COMPONENT, Received, is_for
from stommel.link.values import octets, text, whole
from stommel.messages.mavlink import Fields

PIECE = 160
"""Bytes of a file in one message."""
_MOST_ANEW = 5
_GONE = "orders: the vehicle has no such file any more"
_BACKLOG = 600
"""Bytes that may wait in the outbox when a piece is added."""


class OrdersOutcome(NamedTuple):
    """How a request about orders ended."""

    ending: Ending
    words: tuple[str, ...] = ()
    """Why it was refused, a sentence for each reason, or has failed."""
    held: HeldOrders | None = None
    """Which orders the vehicle holds, where it was asked for."""


class _Task:
    """One request, step by step."""

    def __init__(self, t: float, within: float, pace: Pace, action: int | None, content: bytes, sha256: bytes) -> None:
        self.began, self.patience, self.question = t, Patience(t, within), Question(pace)
        self.action = action
        """GLIDER_ORDERS_ACTION; None: which orders are held is asked for."""
        self.content, self.sha256 = content, sha256
        self.arrived = not content
        """Whether all of the file is in the vehicle."""
        self.missing = len(content)
        self.to_send: deque[tuple[int, int]] = deque()
        self.anew = 0
        """How often it had to be announced again."""
        self.number = 0
        """Of the request."""
        self.outcome: Fields | None = None
        self.problems: dict[int, str] = {}


class OrdersClient:
    """Orders of one vehicle, seen from the shore.

    Parameters
    ----------
    system
        The vehicle.
    draw
        Draws the number of this session.
    """

    def __init__(self, system: int, draw: random.Random) -> None:
        self._system, self._session = system, draw.randrange(1, SESSIONS)
        self._number = 0
        self._pace = Pace()
        self._task: _Task | None = None
        self.outcome: OrdersOutcome | None = None
        """How the last request ended; None while one runs, or before the first."""
        self.is_told = False
        """Whether the vehicle may have been told to carry out the last request."""

    # what can be asked for

    def send(self, content: bytes, t: float, within: float = WITHIN, *, only_check: bool = False) -> None:
        """Send an orders file, and let the vehicle check it; unless only that is wanted, it then holds it.

        Raises
        ------
        StommelError
            The file is empty.
        """
        if not content:
            raise StommelError("orders: the file is empty")
        sha256 = hashlib.sha256(content).digest()
        self._begin(_Task(t, within, self._pace, CHECK if only_check else SWITCH, content, sha256))

    def roll_back(self, sha256: bytes, t: float, within: float = WITHIN) -> None:
        """Let the vehicle hold the orders before again, which have this SHA-256."""
        self._begin(_Task(t, within, self._pace, ROLL_BACK, b"", sha256))

    def ask(self, t: float, within: float = WITHIN) -> None:
        """Ask which orders are held."""
        self._begin(_Task(t, within, self._pace, None, b"", b""))

    def _begin(self, task: _Task) -> None:
        self._number += 1
        task.number = self._number
        self._task, self.outcome, self.is_told = task, None, False

    def drop(self) -> None:
        """Forget the request that runs; what the vehicle was told already, it may carry out all the same."""
        self._task = None

    def progress(self, t: float) -> Progress:
        """How far the sending of a file has come, in bytes."""
        task = self._task
        if task is None:
            return Progress(0, 0, None)
        size = len(task.content)
        return progress(size - task.missing, size, t - task.began)

    # the service

    def take(self, received: Received, t: float) -> None:
        """Take a message; what is not of the vehicle is passed over."""
        task = self._task
        if task is None or received.system != self._system:
            return
        if task.patience.heard(t):
            task.question.again()
        values = received.values
        if not is_for(received, SHORE_SYSTEM, SHORE_COMPONENT):
            return
        if received.name == "ORDERS_MISSING" and values["file"] == task.sha256[:TAG] and not task.arrived:
            self._take_missing(task, values, t)
        elif received.name in ("ORDERS_OUTCOME", "ORDERS_PROBLEM"):
            if (values["session"], values["number"]) == (self._session, task.number):
                self._take_outcome(task, received, t)
        elif received.name == "ORDERS_STATE" and task.action is None:
            self._end(OrdersOutcome(Ending.WHOLE, (), _held(values)), t)

    def _take_missing(self, task: _Task, values: Fields, t: float) -> None:
        if task.to_send or not task.question.tries:
            return  # late: what is on its way is not missing
        if values["refused"]:
            self._end(OrdersOutcome(Ending.REFUSED, (text(values, "words"),)), t)
            return
        task.question.answered(t)
        missing = whole(values, "missing")
        if missing != task.missing:
            task.patience.helped()
        task.missing, task.arrived = missing, missing == 0
        for first, end in _ranges(values):
            for offset in range(first, min(end, len(task.content)), PIECE):
                task.to_send.append((offset, min(offset + PIECE, end, len(task.content))))

    def _take_outcome(self, task: _Task, received: Received, t: float) -> None:
        values = received.values
        task.patience.helped()
        if received.name == "ORDERS_OUTCOME":
            task.outcome = values
        else:
            task.problems[whole(values, "index")] = text(values, "words")
        told = task.outcome
        if told is None:
            return
        if told["accepted"] == NOT_HERE and task.content and task.anew < _MOST_ANEW:
            self._anew(task)
        elif told["accepted"] != DONE:
            if len(task.problems) >= whole(told, "problems"):
                words = tuple(task.problems[index] for index in sorted(task.problems)) or (_GONE,)
                self._end(OrdersOutcome(Ending.REFUSED, words), t)
        elif task.action != CHECK and told["held"] != task.sha256:
            self._end(OrdersOutcome(Ending.FAILED, ("the vehicle holds other orders than those that were sent",)), t)
        else:
            self._end(OrdersOutcome(Ending.WHOLE), t)

    def _anew(self, task: _Task) -> None:
        """Announce the file again: the vehicle has started anew, or was given another meanwhile."""
        self._number += 1
        task.number, task.outcome, task.problems = self._number, None, {}
        task.arrived = False
        task.anew += 1
        task.question.forget()

    def _end(self, outcome: OrdersOutcome, t: float) -> None:
        if self._task is not None:
            self._task.question.answered(t)
        self._task, self.outcome = None, outcome

    def poll(self, t: float, outbox: Outbox) -> None:
        """Send a piece, or ask what is due."""
        task = self._task
        if task is None:
            return
        if given_up := task.patience.given_up(t):
            task.question.forget()
            self._end(OrdersOutcome(Ending.FAILED, (given_up,)), t)
            return
        is_quiet = task.patience.is_quiet(t)
        if is_quiet:
            task.to_send.clear()  # what has arrived, the vehicle will say when it is heard again
        if task.to_send:
            self._send_piece(task, outbox)
        elif task.question.is_due(t) and outbox.waiting < _BACKLOG:
            task.question.asked(t, is_quiet=is_quiet)
            self._ask(task, outbox)

    def _send_piece(self, task: _Task, outbox: Outbox) -> None:
        if outbox.waiting >= _BACKLOG or outbox.room(Priority.DATA) < 256:
            return
        first, end = task.to_send.popleft()
        told: Fields = {
            **self._target(), "file": task.sha256[:TAG], "offset": first, "length": end - first,
            "data": task.content[first:end],
        }  # fmt: skip
        outbox.put(Priority.DATA, "ORDERS_PIECE", told)

    def _ask(self, task: _Task, outbox: Outbox) -> None:
        if task.action is None:
            outbox.put(Priority.COMMAND, "ORDERS_STATE_REQUEST", self._target())
        elif not task.arrived:
            # behind the pieces, so that what is on its way is not said to be missing
            told: Fields = {**self._target(), "size": len(task.content), "sha256": task.sha256}
            outbox.put(Priority.DATA, "ORDERS_ANNOUNCE", told)
        else:
            self.is_told = True
            told = {
                **self._target(), "session": self._session, "number": task.number, "action": task.action,
                "sha256": task.sha256,
            }  # fmt: skip
            outbox.put(Priority.COMMAND, "ORDERS_REQUEST", told)

    def _target(self) -> Fields:
        return {"target_system": self._system, "target_component": VEHICLE_COMPONENT}


def _ranges(values: Fields) -> list[tuple[int, int]]:
    firsts, ends = values["first"], values["end"]
    assert isinstance(firsts, tuple)
    assert isinstance(ends, tuple)
    pairs = [(int(first), int(end)) for first, end in zip(firsts, ends, strict=True)]
    return pairs[: whole(values, "ranges")]


def _held(values: Fields) -> HeldOrders:
    held, previous = (value if any(value) else b"" for value in (octets(values, "held"), octets(values, "previous")))
    return HeldOrders(whole(values, "mission"), text(values, "name"), held, previous)
