"""The dive cycle as a table of transitions: surface, descent, drift, inflection, ascent, and the way out (compiled)."""

from typing import NamedTuple

import numpy as np

from stommel.compilation import compiled, inlined
from stommel.control.commands import LOAD_CLIMB, LOAD_DIVE, LOAD_DRIFT, LOAD_SURFACE, LOAD_UNDERWATER

SURFACE, DESCENT, INFLECTION, ASCENT, RECOVERY, DRIFT = range(6)
PHASES = ("surface", "descent", "inflection", "ascent", "recovery", "drift")
"""Names of the phases; in recovery the vehicle stays at the surface and calls, in drift it hangs in the water."""

(
    NOTHING, ABORT_DEPTH, ABORT_TIME, ABORT_BATTERY, ABORT_LEAK, MISSION_COMPLETE, BOTTOM_AHEAD, TARGET_REACHED,
    ABORT_PRESSURE,
) = range(9)  # fmt: skip
EVENTS = (
    "nothing",
    "abort: too deep",
    "abort: dive too long",
    "abort: battery low",
    "abort: leak",
    "mission complete",
    "bottom ahead",
    "target depth reached",
    "abort: pressure inside the hull",
)
MISSION_ENDS = (ABORT_BATTERY, ABORT_LEAK, ABORT_PRESSURE)
"""Alarms after which the vehicle comes up and stays; too deep and too long only end the dive."""


class DivePlan(NamedTuple):
    """What one dive is asked to do; SI units and radians."""

    depth: float
    """Greatest depth of a dive, and the depth of a drift [m]."""
    turns_early: float
    """Way above it at which the vehicle turns, because it goes on sinking meanwhile [m]."""
    theta: float
    """Magnitude of the pitch [rad]."""
    V_b_dive: float
    """Ballast volume of the descent [m3], negative."""
    V_b_climb: float
    """Ballast volume of the ascent [m3], positive."""
    V_b_surface: float
    """Ballast volume at the surface, to raise the antenna [m3]."""
    V_b_drift: float
    """Ballast volume that is neutral at `depth` [m3]."""
    r_px_drift: float
    """Moving-mass position at which it then lies level [m]."""
    r_px_surface: float
    """Moving-mass position at the surface, which raises the antenna [m]; not a number: where the ascent left it."""
    surface_time: float
    """Time at the surface for position and radio [s]."""
    longest_surface_time: float
    """How long the vehicle waits at the surface for a position that does not come [s]."""
    drift_time: float
    """How long it hangs in the water at the turn [s]."""
    surfacing_interval: float
    """Time under water after which the next ascent goes to the surface [s]."""
    least_altitude: float
    """Height above the bottom at which the vehicle turns [m]."""
    shallow_depth: float
    """The vehicle counts as surfaced when it is no deeper than this [m]."""
    dives_per_surfacing: float
    """Dives between two stays at the surface; between them the vehicle turns at `turn_depth`."""
    turn_depth: float
    """Depth at which a dive that does not surface begins [m]."""
    abort_depth: float
    """Too deep [m]."""
    abort_time: float
    """Too long without a surfacing [s]."""


class DiveState(NamedTuple):
    """Where in the cycle the vehicle is."""

    phase: float
    since: float
    """Time of the mission at which the phase began [s]."""
    submerged_since: float
    """Time at which the vehicle left the surface [s]."""
    dives: float
    """Dives begun."""
    dives_here: float
    """Dives since the last stay at the surface."""
    event: float
    """What happened last; stays until something else happens."""


class Situation(NamedTuple):
    """What the vehicle knows when it decides on the phase."""

    depth: float
    """Measured depth [m]."""
    altitude: float
    """Measured height above the bottom [m]; infinite where none is heard."""
    ballast: float
    """Measured ballast volume [m3]."""
    wanted: bool
    """Whether the mission wants another dive."""
    fixed: bool
    """Whether a position has been found since it surfaced."""
    alarm: int
    """One of `MISSION_ENDS`, or `NOTHING`."""


(
    CALLS, ALARMED, NO_MORE_WANTED, READY, TOO_DEEP, TOO_LONG, BOTTOM_NEAR, AT_DEPTH_TO_DRIFT, AT_DEPTH, DRIFTED,
    BUOYANT, DIVES_AGAIN, SHALLOW,
) = range(13)  # fmt: skip
CONDITIONS = (
    "still calls, or waits for a position",
    "an alarm",
    "no dive wanted",
    "otherwise",
    "deeper than the abort depth",
    "longer under water than allowed",
    "bottom within the least altitude",
    "at the depth, and told to drift",
    "at the depth",
    "drifted long enough",
    "oil outside: buoyant",
    "at the upper turn, another dive wanted",
    "shallow, or climbing longer than allowed",
)
"""What a transition waits for, in words."""

KEPT, THE_ALARM = -1, -2
"""Reasons that the table does not name itself: that of before, and that of the alarm."""


class Transition(NamedTuple):
    """One way out of a phase."""

    phase: int
    condition: int
    reason: int
    """One of `EVENTS`, `KEPT` or `THE_ALARM`."""
    next: int


