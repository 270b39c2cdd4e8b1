"""A round eddy in uniform water."""

from typing import Annotated

import numpy as np
from pydantic import Field

from stommel.ocean.analytic.everywhere import Latitude, Longitude, Speed, Still
from stommel.ocean.analytic.regional import rectangle
from stommel.ocean.kernel.building import Frame, Slot, ocean_grid
from stommel.ocean.kernel.grid import UNBOUNDED_DEPTH, OceanGrid
from stommel.seawater import properties

_REACH, _NODES = 4.0, 161
"""The grid reaches this many radii from the middle, with this many nodes a side: 20 to the radius."""


class Gyre(Still):
    """A round eddy, the same at all depths: speed U (r / R) exp((1 - r2/R2) / 2), greatest at the radius R."""

    latitude_deg: Latitude = 30.0
    longitude_deg: Longitude = 125.0
    speed_m_s: Speed = 0.3
    """Greatest speed; positive turns counterclockwise, seen from above."""
    radius_km: Annotated[float, Field(gt=1.0, le=500.0)] = 50.0

    def grid(self) -> OceanGrid:
        """Grid of 161 x 161 nodes around the middle; beyond it the water is at rest to 0.3 % of the speed: refused."""
        layers = self._layers()
        axis = self.radius_km * 1e3 * np.linspace(-_REACH, _REACH, _NODES)
        latitude, longitude, outward = rectangle(self.latitude_deg, self.longitude_deg, 0.0, axis, axis)
        east, north = np.meshgrid(axis, axis)
        share = np.hypot(east, north) / (self.radius_km * 1e3)
        speed = self.speed_m_s * share * np.exp(0.5 * (1.0 - share**2))
        p = properties.pressure_from_depth(layers.depths, self.latitude_deg)
        water = (properties.in_situ_temperature(layers.CT, layers.S_A, p), layers.S_A, layers.CT)
        full = np.ones((len(layers.depths), *latitude.shape))
        T, S_A, CT = (f[:, None, None] * full for f in water)
        bottom = self.bottom_m if self.bottom_m is not None else UNBOUNDED_DEPTH
        frame = Frame(
            np.zeros(1), (-np.inf, np.inf), layers.depths, latitude, longitude, np.full(latitude.shape, bottom),
            profile_depths=layers.rho_depths, profile_rho=layers.rho,
        )  # fmt: skip
        return ocean_grid(frame, [Slot(T, S_A, CT, -speed * np.cos(outward) * full, speed * np.sin(outward) * full)])
