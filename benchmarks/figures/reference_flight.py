"""The first hours of the benchmark mission at 1 Hz, from which the peers get their settings and their input."""

from dataclasses import dataclass
from functools import cache

import numpy as np
from numpy.typing import NDArray

from stommel.dynamics.packing import pack
from stommel.simulation.flight import fly_mission
from stommel.simulation.scenario.loading import load_mission
from stommel.simulation.scenario.mission import Mission
from stommel.simulation.scenario.shipped import mission_path
from stommel.vehicle import PHYSICS

Array = NDArray[np.float64]

NAME = "still_20_days"
HOURS = 6.0


@dataclass(frozen=True)
class Leg:
    """Settings of a descent or of a climb and the flight that they give, in the middle half of the water."""

    ballast: float
    """[m3]"""
    moving_mass: float
    """Forward of the centre of buoyancy [m]."""
    speed: float
    """Through the water [m/s]."""
    pitch: float
    """[rad]"""
    sinking: float
    """Downward speed [m/s]."""


@dataclass(frozen=True)
class ReferenceFlight:
    """A piece of the mission with its vehicle and its water."""

    mission: Mission
    vehicle: np.record
    """Parameters of the equations of motion, SI units."""
    record: NDArray[np.void]
    """Rows over time, `stommel.simulation.log.ROW`."""

    def column(self, name: str) -> Array:
        """One quantity over time."""
        return np.asarray(self.record[name])

    def speed(self) -> Array:
        """Through the water [m/s]; the sea of the mission is at rest."""
        return np.linalg.norm(np.stack([self.column(name) for name in "uvw"]), axis=0)

    def leg(self, down: bool) -> Leg:
        """Descents, or climbs, between a quarter and three quarters of the dive depth."""
        depth, time = self.column("depth"), self.column("time")
        sinking = np.gradient(depth, time)
        share = depth / self.mission.scenario.dives.depth_m
        rows = (share > 0.25) & (share < 0.75) & ((sinking > 0) == down)
        return Leg(
            ballast=float(np.median(self.column("ballast")[rows])),
            moving_mass=float(np.median(self.column("moving_mass")[rows])),
            speed=float(self.speed()[rows].mean()),
            pitch=float(self.column("pitch")[rows].mean()),
            sinking=float(sinking[rows].mean()),
        )

    def water(self, depths: Array) -> tuple[Array, Array]:
        """Density [kg/m3] and volume of the hull without ballast [m3] at depths [m], at the start."""
        plan, p = self.mission.scenario, self.vehicle
        place = (plan.start_seconds, plan.start.latitude_deg, plan.start.longitude_deg)
        samples = [self.mission.ocean.at(*place, float(depth)) for depth in depths]
        yielded = [1.0 - p.kappa * one.pressure + p.alpha_T * (one.temperature - p.T_0) for one in samples]
        return np.array([one.density for one in samples]), float(p.V_0) * np.array(yielded)


@cache
def reference_flight() -> ReferenceFlight:
    """Fly the first hours."""
    mission = load_mission(mission_path(NAME))
    plan = mission.scenario.model_copy(update={"duration_days": HOURS / 24.0, "output_every_s": 1.0})
    piece = Mission(plan, mission.vehicle, mission.ocean, mission.origin, mission.document)
    return ReferenceFlight(piece, pack(piece.vehicle, PHYSICS[plan.physics]), fly_mission(piece).record)
