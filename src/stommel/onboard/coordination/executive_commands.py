"""What goes to actuators and decision in each state of the executive."""

import math

import numpy as np

from stommel.control.commands import ABORTED, GOING_ON, Commands
from stommel.control.dive_cycle import ASCENT, DESCENT, DRIFT, INFLECTION, NOTHING, SURFACE, wanted_loads
from stommel.onboard.coordination.executive import FLOWN, ExecutiveState, State
from stommel.onboard.coordination.limits import ActuatorLimits

CALLING_AFTER = 60.0
"""At the surface for this time, an aborted vehicle is up to stay, and turns its antenna out of the water [s]."""
CALLS_FOR = 600.0
"""How long an aborted vehicle calls at the surface before it counts as ended [s]; it goes on calling."""
_LOADS_UP, _LOADS_SURFACE = wanted_loads(ASCENT), wanted_loads(SURFACE)


def commands(state: ExecutiveState, control: Commands | None, limits: ActuatorLimits) -> Commands:
    """Return what the actuators shall do until the next decision.

    Parameters
    ----------
    state
        What the executive says.
    control
        What `stommel.control` wants; after an exception its last commands; None where it cannot decide.
    limits
        Of the actuators.

    Returns
    -------
    Commands
        In the states that control flies its own, within the limits. In all others, and where control gives none or one
        that is no number: greatest ballast, steering amidships, nose up under water.
    """
    if state.state in FLOWN and control is not None:
        r_px, V_b, steering = control.r_px, control.V_b, control.steering
        within = (
            limits.r_px_aft <= r_px <= limits.r_px_fore
            and limits.V_b_least <= V_b <= limits.V_b_greatest
            and -limits.steering <= steering <= limits.steering
        )
        if within:
            return control
        if math.isfinite(r_px + V_b + steering):
            return control._replace(
                r_px=min(max(r_px, limits.r_px_aft), limits.r_px_fore),
                V_b=min(max(V_b, limits.V_b_least), limits.V_b_greatest),
                steering=min(max(steering, -limits.steering), limits.steering),
            )
    return _upward(state, limits)


def _upward(state: ExecutiveState, limits: ActuatorLimits) -> Commands:
    """Commands of the executive itself."""
    at_surface_for = state.t - state.surfaced_since
    r_px, ended = limits.r_px_nose_up, GOING_ON
    if state.state is State.ABORT:
        if at_surface_for >= CALLING_AFTER:
            r_px = limits.r_px_calling
        if at_surface_for >= CALLS_FOR:
            ended = ABORTED
    elif state.surfaced:
        r_px = limits.r_px_surface
    loads = _LOADS_SURFACE if state.surfaced else _LOADS_UP
    # a vehicle that does not know its depth calls at any: it may be up
    radio = state.surfaced or state.blind
    return Commands(r_px, limits.V_b_greatest, 0.0, limits.hold_mass, loads, False, radio, ended)


def instruct(memory: np.record, state: ExecutiveState, step: float) -> None:
    """Tell the decision, before it decides, what the executive wants, so that both say the same.

    Parameters
    ----------
    memory
        Of `stommel.control`; changed in place. A dive that has ended early is an inflection, then an ascent to the
        surface; a vehicle that may not dive goes on calling there; software that wakes up under water ascends.
    state
        What the executive says.
    step
        Between two decisions [s].
    """
    if state.state in FLOWN and not state.no_dive:
        return
    memory.dives_here = math.inf  # the next ascent goes to the surface
    if state.state in FLOWN:
        return
    phase, t = int(memory.phase), state.t
    if phase in (DESCENT, DRIFT):
        memory.phase, memory.since = INFLECTION, t
    elif phase == SURFACE and not state.surfaced and not state.blind:
        memory.phase, memory.since, memory.submerged_since = ASCENT, t, t
    elif phase == SURFACE and memory.alarm == NOTHING and memory.under_way != 0:
        memory.since = t + step  # its stay begins with the next decision, again and again
