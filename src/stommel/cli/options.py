"""Options that several verbs share, and what they mean."""

from enum import StrEnum
from typing import TYPE_CHECKING, Annotated

import typer

if TYPE_CHECKING:
    from stommel.vehicle import Physics, Vehicle


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
    float | None, typer.Option("--speed", help="Speed along the path [m/s]; the specification's design speed.")
]
PitchOption = Annotated[
    float | None, typer.Option("--pitch", help="Pitch [deg]; negative dives; the specification's, diving.")
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
