"""A mission: a plan that has been checked against its vehicle and its ocean."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from stommel.ocean.ocean import Ocean
from stommel.simulation.scenario.mission_file import MissionFile
from stommel.vehicle import Vehicle


@dataclass(frozen=True)
class Mission:
    """A plan that has been checked against its vehicle and its ocean."""

    plan: MissionFile
    vehicle: Vehicle
    ocean: Ocean
    origin: str
    """File name, for messages."""
    document: Mapping[str, Any] = field(repr=False)
    """The file's plain values."""
