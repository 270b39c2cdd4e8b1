"""What orders follow from: a plan, the vehicle that flies it, and the water it expects."""

from dataclasses import dataclass
from math import inf

from stommel.errors import FileError, Problem
from stommel.mission.plan import Plan
from stommel.ocean.ocean import Ocean
from stommel.vehicle import Physics, Vehicle


@dataclass(frozen=True)
class Deployment:
    """A plan, its vehicle, and the water where and when it begins."""

    plan: Plan
    vehicle: Vehicle
    ocean: Ocean
    time: float
    """Start [s since 1970-01-01 UTC]."""
    latitude_deg: float
    longitude_deg: float
    physics: Physics
    neutral_depth_m: float | None
    """Depth at which the vehicle is trimmed neutral; None: in the middle of what the buoyancy engine must follow."""
    origin: str
    """File name, for messages."""

    @property
    def ballast_range(self) -> tuple[float, float]:
        """Least and greatest ballast volume of the buoyancy engine [m3].

        Raises
        ------
        FileError
            The vehicle file does not say.
        """
        engine = self.vehicle.description.actuators.buoyancy
        if engine is None:
            text = "[actuators.buoyancy] is missing: a mission needs it"
            raise FileError([Problem(self.vehicle.origin, "actuators.buoyancy", text)])
        return engine.volume_m3

    @property
    def mass_range(self) -> tuple[float, float]:
        """Aft and forward limit switch of the moving mass [m]; infinite where the vehicle file does not say."""
        drive = self.vehicle.description.actuators.moving_mass
        return drive.travel_m if drive is not None else (-inf, inf)
