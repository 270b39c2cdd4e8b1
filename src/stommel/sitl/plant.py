"""The plant below the vehicle's electronics: what its sensors feel, and what its power stages move."""

from dataclasses import dataclass, replace
from typing import Any, NamedTuple

import numpy as np

from stommel.compilation import compiled
from stommel.control.readings import Readings
from stommel.dynamics.equations import net_weight, state_from_array
from stommel.dynamics.state import DEPTH, R_PX, V_B
from stommel.geometry.vectors import Vector
from stommel.ocean.kernel.column import water_at
from stommel.ocean.kernel.grid import TIME, Column
from stommel.simulation.flight import Flown, flown_of
from stommel.simulation.mission_loop import OUTCOMES, RUNNING, begin_step, driven_step
from stommel.simulation.plant.driven import AS_NEW, Drives, Wear
from stommel.simulation.plant.hull_air import Hull
from stommel.simulation.plant.parameters import PITCH_DRIVE, PUMP, STEERING
from stommel.simulation.plant.sensing import felt_field
from stommel.simulation.scenario.mission import Mission
from stommel.simulation.setup import Setup, prepare
from stommel.simulation.writing import salinity_at

FLAT = 1e-6
"""Voltage below which a battery gives nothing [V]."""


@compiled
def spare_buoyancy(vehicle: np.record, column: Column, depth: float, age: float, V_b: float) -> float:
    """Volume by which the vehicle is too light at a depth [m3], negative if it sinks; `age` as for `felt_water`."""
    water = water_at(column, depth, age)
    spare: float = -net_weight(vehicle, water, V_b) / (water.rho * vehicle.g)
    return spare


class WaterFelt(NamedTuple):
    """What the CTD feels."""

    pressure: float
    """Of the sea [Pa]."""
    thermistor: float
    """Temperature of the lagging thermistor [degC]."""
    cell: float
    """Temperature of the water in the conductivity cell [degC]."""
    salinity: float
    """Absolute Salinity [g/kg]."""


@compiled
def felt_water(column: Column, x: np.ndarray, world: np.record, age: float) -> tuple[float, float, float, float]:
    """What the CTD feels, in the order of `WaterFelt`; `age` since the column was looked up [s]."""
    water = water_at(column, x[DEPTH], age)
    return water.P, world.thermistor, water.T - world.cell_error, salinity_at(column, x[DEPTH])


class Currents(NamedTuple):
    """Of the motors while they ran [A]."""

    pump: float
    mass: float
    steering: float


AT_REST = Currents(0.0, 0.0, 0.0)
"""Of motors that stand."""


class Felt(NamedTuple):
    """What the vehicle's sensors feel at the beginning of a step."""

    readings: Readings
    field: Vector
    """At the compass, body frame, in parts of the Earth's."""
    currents: Currents
    limit_fore: bool
    limit_aft: bool


@dataclass
class Plant:
    """A vehicle in its ocean, one step of its electronics at a time."""

    mission: Mission
    setup: Setup
    wear: Wear = AS_NEW
    tick: int = 0
    outcome: int = RUNNING
    _felt: Felt | None = None

    @classmethod
    def of(cls, mission: Mission) -> "Plant":
        """Return the plant of a mission, afloat at its start.

        Raises
        ------
        StommelError
            The vehicle cannot fly the dives that the plan asks for.
        """
        return cls(mission, prepare(mission))

    @property
    def step(self) -> float:
        """Length of a step [s]."""
        return self.setup.loop.control_step

    @property
    def time(self) -> float:
        """Time of the mission [s]."""
        return self.tick * self.step

    @property
    def running(self) -> bool:
        """Whether the mission goes on."""
        return self.outcome == RUNNING and self.tick < self.setup.ticks

    @property
    def ending(self) -> str:
        """How it ended, or would if it ended now."""
        return OUTCOMES[self.outcome]

    @property
    def depth(self) -> float:
        """True depth [m]."""
        return float(self.setup.x[DEPTH])

    def feel(self) -> Felt:
        """Read the sensors at this step."""
        if self._felt is None:
            s = self.setup
            self.outcome, readings = begin_step(
                s.equipment, s.sea, s.loop, s.column, s.x, s.memory, s.world, s.noise, s.log, self.tick
            )
            field = felt_field(s.equipment.sensors, s.world, state_from_array(s.x).Q)
            self._felt = self._felt_of(readings, field, AT_REST)
        return self._felt

    def water(self) -> WaterFelt:
        """What the CTD feels at this step."""
        s = self.setup
        return WaterFelt(*felt_water(s.column, s.x, s.world, s.loop.start + self.time - float(s.column.place[TIME])))

    def move(self, drives: Drives, memory: np.record) -> None:
        """Let the power stages do what they are told for one step; `memory` of the software is written down.

        A vehicle whose software is down keeps the memory of before in the record.
        """
        felt, s, before = self.feel(), self.setup, float(self.setup.memory["phase"])
        np.asarray(s.memory)[()] = memory
        energy = s.world["energy"].copy()
        self.outcome, readings, field = driven_step(
            s.equipment, s.sea, s.loop, s.column, s.x, s.memory, s.world, s.noise, s.log, felt.readings, drives,
            self.wear, before, self.tick,
        )  # fmt: skip
        self.tick += 1
        self._felt = self._felt_of(readings, field, self._currents_of(s.world["energy"] - energy, drives))

    def _felt_of(self, readings: tuple[Any, ...], field: Vector, currents: Currents) -> Felt:
        mass, r_px, broken = self.setup.equipment.plant.mass, self.setup.x[R_PX], self.wear.switches == 0.0
        fore, aft = bool(r_px >= mass.high - 1e-9), bool(r_px <= mass.low + 1e-9)
        plain = (value.item() if isinstance(value, np.generic) else value for value in readings)
        return Felt(Readings(*plain), field, currents, fore and not broken, aft and not broken)

    def spare(self, depth: float) -> float:
        """Volume by which the vehicle as it is now would be too light at a depth [m3]; negative if it would sink."""
        s = self.setup
        age = s.loop.start + self.time - float(s.column.place[TIME])
        return float(spare_buoyancy(s.equipment.vehicle, s.column, depth, age, float(s.x[V_B])))

    @property
    def oil(self) -> float:
        """Oil outside, as ballast volume [m3]."""
        return float(self.setup.x[V_B] + self.setup.world["leaked"] - self.setup.world["dropped"])

    def replace_hull(self, hull: Hull) -> None:
        """Let the hull be another one from now on."""
        if hull is not self.setup.equipment.hull:
            self.setup = replace(self.setup, equipment=self.setup.equipment._replace(hull=hull))

    def flown(self) -> Flown:
        """Return what has been flown so far, as `stommel.fly_mission` does."""
        return flown_of(self.mission, self.setup, self.outcome)

    def _currents_of(self, energy: np.ndarray, drives: Drives) -> Currents:
        voltage = self.setup.world["voltage"] * self.step
        if not voltage > FLAT:
            return Currents(0.0, 0.0, 0.0)
        on = (max(drives.pump, drives.valve), abs(drives.mass), abs(drives.steering))
        used = (energy[PUMP], energy[PITCH_DRIVE], energy[STEERING])
        return Currents(
            *(float(joules / (voltage * share)) if share > 0.0 else 0.0 for joules, share in zip(used, on, strict=True))
        )
