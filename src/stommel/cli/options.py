"""Options that several verbs share, and what they mean."""

from enum import StrEnum
from typing import TYPE_CHECKING, Annotated

import typer

from stommel.cli.numbers import number_option

if TYPE_CHECKING:
    from stommel.vehicle import Physics, Vehicle


SPEEDS = (0.005, 5.0)
"""Speeds along the path that any glider has [m/s]; as `stommel.files.ranges` for files."""
ANGLES = (-90.0, 90.0)
"""Pitch and path [deg]."""
DEPTHS = (0.5, 12000.0)
"""Depths of a dive or of a hull [m]."""
PRESSURES = (0.0, 200.0)
"""Of the sea, gauge [MPa]."""
TURNS = (1.0, 50000.0)
"""Speeds of a motor [r/min]."""
VOLUMES = (0.001, 1e5)
"""Of oil [ml]."""


class PhysicsChoice(StrEnum):
    """Which model flies."""

    paper = "paper"
    full = "full"


VehicleArgument = Annotated[
    str, typer.Argument(metavar="VEHICLE", help="A built-in vehicle (see `stommel vehicles`) or a vehicle file.")
]
JsonOption = Annotated[bool, typer.Option("--json", help="Print JSON and nothing else.")]
PhysicsOption = Annotated[
    PhysicsChoice,
    typer.Option("--physics", help="The paper's model, or all that the vehicle file adds to it (bladder, oil, stall)."),
]
SpeedOption = Annotated[
    float | None, number_option("--speed", *SPEEDS, "m/s", "Speed along the path; the specification's if left out")
]
PitchOption = Annotated[
    float | None, number_option("--pitch", *ANGLES, "deg", "Pitch; negative dives; the specification's if left out")
]
IgnoreLimitsOption = Annotated[bool, typer.Option("--ignore-limits", help="Answer even beyond the actuators' limits.")]
ForceOption = Annotated[bool, typer.Option("--force", help="Replace an existing file.")]


def load(name: str) -> "Vehicle":
    """Load the vehicle that an argument names."""
    from stommel.vehicle import load_vehicle

    return load_vehicle(name)


def physics_of(choice: PhysicsChoice) -> "Physics":
    """Return the switches that a choice stands for."""
    from stommel.vehicle import PHYSICS

    return PHYSICS[choice.value]
