"""Who is on the bus: heartbeats sent, and heartbeats, versions and strangers watched."""

from collections import Counter
from collections.abc import Collection
from dataclasses import dataclass, field
from enum import IntEnum
from math import inf
from typing import NamedTuple

from stommel.messages.codec import Encoder, Received, Rejected
from stommel.messages.database import NODES, database_hash, message_of, sender_of, word_of
from stommel.messages.frames import Frame

PERIOD = 1.0
"""Between two heartbeats [s]."""
INFORMATION_PERIOD = 10.0
"""Between two information frames [s]: a node that starts later learns whom it talks to."""
SILENT_AFTER = 3
"""Heartbeats missed in a row, after which a node is silent."""
_EARLY = 1e-6
"""Times that are sums of steps fall short by rounding [s]."""


class NodeState(IntEnum):
    """States of a node, by their numbers in the database."""

    Initialising = 0
    PreOperational = 1
    Operational = 2
    Safe = 3
    Stopped = 4


class NodeKind(NamedTuple):
    """What a node tells of itself as it starts."""

    hardware: int
    """Board revision, 0 to 255."""
    version: tuple[int, int, int]
    """Of its software: major, minor, patch; each 0 to 255."""


UNSTATED = NodeKind(0, (0, 0, 0))


class HeartbeatSender:
    """Sends a node's heartbeat each second, and what it is as it starts and every 10 s."""

    def __init__(self, node: int, encoder: Encoder, restarts: int = 0, kind: NodeKind = UNSTATED) -> None:
        self._name = NODES[node]
        self._encoder = encoder
        self._restarts = min(restarts, 0xFFFF)
        self._kind = kind
        self._began: float | None = None
        self._next_heartbeat = self._next_information = 0.0

    def poll(self, t: float, state: NodeState) -> list[Frame]:
        """Return the frames that are due at a time [s]; the first call is the node's start."""
        if self._began is None:
            self._began = self._next_heartbeat = self._next_information = t
        frames = []
        if t >= self._next_information - _EARLY:
            self._next_information = _next(self._next_information, INFORMATION_PERIOD, t)
            frames.append(self._information())
        if t >= self._next_heartbeat - _EARLY:
            self._next_heartbeat = _next(self._next_heartbeat, PERIOD, t)
            uptime = min(max(t - self._began, 0.0), 0xFFFFFF)
            frames.append(
                self._encoder.frame(f"{self._name}Heartbeat", state=state, restarts=self._restarts, uptime=uptime)
            )
        return frames

    def _information(self) -> Frame:
        major, minor, patch = self._kind.version
        return self._encoder.frame(
            f"{self._name}Information", hardware=self._kind.hardware, version_major=major, version_minor=minor,
            version_patch=patch, database_hash=database_hash(),
        )  # fmt: skip


def _next(due: float, period: float, t: float) -> float:
    """Next time on the same grid; a new grid where times were left out."""
    return due + period if due + period > t else t + period


class NodeReport(NamedTuple):
    """What is known of a node."""

    name: str
    state: str
    """In the database's words; empty before its first heartbeat."""
    restarts: int
    """How often it has started, by its own count."""
    restarts_seen: int
    """How often it was seen to start anew."""
    uptime: float
    """Since it started, as it last said [s]."""
    heard: float | None
    """When its last heartbeat came [s]; None before the first."""
    silent: bool
    """Whether it has missed too many heartbeats in a row."""
    lost: int
    """Its frames that were lost, by their alive counters."""
    version: tuple[int, int, int] | None
    """Of its software; None before it told."""
    hardware: int | None
    """Board revision; None before it told."""
    refused: str
    """Why it is not obeyed; empty if it is."""
    emergencies: tuple[str, ...]
    """Faults that it reported and that hold."""


class Network(NamedTuple):
    """What is known of the bus at a time."""

    t: float
    nodes: tuple[NodeReport, ...]
    unknown: tuple[tuple[str, int], ...]
    """Whose frames the database does not know, in words, and how many."""
    rejected: tuple[tuple[str, str, int], ...]
    """Whose frames were rejected: message, reason and how many."""


@dataclass
class _Node:
    name: str
    state: int | None = None
    restarts: int = 0
    restarts_seen: int = 0
    uptime: float = 0.0
    heard: float | None = None
    lost: int = 0
    kind: NodeKind | None = None
    refused: str = ""
    emergencies: set[str] = field(default_factory=set)


