"""The shore's side of MAVLink's mission protocol: waypoints sent, read back and compared; waypoints fetched."""

from enum import Enum
from math import isclose
from typing import NamedTuple

from stommel.link.endings import Ending, Progress, progress
from stommel.link.gathering import Gathering
from stommel.link.missions.items import (
    MISSION,
    MOST_WAYPOINTS,
    Item,
    ItemRefusal,
    MissionResult,
    in_degrees,
    item_in,
    item_of,
    plan_of,
    refusal_of,
    waypoints_digest,
)
from stommel.link.missions.port import WaypointPlan
from stommel.link.outbox import Outbox, Priority
from stommel.link.patience import WITHIN, Patience
from stommel.link.question import Pace, Question
from stommel.link.service import SHORE_COMPONENT, SHORE_SYSTEM, VEHICLE_COMPONENT, Received, is_for
from stommel.link.values import real, text, whole
from stommel.messages.mavlink import Fields

_MOST_TRIES = 12
"""How often the end of an upload is asked for before what is held decides."""
_BEGUN_ANEW = 40.0
"""A vehicle that is heard but asks for nothing more has forgotten the upload [s]."""
_MOST_FETCHES = 5


class WaypointOutcome(NamedTuple):
    """How an upload or a download ended."""

    ending: Ending
    words: str = ""
    """Why it was refused or has failed."""
    plan: WaypointPlan | None = None
    """What a download found."""


class _Step(Enum):
    """Steps of a request."""

    BEGIN = "whatever was under way is ended: the vehicle says how many waypoints it holds"
    OFFER = "the count of the waypoints is told"
    SERVE = "the vehicle asks for one after the other"
    END = "its acknowledgement is waited for"
    FETCH = "its waypoints are asked for"
    COMPARE = "what it holds is compared by a digest"


class _Task:
    """One request."""

    def __init__(self, t: float, within: float, pace: Pace, plan: WaypointPlan | None) -> None:
        self.began, self.patience, self.question = t, Patience(t, within), Question(pace)
        self.plan = plan
        """To be sent; None: they are fetched."""
        self.step = _Step.BEGIN
        self.served = 0
        """Items that the vehicle has asked for."""
        self.answers: list[int] = []
        """Items that it waits for."""
        self.helped = t
        self.fetched: dict[int, Item] = {}
        self.gathering: Gathering | None = None
        self.fetches = 0
        self.words: dict[str, None] = {}
        """Of a refusal, each reason once."""
        self.is_accepted = False


