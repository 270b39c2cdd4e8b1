"""`stommel envelope`: what the actuator ranges reach, and which ranges a wanted region needs."""

from math import degrees
from typing import TYPE_CHECKING, Annotated

import typer

from stommel.cli.finish import finish
from stommel.cli.numbers import numbers, pairs_of
from stommel.cli.options import (
    ANGLES,
    SPEEDS,
    JsonOption,
    PhysicsChoice,
    PhysicsOption,
    VehicleArgument,
    load,
    physics_of,
)
from stommel.cli.output import number, show_table, show_values
from stommel.errors import StommelError

if TYPE_CHECKING:
    from stommel.analysis import BestConditions, EnvelopeRow, RangesNeeded
    from stommel.vehicle import Vehicle


def envelope(
    vehicle: VehicleArgument,
    speed: Annotated[
        str | None, typer.Option("--speed", help="Speeds of a wanted region [m/s], as in `table`; with --pitch.")
    ] = None,
    pitch: Annotated[
        str | None, typer.Option("--pitch", help="Pitches of a wanted region [deg], as in `table`; with --speed.")
    ] = None,
    physics: PhysicsOption = PhysicsChoice.paper,
    as_json: JsonOption = False,
) -> None:
    """Show the speeds that actuator ranges reach at each pitch, and the ranges that a wanted region needs.

    Without --speed and --pitch the wanted region is the specification's.

    Example: stommel envelope zju
    """
    from stommel.analysis import best_conditions, flight_envelope, ranges_needed, specified_flights

    glider, switches = load(vehicle), physics_of(physics)
    if (speed is None) != (pitch is None):
        raise StommelError("--speed and --pitch go together: a region has both")
    if speed is not None and pitch is not None:
        wanted = _region(speed, pitch)
    else:
        wanted = specified_flights(glider) if _specifies(glider) else []
    needs = ranges_needed(glider, wanted, physics=switches) if wanted else None
    engine = glider.description.actuators.buoyancy
    reach = flight_envelope(glider, physics=switches) if engine is not None else None
    full_ml = engine.range_ml[0] if engine is not None else 0.0
    best = best_conditions(glider, ballast_ml=full_ml, physics=switches) if full_ml < 0.0 else None
    if reach is None and needs is None:
        raise StommelError(
            f"{glider.name}: its file has neither [actuators.buoyancy], to see what is reached, nor [specification], "
            "to see what is needed; give a wanted region with --speed and --pitch"
        )
    answer = {
        "reach": [row.as_row() for row in reach] if reach is not None else None,
        "needs": needs.as_row() if needs is not None else None,
        **(best.as_row() if best is not None else {"best_glide": None, "fastest": None}),
    }
    finish(answer, None, as_json, lambda _: _show(glider.name, reach, best, needs))


def _region(speed: str, pitch: str) -> list[tuple[float, float]]:
    """Every pair of a speed and a pitch."""
    speeds, pitches = numbers(speed, "--speed", SPEEDS, "m/s"), numbers(pitch, "--pitch", ANGLES, "deg")
    return pairs_of(speeds, pitches, "speeds", "pitches")


def _specifies(glider: "Vehicle") -> bool:
    """Whether the specification says which flights it wants."""
    spec = glider.description.specification
    return bool(spec and spec.speed_m_s and spec.design_speed_m_s and spec.design_pitch_deg)


def _show(
    name: str, reach: "list[EnvelopeRow] | None", best: "BestConditions | None", needs: "RangesNeeded | None"
) -> None:
    if reach is not None:
        _show_reach(name, reach)
    if best is not None:
        _show_best(best)
    if needs is not None:
        _show_needs(needs)


def _show_reach(name: str, reach: "list[EnvelopeRow]") -> None:
    body = [
        [
            number(row.pitch_deg, 0),
            number(row.slowest.V if row.slowest else None, 3),
            number(row.fastest.V if row.fastest else None, 3),
            number(row.fastest.horizontal_speed if row.fastest else None, 3),
            row.limited_by,
        ]
        for row in reach
    ]
    columns = ["pitch\ndeg", "slowest\nm/s", "fastest\nm/s", "over ground\nm/s", "limited by"]
    show_table(f"{name}: reachable speeds", columns, body)


def _show_best(best: "BestConditions") -> None:
    glide, fast = best.best_glide, best.fastest
    show_values(
        "Best conditions at full ballast, diving",
        {
            "best glide": f"{glide.glide_ratio:.2f} m forward per m down, path {degrees(glide.gamma):.2f} deg, "
            f"pitch {degrees(glide.theta):.2f} deg{_limits(best.glide_remarks)}",
            "fastest": f"{fast.horizontal_speed:.3f} m/s over ground, speed {fast.V:.3f} m/s, "
            f"pitch {degrees(fast.theta):.2f} deg{_limits(best.fastest_remarks)}",
        },
    )


def _limits(remarks: tuple[str, ...]) -> str:
    """What a best flight is limited by, or breaks."""
    return "".join(f"; {remark}" for remark in remarks)


def _show_needs(needs: "RangesNeeded") -> None:
    travel, volume = needs.moving_mass_choice_mm, needs.ballast_choice_ml
    show_values(
        "Ranges that the wanted flights need",
        {
            "moving mass": f"±{needs.moving_mass_mm:.1f} mm about neutral; choose ±{travel:g} mm",
            "ballast": f"±{needs.ballast_ml:.1f} ml; choose ±{volume:g} ml",
        },
        [
            "beyond the stall angle, out of reach of any range: "
            f"{flight.V:g} m/s at pitch {degrees(flight.theta):.1f} deg"
            for flight in needs.stalled
        ],
    )
