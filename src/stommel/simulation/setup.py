"""Everything that a mission is flown with, made ready at its start."""

from dataclasses import dataclass
from math import cos, radians

import numpy as np
from numpy.typing import NDArray

from stommel.compilation import compiled
from stommel.control.memory import new_memory
from stommel.control.orders import Orders
from stommel.dynamics.acceleration import state_of
from stommel.dynamics.packing import pack, reference_water
from stommel.dynamics.state import Actuation
from stommel.geometry.attitude import quaternion_from_euler
from stommel.geometry.vectors import Quaternion
from stommel.ocean.kernel.grid import Column, new_cell, new_column
from stommel.planning.ballasting import water_of
from stommel.planning.orders import orders_of
from stommel.simulation.log import CELL, EVENT, EVENT_ROWS, ROW, ROWS, SAMPLE, SAMPLES, SURFACING, SURFACINGS, Log
from stommel.simulation.mission_loop import Equipment, Sea
from stommel.simulation.plant.building import plant_of
from stommel.simulation.plant.hull_air import KELVIN, hull_of
from stommel.simulation.plant.sensors import sensors_of
from stommel.simulation.plant.waves import waves_of
from stommel.simulation.plant.world import new_world
from stommel.simulation.scenario.mission import Mission
from stommel.simulation.scenario.scenario_file import ScenarioFile
from stommel.simulation.stiffness import refuse_stiffness
from stommel.simulation.timing import Loop, column_step, loop_of
from stommel.vehicle import PHYSICS

Array = NDArray[np.float64]
LoopArguments = tuple[Equipment, Orders, Sea, Loop, Column, Array, np.record, np.record, np.random.Generator, Log]


@dataclass(frozen=True)
class Setup:
    """What the mission loop is told, and what it changes in place."""

    equipment: Equipment
    orders: Orders
    sea: Sea
    loop: Loop
    column: Column
    x: Array
    """Flat state of the equations of motion."""
    memory: np.record
    """The software's."""
    world: np.record
    noise: np.random.Generator
    log: Log
    ticks: int
    """Control steps of the longest mission."""

    @property
    def arguments(self) -> LoopArguments:
        """The setup in the order in which the loop takes it."""
        return (
            self.equipment,
            self.orders,
            self.sea,
            self.loop,
            self.column,
            self.x,
            self.memory,
            self.world,
            self.noise,
            self.log,
        )


def prepare(mission: Mission) -> Setup:
    """Make a mission ready to fly: afloat at its start, heading as asked.

    Raises
    ------
    StommelError
        The vehicle cannot fly the dives that the plan asks for.
    """
    scenario, vehicle = mission.scenario, pack(mission.vehicle, PHYSICS[mission.scenario.physics]).copy()
    plant = plant_of(mission.vehicle, water_of(mission.deployment).mean_temperature_c)
    sensors = sensors_of(scenario)
    orders = orders_of(mission.deployment, scenario.integration.control_step_s, plant.battery.energy)
    loop = loop_of(mission, vehicle, orders.dives)
    refuse_stiffness(loop)
    ticks = round(scenario.duration_days * 86400.0 / loop.control_step)
    grid = mission.ocean.grid()
    start = scenario.start
    latitude, longitude = radians(start.latitude_deg), radians(start.longitude_deg)
    heading = radians(scenario.heading_deg)
    return Setup(
        equipment=Equipment(vehicle, plant, sensors, hull_of(scenario, mission.vehicle, vehicle)),
        orders=orders,
        sea=Sea(grid, mission.ocean.table, waves_of(mission)),
        loop=loop,
        column=new_column(grid, 1.2 * scenario.dives.depth_m + 20.0, column_step(scenario)),
        x=_state_at_start(mission, vehicle, plant.engine.high),
        memory=new_memory(latitude, longitude, heading),
        world=_world_at_start(mission, latitude, longitude, heading),
        noise=np.random.default_rng(scenario.seed),
        log=_empty_log(scenario, loop, sensors.sample_every, ticks),
        ticks=ticks,
    )


def _empty_log(scenario: ScenarioFile, loop: Loop, sample_every: int, ticks: int) -> Log:
    """Room for everything that a mission can write down."""
    most_dives = max(16, int(scenario.duration_days * 86400.0 / 60.0))
    counts = np.zeros(6, dtype=np.int64)
    counts[CELL] = new_cell()
    return Log(
        record=np.empty(ticks // loop.record_every + 2, ROW),
        samples=np.empty(ticks // sample_every + 2, SAMPLE),
        surfacings=np.empty(most_dives, SURFACING),
        events=np.empty(8 * most_dives, EVENT),
        counts=counts,
    )


def written(log: Log) -> Log:
    """The filled part of a log."""
    counts = log.counts
    return Log(
        log.record[: counts[ROWS]],
        log.samples[: counts[SAMPLES]],
        log.surfacings[: counts[SURFACINGS]],
        log.events[: counts[EVENT_ROWS]],
        counts,
    )


def _world_at_start(mission: Mission, latitude: float, longitude: float, heading: float) -> np.record:
    scenario, world = mission.scenario, new_world()
    here = mission.ocean.at(scenario.start_seconds, scenario.start.latitude_deg, scenario.start.longitude_deg, 0.0)
    world.latitude, world.longitude = latitude, longitude
    world.thermistor = world.water_before = here.temperature
    world.air_temperature = here.temperature + KELVIN
    theta = radians(scenario.dives.pitch_deg)
    world.measured[:] = (theta, heading, 0.0, 0.0, cos(theta))
    return world


def _state_at_start(mission: Mission, vehicle: np.record, V_b: float) -> Array:
    """Afloat and at rest, nose up as in a climb."""
    scenario, rest = mission.scenario, (0.0, 0.0, 0.0)
    Q = _wings_level(radians(scenario.dives.pitch_deg), radians(scenario.heading_deg))
    r_px = mission.vehicle.description.moving_mass.neutral_position_m
    water = reference_water(mission.vehicle)
    state = state_of(vehicle, rest, rest, rest, Q, r_px, V_b, Actuation(), water)
    return np.array([*state.X, *state.Q, *state.p, *state.h, state.r_px, state.p_px, state.V_b])


@compiled
def _wings_level(theta: float, heading: float) -> Quaternion:
    """Attitude at pitch and heading [rad]; compiled here, so that its machine code is kept on disk."""
    return quaternion_from_euler(0.0, theta, heading)
