"""The vehicle's side of orders files: pieces in any order, checked and switched over as one, told by their hash."""

from typing import NamedTuple

from stommel.errors import FileError, StommelError
from stommel.link.missions.items import waypoints_digest
from stommel.link.missions.port import OrdersPort, WaypointPort
from stommel.link.once import Arrival, Once
from stommel.link.outbox import Outbox, Priority
from stommel.link.service import Received, is_for
from stommel.link.values import octets, whole
from stommel.link.words import fitted
from stommel.messages.mavlink import Fields

CHECK, SWITCH, ROLL_BACK = 0, 1, 2
"""GLIDER_ORDERS_ACTION."""
TAG = 4
"""First bytes of a file's SHA-256 that stand for it in its pieces."""
REFUSED, DONE, NOT_HERE = 0, 1, 2
"""Field `accepted` of ORDERS_OUTCOME."""
RANGES = 20
"""That one ORDERS_MISSING holds."""
_SHA256 = 32
_MOST_PROBLEMS = 255
_MOST_SENDERS = 16


class _Outcome(NamedTuple):
    """What became of a request."""

    values: Fields
    problems: tuple[str, ...]


class OrdersServer:
    """Takes orders files, and tells which one is held.

    Parameters
    ----------
    system, component
        The vehicle's coordination software.
    orders
        Where orders files are kept.
    waypoints
        The waypoints that they hold.
    """

    def __init__(self, system: int, component: int, orders: OrdersPort, waypoints: WaypointPort) -> None:
        self._system, self._component = system, component
        self._orders, self._waypoints = orders, waypoints
        self._once = Once()
        self._last: dict[tuple[int, int], _Outcome] = {}
        self._answers: dict[tuple[str, int, int, int], Fields] = {}
        """By name, whom for and number, so that what is asked twice waits once."""
        self._takes = {
            "ORDERS_ANNOUNCE": self._announce,
            "ORDERS_PIECE": self._piece,
            "ORDERS_REQUEST": self._request,
            "ORDERS_STATE_REQUEST": self._state,
        }

    def take(self, received: Received, t: float) -> None:  # noqa: ARG002 - as every service's
        """Take a message; what is of no orders for this vehicle is passed over."""
        take = self._takes.get(received.name)
        if take is not None and is_for(received, self._system, self._component):
            take(received)

    def _announce(self, received: Received) -> None:
        sha256, size = octets(received.values, "sha256"), whole(received.values, "size")
        told: Fields = {"file": sha256[:TAG]}
        try:
            if self._orders.held().sha256 != sha256:  # that file is held already
                self._orders.announce(size, sha256)
                gaps = list(self._orders.missing())
                told |= {
                    "missing": sum(end - first for first, end in gaps), "ranges": min(len(gaps), RANGES),
                    "first": tuple(first for first, _ in gaps[:RANGES]), "end": tuple(end for _, end in gaps[:RANGES]),
                }  # fmt: skip
        except StommelError as error:
            told |= {"refused": 1, "words": fitted(str(error), 80)}
        self._answer(received, "ORDERS_MISSING", told)

    def _piece(self, received: Received) -> None:
        values, announced = received.values, self._orders.announced()
        piece = octets(received.values, "data")[: whole(values, "length")]
        if announced and announced[:TAG] == values["file"]:
            try:
                self._orders.take_piece(whole(values, "offset"), piece)
            except StommelError:
                return  # outside of the file, or not kept: it stays missing

    def _request(self, received: Received) -> None:
        values, sender = received.values, (received.system, received.component)
        arrival = self._once.judge(sender, whole(values, "session"), whole(values, "number"))
        if arrival is Arrival.OLD:
            return
        if arrival is Arrival.NEW:
            accepted, problems = self._carried_out(whole(values, "action"), octets(received.values, "sha256"))
            told: Fields = {
                "session": values["session"], "number": values["number"], "accepted": accepted,
                "problems": len(problems), "held": self._orders.held().sha256,
            }  # fmt: skip
            self._last[sender] = _Outcome(told, problems)
            while len(self._last) > _MOST_SENDERS:
                del self._last[next(iter(self._last))]
        outcome = self._last.get(sender)
        if outcome is not None:
            self._answer(received, "ORDERS_OUTCOME", outcome.values)
            for index, words in enumerate(outcome.problems):
                told = {"session": values["session"], "number": values["number"], "index": index, "words": words}
                self._answer(received, "ORDERS_PROBLEM", told, index)

    def _carried_out(self, action: int, sha256: bytes) -> tuple[int, tuple[str, ...]]:
        """Do what is asked for; return whether it was done, and if not why."""
        orders = self._orders
        try:
            if action == ROLL_BACK:
                if orders.held().previous != sha256:
                    return REFUSED, ("orders: the ones before are others, or there are none",)
                orders.roll_back()
            elif action not in (CHECK, SWITCH):
                return REFUSED, (f"action = {action}: must be {CHECK}, {SWITCH} or {ROLL_BACK}",)
            elif action == CHECK or orders.held().sha256 != sha256:
                if orders.announced() != sha256:
                    return NOT_HERE, ()
                orders.check() if action == CHECK else orders.switch()
        except FileError as error:
            return REFUSED, tuple(fitted(str(problem), 200) for problem in error.problems[:_MOST_PROBLEMS])
        except StommelError as error:
            return REFUSED, (fitted(str(error), 200),)
        return DONE, ()

    def _state(self, received: Received) -> None:
        held, plan = self._orders.held(), self._waypoints.plan()
        told: Fields = {
            "mission": held.number, "held": held.sha256, "previous": held.previous, "name": fitted(held.name, 60),
            "waypoints": 0 if plan is None else len(plan.waypoints),
            "depth": 0.0 if plan is None else plan.depth or 0.0,
            "radius": 0.0 if plan is None else plan.radius or 0.0,
            "waypoints_digest": waypoints_digest(() if plan is None else plan.waypoints),
        }  # fmt: skip
        self._answer(received, "ORDERS_STATE", told)

    def _answer(self, received: Received, name: str, told: Fields, number: int = 0) -> None:
        to: Fields = {"target_system": received.system, "target_component": received.component}
        if len(self._answers) < 2 * _MOST_PROBLEMS:
            self._answers[name, received.system, received.component, number] = told | to

    def poll(self, t: float, outbox: Outbox) -> None:  # noqa: ARG002 - as every service's
        """Say answers."""
        while self._answers and outbox.room(Priority.COMMAND) >= 256:
            key = next(iter(self._answers))
            values = self._answers.pop(key)
            if key[0] == "ORDERS_STATE":
                del values["target_system"], values["target_component"]
            outbox.put(Priority.COMMAND, key[0], values)
