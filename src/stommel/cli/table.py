"""`stommel table`: trim over speeds and pitches, as Tables 1 and 2 of the paper."""

from typing import TYPE_CHECKING, Annotated

import typer

from stommel.cli.design_flight import design_pitch, design_speed
from stommel.cli.finish import finish
from stommel.cli.numbers import MOST, NumberError, numbers
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
from stommel.cli.output import number, show_table
from stommel.compilation import one_question

if TYPE_CHECKING:
    from stommel.analysis.trim import TrimRow


@one_question()
def table(
    vehicle: VehicleArgument,
    speed: Annotated[
        str | None,
        typer.Option("--speed", help="Speeds [m/s]: 0.4, or 0.2,0.4, or 0.1:0.8:0.1; the specification's design one."),
    ] = None,
    pitch: Annotated[
        str | None,
        typer.Option("--pitch", help="Pitches [deg]: -35, or -20,-35, or -5:-60:-5; the specification's, diving."),
    ] = None,
    physics: PhysicsOption = PhysicsChoice.paper,
    as_json: JsonOption = False,
) -> None:
    """Trim every pair of speed and pitch. Rows beyond the actuators' limits stay, and are marked.

    Example: stommel table zju --speed 0.4 --pitch -5:-60:-5
    """
    glider = load(vehicle)
    speeds = numbers(speed, "--speed", SPEEDS, "m/s") if speed is not None else [design_speed(glider, None)]
    pitches = numbers(pitch, "--pitch", ANGLES, "deg") if pitch is not None else [design_pitch(glider, None)]
    if len(speeds) * len(pitches) > MOST:
        raise NumberError(f"{len(speeds)} speeds by {len(pitches)} pitches; at most {MOST} rows are allowed")
    from stommel.analysis.trim import trim_table

    rows = trim_table(glider, speeds_m_s=speeds, pitches_deg=pitches, physics=physics_of(physics))
    finish({"rows": [row.as_row() for row in rows]}, None, as_json, lambda _: _show(glider.name, rows))


def _show(name: str, rows: "list[TrimRow]") -> None:
    body, notes = [], []
    for row in rows:
        cells = row.flight.as_row()
        mark = "*" if row.beyond else ""
        body.append(
            [
                number(cells["speed_m_s"], 3),
                number(cells["pitch_deg"], 1),
                number(cells["moving_mass_position_mm"], 1) + mark,
                number(cells["angle_of_attack_deg"], 2),
                number(cells["ballast_volume_ml"], 1),
                number(cells["glide_path_deg"], 2),
            ]
        )
    if any(row.beyond for row in rows):
        notes.append("* beyond the limits of the vehicle file; --json names them")
    columns = ["speed\nm/s", "pitch\ndeg", "moving mass\nmm", "angle of attack\ndeg", "ballast\nml", "glide path\ndeg"]
    show_table(f"{name}: wings-level equilibria", columns, body, notes)
