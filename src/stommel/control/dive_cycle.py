"""The dive cycle as a table of transitions: surface, descent, inflection, ascent, and the way out (compiled)."""

from typing import NamedTuple

from stommel.dynamics.compilation import compiled, inlined

SURFACE, DESCENT, INFLECTION, ASCENT, RECOVERY = range(5)
PHASES = ("surface", "descent", "inflection", "ascent", "recovery")
"""Names of the phases; in recovery the vehicle stays at the surface and calls."""

NOTHING, ABORT_DEPTH, ABORT_TIME, ABORT_BATTERY, ABORT_LEAK, MISSION_COMPLETE, BOTTOM_AHEAD, TARGET_REACHED = range(8)
EVENTS = (
    "nothing",
    "abort: too deep",
    "abort: dive too long",
    "abort: battery low",
    "abort: leak",
    "mission complete",
    "bottom ahead",
    "target depth reached",
)


class DivePlan(NamedTuple):
    """What one dive is asked to do; SI units and radians."""

    depth: float
    """Depth at which the vehicle turns [m]."""
    theta: float
    """Magnitude of the pitch [rad]."""
    V_b_dive: float
    """Ballast volume of the descent [m3], negative."""
    V_b_climb: float
    """Ballast volume of the ascent [m3], positive."""
    V_b_surface: float
    """Ballast volume at the surface, to raise the antenna [m3]."""
    surface_time: float
    """Time at the surface for position and radio [s]."""
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


@compiled
def next_dive_state(
    state: DiveState, plan: DivePlan, t: float, depth: float, altitude: float, ballast: float, wanted: bool
) -> DiveState:
    """Advance the cycle by measurements.

    Parameters
    ----------
    t
        Time of the mission [s].
    depth, altitude
        Measured depth, and height above the bottom (infinite where none is heard) [m].
    ballast
        Measured ballast volume [m3].
    wanted
        Whether the mission wants another dive.
    """
    phase = int(state.phase)
    if phase == SURFACE:
        return _at_surface(state, plan, t, wanted)
    if phase == DESCENT:
        return _descending(state, plan, t, depth, altitude)
    if phase == INFLECTION and ballast >= 0.0:
        return _enter(state, ASCENT, t, int(state.event))
    if phase == ASCENT:
        return _climbing(state, plan, t, depth, wanted)
    return state


@inlined
def _at_surface(state: DiveState, plan: DivePlan, t: float, wanted: bool) -> DiveState:
    if t - state.since < plan.surface_time:
        return state
    if not wanted:
        return _enter(state, RECOVERY, t, MISSION_COMPLETE)
    return DiveState(float(DESCENT), t, t, state.dives + 1.0, 1.0, state.event)


@inlined
def _descending(state: DiveState, plan: DivePlan, t: float, depth: float, altitude: float) -> DiveState:
    if depth > plan.abort_depth:
        return _enter(state, INFLECTION, t, ABORT_DEPTH)
    if t - state.submerged_since > plan.abort_time:
        return _enter(state, INFLECTION, t, ABORT_TIME)
    if depth >= plan.depth:
        return _enter(state, INFLECTION, t, TARGET_REACHED)
    if altitude <= plan.least_altitude:
        return _enter(state, INFLECTION, t, BOTTOM_AHEAD)
    return state


@inlined
def _climbing(state: DiveState, plan: DivePlan, t: float, depth: float, wanted: bool) -> DiveState:
    again = wanted and state.dives_here < plan.dives_per_surfacing and int(state.event) != ABORT_TIME
    if again and depth <= plan.turn_depth:
        return DiveState(
            float(DESCENT), t, state.submerged_since, state.dives + 1.0, state.dives_here + 1.0, state.event
        )
    if depth <= plan.shallow_depth:
        return _enter(state, SURFACE, t, int(state.event))
    return state


@inlined
def _enter(state: DiveState, phase: int, t: float, event: int) -> DiveState:
    return DiveState(float(phase), t, state.submerged_since, state.dives, state.dives_here, float(event))


@compiled
def wanted_ballast(state: DiveState, plan: DivePlan) -> float:
    """Ballast volume that the phase asks for [m3]."""
    phase = int(state.phase)
    if phase == DESCENT:
        return plan.V_b_dive
    if phase in (SURFACE, RECOVERY):
        return plan.V_b_surface
    return plan.V_b_climb


@compiled
def wanted_pitch(state: DiveState, plan: DivePlan) -> float:
    """Pitch that the phase asks for [rad]."""
    return -plan.theta if int(state.phase) == DESCENT else plan.theta
