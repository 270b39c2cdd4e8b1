"""How time goes in a mission: control steps, integration steps, looks at the ocean."""

from math import ceil
from typing import NamedTuple

import numpy as np

from stommel.analysis.flight_table import fastest_mode
from stommel.control.dive_cycle import DivePlan
from stommel.planning.ballasting import drives
from stommel.simulation.scenario.mission import Mission
from stommel.simulation.scenario.scenario_file import ScenarioFile
from stommel.vehicle import PHYSICS


class Loop(NamedTuple):
    """How time goes."""

    start: float
    """Start of the mission [s since 1970-01-01 UTC]."""
    control_step: float
    """Between two decisions [s]."""
    steady_steps: int
    """Integration steps in a control step while nothing moves."""
    moving_steps: int
    """Integration steps in a control step while an actuator moves or the vehicle answers it."""
    damping: float
    """Fastest damping of the vehicle's rotation, over the square of its speed [s/m2]."""
    settle_time: float
    """How long the vehicle answers [s]."""
    column_period: float
    """Between two looks at the ocean around the vehicle [s]."""
    record_every: int
    """Control steps between two rows of output."""


def column_step(scenario: ScenarioFile) -> float:
    """Distance of the column's depths [m]: fine in a pool, 2 m at sea."""
    return min(2.0, scenario.dives.depth_m / 20.0)


FASTEST_STEADY, FASTEST_MOVING = 2.5, 1.3
"""Integration step times the fastest eigenvalue: stable without actuators in motion, and exact to 1e-4 with them."""


def loop_of(mission: Mission, vehicle: np.record, dives: DivePlan) -> Loop:
    """How time goes for a packed vehicle: integration steps at least as fine as its fastest mode needs."""
    scenario, physics = mission.scenario, PHYSICS[mission.scenario.physics]
    fastest = max(
        fastest_mode(mission.vehicle, sign * dives.theta, sign * drive, physics=physics)
        for sign, drive in zip((-1.0, 1.0), drives(mission.deployment), strict=True)
    )
    cut = scenario.integration
    return Loop(
        start=scenario.start_seconds,
        control_step=cut.control_step_s,
        steady_steps=max(cut.steady_steps, ceil(cut.control_step_s * fastest / FASTEST_STEADY)),
        moving_steps=max(cut.moving_steps, ceil(cut.control_step_s * fastest / FASTEST_MOVING)),
        damping=_rotational_damping(vehicle),
        settle_time=cut.settle_s,
        column_period=cut.ocean_s,
        record_every=round(scenario.output_every_s / cut.control_step_s),
    )


_SLOW = 0.3
"""Speed at which the part of the damping that grows with V is taken along with that of V^2 [m/s]."""


def _rotational_damping(vehicle: np.record) -> float:
    """Fastest damping of roll, pitch and yaw over the square of the speed [s/m2]; added masses are in the inertia."""
    inertia = np.array(vehicle.J_0)[:3]
    damping = np.abs(vehicle.D_omega) + np.abs(vehicle.D_omega_V) / _SLOW
    return float(np.max(damping / inertia))
