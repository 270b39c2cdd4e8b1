"""States of a node and the ways between them, as one table that both nodes follow."""

from enum import Enum
from typing import NamedTuple

from stommel.messages.nodes import NodeState


class Mode(Enum):
    """What a node is about."""

    INITIALISING = "initialising"
    PRE_OPERATIONAL = "pre-operational"
    OPERATIONAL = "operational"
    STOPPED = "stopped"
    BRAKED = "braked"
    QUIET = "quiet"
    LEFT_ALONE = "left alone"
    ABORTED = "aborted"


class Event(Enum):
    """What takes a node from one mode to another."""

    READY = "its first step is done"
    START = "command Start"
    STOP = "command Stop"
    BRAKE = "command Brake"
    CLEAR = "command ClearFault"
    RESTART = "command Restart"
    SYNC = "a Sync is heard"
    SILENCE = "no Sync for `quiet_after`"
    LONG_SILENCE = "no Sync for `blow_after` or `rest_after`"
    ABORT = "an Abort, or command Blow"
    STRANGER = "the coordinator has another CAN database"


class Transition(NamedTuple):
    """One row of the table."""

    mode: Mode
    event: Event
    next: Mode | None
    """None: the mode before the silence or the abort."""


STATES = {
    Mode.INITIALISING: NodeState.Initialising,
    Mode.PRE_OPERATIONAL: NodeState.PreOperational,
    Mode.OPERATIONAL: NodeState.Operational,
    Mode.STOPPED: NodeState.Stopped,
    Mode.BRAKED: NodeState.Safe,
    Mode.QUIET: NodeState.Safe,
    Mode.LEFT_ALONE: NodeState.Safe,
    Mode.ABORTED: NodeState.Safe,
}
"""What the heartbeat says in each mode."""

_AWAKE = (Mode.PRE_OPERATIONAL, Mode.OPERATIONAL, Mode.STOPPED, Mode.BRAKED)

TRANSITIONS = (
    Transition(Mode.INITIALISING, Event.READY, Mode.PRE_OPERATIONAL),
    *(Transition(mode, Event.START, Mode.OPERATIONAL) for mode in (*_AWAKE, Mode.ABORTED)),
    *(Transition(mode, Event.STOP, Mode.STOPPED) for mode in _AWAKE),
    *(Transition(mode, Event.BRAKE, Mode.BRAKED) for mode in (Mode.OPERATIONAL, Mode.BRAKED)),
    Transition(Mode.BRAKED, Event.CLEAR, Mode.OPERATIONAL),
    Transition(Mode.ABORTED, Event.CLEAR, None),
    Transition(Mode.OPERATIONAL, Event.STRANGER, Mode.PRE_OPERATIONAL),
    Transition(Mode.BRAKED, Event.STRANGER, Mode.PRE_OPERATIONAL),
    *(Transition(mode, Event.SILENCE, Mode.QUIET) for mode in _AWAKE),
    Transition(Mode.QUIET, Event.LONG_SILENCE, Mode.LEFT_ALONE),
    Transition(Mode.QUIET, Event.SYNC, None),
    Transition(Mode.LEFT_ALONE, Event.SYNC, None),
    *(Transition(mode, Event.ABORT, Mode.ABORTED) for mode in Mode),
    *(Transition(mode, Event.RESTART, Mode.INITIALISING) for mode in Mode),
)
"""All ways between the modes; an event without a row in a mode does nothing there."""

_NEXT = {(row.mode, row.event): row for row in TRANSITIONS}


class Modes:
    """The mode of one node."""

    def __init__(self) -> None:
        self.mode = Mode.INITIALISING
        self._before = Mode.PRE_OPERATIONAL

    def take(self, event: Event) -> bool:
        """Follow an event; return whether the table has a row for it in this mode."""
        row = _NEXT.get((self.mode, event))
        if row is None:
            return False
        following = self._before if row.next is None else row.next
        if self.mode in _AWAKE:
            # a braked drive is no fault of the bus: what was held stays held
            self._before = self.mode
        self.mode = following
        return True

    @property
    def state(self) -> NodeState:
        """What the heartbeat says."""
        return STATES[self.mode]
