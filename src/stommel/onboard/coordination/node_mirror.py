"""What is known of the parameters of one node, and what is still to be asked of it."""

import struct
from collections import deque
from collections.abc import Mapping
from enum import Enum
from math import inf, isfinite
from typing import Any, NamedTuple

from stommel.errors import StommelError
from stommel.messages.codec import Encoder
from stommel.messages.database import NODES
from stommel.messages.frames import Frame
from stommel.messages.nodes import NodeWatch
from stommel.messages.parameters import ParameterAnswer, ParameterClient, ParameterType, Value, from_bits, to_bits
from stommel.onboard.nodes.parameter_tables import PARAMETERS

ASK_AGAIN = 60.0
"""After a request that a node did not answer nothing is asked for so long [s]."""
MOST_WAITING = 256
"""Of writes and savings to a node; more are refused."""


class ParameterState(Enum):
    """What is known of a parameter."""

    ASKED = "asked"
    """It will be, or is being asked for; numbers are those of before, if any."""
    KNOWN = "known"
    SILENT = "silent"
    """Its node does not answer; numbers are those of before, if any."""
    ABSENT = "absent"
    """The node has none of this number, or one of another type."""


class NodeParameter(NamedTuple):
    """A parameter of a node. Numbers are None until the node has told them, and of the time when it did."""

    number: int
    """On the bus, 0 to 255."""
    name: str
    type: ParameterType
    value: Value | None
    default: Value | None
    low: Value | None
    high: Value | None
    unit: str
    words: str
    """What it means to people."""
    state: ParameterState


class ParameterOutcome(NamedTuple):
    """What became of what was asked of a node."""

    node: int
    number: int
    """Of the parameter; 0 of a saving."""
    operation: str
    """`Write` or `Save`; `Read` where that cannot be asked."""
    value: Value | None
    """That was to be written; None of a saving."""
    result: str
    """`Ok`, or why not in the CAN database's words: `OutOfRange`, `NoSuchParameter`, `NotSaved`; `NoAnswer` if the node
    did not answer or is not there, `Busy` if too many were waiting."""

    @property
    def words(self) -> str:
        """One sentence for the log."""
        node = NODES.get(self.node, str(self.node))
        if self.operation != "Write":
            return f"{node}: parameters saved: {self.result}"
        names = {p.number: f"{p.name} = {self.value} {p.unit}".rstrip() for p in PARAMETERS.get(self.node, ())}
        return f"{node}: {names.get(self.number, f'{self.number} = {self.value}')}: {self.result}"


class UnknownParameterError(StommelError):
    """A node has no parameter of this name."""


_READS = {"ReadType": "", "Read": "value", "ReadDefault": "default", "ReadMinimum": "low", "ReadMaximum": "high"}
"""Operations by which a parameter becomes known, in their order, and what each tells."""
_LAST_READ = "ReadMaximum"


class Request(NamedTuple):
    """Something to ask of a node."""

    operation: str
    number: int
    value: Value | None = None


