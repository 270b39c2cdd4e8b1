"""The mission executive: a table of states above the dive cycle, from start-up to recovery and abort.

`stommel.control` decides how to fly; the executive decides whether. Above control's dive cycle it knows seven states;
while the mission is flown, control's phases are shown as they are. In every state of its own the executive asks for the
greatest ballast: whatever goes wrong, the vehicle comes up.
"""

from collections.abc import Callable
from enum import Enum
from typing import NamedTuple

from stommel.control.dive_cycle import PHASES, RECOVERY, SURFACE
from stommel.onboard.coordination.failsafes import Reaction
from stommel.onboard.coordination.safety import SafetyState
from stommel.onboard.coordination.situation import NO_REQUESTS, OperatorRequests, Situation

CHECK_TIME = 900.0
"""How long start-up waits for what is unproven before it holds and calls [s]; a cold GPS needs some minutes."""
SELF_TESTED = ("pump", "moving mass", "steering")
"""Start checks that a self-test of the motion node proves."""


class State(Enum):
    """States of the executive, and their words."""

    START_UP = "start-up"
    HOLD = "hold"
    COMMUNICATE = "communicate"
    MISSION = "mission"
    ASCEND = "ascend"
    RECOVER = "recover"
    ABORT = "abort"


STATE_WORDS = {
    State.START_UP: "at the surface, the start checks run",
    State.HOLD: "at the surface, calling: no mission, not told to start, or something forbids a dive",
    State.COMMUNICATE: "at the surface in a mission: position, radio, new orders",
    State.MISSION: "under water: control flies its descents, inflections, ascents and drifts",
    State.ASCEND: "the dive has ended early: greatest ballast, nose up, until the surface",
    State.RECOVER: "at the surface, calling: the mission is over",
    State.ABORT: "last reaction: greatest ballast, nose up, rudder amidships; at the surface it calls",
}
FLOWN = frozenset((State.COMMUNICATE, State.MISSION, State.RECOVER))
"""States in which control's commands are obeyed."""
COMING_UP = frozenset((State.ASCEND, State.ABORT))
"""States in which the executive brings the vehicle up."""


class View(NamedTuple):
    """What a condition looks at."""

    now: Situation
    safety: SafetyState
    asked: OperatorRequests
    started: bool
    """Whether the operator has started the mission."""
    since: float
    """When the state began [s]."""


class Condition(NamedTuple):
    """What a transition waits for."""

    words: str
    holds: Callable[[View], bool]


def _surfaced(view: View) -> bool:
    """Whether it is known that the vehicle is at the surface."""
    return not view.safety.submerged and (not view.now.pressure_silent or view.now.readings.fixed)


def _may_fly(view: View) -> bool:
    now = view.now
    return view.safety.worst < Reaction.NO_DIVE and view.started and now.mission_present and not view.safety.unproven


LAST_REACTION = Condition(
    "safety or the operator asks for the last reaction",
    lambda view: view.safety.worst >= Reaction.ABORT or view.asked.abort,
)
UNDER_WATER = Condition("it is under water", lambda view: view.safety.submerged)
CHECKED = Condition(
    "every start check but that of the mission has passed",
    lambda view: not view.safety.unproven or view.safety.unproven == ("mission",),
)
CHECK_TIME_OVER = Condition("the start checks take too long", lambda view: view.now.t - view.since >= CHECK_TIME)
CHECKS_ASKED = Condition("the operator asks for the start checks", lambda view: view.asked.check)
BEGINS_ANEW = Condition(
    "the operator starts a mission, or asks for the start checks", lambda view: view.asked.start or view.asked.check
)
MAY_FLY = Condition("told to start, mission valid, all proven, no alarm forbids it", _may_fly)
MAY_NOT_FLY = Condition("an alarm, a missing proof or the operator forbids a dive", lambda view: not _may_fly(view))
CONTROL_OVER = Condition("control is in recovery", lambda view: view.now.phase == RECOVERY)
CONTROL_DIVES = Condition("control dives", lambda view: view.now.phase not in (SURFACE, RECOVERY))
CONTROL_SURFACED = Condition("control is at the surface", lambda view: view.now.phase == SURFACE)
DIVE_ENDS = Condition(
    "safety or the operator ends the dive, or there is no mission",
    lambda view: view.safety.worst >= Reaction.SURFACE or view.asked.surface or not view.now.mission_present,
)
AT_SURFACE = Condition("it is at the surface", _surfaced)
CLEARED = Condition(
    "the operator clears, and no alarm that asks for the last reaction is left",
    lambda view: view.asked.clear and view.safety.worst < Reaction.ABORT and not view.asked.abort,
)


class Transition(NamedTuple):
    """One way out of a state."""

    state: State
    condition: Condition
    next: State


