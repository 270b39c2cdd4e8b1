"""The sea in which an endurance is asked for: its stratification costs ballast, its temperature charge."""

from dataclasses import dataclass

from stommel.analysis.request import RequestError
from stommel.analysis.stratified import (
    DiveBallast,
    DiveWater,
    WantedDive,
    ballast_for,
    dive_water,
    neutral_volumes,
    trimmed_midway,
)
from stommel.ocean.ocean import Ocean
from stommel.vehicle import Physics, Vehicle


@dataclass(frozen=True)
class Sea:
    """An ocean where and when the dives begin."""

    ocean: Ocean
    time: float
    """[s since 1970-01-01 UTC]."""
    latitude_deg: float
    longitude_deg: float

    def water(self, depth: float) -> DiveWater:
        """From the surface to `depth` [m].

        Raises
        ------
        StommelError
            There is no such water.
        """
        return dive_water(self.ocean, self.time, self.latitude_deg, self.longitude_deg, depth)

    def trimmed(self, vehicle: Vehicle, physics: Physics, depth: float) -> Vehicle:
        """Trim a vehicle for dives here, as a mission does."""
        return trimmed_midway(vehicle, physics, self.water(depth))

    def ballast(self, vehicle: Vehicle, physics: Physics, pitch_deg: float, speed: float, depth: float) -> DiveBallast:
        """Ballast of dives here, as a mission finds it.

        Raises
        ------
        RequestError
            The buoyancy engine cannot follow the density of the water.
        """
        neutral = neutral_volumes(vehicle, physics, self.water(depth))
        found = ballast_for(vehicle, physics, neutral, WantedDive(abs(pitch_deg), speed))
        engine = vehicle.description.actuators.buoyancy
        assert engine is not None
        low, high = engine.volume_m3
        if found.down < low - 1e-9 or found.up > high + 1e-9:
            raise RequestError(
                f"{self.ocean.name}: the water between 0 and {depth:g} m takes {found.down * 1e6:.0f} to "
                f"{found.up * 1e6:.0f} ml at {speed:g} m/s; the engine has {low * 1e6:.0f} to {high * 1e6:.0f} ml"
            )
        return found