class NodeMirror:
    """What is known of one node, and what is still to be asked of it."""

    def __init__(self, node: int, encoder: Encoder, wanted: Mapping[str, Value]) -> None:
        self.node, self.client = node, ParameterClient(node, encoder)
        self.known = {
            p.number: NodeParameter(
                p.number, p.name, p.type, None, None, None, None, p.unit, p.words, ParameterState.ASKED
            )
            for p in sorted(PARAMETERS[node])
        }
        numbers = {p.name: p.number for p in self.known.values()}
        for name in wanted:
            if name not in numbers:
                raise UnknownParameterError(
                    f"{name}: is no parameter of the {NODES[node]} node; there are {', '.join(numbers)}"
                )
        self._wanted = {numbers[name]: value for name, value in wanted.items()}
        self._to_set: dict[int, Value] = {}
        self._asked: deque[Request] = deque()
        self._reads: deque[Request] = deque()
        self._current: Request | None = None
        self._there = False
        self._restarts = 0
        self._begins_again = inf
        self._outcomes: list[ParameterOutcome] = []

    def queue(self, request: Request) -> str:
        """Take what is asked for; return why it cannot be, if it cannot."""
        if not self._there:
            return "NoAnswer"
        parameter = self.known.get(request.number)
        if parameter is None and request.operation != "Save":
            return "NoSuchParameter"
        if parameter is not None and request.operation == "Write":
            if request.value is None or _bits(parameter.type, request.value) is None:
                return "OutOfRange"
            self._to_set.pop(request.number, None)  # what somebody says now counts more
        if len(self._asked) >= MOST_WAITING:
            return "Busy"
        self._asked.append(request)
        return ""

    def step(self, watch: NodeWatch, t: float) -> list[Frame]:
        """Begin and end with the node as it comes and goes; return the request that is due."""
        there = watch.is_met(self.node) and not watch.is_silent(self.node, t)
        restarts = watch.restarts_of(self.node)
        if there and (not self._there or restarts != self._restarts or t >= self._begins_again):
            self._begin()
        elif self._there and not there:
            self._leave()
        self._there, self._restarts = there, restarts
        if there and self._current is None:
            self._current = self._next()
            if self._current is not None:
                operation, number, value = self._current
                bits = 0 if value is None else _bits(self.known[number].type, value) or 0
                self.client.ask(operation, number, t, bits)
        return self.client.poll(t)

    def learn(self, t: float) -> list[ParameterOutcome]:
        """Take what has been answered; return what became of writes and savings."""
        for answer in self.client.answers():
            request, self._current = self._current, None
            assert request is not None
            if request.operation in ("Write", "Save"):
                operation, number, value = request
                self._outcomes.append(ParameterOutcome(self.node, number, operation, value, answer.result))
            if answer.result == "NoAnswer":
                if request.operation in _READS:
                    self._mark(ParameterState.SILENT)
                    self._reads.clear()
                    self._begins_again = t + ASK_AGAIN
            elif request.operation != "Save":
                self._learn(request, answer)
        outcomes, self._outcomes = self._outcomes, []
        return outcomes

    def _learn(self, request: Request, answer: ParameterAnswer) -> None:
        """Take what a node said of a parameter."""
        known = self.known[request.number]
        other_type = request.operation == "ReadType" and answer.bits != known.type
        if answer.result == "NoSuchParameter" or other_type:
            self.known[request.number] = known._replace(state=ParameterState.ABSENT)
            return
        field = "value" if request.operation == "Write" else _READS[request.operation]
        if field:
            told: dict[str, Any] = {field: from_bits(known.type, answer.bits)}
            known = known._replace(**told)
        if request.operation == _LAST_READ:
            known = known._replace(state=ParameterState.KNOWN)
        self.known[request.number] = known
        wanted = self._to_set.pop(request.number, None) if request.operation == "Read" else None
        if wanted is not None and _bits(known.type, wanted) != answer.bits:
            self._set(request.number, wanted)

    def _set(self, number: int, value: Value) -> None:
        """Ask for a value of the configuration; one that the type cannot hold is told as if the node had refused."""
        request = Request("Write", number, value)
        objection = self.queue(request)
        if objection:
            self._outcomes.append(ParameterOutcome(self.node, number, "Write", value, objection))

    def _next(self) -> Request | None:
        if self._asked:
            return self._asked.popleft()
        while self._reads:
            request = self._reads.popleft()
            if self.known[request.number].state is not ParameterState.ABSENT:
                return request
        return None

    def _begin(self) -> None:
        """Ask for everything, first of all what shall be something."""
        self._mark(ParameterState.ASKED)
        self._to_set = dict(self._wanted)
        numbers = (*self._wanted, *(number for number in self.known if number not in self._wanted))
        self._reads = deque(Request(operation, number) for number in numbers for operation in _READS)
        self._begins_again = inf

    def _leave(self) -> None:
        """Ask for nothing of a node that is gone."""
        self._mark(ParameterState.SILENT)
        self._reads.clear()
        for operation, number, value in self._asked:
            self._outcomes.append(ParameterOutcome(self.node, number, operation, value, "NoAnswer"))
        self._asked.clear()

    def _mark(self, state: ParameterState) -> None:
        self.known = {number: known._replace(state=state) for number, known in self.known.items()}


def _bits(kind: ParameterType, value: Value) -> int | None:
    """32 bits of a value; None if the type cannot hold it."""
    try:
        whole = isfinite(value) and value == int(value)
        if kind is ParameterType.float32:
            return to_bits(kind, value) if isfinite(value) else None
        return to_bits(kind, value) if whole and (kind is ParameterType.int32 or value in (0, 1)) else None
    except (struct.error, OverflowError):
        return None