TRANSITIONS = (
    Transition(State.START_UP, LAST_REACTION, State.ABORT),
    # a brown-out in the middle of a dive: nothing is known but the depth
    Transition(State.START_UP, UNDER_WATER, State.ASCEND),
    Transition(State.START_UP, CHECKED, State.HOLD),
    Transition(State.START_UP, CHECK_TIME_OVER, State.HOLD),
    Transition(State.HOLD, LAST_REACTION, State.ABORT),
    Transition(State.HOLD, UNDER_WATER, State.ASCEND),
    Transition(State.HOLD, CHECKS_ASKED, State.START_UP),
    Transition(State.HOLD, CONTROL_OVER, State.RECOVER),
    Transition(State.HOLD, MAY_FLY, State.COMMUNICATE),
    Transition(State.COMMUNICATE, LAST_REACTION, State.ABORT),
    Transition(State.COMMUNICATE, CONTROL_OVER, State.RECOVER),
    Transition(State.COMMUNICATE, MAY_NOT_FLY, State.HOLD),
    Transition(State.COMMUNICATE, CONTROL_DIVES, State.MISSION),
    Transition(State.MISSION, LAST_REACTION, State.ABORT),
    Transition(State.MISSION, DIVE_ENDS, State.ASCEND),
    Transition(State.MISSION, CONTROL_OVER, State.RECOVER),
    Transition(State.MISSION, CONTROL_SURFACED, State.COMMUNICATE),
    Transition(State.ASCEND, LAST_REACTION, State.ABORT),
    Transition(State.ASCEND, AT_SURFACE, State.START_UP),
    Transition(State.RECOVER, LAST_REACTION, State.ABORT),
    Transition(State.RECOVER, UNDER_WATER, State.ASCEND),
    Transition(State.RECOVER, BEGINS_ANEW, State.START_UP),
    Transition(State.ABORT, CLEARED, State.START_UP),
)
"""The executive: of the rows of a state, in their order, the first whose condition holds is taken; if none does, it
stays. At most one is taken at a decision."""

_WAYS_OUT = {state: tuple((row.condition.holds, row) for row in TRANSITIONS if row.state is state) for state in State}


class ExecutiveState(NamedTuple):
    """What the executive says at one decision."""

    state: State
    since: float
    """When it began [s]."""
    because: str
    """Words of the condition by which it began; of an abort, of what asked for it."""
    phase: int
    """Of control's dive cycle."""
    surfaced: bool
    """Whether it is known that the vehicle is at the surface."""
    surfaced_since: float
    """When it came to the surface [s]; infinite under water."""
    blind: bool
    """Whether the depth is unknown."""
    no_dive: bool
    """Whether no dive may begin."""
    drop_weight: bool
    """Whether the drop weight shall go; once asked for, until the abort is cleared."""
    reason: str
    """Word for the abort in the CAN database's `Abort.reason`; `None` in other states."""
    started: bool
    """Whether the operator has started the mission; kept by the caller over a restart."""
    self_test: bool
    """Whether the motion node shall test its drives: start-up at the surface, and they are unproven."""
    t: float
    """Time of this decision [s]."""

    @property
    def coming_up(self) -> bool:
        """Whether the executive brings the vehicle up."""
        return self.state in COMING_UP

    @property
    def words(self) -> str:
        """State, and in a mission control's phase."""
        return f"mission: {PHASES[self.phase]}" if self.state is State.MISSION else self.state.value


class Executive:
    """Goes from state to state.

    Parameters
    ----------
    started
        Whether the operator had started the mission before this software was switched on.
    """

    def __init__(self, *, started: bool = False) -> None:
        self._state = State.START_UP
        self._since: float | None = None
        self._because = "switched on"
        self._started = started
        self._drop_weight = False
        self._reason = "None"
        self._surfaced_since = float("inf")

    def update(self, now: Situation, safety: SafetyState, requests: OperatorRequests = NO_REQUESTS) -> ExecutiveState:
        """Look at the next situation, and at what safety and operator say of it."""
        if self._since is None:
            self._since = now.t
        if requests is not NO_REQUESTS:
            self._started = (self._started or requests.start) and not (requests.hold or requests.abort)
        view = View(now, safety, requests, self._started, self._since)
        for holds, row in _WAYS_OUT[self._state]:
            if holds(view):
                self._enter(row, view)
                break
        if self._state is State.ABORT:
            self._drop_weight = self._drop_weight or safety.worst >= Reaction.DROP_WEIGHT
        return self._told(view)

    def _enter(self, row: Transition, view: View) -> None:
        self._state, self._since, self._because = row.next, view.now.t, row.condition.words
        if row.next in (State.ABORT, State.RECOVER):
            self._started = False
        if row.next is State.ABORT:
            alarms = [alarm.name for alarm in view.safety.active if alarm.reaction >= Reaction.ABORT]
            self._because = ", ".join(alarms) or "the operator asks for it"
            self._reason = view.safety.reason if alarms else "Operator"
        elif row.state is State.ABORT:
            self._reason, self._drop_weight = "None", False

    def _told(self, view: View) -> ExecutiveState:
        now, safety = view.now, view.safety
        surfaced = _surfaced(view)
        if not surfaced:
            self._surfaced_since = float("inf")
        elif self._surfaced_since == float("inf"):
            self._surfaced_since = now.t
        no_dive = not _may_fly(view)
        self_test = self._state is State.START_UP and surfaced and any(name in SELF_TESTED for name in safety.unproven)
        since = now.t if self._since is None else self._since
        return ExecutiveState(
            self._state, since, self._because, now.phase, surfaced, self._surfaced_since, now.pressure_silent,
            no_dive, self._drop_weight, self._reason, self._started, self_test, now.t,
        )  # fmt: skip
