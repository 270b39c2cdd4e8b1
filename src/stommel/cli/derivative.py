"""`stommel derivative`: accelerations in given states, for checking against other codes."""

from enum import StrEnum
from pathlib import Path
from typing import Annotated

import typer

from stommel.cli.finish import finish
from stommel.cli.options import PhysicsChoice, PhysicsOption, VehicleArgument, load, physics_of
from stommel.compilation import one_question


class ActuatorChoice(StrEnum):
    """How the moving mass is held."""

    locked = "locked"
    free = "free"


@one_question()
def derivative(
    vehicle: VehicleArgument,
    states: Annotated[Path, typer.Option("--states", help="JSON file with a list of states.")],
    actuators: Annotated[
        ActuatorChoice,
        typer.Option("--actuators", help="The moving mass held at its rate, or sliding freely under its force."),
    ] = ActuatorChoice.locked,
    physics: PhysicsOption = PhysicsChoice.paper,
    as_json: Annotated[bool, typer.Option("--json", help="The answer is always JSON.", hidden=True)] = True,  # noqa: ARG001
) -> None:
    """Print the accelerations in each state of a file, as JSON.

    A state has the keys velocity_m_s [u, v, w], angular_velocity_rad_s [p, q, r], attitude_deg [roll, pitch, yaw],
    moving_mass_position_m, and may have moving_mass_rate_m_s, moving_mass_force_n, ballast_volume_m3, rudder_deg,
    roll_mass_deg.

    Example: stommel derivative zju --states states.json --actuators free
    """
    from stommel.dynamics.state_files import accelerations_of, read_states

    glider = load(vehicle)
    found = accelerations_of(
        glider, read_states(states), free=actuators is ActuatorChoice.free, physics=physics_of(physics)
    )
    finish(found, None, True, lambda _: None)
