"""A mission: a scenario that has been checked against its vehicle and its ocean."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from stommel.ocean.ocean import Ocean
from stommel.planning.deployment import Deployment
from stommel.simulation.scenario.scenario_file import ScenarioFile
from stommel.vehicle import PHYSICS, Vehicle


@dataclass(frozen=True)
class Mission:
    """A scenario (a plan and the world it is flown in) that has been checked against its vehicle and its ocean."""

    scenario: ScenarioFile
    vehicle: Vehicle
    ocean: Ocean
    origin: str
    """File name, for messages."""
    document: Mapping[str, Any] = field(repr=False)
    """The file's plain values."""

    @property
    def deployment(self) -> Deployment:
        """What the software's orders follow from."""
        scenario = self.scenario
        return Deployment(
            plan=scenario,
            vehicle=self.vehicle,
            ocean=self.ocean,
            time=scenario.start_seconds,
            latitude_deg=scenario.start.latitude_deg,
            longitude_deg=scenario.start.longitude_deg,
            physics=PHYSICS[scenario.physics],
            neutral_depth_m=scenario.ballasting.neutral_depth_m,
            origin=self.origin,
        )
