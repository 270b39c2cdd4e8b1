"""`stommel turn`: the settings of a wanted turn."""

from enum import StrEnum
from typing import Annotated

import typer

from stommel.cli.design_flight import design_pitch, design_speed
from stommel.cli.numbers import number_option
from stommel.cli.options import (
    IgnoreLimitsOption,
    JsonOption,
    PhysicsChoice,
    PhysicsOption,
    PitchOption,
    SpeedOption,
    VehicleArgument,
    load,
    physics_of,
)
from stommel.cli.steady import finish_turn
from stommel.compilation import one_question


class SteeringChoice(StrEnum):
    """What steers."""

    rudder = "rudder"
    roll = "roll"


@one_question()
def turn(
    vehicle: VehicleArgument,
    speed: SpeedOption = None,
    pitch: PitchOption = None,
    turn_rate: Annotated[
        float | None, number_option("--turn-rate", -5, 5, "rad/s", "Turn rate; positive turns to starboard")
    ] = None,
    radius: Annotated[
        float | None,
        number_option("--radius", -1e6, 1e6, "m", "Radius instead; positive turns to starboard"),
    ] = None,
    by: Annotated[
        SteeringChoice | None, typer.Option("--by", help="What steers; the rudder where there is one.")
    ] = None,
    physics: PhysicsOption = PhysicsChoice.paper,
    ignore_limits: IgnoreLimitsOption = False,
    as_json: JsonOption = False,
) -> None:
    """Find moving mass, ballast and rudder (or roll of the moving mass) for a wanted turn.

    Example: stommel turn seawing --speed 0.4 --pitch -30 --turn-rate 0.005
    """
    from stommel.analysis.turn import turn as solve

    glider = load(vehicle)
    flight = solve(
        glider,
        speed_m_s=design_speed(glider, speed),
        pitch_deg=design_pitch(glider, pitch),
        turn_rate_rad_s=turn_rate,
        radius_m=radius,
        by=by.value if by is not None else None,
        physics=physics_of(physics),
        within_limits=not ignore_limits,
    )
    finish_turn("steady turn", glider, flight, physics_of(physics), as_json)
