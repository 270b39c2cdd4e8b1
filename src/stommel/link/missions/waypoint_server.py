"""The vehicle's side of MAVLink's mission protocol: items are staged, made into orders, and switched over as one."""

from collections import deque
from collections.abc import Callable
from typing import NamedTuple

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
)
from stommel.link.missions.port import WaypointPort, WaypointProgress, WaypointRefusal
from stommel.link.outbox import Outbox, Priority
from stommel.link.question import Pace, Question
from stommel.link.service import Received, is_for
from stommel.link.values import whole
from stommel.link.words import fitted
from stommel.messages.mavlink import Fields

GIVEN_UP_AFTER = 120.0
"""An upload of which nothing more comes ends after this time [s]; the mission stays as it was."""
CURRENT_EVERY = 5.0
"""Between two MISSION_CURRENT [s]."""
_LOOKS_EVERY = 1.0
"""Between two looks at how far the vehicle has come [s]."""
_ANSWERED_AGAIN = 300.0
"""How long the end of an upload is told again to one who did not hear it [s]."""
_MOST_ANSWERS = 64
_WHOLE = 0xFFFF
"""Number of the item in a refusal of the whole."""


class _Upload:
    """Items that are being received."""

    def __init__(self, sender: tuple[int, int], count: int, pace: Pace, t: float) -> None:
        self.sender, self.count = sender, count
        self.items: list[Item] = []
        self.question = Question(pace)
        self.helped = t


class _Ended(NamedTuple):
    """How the last upload ended."""

    sender: tuple[int, int]
    items: int
    """How many it had."""
    refusal: ItemRefusal | None
    item: int
    t: float


