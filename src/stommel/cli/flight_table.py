"""`stommel flight-table`: what the flight software needs of the model, as a file."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from stommel.cli.finish import finish
from stommel.cli.options import JsonOption, PhysicsChoice, PhysicsOption, VehicleArgument, load, physics_of
from stommel.cli.output import number, show_table
from stommel.cli.paths import file_parser

if TYPE_CHECKING:
    from stommel.control.flight_table import FlightTable

_SHOWN = 5
"""Pitches that the terminal shows."""


def flight_table(
    vehicle: VehicleArgument,
    output: Annotated[
        Path | None,
        typer.Option(
            "--output",
            metavar="FILE",
            parser=file_parser("--output", ".toml"),
            help="File to write for the vehicle's software, .toml.",
        ),
    ] = None,
    physics: PhysicsOption = PhysicsChoice.full,
    as_json: JsonOption = False,
) -> None:
    """Trim the vehicle over pitch and ballast volume: the table that control laws and dead reckoning fly by.

    Example: stommel flight-table zju --output zju-flight.toml
    """
    from stommel.analysis.flight_table import flight_table as computed
    from stommel.control.flight_table_file import FlightTableHeader, write_flight_table
    from stommel.vehicle.fingerprint import fingerprint
    from stommel.version import __version__

    glider = load(vehicle)
    table = computed(glider, physics=physics_of(physics))
    header = FlightTableHeader(
        glider.name, fingerprint(glider), physics.value, glider.neutral_density_kg_m3, __version__
    )
    written = []
    if output is not None:
        write_flight_table(output, table, header)
        written.append(output)
    answer = vars(header) | {"flights": _rows(table)}
    finish(answer, written, as_json, lambda answer: _show(answer, table))


def _rows(table: "FlightTable") -> list[dict[str, Any]]:
    """Every flight of the table, a dive's pitch and ballast negative."""
    import numpy as np

    return [
        {
            "pitch_deg": sign * float(np.degrees(theta)),
            "ballast_ml": sign * 1e6 * float(V_b),
            "moving_mass_mm": 1e3 * float(table.r_px[way, i, j]),
            "angle_of_attack_deg": float(np.degrees(table.alpha[way, i, j])),
            "speed_m_s": float(table.speed[way, i, j]),
            "turn_pole_per_s": float(table.turn_pole[way, i, j]),
            "turn_drive_per_s2": float(table.turn_drive[way, i, j]),
        }
        for way, sign in enumerate((-1.0, 1.0))
        for i, theta in enumerate(table.theta)
        for j, V_b in enumerate(table.V_b)
    ]


def _show(answer: dict[str, Any], table: "FlightTable") -> None:
    """Show dives and climbs with the most ballast, at a few pitches."""
    rows, columns = answer["flights"], len(table.V_b)
    fullest = rows[columns - 1 :: columns]
    pitches = len(table.theta)
    every = max(1, (pitches - 1) // (_SHOWN - 1))
    shown = fullest[:pitches:every][::-1] + fullest[pitches::every]
    show_table(
        f"{answer['vehicle']}: flight table, here with {1e6 * table.V_b[-1]:.0f} ml",
        ["pitch\ndeg", "speed\nm/s", "angle of attack\ndeg", "moving mass\nmm", "turn pole\n1/s", "turn drive\n1/s2"],
        [
            [
                number(row["pitch_deg"], 0),
                number(row["speed_m_s"], 3),
                number(row["angle_of_attack_deg"], 2),
                number(row["moving_mass_mm"], 1),
                number(row["turn_pole_per_s"], 4),
                number(row["turn_drive_per_s2"], 5),
            ]
            for row in shown
        ],
        [f"{pitches} pitches and {columns} ballast volumes, diving and climbing; --json lists all {len(rows)} flights"],
    )