TRANSITIONS = (
    Transition(SURFACE, CALLS, KEPT, SURFACE),
    Transition(SURFACE, ALARMED, THE_ALARM, RECOVERY),
    Transition(SURFACE, NO_MORE_WANTED, MISSION_COMPLETE, RECOVERY),
    Transition(SURFACE, READY, KEPT, DESCENT),
    Transition(DESCENT, ALARMED, THE_ALARM, INFLECTION),
    Transition(DESCENT, TOO_DEEP, ABORT_DEPTH, INFLECTION),
    Transition(DESCENT, TOO_LONG, ABORT_TIME, INFLECTION),
    Transition(DESCENT, BOTTOM_NEAR, BOTTOM_AHEAD, INFLECTION),
    Transition(DESCENT, AT_DEPTH_TO_DRIFT, TARGET_REACHED, DRIFT),
    Transition(DESCENT, AT_DEPTH, TARGET_REACHED, INFLECTION),
    Transition(INFLECTION, BUOYANT, KEPT, ASCENT),
    Transition(ASCENT, DIVES_AGAIN, KEPT, DESCENT),
    # a pressure sensor that never says shallow must not keep the vehicle from calling
    Transition(ASCENT, SHALLOW, KEPT, SURFACE),
    Transition(DRIFT, ALARMED, THE_ALARM, INFLECTION),
    Transition(DRIFT, TOO_DEEP, ABORT_DEPTH, INFLECTION),
    Transition(DRIFT, TOO_LONG, ABORT_TIME, INFLECTION),
    Transition(DRIFT, BOTTOM_NEAR, BOTTOM_AHEAD, INFLECTION),
    Transition(DRIFT, DRIFTED, TARGET_REACHED, INFLECTION),
)
"""The dive cycle: of the rows of a phase, in the order of the phases, the first whose condition holds is taken. A row
back to its own phase stays there; recovery has no way out."""

_ROWS = np.array(TRANSITIONS, dtype=np.int64)
_FIRST = np.searchsorted(_ROWS[:, 0], np.arange(len(PHASES) + 1))
"""Where the rows of each phase begin."""


@compiled
def next_dive_state(state: DiveState, plan: DivePlan, t: float, situation: Situation) -> DiveState:
    """Advance the cycle by measurements, at time `t` of the mission [s]."""
    phase = int(state.phase)
    for k in range(_FIRST[phase], _FIRST[phase + 1]):
        if _holds(_ROWS[k, 1], state, plan, t, situation):
            return _entered(state, _ROWS[k, 3], t, _ROWS[k, 2], situation.alarm)
    return state


@inlined
def _holds(condition: int, state: DiveState, plan: DivePlan, t: float, now: Situation) -> bool:  # noqa: PLR0911 - one line a condition
    if condition == CALLS:
        waited = t - state.since
        return waited < plan.surface_time or not (now.fixed or waited >= plan.longest_surface_time)
    if condition == ALARMED:
        return now.alarm != NOTHING
    if condition == NO_MORE_WANTED:
        return not now.wanted
    if condition == TOO_DEEP:
        return now.depth > plan.abort_depth
    if condition == TOO_LONG:
        return t - state.submerged_since > plan.abort_time
    if condition == BOTTOM_NEAR:
        return now.altitude <= plan.least_altitude
    if condition == AT_DEPTH_TO_DRIFT:
        return now.depth >= plan.depth - plan.turns_early and plan.drift_time > 0.0
    if condition == AT_DEPTH:
        return now.depth >= plan.depth - plan.turns_early
    if condition == DRIFTED:
        return t - state.since >= plan.drift_time
    if condition == BUOYANT:
        return now.ballast >= 0.0
    if condition == DIVES_AGAIN:
        time_left = t - state.submerged_since < plan.surfacing_interval and int(state.event) != ABORT_TIME
        more = now.wanted and now.alarm == NOTHING and time_left and state.dives_here < plan.dives_per_surfacing
        return more and now.depth <= plan.turn_depth
    if condition == SHALLOW:
        return now.depth <= plan.shallow_depth or t - state.since > plan.abort_time
    return True


@inlined
def _entered(state: DiveState, phase: int, t: float, reason: int, alarm: int) -> DiveState:
    """The next state; a descent begins a dive, from the surface the first of its stay under water."""
    if phase == int(state.phase):
        return state
    event = state.event if reason == KEPT else float(alarm) if reason == THE_ALARM else float(reason)
    submerged_since, dives, dives_here = state.submerged_since, state.dives, state.dives_here
    if phase == DESCENT:
        dives += 1.0
        dives_here += 1.0
        if int(state.phase) == SURFACE:
            submerged_since, dives_here = t, 1.0
    return DiveState(float(phase), t, submerged_since, dives, dives_here, event)


@compiled
def wanted_ballast(state: DiveState, plan: DivePlan) -> float:
    """Ballast volume that the phase asks for [m3]."""
    phase = int(state.phase)
    if phase == DESCENT:
        return plan.V_b_dive
    if phase == DRIFT:
        return plan.V_b_drift
    if phase in (SURFACE, RECOVERY):
        return plan.V_b_surface
    return plan.V_b_climb


@compiled
def wanted_pitch(state: DiveState, plan: DivePlan) -> float:
    """Pitch that the phase asks for [rad]."""
    phase = int(state.phase)
    if phase == DRIFT:
        return 0.0
    return -plan.theta if phase == DESCENT else plan.theta


@inlined
def wanted_loads(phase: int) -> int:
    """Groups of consumers that are on in a phase, bits of `stommel.control.commands`."""
    if phase in (SURFACE, RECOVERY):
        return LOAD_SURFACE
    leg = LOAD_DIVE if phase == DESCENT else LOAD_DRIFT if phase == DRIFT else LOAD_CLIMB
    return LOAD_UNDERWATER | leg
