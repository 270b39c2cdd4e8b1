"""`stommel steady`: the flight that actuator settings give."""

from typing import TYPE_CHECKING, Annotated, Any

from stommel.cli.finish import finish
from stommel.cli.numbers import number_option
from stommel.cli.options import (
    ANGLES,
    IgnoreLimitsOption,
    JsonOption,
    PhysicsChoice,
    PhysicsOption,
    VehicleArgument,
    load,
    physics_of,
)
from stommel.cli.output import number, show_values
from stommel.compilation import one_question

if TYPE_CHECKING:
    from stommel.analysis.flight import SteadyFlight
    from stommel.vehicle import Physics, Vehicle


@one_question()
def steady(
    vehicle: VehicleArgument,
    moving_mass_mm: Annotated[
        float, number_option("--moving-mass-mm", -5000, 5000, "mm", "Moving mass forward of the centre of buoyancy")
    ],
    ballast_ml: Annotated[float, number_option("--ballast-ml", -1e5, 1e5, "ml", "Ballast volume; negative dives")],
    rudder_deg: Annotated[
        float, number_option("--rudder-deg", *ANGLES, "deg", "Rudder; positive yaws the nose to starboard")
    ] = 0.0,
    roll_mass_deg: Annotated[
        float,
        number_option("--roll-mass-deg", -180, 180, "deg", "Moving mass about the hull; positive to port"),
    ] = 0.0,
    physics: PhysicsOption = PhysicsChoice.paper,
    ignore_limits: IgnoreLimitsOption = False,
    as_json: JsonOption = False,
) -> None:
    """Find the steady flight, straight or turning, that settings give.

    Example: stommel steady seawing --moving-mass-mm 421.67 --ballast-ml -292.7 --roll-mass-deg 45
    """
    from stommel.analysis.trim import steady_flight

    glider = load(vehicle)
    flight = steady_flight(
        glider,
        moving_mass_mm=moving_mass_mm,
        ballast_ml=ballast_ml,
        rudder_deg=rudder_deg,
        roll_mass_deg=roll_mass_deg,
        physics=physics_of(physics),
        within_limits=not ignore_limits,
    )
    finish_turn("steady flight of these settings", glider, flight, physics_of(physics), as_json)


def finish_turn(title: str, glider: "Vehicle", flight: "SteadyFlight", physics: "Physics", as_json: bool) -> None:
    """End with a straight or turning flight, and whether the vehicle stays in it by itself."""
    from stommel.analysis.linearization import is_stable

    row = flight.as_turn() | {"stable": is_stable(glider, flight, physics=physics)}
    finish(row, None, as_json, lambda row: _show(f"{glider.name}: {title}", glider, row))


def _show(title: str, glider: "Vehicle", row: dict[str, Any]) -> None:
    straight = row["radius_m"] is None
    values = {
        "speed": number(row["speed_m_s"], 3, "m/s"),
        "pitch": number(row["pitch_deg"], 2, "deg"),
        "glide path": number(row["glide_path_deg"], 2, "deg"),
        "angle of attack": number(row["angle_of_attack_deg"], 2, "deg"),
        "sideslip": number(row["sideslip_deg"], 2, "deg"),
        "roll": number(row["roll_deg"], 2, "deg"),
        "turn rate": "straight" if straight else f"{row['turn_rate_rad_s']:.5f} rad/s",
        "radius": "straight" if straight else number(row["radius_m"], 2, "m"),
        "moving mass position": number(row["moving_mass_position_mm"], 1, "mm"),
        "ballast volume": number(row["ballast_volume_ml"], 1, "ml"),
    }
    if glider.description.rudder is not None:
        values["rudder"] = number(row["rudder_deg"], 2, "deg")
    if glider.description.moving_mass.offset_m != 0.0:
        values["roll of moving mass"] = number(row["roll_mass_deg"], 2, "deg")
    values["stable"] = "yes" if row["stable"] else "no: the vehicle leaves this flight by itself"
    values["residual"] = f"{row['residual']:.1e} N, N m"
    show_values(title, values)
