"""A node on the bus: what it hears, and what every node says."""

from collections import deque
from collections.abc import Sequence

from stommel.messages.codec import Decoder, Encoder, Received
from stommel.messages.commanding import CommandReceiver, Order
from stommel.messages.database import (
    BENCH,
    COORDINATOR,
    NODES,
    database,
    database_hash,
    value_named,
    word_of,
    words_of,
)
from stommel.messages.frames import Frame
from stommel.messages.nodes import UNSTATED, HeartbeatSender, NodeKind
from stommel.messages.parameters import MemoryStore, ParameterServer, ParameterStore
from stommel.onboard.execution.node_states import Event, Mode, Modes
from stommel.onboard.nodes.node_settings import NodeSettings, Settings, parameters_of, settings_with

BAD_FRAMES, BAD_FRAMES_WITHIN = 5, 10.0
"""Rejected frames within so many seconds that are told as a fault: one is a count, not an alarm."""

_SETTING = ("Write", "RestoreDefaults")
"""Requests after which parameters have other values; the node hears of no others."""


class NodeLink:
    """Heartbeat, mode, faults, commands and parameters of a node, whatever else it does.

    Times are counted from step to step, and never run back, whatever the clock does.
    """

    def __init__(
        self, node: int, settings: NodeSettings, restarts: int, store: ParameterStore | None, kind: NodeKind = UNSTATED
    ) -> None:
        self.name = NODES[node]
        self.modes = Modes()
        self.now = 0.0
        self.stranger = False
        """Whether the coordinator has another CAN database; it is then not obeyed, and its Sync counts for nothing."""
        self._node, self._restarts, self._kind = node, restarts, kind
        self._encoder, self._decoder = Encoder(), Decoder()
        self._receiver = CommandReceiver(node, self._encoder)
        self._parameters, self._store = parameters_of(settings), MemoryStore() if store is None else store
        self._server = ParameterServer(self._parameters, self._store)
        self._heard = frozenset(
            message.frame_id
            for message in database().messages
            if self.name in message.receivers and message.senders[0] in (NODES[COORDINATOR], NODES[BENCH])
        )
        self._commands = frozenset(words_of(f"{self.name}Acknowledgement", "command").values())
        self._out: list[Frame] = []
        self._faults: dict[str, int] = {}
        self._bad: deque[float] = deque(maxlen=BAD_FRAMES)
        self._clock: float | None = None
        self._begin()

    def _begin(self) -> None:
        self._heartbeat = HeartbeatSender(self._node, self._encoder, self._restarts, self._kind)
        self.last_sync = self.now
        self._faults.clear()
        self.report("ParameterStore", active=bool(self._server.notes))

    @property
    def notes(self) -> list[str]:
        """What was wrong with the parameter store, in words."""
        return self._server.notes

    @property
    def silence(self) -> float:
        """Time without Sync from a coordinator that is obeyed [s]."""
        return self.now - self.last_sync

    def restart(self) -> None:
        """Begin anew, as after a power cut: of the parameters what was saved holds."""
        self._restarts += 1
        self._server = ParameterServer(self._parameters, self._store)
        self.stranger = False
        self.modes.take(Event.RESTART)
        self._begin()

    def begin_step(self, t: float) -> bool:
        """Take the time of a step; return whether it is a new one."""
        first = self._clock is None
        passed = 0.0 if self._clock is None else t - self._clock
        self._clock = t
        self.now += max(0.0, passed)
        return first or passed > 0.0

    def hear(self, frames: Sequence[Frame]) -> list[Received]:
        """What frames say that are meant for the node; what every node does with them is done."""
        heard = []
        for frame in frames:
            if frame.identifier not in self._heard:
                continue
            received = self._decoder.take(frame)
            if not isinstance(received, Received):
                self._bad.append(self.now)
                continue
            if received.name == "Sync":
                self._hear_sync()
            elif received.name == "CoordinatorInformation":
                self._meet(int(received.values["database_hash"]))
            elif received.name.endswith("ParameterRequest"):
                self._out += self._server.take(received, self._encoder)
                if word_of(received.name, "operation", int(received.values["operation"])) in _SETTING:
                    heard.append(received)
            else:
                heard.append(received)
        return heard

    def order(self, received: Received) -> Order | None:
        """Return the command of a frame, if it is one for this node and not a retry."""
        order, answers = self._receiver.take(received, self.now)
        self._out += answers
        return order if order is not None and order.command in self._commands else None

    def acknowledge(self, order: Order, result: str, detail: int = 0) -> None:
        """Say what became of a command."""
        self._out.append(self._receiver.acknowledge(order, result, detail))

    def watch_silence(self, quiet_after: float, alone_after: float) -> None:
        """Follow how long no Sync was heard."""
        if self.silence >= quiet_after and self.modes.take(Event.SILENCE):
            self._decoder.forget(set(self._heard))
        if self.silence >= alone_after:
            self.modes.take(Event.LONG_SILENCE)
        self.report("BusQuiet", active=self.silence >= quiet_after)
        self.report("WrongVersion", active=self.stranger)
        many = len(self._bad) == BAD_FRAMES and self.now - self._bad[0] <= BAD_FRAMES_WITHIN
        self.report("BadFrames", active=many)

    def report(self, code: str, *, active: bool, detail: int = 0) -> None:
        """Tell a fault, once as it begins or becomes another and once as it ends."""
        if self._faults.get(code) == (detail if active else None):
            return
        if active:
            self._faults[code] = detail
        else:
            del self._faults[code]
        message = f"{self.name}Emergency"
        self.say(message, code=value_named(message, "code", code), active=bool(active), detail=int(detail))

    def say(self, message: str, **values: float) -> None:
        """Put a message among those that the step sends."""
        self._out.append(self._encoder.frame(message, **values))

    def end_step(self) -> list[Frame]:
        """Return all that the step sends, the most urgent first."""
        out = self._out + self._heartbeat.poll(self.now, self.modes.state)
        self._out = []
        self.modes.take(Event.READY)
        out.sort(key=lambda frame: frame.identifier)
        return out

    def settings_with(self, settings: Settings) -> Settings:
        """Return settings with the values of the parameters."""
        return settings_with(settings, self._server)

    def set_parameter(self, number: int, bits: int) -> None:
        """Set a value that the node itself counts."""
        self._server.write(number, bits)

    def _hear_sync(self) -> None:
        if not self.stranger:
            self.last_sync = self.now
            self.modes.take(Event.SYNC)

    def _meet(self, theirs: int) -> None:
        self.stranger = theirs != database_hash()
        if self.stranger:
            self.modes.take(Event.STRANGER)

    def obeys(self) -> bool:
        """Whether the node follows set points and switches now."""
        return not self.stranger and self.modes.mode is Mode.OPERATIONAL
