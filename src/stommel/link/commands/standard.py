"""Commands of ordinary MAVLink software: COMMAND_LONG, COMMAND_INT, and their acknowledgements.

They have no id, no expiry and no ledger. Ours have; these are for software that knows no other.
"""

import math
from collections.abc import Callable
from typing import NamedTuple, Protocol

from stommel.errors import StommelError
from stommel.link.commands.identity import Identity
from stommel.link.commands.port import CommandPort, Readiness
from stommel.link.commands.states import UNKNOWN_PERCENT, Command, Progress, State, When
from stommel.link.commands.table import ABORT, HOLD, PARAMETERS, RECALL, START, command_numbered, refusal
from stommel.link.outbox import Outbox, Priority
from stommel.link.service import Received, is_for
from stommel.link.values import real, whole
from stommel.messages.mavlink import Fields, enumeration

SAME_WITHIN = 3.0
"""A command equal to the last one of its sender is a retransmission within this time [s]; not all count up."""
COUNTED_WITHIN = 30.0
"""The same where `confirmation` has risen [s]."""
EVERY = 1.0
"""Between two reports of a command in progress [s]."""
MOST = 32
"""Commands in progress, senders that are remembered, answers that wait."""
LEAST_INTERVAL, MOST_INTERVAL = 1e4, 3.6e9
"""Of a message that is asked for [us]."""
_RESULTS = {
    State.DONE: "ACCEPTED", State.REFUSED: "DENIED", State.FAILED: "FAILED", State.IN_PROGRESS: "IN_PROGRESS",
}  # fmt: skip


class Telemetry(Protocol):
    """Who says the vehicle's messages."""

    def request(self, number: int, t: float) -> bool:
        """Say a message once, soon; whether the vehicle has it."""

    def set_interval(self, number: int, interval: float | None, t: float) -> bool:
        """Say a message every so often [s]; 0: as it was at first, None: not at all. Whether the vehicle has it."""


class _Last(NamedTuple):
    """The last command of a sender."""

    key: tuple[object, ...]
    confirmation: int
    t: float
    result: str
    id: int


class _Running(NamedTuple):
    """A command in progress."""

    command: int
    sender: tuple[int, int]
    progress: Progress
    said: float