class WaypointServer:
    """Takes and gives the waypoints of a vehicle.

    Parameters
    ----------
    system, component
        The vehicle's coordination software.
    port
        Where its waypoints are kept.
    tell
        Says in words why waypoints were refused, to software that knows no WAYPOINTS_REFUSED.
    """

    def __init__(
        self, system: int, component: int, port: WaypointPort, tell: Callable[[str], None] = lambda _: None
    ) -> None:
        self._system, self._component, self._port, self._tell_words = system, component, port, tell
        self._pace = Pace()
        self._upload: _Upload | None = None
        self._ended: _Ended | None = None
        self._answers: deque[tuple[str, Fields]] = deque(maxlen=_MOST_ANSWERS)
        self._told = WaypointProgress(None)
        self._tell_at = self._look_at = 0.0
        self._takes = {
            "MISSION_COUNT": self._count,
            "MISSION_ITEM_INT": self._item,
            "MISSION_ITEM": self._item,
            "MISSION_ACK": self._ack,
            "MISSION_REQUEST_LIST": self._list,
            "MISSION_REQUEST_INT": self._request,
            "MISSION_REQUEST": self._request,
            "MISSION_CLEAR_ALL": self._clear,
            "MISSION_SET_CURRENT": self._aim,
        }

    @property
    def is_receiving(self) -> bool:
        """Whether an upload is under way."""
        return self._upload is not None

    def take(self, received: Received, t: float) -> None:
        """Take a message; what is of no mission of this vehicle is passed over."""
        take = self._takes.get(received.name)
        if take is None or not is_for(received, self._system, self._component):
            return
        kind = whole(received.values, "mission_type") if "mission_type" in received.values else MISSION
        if kind == MISSION:
            take(received, t)
        elif received.name == "MISSION_REQUEST_LIST":
            self._answer(received, "MISSION_COUNT", count=0, mission_type=kind)
        elif received.name in ("MISSION_COUNT", "MISSION_CLEAR_ALL"):
            self._answer(received, "MISSION_ACK", type=int(MissionResult.UNSUPPORTED), mission_type=kind)

    def _answer(self, received: Received, name: str, **values: int) -> None:
        to: Fields = {"target_system": received.system, "target_component": received.component}
        self._answers.append((name, {**to, **values}))

    # a mission comes

    def _count(self, received: Received, t: float) -> None:
        sender, count = (received.system, received.component), whole(received.values, "count")
        upload = self._upload
        if upload is not None and upload.sender != sender:
            self._refuse(received, MissionResult.DENIED, "another station is sending a mission")
        elif upload is not None and upload.count == count and not upload.items:
            upload.question.again()
        elif count == 0:
            self._clear(received, t)
        elif count > MOST_WAYPOINTS:
            words = f"count = {count}: must be at most {MOST_WAYPOINTS} waypoints"
            self._refuse(received, MissionResult.NO_SPACE, words)
        else:
            self._upload, self._ended = _Upload(sender, count, self._pace, t), None

    def _item(self, received: Received, t: float) -> None:
        upload, sender = self._upload, (received.system, received.component)
        seq = whole(received.values, "seq")
        if upload is None:
            self._end_again(received, sender, seq, t)
            return
        if sender != upload.sender or seq != len(upload.items) or not upload.question.tries:
            return  # late, or not what was asked for
        item = item_in(received.values, degrees=received.name == "MISSION_ITEM")
        refusal = refusal_of(item)
        if refusal is not None:
            self._end(received, t, refusal, seq)
            return
        upload.question.answered(t)
        upload.items.append(item)
        upload.helped = t
        if len(upload.items) == upload.count:
            self._finish(received, upload, t)

    def _finish(self, received: Received, upload: _Upload, t: float) -> None:
        """Make orders of the items, and say what became of them."""
        plan = plan_of(upload.items)
        if isinstance(plan, ItemRefusal):
            self._end(received, t, plan, _WHOLE)
            return
        refusals = self._port.take_plan(plan)
        told = [_as_item(refusal) for refusal in refusals]
        for item, words in told[1:]:
            self._tell(received, MissionResult.INVALID, words, item)
        if told:
            item, words = told[0]
            self._end(received, t, ItemRefusal(MissionResult.INVALID, words), item)
        else:
            self._end(received, t)

    def _end(self, received: Received, t: float, refusal: ItemRefusal | None = None, item: int = _WHOLE) -> None:
        upload = self._upload
        assert upload is not None
        self._upload, self._ended = None, _Ended(upload.sender, upload.count, refusal, item, t)
        self._tell_end(received, self._ended)

    def _tell_end(self, received: Received, ended: _Ended) -> None:
        if ended.refusal is None:
            self._answer(received, "MISSION_ACK", type=int(MissionResult.ACCEPTED))
        else:
            self._refuse(received, ended.refusal.result, ended.refusal.words, ended.item)

    def _end_again(self, received: Received, sender: tuple[int, int], seq: int, t: float) -> None:
        """Tell the end of an upload again: its acknowledgement was lost."""
        ended = self._ended
        if ended is None or ended.sender != sender or t - ended.t >= _ANSWERED_AGAIN:
            return
        if ended.refusal is not None or seq == ended.items - 1:
            self._tell_end(received, ended)

    def _refuse(self, received: Received, result: MissionResult, words: str, item: int = _WHOLE) -> None:
        # the reason goes first: whoever waits for the acknowledgement has it then
        self._tell(received, result, words, item)
        self._answer(received, "MISSION_ACK", type=int(result))

    def _tell(self, received: Received, result: MissionResult, words: str, item: int) -> None:
        to: Fields = {"target_system": received.system, "target_component": received.component}
        told: Fields = {**to, "seq": item, "type": int(result), "words": fitted(words, 200)}
        self._answers.append(("WAYPOINTS_REFUSED", told))
        self._tell_words(f"waypoints refused: {words}")

    def _ack(self, received: Received, t: float) -> None:  # noqa: ARG002 - as the others
        """A station ends its upload, or a download; of that nothing is kept here."""
        upload = self._upload
        if upload is not None and upload.sender == (received.system, received.component):
            self._upload = None

    def _clear(self, received: Received, t: float) -> None:  # noqa: ARG002 - as the others
        """A vehicle under orders cannot be without waypoints by half: the mission is replaced or rolled back."""
        self._refuse(received, MissionResult.DENIED, "a mission is not cleared over the radio: send another, or hold")

    # what is held is asked for

    def _list(self, received: Received, t: float) -> None:  # noqa: ARG002 - as the others
        """The station begins anew, whatever it was sending."""
        upload = self._upload
        if upload is not None and upload.sender == (received.system, received.component):
            self._upload = None
        plan = self._port.plan()
        self._answer(received, "MISSION_COUNT", count=0 if plan is None else len(plan.waypoints))

    def _request(self, received: Received, t: float) -> None:  # noqa: ARG002 - as the others
        plan, seq = self._port.plan(), whole(received.values, "seq")
        if plan is None or seq >= len(plan.waypoints):
            self._answer(received, "MISSION_ACK", type=int(MissionResult.INVALID_SEQUENCE))
            return
        to: Fields = {"target_system": received.system, "target_component": received.component}
        item = to | item_of(seq, plan, self._port.progress().current)
        if received.name == "MISSION_REQUEST":
            self._answers.append(("MISSION_ITEM", in_degrees(item)))
        else:
            self._answers.append(("MISSION_ITEM_INT", item))

    def _aim(self, received: Received, t: float) -> None:
        words = self._port.aim_at(whole(received.values, "seq"))
        if words:
            self._refuse(received, MissionResult.INVALID_SEQUENCE, words)
        self._tell_at = self._look_at = t

    # what is said

    def poll(self, t: float, outbox: Outbox) -> None:
        """Say answers, ask for the next item of an upload, tell how far the vehicle has come."""
        while self._answers and outbox.room(Priority.COMMAND) >= 256:
            name, values = self._answers.popleft()
            outbox.put(Priority.COMMAND, name, values)
        self._ask(t, outbox)
        self._tell_progress(t, outbox)

    def _ask(self, t: float, outbox: Outbox) -> None:
        upload = self._upload
        if upload is None:
            return
        to: Fields = {"target_system": upload.sender[0], "target_component": upload.sender[1]}
        if t - upload.helped > GIVEN_UP_AFTER:
            self._upload = None
            outbox.put(Priority.COMMAND, "MISSION_ACK", {**to, "type": int(MissionResult.CANCELLED)})
        elif upload.question.is_due(t) and outbox.room(Priority.COMMAND) >= 256:
            upload.question.asked(t)
            outbox.put(Priority.COMMAND, "MISSION_REQUEST_INT", {**to, "seq": len(upload.items)})

    def _tell_progress(self, t: float, outbox: Outbox) -> None:
        if t < self._look_at:
            return
        self._look_at = t + _LOOKS_EVERY
        progress = self._port.progress()
        if progress.reached not in (None, self._told.reached):
            outbox.put(Priority.STATE, "MISSION_ITEM_REACHED", {"seq": progress.reached or 0})
        if t < self._tell_at and progress == self._told:
            return
        self._told, self._tell_at = progress, t + CURRENT_EVERY
        total = progress.total
        if total is None:
            plan = self._port.plan()
            total = 0xFFFF if plan is None else len(plan.waypoints)
        told: Fields = {"seq": progress.current or 0, "total": total, "mission_state": progress.state}
        outbox.put(Priority.STATE, "MISSION_CURRENT", told)


def _as_item(refusal: WaypointRefusal) -> tuple[int, str]:
    """Number of the item and words of a refusal."""
    return (_WHOLE, refusal.words) if refusal.item is None else (refusal.item, f"item {refusal.item}: {refusal.words}")