class WaypointClient:
    """Waypoints of one vehicle, seen from the shore.

    Parameters
    ----------
    system
        The vehicle.
    """

    def __init__(self, system: int) -> None:
        self._system = system
        self._pace = Pace()
        self._task: _Task | None = None
        self.outcome: WaypointOutcome | None = None
        """How the last request ended; None while one runs, or before the first."""

    def send(self, plan: WaypointPlan, t: float, within: float = WITHIN) -> None:
        """Send waypoints; what was under way is ended, and the vehicle holds what it held before."""
        self._task, self.outcome = _Task(t, within, self._pace, plan), None
        words = self._unsendable(plan)
        if words:
            self._end(Ending.REFUSED, words)

    def fetch(self, t: float, within: float = WITHIN) -> None:
        """Fetch the waypoints that the vehicle holds."""
        self._task, self.outcome = _Task(t, within, self._pace, None), None

    def _unsendable(self, plan: WaypointPlan) -> str:
        """Why nothing can be made of a plan."""
        if not 1 <= len(plan.waypoints) <= MOST_WAYPOINTS:
            return f"{len(plan.waypoints)} waypoints: must be between 1 and {MOST_WAYPOINTS}"
        refusals = (
            refusal_of(item_in(item_of(number, plan, None), degrees=False)) for number in range(len(plan.waypoints))
        )
        return next((refusal.words for refusal in refusals if refusal is not None), "")

    def progress(self, t: float) -> Progress:
        """How far the request has come, in waypoints."""
        task = self._task
        if task is None:
            return Progress(0, 0, None)
        if task.plan is not None:
            return progress(task.served, len(task.plan.waypoints), t - task.began)
        return progress(len(task.fetched), task.gathering.count if task.gathering else 0, t - task.began)

    # what is heard

    def take(self, received: Received, t: float) -> None:
        """Take a message; what is not of the vehicle is passed over."""
        task = self._task
        if task is None or received.system != self._system:
            return
        if task.patience.heard(t):
            task.question.again()
            task.helped = t
            if task.gathering is not None:
                task.gathering.again()
        if received.component != VEHICLE_COMPONENT or not is_for(received, SHORE_SYSTEM, SHORE_COMPONENT):
            return
        if received.values.get("mission_type", MISSION) != MISSION:
            return
        name, values = received.name, received.values
        if name == "MISSION_COUNT" and task.step is _Step.BEGIN:
            self._take_count(task, whole(values, "count"), t)
        elif name in ("MISSION_REQUEST_INT", "MISSION_REQUEST"):
            self._take_request(task, received, t)
        elif name == "WAYPOINTS_REFUSED" and task.step in (_Step.OFFER, _Step.SERVE, _Step.END):
            task.words[text(values, "words")] = None
        elif name == "MISSION_ACK" and task.step in (_Step.OFFER, _Step.SERVE, _Step.END):
            self._take_end(task, whole(values, "type"), t)
        elif name == "MISSION_ITEM_INT" and task.step is _Step.FETCH:
            self._take_item(task, values, t)
        elif name == "ORDERS_STATE" and task.step is _Step.COMPARE:
            self._compare(task, values, t)

    def _go(self, task: _Task, step: _Step, t: float) -> None:
        task.question.answered(t)
        task.patience.helped()
        task.step, task.helped = step, t

    def _take_count(self, task: _Task, count: int, t: float) -> None:
        if task.plan is not None:
            self._go(task, _Step.OFFER, t)
            return
        self._go(task, _Step.FETCH if count else _Step.COMPARE, t)
        task.fetched, task.gathering = {}, Gathering(min(count, MOST_WAYPOINTS), self._pace)
        task.fetches += 1

    def _take_request(self, task: _Task, received: Received, t: float) -> None:
        """Only the next item is given, or one that was asked for before: another request is of another upload."""
        if task.plan is None or task.step not in (_Step.OFFER, _Step.SERVE, _Step.END):
            return
        seq = whole(received.values, "seq")
        if seq > task.served or seq >= len(task.plan.waypoints):
            return
        if task.step is _Step.OFFER:
            self._go(task, _Step.SERVE, t)
        if seq == task.served:
            task.served += 1
            task.patience.helped()
        task.helped = t
        is_float = received.name == "MISSION_REQUEST"
        task.answers = [seq if not is_float else -1 - seq]
        if task.served == len(task.plan.waypoints) and task.step is _Step.SERVE:
            task.step = _Step.END
            task.question.forget()

    def _take_end(self, task: _Task, result: int, t: float) -> None:
        if task.plan is None:
            return
        if result == MissionResult.ACCEPTED:
            task.is_accepted = True
            self._go(task, _Step.COMPARE, t)
        elif task.words or result not in MissionResult.__members__.values():
            self._end(Ending.REFUSED, "; ".join(task.words) or f"the vehicle refuses it, result {result}")
        else:
            self._end(Ending.REFUSED, f"the vehicle refuses it: {MissionResult(result).name.lower().replace('_', ' ')}")

    def _take_item(self, task: _Task, values: Fields, t: float) -> None:
        seq, gathering = whole(values, "seq"), task.gathering
        assert gathering is not None
        if gathering.take(seq, t):
            task.fetched[seq] = item_in(values, degrees=False)
            task.patience.helped()
            if gathering.is_whole:
                self._go(task, _Step.COMPARE, t)

    def _compare(self, task: _Task, values: Fields, t: float) -> None:
        if task.plan is not None:
            if _agrees(task.plan, values):
                self._end(Ending.WHOLE)
            elif task.is_accepted:
                self._end(Ending.FAILED, "the vehicle holds other waypoints than those that were sent")
            else:
                self._end(Ending.FAILED, "the vehicle did not take the waypoints; it holds those that it held before")
            return
        items = [task.fetched[seq] for seq in sorted(task.fetched)]
        plan = plan_of(items) if items else WaypointPlan((), None, None)
        if isinstance(plan, ItemRefusal):
            self._end(Ending.FAILED, plan.words)
        elif _agrees(plan, values):
            self._end(Ending.WHOLE, plan=plan)
        elif task.fetches < _MOST_FETCHES:
            self._go(task, _Step.BEGIN, t)  # another mission has come in between
        else:
            self._end(Ending.FAILED, "the waypoints change faster than they are fetched")

    def _end(self, ending: Ending, words: str = "", plan: WaypointPlan | None = None) -> None:
        self._task, self.outcome = None, WaypointOutcome(ending, words, plan)

    # what is said

    def poll(self, t: float, outbox: Outbox) -> None:
        """Give what the vehicle asks for, and ask what is due."""
        task = self._task
        if task is None or outbox.room(Priority.COMMAND) < 512:
            return
        if given_up := task.patience.given_up(t):
            self._end(Ending.FAILED, given_up)
            return
        is_quiet = task.patience.is_quiet(t)
        if task.step is _Step.FETCH:
            assert task.gathering is not None
            for seq in task.gathering.due(t, is_quiet=is_quiet):
                outbox.put(Priority.COMMAND, "MISSION_REQUEST_INT", {**self._target(), "seq": seq})
            return
        self._serve(task, t, outbox)
        if task.step is not _Step.SERVE and task.question.is_due(t):
            if task.step is _Step.END and task.question.tries >= _MOST_TRIES:
                task.question.forget()
                task.step = _Step.COMPARE
            task.question.asked(t, is_quiet=is_quiet)
            self._ask(task, outbox)

    def _serve(self, task: _Task, t: float, outbox: Outbox) -> None:
        for seq in task.answers:
            self._give(task, seq, outbox)
            if task.step is _Step.END:
                task.question.asked(t)
        task.answers = []
        is_forgotten = t - task.helped > _BEGUN_ANEW and not task.patience.is_quiet(t)
        if task.step is _Step.SERVE and is_forgotten:
            task.step, task.served, task.helped = _Step.BEGIN, 0, t
            task.question.forget()

    def _give(self, task: _Task, seq: int, outbox: Outbox) -> None:
        """Say an item: as whole numbers, or below 0 the one that was asked for in degrees."""
        assert task.plan is not None
        if seq >= 0:
            outbox.put(Priority.COMMAND, "MISSION_ITEM_INT", self._target() | item_of(seq, task.plan, 0))
        else:
            outbox.put(Priority.COMMAND, "MISSION_ITEM", self._target() | in_degrees(item_of(-1 - seq, task.plan, 0)))

    def _ask(self, task: _Task, outbox: Outbox) -> None:
        if task.step is _Step.BEGIN:
            outbox.put(Priority.COMMAND, "MISSION_REQUEST_LIST", self._target())
        elif task.step is _Step.COMPARE:
            outbox.put(Priority.COMMAND, "ORDERS_STATE_REQUEST", self._target())
        elif task.step is _Step.OFFER:
            assert task.plan is not None
            outbox.put(Priority.COMMAND, "MISSION_COUNT", self._target() | {"count": len(task.plan.waypoints)})
        elif task.step is _Step.END:
            assert task.plan is not None
            self._give(task, len(task.plan.waypoints) - 1, outbox)

    def _target(self) -> Fields:
        return {"target_system": self._system, "target_component": VEHICLE_COMPONENT}


def _agrees(plan: WaypointPlan, state: Fields) -> bool:
    """Whether the vehicle holds a plan, as far as the plan says."""
    return (
        state["waypoints"] == len(plan.waypoints)
        and state["waypoints_digest"] == waypoints_digest(plan.waypoints)
        and (plan.depth is None or isclose(plan.depth, real(state, "depth"), rel_tol=1e-6))
        and (plan.radius is None or isclose(plan.radius, real(state, "radius"), rel_tol=1e-6))
    )
