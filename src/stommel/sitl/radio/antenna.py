"""Whether the vehicle's antenna is out of the water: between the steps of the plant, by its waves."""

import math

import numpy as np

from stommel.compilation import compiled
from stommel.dynamics.equations import state_from_array
from stommel.dynamics.state import DEPTH, V_B
from stommel.geometry.attitude import attitude_of
from stommel.machinery.hull.floating import water_line
from stommel.ocean.kernel.column import water_at
from stommel.ocean.kernel.grid import TIME, Column
from stommel.simulation.mission_loop import Equipment
from stommel.simulation.plant.motion import surplus_volume
from stommel.simulation.plant.waves import antenna_height
from stommel.sitl.plant import Plant

EVERYWHERE = math.inf
"""Height of an antenna of which nobody said where it is, and of one on a cable."""


@compiled
def calm_height(equipment: Equipment, column: Column, x: np.ndarray, age: float) -> float:
    """Height of the antenna of a floating vehicle over the calm surface [m]."""
    theta = attitude_of(state_from_array(x).Q).theta
    water = water_at(column, x[DEPTH], age)
    line = water_line(equipment.plant.form, theta, surplus_volume(equipment.vehicle, water, x[V_B]))
    height: float = antenna_height(equipment.plant.antenna, line, theta)
    return height


class Antenna:
    """The antenna of a vehicle in the loop, from one step of the plant to the next.

    Parameters
    ----------
    plant
        The vehicle in its waves.
    tethered
        Whether a cable holds the antenna above the water, wherever the vehicle is.
    """

    def __init__(self, plant: Plant, *, tethered: bool = False) -> None:
        self._plant, self._tethered = plant, tethered
        self._height = -math.inf
        self._looks = True

    def look(self) -> None:
        """Look where the vehicle is now, when anybody asks; what the waves do is asked between two looks."""
        self._looks = True

    def _look(self) -> None:
        self._looks = False
        s = self._plant.setup
        if self._tethered:
            self._height = EVERYWHERE
        elif not s.world["afloat"]:
            self._height = -math.inf
        elif math.isnan(s.equipment.plant.antenna[0]):
            self._height = EVERYWHERE
        else:
            age = s.loop.start + self._plant.time - float(s.column.place[TIME])
            self._height = float(calm_height(s.equipment, s.column, s.x, age))

    def emerges(self, t: float) -> bool:
        """Whether it is out of the water at a time of the mission [s]."""
        if self._looks:
            self._look()
        if not math.isfinite(self._height):
            return self._height > 0.0
        waves = self._plant.setup.sea.waves
        return self._height > float(np.sum(waves.amplitude * np.cos(waves.omega * t + waves.phase)))
