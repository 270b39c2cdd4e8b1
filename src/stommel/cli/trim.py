"""`stommel trim`: the actuator settings of one wanted flight."""

from typing import TYPE_CHECKING, Annotated

from stommel.cli.design_flight import design_pitch, design_speed
from stommel.cli.finish import finish
from stommel.cli.numbers import number_option
from stommel.cli.options import (
    ANGLES,
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
from stommel.cli.output import number, show_values
from stommel.compilation import one_question

if TYPE_CHECKING:
    from stommel.analysis.flight import SteadyFlight


@one_question()
def trim(
    vehicle: VehicleArgument,
    speed: SpeedOption = None,
    pitch: PitchOption = None,
    glide_path: Annotated[
        float | None, number_option("--glide-path", *ANGLES, "deg", "Angle of the path instead of the pitch")
    ] = None,
    physics: PhysicsOption = PhysicsChoice.paper,
    ignore_limits: IgnoreLimitsOption = False,
    as_json: JsonOption = False,
) -> None:
    """Find moving-mass position and ballast volume for a wanted steady flight.

    Example: stommel trim zju --speed 0.4 --pitch -35
    """
    from stommel.analysis.trim import trim as solve

    glider = load(vehicle)
    flight = solve(
        glider,
        speed_m_s=design_speed(glider, speed),
        pitch_deg=pitch if glide_path is not None else design_pitch(glider, pitch),
        glide_path_deg=glide_path,
        physics=physics_of(physics),
        within_limits=not ignore_limits,
    )
    finish(flight.as_row(), None, as_json, lambda _: _show(glider.name, flight))


def _show(name: str, flight: "SteadyFlight") -> None:
    row = flight.as_row()
    show_values(
        f"{name}: wings-level steady flight",
        {
            "speed": number(row["speed_m_s"], 3, "m/s"),
            "pitch": number(row["pitch_deg"], 2, "deg"),
            "glide path": number(row["glide_path_deg"], 2, "deg"),
            "angle of attack": number(row["angle_of_attack_deg"], 2, "deg"),
            "moving mass position": number(row["moving_mass_position_mm"], 1, "mm forward of the centre of buoyancy"),
            "ballast volume": number(row["ballast_volume_ml"], 1, "ml"),
            "horizontal speed": number(flight.horizontal_speed, 3, "m/s"),
            "sinking speed": number(flight.sinking_speed, 3, "m/s"),
            "residual": f"{row['residual']:.1e} N, N m",
        },
    )