class NodeWatch:
    """Follows nodes by what a decoder gives; one lost frame is a count, never an alarm.

    A node that was never heard is silent too, once it has missed as many heartbeats since the watch began.
    """

    def __init__(self, nodes: tuple[int, ...], t: float, silent_after: int = SILENT_AFTER) -> None:
        self._nodes = {NODES[number]: _Node(NODES[number]) for number in nodes}
        self._began = t
        self._patience = (silent_after + 0.5) * PERIOD
        self._strangers: Counter[int] = Counter()
        self._rejected: Counter[tuple[int, str]] = Counter()

    def take(self, answer: Received | Rejected, t: float) -> None:
        """Take what a decoder said of a frame at a time [s]."""
        if isinstance(answer, Rejected):
            if answer.reason == "unknown":
                self._strangers[answer.identifier] += 1
            else:
                self._rejected[answer.identifier, answer.reason] += 1
            return
        node = self._nodes.get(sender_of(answer.name))
        if node is None:
            return
        node.lost += answer.lost
        if answer.name.endswith("Heartbeat"):
            _take_heartbeat(node, answer, t)
        elif answer.name.endswith("Information"):
            _take_information(node, answer)
        elif answer.name.endswith("Emergency"):
            _take_emergency(node, answer)

    def obeys(self, answer: Received) -> bool:
        """Whether a message comes from a node that is not refused; from one that is not watched, too."""
        node = self._nodes.get(sender_of(answer.name))
        return node is None or not node.refused

    def is_silent(self, node: int, t: float) -> bool:
        """Whether a watched node has missed too many heartbeats in a row."""
        return self._is_silent(self._nodes[NODES[node]], t)

    def is_refused(self, node: int) -> bool:
        """Whether a watched node is of another version, and not obeyed."""
        return bool(self._nodes[NODES[node]].refused)

    def state_of(self, node: int) -> int | None:
        """State of a watched node, one of `NodeState`; None before its first heartbeat."""
        return self._nodes[NODES[node]].state

    def heard_at(self, node: int) -> float:
        """When the last heartbeat of a watched node came [s]; minus infinity before the first."""
        heard = self._nodes[NODES[node]].heard
        return -inf if heard is None else heard

    def restarts_of(self, node: int) -> int:
        """How often a watched node was seen to start anew."""
        return self._nodes[NODES[node]].restarts_seen

    def is_met(self, node: int) -> bool:
        """Whether a watched node has said what it is, and is not refused."""
        known = self._nodes[NODES[node]]
        return known.kind is not None and not known.refused

    def reports(self, node: int, fault: str) -> bool:
        """Whether a watched node has told a fault, a word of its emergencies, and not that it is over."""
        return fault in self._nodes[NODES[node]].emergencies

    @property
    def restarts_seen(self) -> int:
        """How often watched nodes were seen to start anew."""
        return sum(node.restarts_seen for node in self._nodes.values())

    @property
    def strangers(self) -> Collection[int]:
        """Identifiers that the database does not know; they only become more."""
        return self._strangers.keys()

    def snapshot(self, t: float) -> Network:
        """Return all that is known at a time [s]."""
        nodes = tuple(self._report(node, t) for node in self._nodes.values())
        unknown = tuple((named_stranger(identifier), count) for identifier, count in sorted(self._strangers.items()))
        rejected = tuple(
            (named(identifier), reason, count) for (identifier, reason), count in sorted(self._rejected.items())
        )
        return Network(t, nodes, unknown, rejected)

    def _is_silent(self, node: _Node, t: float) -> bool:
        return t - (self._began if node.heard is None else node.heard) > self._patience

    def _report(self, node: _Node, t: float) -> NodeReport:
        state = "" if node.state is None else word_of(f"{node.name}Heartbeat", "state", node.state)
        return NodeReport(
            name=node.name,
            state=state,
            restarts=node.restarts,
            restarts_seen=node.restarts_seen,
            uptime=node.uptime,
            heard=node.heard,
            silent=self._is_silent(node, t),
            lost=node.lost,
            version=node.kind.version if node.kind else None,
            hardware=node.kind.hardware if node.kind else None,
            refused=node.refused,
            emergencies=tuple(sorted(node.emergencies)),
        )


def _take_heartbeat(node: _Node, answer: Received, t: float) -> None:
    values = answer.values
    restarts, uptime = int(values["restarts"]), values["uptime"]
    if node.heard is not None and (restarts != node.restarts or uptime < node.uptime):
        node.restarts_seen += 1
        node.emergencies.clear()
    node.state, node.restarts, node.uptime, node.heard = int(values["state"]), restarts, uptime, t


def _take_information(node: _Node, answer: Received) -> None:
    values = answer.values
    version = (int(values["version_major"]), int(values["version_minor"]), int(values["version_patch"]))
    node.kind = NodeKind(int(values["hardware"]), version)
    theirs, ours = int(values["database_hash"]), database_hash()
    node.refused = "" if theirs == ours else f"{node.name}: CAN database {theirs:06x}, must be {ours:06x}"


def _take_emergency(node: _Node, answer: Received) -> None:
    word = word_of(answer.name, "code", int(answer.values["code"]))
    if answer.values["active"]:
        node.emergencies.add(word)
    else:
        node.emergencies.discard(word)


def named(identifier: int) -> str:
    """Name of a message; of a frame that the database does not know, what it may be."""
    message = message_of(identifier)
    return message.name if message is not None else named_stranger(identifier)


_BLOCKS = {
    0x080: "emergency", 0x180: "acknowledgement", 0x580: "parameter answer", 0x700: "heartbeat", 0x720: "information",
}  # fmt: skip
"""First identifiers of the blocks that have the node's number at their end."""


def named_stranger(identifier: int) -> str:
    """What a frame may be that the database does not know, by the plan of its identifiers."""
    what = _BLOCKS.get(identifier & ~0x0F)
    return f"0x{identifier:03X}" + (f": {what} of an unknown node {identifier & 0x0F}" if what else "")
