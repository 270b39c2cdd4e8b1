"""Flying a mission, and what comes out of it as plain arrays."""

from collections.abc import Callable
from dataclasses import dataclass
from math import radians

import numpy as np
from numpy.typing import NDArray

from stommel.analysis.flight_table import flight_table
from stommel.compilation import compiled
from stommel.dynamics.acceleration import state_of
from stommel.dynamics.packing import pack, reference_water
from stommel.dynamics.state import Actuation
from stommel.geometry.attitude import quaternion_from_euler
from stommel.geometry.vectors import Quaternion
from stommel.ocean.kernel.grid import new_cell, new_column
from stommel.planning.mission import Mission
from stommel.simulation.memory import (
    CELL,
    EVENT_COLUMNS,
    EVENTS,
    PLANT_STATE,
    ROWS,
    SAMPLE_COLUMNS,
    SAMPLES,
    SOFTWARE_STATE,
    STATE_COLUMNS,
    SURFACING_COLUMNS,
    SURFACINGS,
    Log,
)
from stommel.simulation.mission_loop import OUTCOMES, RUNNING, Equipment, Sea, fly
from stommel.simulation.plant.building import plant_of
from stommel.simulation.plant.hull_air import KELVIN
from stommel.simulation.plant.parameters import Loop, Plant
from stommel.simulation.plant.waves import waves_of
from stommel.simulation.scenario.mission_file import MissionFile
from stommel.simulation.settings import column_step, dive_plan, hull_of, loop_of, orders_of, sensors_of
from stommel.vehicle import PHYSICS

Array = NDArray[np.float64]
Progress = Callable[[float], None]
"""Called with the share of the mission that is flown."""

_PIECE_DAYS = 0.5
"""A mission is flown in pieces of so many days, with progress and interruption between them."""


@dataclass(frozen=True)
class Flown:
    """What came out of a mission, as plain arrays; `stommel.simulation.results.dataset` makes a Dataset of it."""

    mission: Mission
    record: Array
    """Rows over time, `STATE_COLUMNS`."""
    samples: Array
    """Of the CTD, `SAMPLE_COLUMNS`."""
    surfacings: Array
    """`SURFACING_COLUMNS`."""
    events: Array
    """`EVENT_COLUMNS`."""
    outcome: str
    """How it ended."""
    plant: Plant
    distance_through_water: float
    """Along the path [m]."""


def fly_mission(mission: Mission, *, progress: Progress | None = None) -> Flown:
    """Fly a mission from its start until it is complete, its time is over, or it cannot go on.

    The same mission, seed and version give the same bytes.

    Raises
    ------
    StommelError
        The vehicle cannot fly the dives that the plan asks for.
    """
    plan, vehicle = mission.plan, pack(mission.vehicle, PHYSICS[mission.plan.physics])
    plant = plant_of(mission.vehicle, plan.sampling.phases)
    dives = dive_plan(mission, plant)
    loop = loop_of(mission, vehicle, dives)
    ticks = round(plan.duration_days * 86400.0 / loop.control_step)
    sensors = sensors_of(plan)
    equipment = Equipment(vehicle, plant, sensors, hull_of(mission))
    orders = orders_of(mission, plant, dives, flight_table(mission.vehicle, physics=PHYSICS[plan.physics]))
    grid = mission.ocean.grid()
    sea = Sea(grid, mission.ocean.table, waves_of(mission))
    column = new_column(grid, 1.2 * plan.dives.depth_m + 20.0, column_step(plan))
    x, software, world = _start(mission, plant)
    log, noise = _empty_log(plan, loop, sensors.sample_every, ticks), np.random.default_rng(plan.seed)
    piece = max(1, round(_PIECE_DAYS * 86400.0 / loop.control_step))
    outcome, done = RUNNING, 0
    while done < ticks and outcome == RUNNING:
        until = min(ticks, done + piece)
        outcome = fly(equipment, orders, sea, loop, column, x, software, world, noise, log, done, until)
        done = until
        if progress is not None:
            progress(done / ticks)
    record = log.record[: log.counts[ROWS]]
    return Flown(
        mission=mission,
        record=record,
        samples=log.samples[: log.counts[SAMPLES]],
        surfacings=log.surfacings[: log.counts[SURFACINGS]],
        events=log.events[: log.counts[EVENTS]],
        outcome=OUTCOMES[outcome],
        plant=plant,
        distance_through_water=float(np.linalg.norm(record[:, 7:10], axis=1).sum() * plan.output_every_s),
    )


def _empty_log(plan: MissionFile, loop: Loop, sample_every: int, ticks: int) -> Log:
    """Room for everything that a mission can write down."""
    most_dives = max(16, int(plan.duration_days * 86400.0 / 60.0))
    counts = np.zeros(6, dtype=np.int64)
    counts[CELL] = new_cell()
    return Log(
        record=np.empty((ticks // loop.record_every + 2, len(STATE_COLUMNS))),
        samples=np.empty((ticks // sample_every + 2, len(SAMPLE_COLUMNS))),
        surfacings=np.empty((most_dives, len(SURFACING_COLUMNS))),
        events=np.empty((8 * most_dives, len(EVENT_COLUMNS))),
        counts=counts,
    )


def _start(mission: Mission, plant: Plant) -> tuple[Array, np.record, np.record]:
    """State of the equations, of the software and of the world: afloat at the start, heading as asked."""
    plan, vehicle = mission.plan, mission.vehicle
    latitude, longitude = radians(plan.start.latitude_deg), radians(plan.start.longitude_deg)
    software = np.zeros(1, SOFTWARE_STATE).view(np.recarray)[0]
    world = np.zeros(1, PLANT_STATE).view(np.recarray)[0]
    world.latitude = software.latitude = software.submerged_latitude = software.line_latitude = latitude
    world.longitude = software.longitude = software.submerged_longitude = software.line_longitude = longitude
    world.afloat, world.moved_at, software.first_fix_at = 1, -1e9, -1.0
    heading = radians(plan.heading_deg)
    software.heading_wanted = software.heading_before = heading
    here = mission.ocean.at(plan.start_seconds, plan.start.latitude_deg, plan.start.longitude_deg, 0.0)
    world.thermistor = world.water_before = here.temperature
    world.air_temperature = here.temperature + KELVIN
    theta = radians(plan.dives.pitch_deg)
    world.measured[:] = (theta, heading, 0.0)
    rest = (0.0, 0.0, 0.0)
    Q = _wings_level(theta, heading)
    r_px = vehicle.description.moving_mass.neutral_position_m
    record = pack(vehicle, PHYSICS[plan.physics])
    state = state_of(record, rest, rest, rest, Q, r_px, plant.ballast_high, Actuation(), reference_water(vehicle))
    x = np.array([*state.X, *state.Q, *state.p, *state.h, state.r_px, state.p_px, state.V_b])
    return x, software, world


@compiled
def _wings_level(theta: float, heading: float) -> Quaternion:
    """Attitude at pitch and heading [rad]; compiled here, so that its machine code is kept on disk."""
    return quaternion_from_euler(0.0, theta, heading)
