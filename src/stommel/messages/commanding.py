"""Commands that are acknowledged: asked again until they are, or given up; done once however often they are asked."""

from dataclasses import dataclass
from typing import NamedTuple

from stommel.messages.codec import Encoder, Received, UnsayableError
from stommel.messages.database import ACQUISITION, BENCH, COORDINATOR, MOTION, NODES, value_named, word_of, words_of
from stommel.messages.frames import Frame

TIME_OUT = 1.0
"""After which a command is asked again [s]."""
TRIES = 4
"""How often a command is sent without an answer before it is given up."""
AT_WORK = 10.0
"""After which a node that said it is at work is asked again [s]; a lost last word is so said again."""
FORGOTTEN_AFTER = 60.0
"""Time without a retry after which a node forgets a command [s]."""
ALL = 0
"""Target of commands to every node."""
_ACKNOWLEDGING = {f"{NODES[node]}Acknowledgement": node for node in (MOTION, ACQUISITION)}
_GOING_ON = ("Accepted", "InProgress")
"""Results after which another one comes."""
_HALF = 0x8000
_FIRST = {COORDINATOR: 0, BENCH: _HALF}
"""Where each sender's numbers begin, so that neither takes the other's acknowledgement for its own."""
_STRIDE = 0x101
"""Between the first numbers of two starts; more commands than in a minute, within which nodes remember."""
_EARLY = 1e-6
"""Times that are sums of steps fall short by rounding [s]."""


class Outcome(NamedTuple):
    """What became of a command."""

    target: int
    """Number of the node."""
    command: str
    sequence: int
    result: str
    """`Done`, `Refused`, `Unknown` or `Failed` as the node said; `NoAnswer` if it never did."""
    detail: int
    """A number that belongs to the result."""


@dataclass
class _Pending:
    target: int
    command: str
    sequence: int
    argument: int
    deadline: float
    """When it is sent again, or given up [s]."""
    tries: int = 0


class CommandSender:
    """Sends commands of one node, several at a time, and says what became of each.

    A restarted sender begins with other numbers than before (`restarts`), as a node takes a number that it knows for a
    retry.
    """

    def __init__(self, encoder: Encoder, node: int = COORDINATOR, restarts: int = 0) -> None:
        self._encoder = encoder
        self._message = f"{NODES[node]}Command"
        self._first = _FIRST[node]
        self._count = restarts * _STRIDE
        self._pending: list[_Pending] = []
        self._outcomes: list[Outcome] = []

    def send(self, target: int, command: str, argument: int, t: float) -> int:
        """Take a command for a node, or for all (target 0), and return its number; `poll` gives its frames.

        A command for all is sent `TRIES` times without waiting for anyone, and has no outcome.

        Raises
        ------
        UnsayableError
            There is no such command, no such target, or the argument is no 16-bit number.
        """
        pending = _Pending(target, command, self._first + self._count % _HALF, argument, t)
        if target not in (ALL, *_ACKNOWLEDGING.values()):
            raise UnsayableError(f"command {command}: target {target}: must be 0 (all), 2 (Motion) or 3 (Acquisition)")
        if command not in words_of(self._message, "command").values():
            known = ", ".join(sorted(words_of(self._message, "command").values()))
            raise UnsayableError(f"command {command}: must be one of {known}")
        Encoder().frame(self._message, **self._values(pending))  # an argument that cannot be said is refused here
        self._count += 1
        self._pending.append(pending)
        return pending.sequence

    def poll(self, t: float) -> list[Frame]:
        """Return the frames that are due at a time [s]."""
        frames = []
        for pending in [pending for pending in self._pending if t >= pending.deadline - _EARLY]:
            if pending.tries >= TRIES:
                self._end(pending, "NoAnswer", 0)
                continue
            pending.tries += 1
            pending.deadline = t + TIME_OUT
            frames.append(self._encoder.frame(self._message, **self._values(pending)))
        return frames

    def take(self, received: Received, t: float) -> None:
        """Take a message at a time [s]; all but acknowledgements of own commands are passed over."""
        node = _ACKNOWLEDGING.get(received.name)
        if node is None:
            return
        values = received.values
        for pending in self._pending:
            if (pending.target, pending.sequence) != (node, values["sequence"]):
                continue
            if value_named(received.name, "command", pending.command) != values["command"]:
                continue
            result = word_of(received.name, "result", int(values["result"]))
            if result in _GOING_ON:
                pending.tries, pending.deadline = 0, t + AT_WORK
            else:
                self._end(pending, result, int(values["detail"]))
            return

    def outcomes(self) -> list[Outcome]:
        """Return what became of commands since this was last asked."""
        outcomes, self._outcomes = self._outcomes, []
        return outcomes

    @property
    def pending(self) -> int:
        """How many commands have no outcome yet."""
        return len(self._pending)

    def _end(self, pending: _Pending, result: str, detail: int) -> None:
        self._pending.remove(pending)
        if pending.target != ALL:
            self._outcomes.append(Outcome(pending.target, pending.command, pending.sequence, result, detail))

    def _values(self, pending: _Pending) -> dict[str, float]:
        command = value_named(self._message, "command", pending.command)
        return {
            "target": pending.target,
            "command": command,
            "sequence": pending.sequence,
            "argument": pending.argument,
        }


class Order(NamedTuple):
    """A command that a node shall carry out, once."""

    sender: str
    """Message that it came in."""
    command: str
    argument: int
    sequence: int


@dataclass
class _Remembered:
    order: Order
    heard: float
    """When it was last asked [s]."""
    result: str = "Accepted"
    detail: int = 0


class CommandReceiver:
    """Takes a node's commands; a retry is answered with what became of the command, and not done twice."""

    def __init__(self, node: int, encoder: Encoder) -> None:
        self._node = node
        self._acknowledgement = f"{NODES[node]}Acknowledgement"
        self._encoder = encoder
        self._known: dict[tuple[str, int], _Remembered] = {}

    def take(self, received: Received, t: float) -> tuple[Order | None, list[Frame]]:
        """Take a message at a time [s]; return a command to carry out, and frames to send.

        The node answers a command with `acknowledge`: at once where it is at once done or refused; else `InProgress`
        first, and its end later.
        """
        values = received.values
        if not received.name.endswith("Command") or values["target"] not in (ALL, self._node):
            return None, []
        command = word_of(received.name, "command", int(values["command"]))
        order = Order(received.name, command, int(values["argument"]), int(values["sequence"]))
        self._known = {key: known for key, known in self._known.items() if t - known.heard <= FORGOTTEN_AFTER}
        known = self._known.get((order.sender, order.sequence))
        if known is not None and known.order == order:
            known.heard = t
            return None, [self.acknowledge(order, known.result, known.detail)]
        self._known[order.sender, order.sequence] = _Remembered(order, t)
        return order, []

    def acknowledge(self, order: Order, result: str, detail: int = 0) -> Frame:
        """Return the frame that says what became of a command: `Accepted`, `InProgress`, `Done`, `Refused`, ..."""
        known = self._known.get((order.sender, order.sequence))
        if known is not None and known.order == order:
            known.result, known.detail = result, detail
        return self._encoder.frame(
            self._acknowledgement,
            command=value_named(self._acknowledgement, "command", order.command),
            result=value_named(self._acknowledgement, "result", result),
            sequence=order.sequence,
            detail=detail,
        )