class StandardCommands:
    """Executes standard commands through the same port as our own.

    Parameters
    ----------
    system, component
        Who is commanded.
    port
        Executes.
    telemetry
        Says the vehicle's messages.
    identity
        Who the vehicle is.
    abort_came
        Is told of each abort, so that commands of our own that wait are cancelled.
    tell
        Says in words why a command is not executed: COMMAND_ACK has no room for them.
    """

    def __init__(
        self,
        system: int,
        component: int,
        port: CommandPort,
        telemetry: Telemetry,
        identity: Identity,
        abort_came: Callable[[float], None],
        tell: Callable[[str], None] = lambda _: None,
    ) -> None:
        self._me = (system, component)
        self._port, self._telemetry, self._identity, self._abort_came = port, telemetry, identity, abort_came
        self._tell = tell
        self._last: dict[tuple[int, int], _Last] = {}
        self._running: dict[int, _Running] = {}
        self._answers: list[tuple[str, Fields]] = []
        self._count = 0
        self._does: dict[int, Callable[[list[float], float], tuple[str, int]]] = {
            _number("COMPONENT_ARM_DISARM"): self._arm,
            _number("MISSION_START"): self._start,
            _number("NAV_RETURN_TO_LAUNCH"): lambda _, t: self._begin(RECALL, [], t),
            _number("DO_FLIGHTTERMINATION"): self._terminate,
            _number("REQUEST_MESSAGE"): self._request,
            _number("SET_MESSAGE_INTERVAL"): self._set_interval,
            _number("REQUEST_AUTOPILOT_CAPABILITIES"): lambda _, t: self._request([float(_VERSION)], t),
        }
        self._repeatable = {_number(name) for name in ("REQUEST_MESSAGE", "SET_MESSAGE_INTERVAL")}
        self._repeatable.add(_number("REQUEST_AUTOPILOT_CAPABILITIES"))

    def take(self, received: Received, t: float) -> None:
        """Take a message at a time [s]."""
        is_int = received.name == "COMMAND_INT"
        if not (is_int or received.name == "COMMAND_LONG") or not is_for(received, *self._me):
            return
        values = received.values
        number, confirmation = whole(values, "command"), 0 if is_int else whole(values, "confirmation")
        places = ("x", "y", "z") if is_int else ("param5", "param6", "param7")
        names = ("param1", "param2", "param3", "param4", *places)
        parameters = [real(values, name) for name in names]
        sender = (received.system, received.component)
        key = (number, *map(str, parameters))
        last = self._last.get(sender)
        if last is not None and last.key == key and number not in self._repeatable:
            counted = confirmation > 0 and confirmation >= last.confirmation
            if t - last.t <= (COUNTED_WITHIN if counted else SAME_WITHIN):
                self._last[sender] = last._replace(confirmation=max(confirmation, last.confirmation), t=t)
                self._acknowledge(number, last.result, sender)
                return
        result, id = self._do(number, parameters, t)
        self._last.pop(sender, None)
        self._last[sender] = _Last(key, confirmation, t, result, id)
        if len(self._last) > MOST:
            del self._last[next(iter(self._last))]
        if result == "IN_PROGRESS":
            self._running[id] = _Running(number, sender, Progress(State.IN_PROGRESS), t)
        self._acknowledge(number, result, sender)

    def poll(self, t: float, outbox: Outbox) -> None:
        """Follow what is in progress, and say what waits, at a time [s]."""
        for id, running in list(self._running.items()):
            progress = self._port.progress(id) or Progress(State.FAILED)
            if progress.state.is_last:
                del self._running[id]
                result = _RESULTS.get(progress.state, "FAILED")
                if result == "FAILED" and progress.words:
                    self._tell(f"command {running.command} failed: {progress.words}")
                for sender, last in self._last.items():
                    if last.id == id:
                        self._last[sender] = last._replace(result=result)
                self._acknowledge(running.command, result, running.sender)
            elif progress != running.progress and t - running.said >= EVERY:
                self._running[id] = running._replace(progress=progress, said=t)
                self._acknowledge(running.command, "IN_PROGRESS", running.sender, progress.percent)
        while self._answers and outbox.room(Priority.COMMAND) >= 100:
            outbox.put(Priority.COMMAND, *self._answers.pop(0))

    # what is done: result and the port's number of what was begun

    def _do(self, number: int, parameters: list[float], t: float) -> tuple[str, int]:
        if does := self._does.get(number):
            return does(parameters, t)
        if command_numbered(number) is None:
            return "UNSUPPORTED", 0
        if any(value != 0.0 and not math.isnan(value) for value in parameters[PARAMETERS:]):
            return "DENIED", 0
        return self._begin(number, parameters[:PARAMETERS], t)

    def _begin(self, number: int, parameters: list[float], t: float) -> tuple[str, int]:
        """Begin a command of our own table; parameters that are not used may be no numbers."""
        kind = command_numbered(number)
        assert kind is not None
        used = len(kind.parameters)
        given = [*parameters, *[0.0] * PARAMETERS][:PARAMETERS]
        given = given[:used] + [0.0 if math.isnan(value) else value for value in given[used:]]
        if problem := refusal(kind, given):
            self._tell(f"command {number} refused: {problem}")
            return "DENIED", 0
        if len(self._running) >= MOST:
            return "TEMPORARILY_REJECTED", 0
        self._count += 1
        # ids of the link's own commands have 64 random bits; those below 2^32 are as good as never drawn
        command = Command(self._count, number, tuple(given), When.AT_ONCE, 0, 0)
        answer = self._port.check(command)
        if answer.readiness is not Readiness.READY:
            if answer.words:
                self._tell(f"command {number} refused: {answer.words}")
            return ("TEMPORARILY_REJECTED" if answer.readiness is Readiness.NOT_YET else "DENIED"), 0
        if number == ABORT:
            self._abort_came(t)
        try:
            progress = self._port.begin(command)
        except StommelError as error:
            self._tell(f"command {number} failed: {error}")
            return "FAILED", 0
        last = progress.state.is_last
        return (_RESULTS.get(progress.state, "FAILED") if last else "IN_PROGRESS"), self._count

    def _arm(self, parameters: list[float], t: float) -> tuple[str, int]:
        """Armed is: the mission is started."""
        if parameters[0] not in (0.0, 1.0):
            return "DENIED", 0
        return self._begin(START if parameters[0] else HOLD, [], t)

    def _start(self, parameters: list[float], t: float) -> tuple[str, int]:
        """A mission begins with its first item, or goes on where it was."""
        return self._begin(START, [], t) if not parameters[0] > 0.0 else ("DENIED", 0)

    def _terminate(self, parameters: list[float], t: float) -> tuple[str, int]:
        return self._begin(ABORT, [], t) if parameters[0] > 0.5 else ("DENIED", 0)

    def _request(self, parameters: list[float], t: float) -> tuple[str, int]:
        number = _message_number(parameters[0])
        if number is None:
            return "DENIED", 0
        if number == _VERSION:
            self._say("AUTOPILOT_VERSION", self._identity.values())
            return "ACCEPTED", 0
        return ("ACCEPTED" if self._telemetry.request(number, t) else "UNSUPPORTED"), 0

    def _set_interval(self, parameters: list[float], t: float) -> tuple[str, int]:
        number, interval = _message_number(parameters[0]), parameters[1]
        if number is None or not (interval in (-1.0, 0.0) or LEAST_INTERVAL <= interval <= MOST_INTERVAL):
            return "DENIED", 0
        seconds = None if interval == -1.0 else interval / 1e6
        return ("ACCEPTED" if self._telemetry.set_interval(number, seconds, t) else "UNSUPPORTED"), 0

    # what is said

    def _acknowledge(self, number: int, result: str, sender: tuple[int, int], percent: int = UNKNOWN_PERCENT) -> None:
        values: Fields = {
            "command": number,
            "result": enumeration("MAV_RESULT")[f"MAV_RESULT_{result}"],
            "progress": min(max(percent, 0), UNKNOWN_PERCENT) if result == "IN_PROGRESS" else 0,
            "target_system": sender[0],
            "target_component": sender[1],
        }
        self._say("COMMAND_ACK", values)

    def _say(self, name: str, values: Fields) -> None:
        self._answers.append((name, values))
        del self._answers[:-MOST]


_VERSION = 148
"""Number of AUTOPILOT_VERSION."""


def _number(name: str) -> int:
    return enumeration("MAV_CMD")[f"MAV_CMD_{name}"]


def _message_number(value: float) -> int | None:
    """A message's number, carried as a float."""
    return int(value) if 0.0 <= value < 2**24 and value.is_integer() else None
