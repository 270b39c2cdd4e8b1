"""Vehicles that turn so fast that no mission of theirs would end: refused before it is flown."""

from stommel.errors import StommelError
from stommel.simulation.timing import Loop

MOST_STEPS = 1000
"""Integration steps in a control step; as many as a mission file may ask for."""
_FASTEST_M_S = 2.0
"""Speed up to which a mission must go on."""
_STABLE = 1.25
"""Integration step times the rate of a damping; as in the mission loop while an actuator moves."""


class StiffnessError(StommelError):
    """A vehicle too stiff to be flown in time."""


def refuse_stiffness(loop: Loop) -> None:
    """Refuse a vehicle whose damping or fastest mode asks for far too many integration steps.

    Raises
    ------
    StiffnessError
        With the time constant and what makes it so.
    """
    rate = loop.damping * _FASTEST_M_S**2
    if max(loop.steady_steps, loop.moving_steps) > MOST_STEPS:
        rate = max(rate, loop.moving_steps / loop.control_step)
    if loop.control_step * rate / _STABLE > MOST_STEPS:
        raise StiffnessError(
            f"the vehicle is too stiff to be flown: its rotation is damped within {1.0 / rate:.2g} s, which takes more "
            f"than {MOST_STEPS} integration steps in each integration.control_step_s = {loop.control_step:g}; look at "
            "hydrodynamics.roll_damping_kg_s, pitch_damping_kg_s and yaw_damping_kg_s against rigid_body.inertia_kg_m2"
        )
