"""The dive cycle as a table of transitions: surface, descent, drift, inflection, ascent, and the way out (compiled)."""

from typing import NamedTuple

from stommel.compilation import compiled, inlined

SURFACE, DESCENT, INFLECTION, ASCENT, RECOVERY, DRIFT = range(6)
PHASES = ("surface", "descent", "inflection", "ascent", "recovery", "drift")
"""Names of the phases; in recovery the vehicle stays at the surface and calls, in drift it hangs in the water."""

(
    NOTHING, ABORT_DEPTH, ABORT_TIME, ABORT_BATTERY, ABORT_LEAK, MISSION_COMPLETE, BOTTOM_AHEAD, TARGET_REACHED,
    ABORT_PRESSURE, OUTSIDE_DATA,
) = range(10)  # fmt: skip
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
    "outside the ocean's data",
)
MISSION_ENDS = (ABORT_BATTERY, ABORT_LEAK, ABORT_PRESSURE)
"""Alarms after which the vehicle comes up and stays; too deep and too long only end the dive."""


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


class Readings(NamedTuple):
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


@compiled
def next_dive_state(state: DiveState, plan: DivePlan, t: float, readings: Readings) -> DiveState:
    """Advance the cycle by measurements, at time `t` of the mission [s]."""
    phase = int(state.phase)
    if phase == SURFACE:
        return _at_surface(state, plan, t, readings)
    if phase in (DESCENT, DRIFT):
        return _below(state, plan, t, readings)
    if phase == INFLECTION and readings.ballast >= 0.0:
        return _enter(state, ASCENT, t, int(state.event))
    if phase == ASCENT:
        return _climbing(state, plan, t, readings)
    return state


@inlined
def _at_surface(state: DiveState, plan: DivePlan, t: float, readings: Readings) -> DiveState:
    waited = t - state.since
    if waited < plan.surface_time or not (readings.fixed or waited >= plan.longest_surface_time):
        return state
    if readings.alarm != NOTHING:
        return _enter(state, RECOVERY, t, readings.alarm)
    if not readings.wanted:
        return _enter(state, RECOVERY, t, MISSION_COMPLETE)
    return DiveState(float(DESCENT), t, t, state.dives + 1.0, 1.0, state.event)


@inlined
def _below(state: DiveState, plan: DivePlan, t: float, readings: Readings) -> DiveState:
    """Descent and drift: whether to turn upwards, and why."""
    if readings.alarm != NOTHING:
        return _enter(state, INFLECTION, t, readings.alarm)
    if readings.depth > plan.abort_depth:
        return _enter(state, INFLECTION, t, ABORT_DEPTH)
    if t - state.submerged_since > plan.abort_time:
        return _enter(state, INFLECTION, t, ABORT_TIME)
    if readings.altitude <= plan.least_altitude:
        return _enter(state, INFLECTION, t, BOTTOM_AHEAD)
    if int(state.phase) == DRIFT:
        return _enter(state, INFLECTION, t, TARGET_REACHED) if t - state.since >= plan.drift_time else state
    if readings.depth >= plan.depth:
        return _enter(state, DRIFT if plan.drift_time > 0.0 else INFLECTION, t, TARGET_REACHED)
    return state


@inlined
def _climbing(state: DiveState, plan: DivePlan, t: float, readings: Readings) -> DiveState:
    time_left = t - state.submerged_since < plan.surfacing_interval and int(state.event) != ABORT_TIME
    again = readings.wanted and readings.alarm == NOTHING and time_left and state.dives_here < plan.dives_per_surfacing
    if again and readings.depth <= plan.turn_depth:
        return DiveState(
            float(DESCENT), t, state.submerged_since, state.dives + 1.0, state.dives_here + 1.0, state.event
        )
    # a pressure sensor that never says shallow must not keep the vehicle from calling
    if readings.depth <= plan.shallow_depth or t - state.since > plan.abort_time:
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
