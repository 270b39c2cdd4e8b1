"""A mission: a vehicle, an ocean and a plan, ready to be flown, and flown."""

import tomllib
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from math import radians
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from pydantic import ValidationError

from stommel.analysis.flight_table import flight_table
from stommel.analysis.trim import trim
from stommel.control.dive_cycle import DivePlan
from stommel.control.laws import HeadingLaw, PitchLaw
from stommel.dynamics.acceleration import state_of
from stommel.dynamics.attitude import quaternion_from_euler
from stommel.dynamics.packing import pack, reference_water
from stommel.dynamics.state import Actuation
from stommel.errors import FileError, Problem, StommelError
from stommel.ocean.grid import new_cell, new_column
from stommel.ocean.ocean import Ocean
from stommel.simulation.flying import OUTCOMES, RUNNING, fly
from stommel.simulation.mission_file import MissionFile
from stommel.simulation.parameters import (
    EVENT_COLUMNS,
    PLANT_STATE,
    SOFTWARE_STATE,
    STATE_COLUMNS,
    SURFACING_COLUMNS,
    Loop,
    Plant,
    Sensors,
)
from stommel.simulation.plant import plant_of
from stommel.vehicle import PHYSICS, Vehicle, load_vehicle
from stommel.vehicle.messages import sentences

Array = NDArray[np.float64]
Progress = Callable[[float], None]
"""Called with the share of the mission that is flown."""

_PIECE_DAYS = 0.5
"""A mission is flown in pieces of so many days, with progress and interruption between them."""


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


@dataclass(frozen=True)
class Flown:
    """What came out of a mission, as plain arrays; `stommel.simulation.results` makes a Dataset of it."""

    mission: Mission
    record: Array
    """Rows over time, `STATE_COLUMNS`."""
    surfacings: Array
    """`SURFACING_COLUMNS`."""
    events: Array
    """`EVENT_COLUMNS`."""
    outcome: str
    """How it ended."""
    plant: Plant
    distance_through_water: float
    """Along the path [m]."""


def load_mission(path: str | Path) -> Mission:
    """Read a mission file, its vehicle and its ocean, and check them against each other.

    Raises
    ------
    FileError
        The file cannot be read, or something in it is impossible; with the key and what is allowed.
    StommelError
        The vehicle or the ocean cannot be used.
    """
    name = str(path)
    try:
        text = Path(path).read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError) as error:
        raise FileError([Problem(name, "", f"cannot be read: {error}")]) from error
    try:
        document = tomllib.loads(text)
    except tomllib.TOMLDecodeError as error:
        raise FileError([Problem(name, "", f"is not valid TOML: {error}")]) from error
    return mission_from(document, name, Path(path).parent)


def mission_from(
    document: Mapping[str, Any],
    origin: str,
    folder: Path,
    vehicle: Vehicle | None = None,
    ocean: Ocean | None = None,
) -> Mission:
    """Make a mission of a parsed file; files that it names are sought in `folder`.

    `vehicle` and `ocean`, already loaded, stand in for the file's own.
    """
    try:
        plan = MissionFile.model_validate(document)
    except ValidationError as error:
        raise FileError([Problem(origin, key, text) for key, text in sentences(error, MissionFile)]) from None
    if vehicle is None:
        beside = folder / plan.vehicle
        vehicle = load_vehicle(beside if beside.is_file() else plan.vehicle)
    for key, value in plan.changes.items():
        vehicle = vehicle.with_value(key, value)
    vehicle.require_lateral("a mission")
    if ocean is None:
        ocean = _ocean(plan, folder)
    mission = Mission(plan, vehicle, ocean, origin, document)
    _check(mission)
    return replace(mission, vehicle=_ballasted(mission))


def _ballasted(mission: Mission) -> Vehicle:
    """Trim the vehicle neutral in the water it will fly in, as before any deployment.

    At `ballasting.neutral_depth_m`; if that is left out, in the middle of what the buoyancy engine must follow.
    """
    plan, vehicle = mission.plan, mission.vehicle
    depth = plan.ballasting.neutral_depth_m
    if depth is None:
        volumes = neutral_volumes(mission)
        middle = 0.5 * float(volumes.min() + volumes.max())
        neutral_volume = vehicle.description.mass_kg / vehicle.description.water.density_kg_m3 + middle
        return vehicle.with_value("water.density_kg_m3", vehicle.description.mass_kg / neutral_volume)
    here = mission.ocean.at(plan.start_seconds, plan.start.latitude_deg, plan.start.longitude_deg, depth)
    record = pack(vehicle, PHYSICS[plan.physics])
    yielded = 1.0 - record.kappa * here.pressure + record.alpha_T * (here.temperature - record.T_0)
    return vehicle.with_value("water.density_kg_m3", float(here.density * yielded))


def _ocean(plan: MissionFile, folder: Path) -> Ocean:
    choice = plan.ocean
    if choice.name is not None:
        return Ocean.analytic(choice.name, **choice.parameters)
    assert choice.file is not None
    beside = folder / choice.file
    return Ocean.open(beside if beside.is_file() else Path(choice.file), outside=choice.outside)


def _check(mission: Mission) -> None:
    """Refuse what cannot be flown: too deep for the hull, waypoints on land or outside the ocean."""
    plan, hull, origin = mission.plan, mission.vehicle.description.hull, mission.origin
    wrong: list[Problem] = []
    rating = hull.depth_rating_m if hull is not None else None
    if rating is not None and plan.dives.depth_m > rating:
        text = f"dives.depth_m = {plan.dives.depth_m:g}: deeper than the hull's rating, {rating:g} m"
        wrong.append(Problem(origin, "dives.depth_m", text))
    places = {"start": plan.start} | {f"waypoints.{i}": place for i, place in enumerate(plan.waypoints)}
    for key, place in places.items():
        try:
            mission.ocean.at(plan.start_seconds, place.latitude_deg, place.longitude_deg, 0.0)
        except StommelError as error:
            text = f"{key} = ({place.latitude_deg:g}, {place.longitude_deg:g}): {error}"
            wrong.append(Problem(origin, key, text))
    if not wrong:
        bottom = mission.ocean.bottom_depth(plan.start.latitude_deg, plan.start.longitude_deg)
        if plan.dives.depth_m > bottom:
            text = f"dives.depth_m = {plan.dives.depth_m:g}: below the bottom at the start, {bottom:.4g} m"
            wrong.append(Problem(origin, "dives.depth_m", text))
    if wrong:
        raise FileError(wrong)


def fly_mission(mission: Mission, *, progress: Progress | None = None) -> Flown:
    """Fly a mission from its start until it is complete, its time is over, or it cannot go on.

    The same mission, seed and version give the same bytes.

    Raises
    ------
    StommelError
        The vehicle cannot fly the dives that the plan asks for.
    """
    plan = mission.plan
    loop = _loop(plan)
    table = flight_table(mission.vehicle, physics=PHYSICS[plan.physics])
    plant = plant_of(mission.vehicle)
    ticks = round(plan.duration_days * 86400.0 / loop.control_step)
    record = np.full((ticks // loop.record_every + 2, len(STATE_COLUMNS)), np.nan)
    most_dives = max(16, int(plan.duration_days * 86400.0 / 60.0))
    surfacings = np.full((most_dives, len(SURFACING_COLUMNS)), np.nan)
    events = np.full((8 * most_dives, len(EVENT_COLUMNS)), np.nan)
    counts = np.zeros(5, dtype=np.int64)
    counts[3:5] = new_cell()
    x, software, world = _start(mission, plant)
    grid, density = mission.ocean.grid(), mission.ocean.table
    noise = np.random.default_rng(plan.seed)
    column = new_column(grid, 1.2 * plan.dives.depth_m + 20.0, _levels(plan))
    piece = max(1, round(_PIECE_DAYS * 86400.0 / loop.control_step))
    outcome, done = RUNNING, 0
    vehicle, sensors, dives = pack(mission.vehicle, PHYSICS[plan.physics]), sensors_of(plan), _dive_plan(mission, plant)
    pitch_law, heading_law, waypoints = _pitch_law(plan), _heading_law(plan), _waypoints(plan)
    while done < ticks and outcome == RUNNING:
        until = min(ticks, done + piece)
        outcome = fly(
            vehicle, plant, sensors, loop, dives, pitch_law, heading_law, table, waypoints,
            plan.guidance.acceptance_radius_m, plan.guidance.lookahead_m, grid, density, column, x, software, world,
            noise, done, until, record, surfacings, events, counts,
        )  # fmt: skip
        done = until
        if progress is not None:
            progress(done / ticks)
    path = np.linalg.norm(record[: counts[0], 7:10], axis=1).sum() * plan.output_every_s
    return Flown(
        mission=mission,
        record=record[: counts[0]],
        surfacings=surfacings[: counts[1]],
        events=events[: counts[2]],
        outcome=OUTCOMES[outcome],
        plant=plant,
        distance_through_water=float(path),
    )


def _levels(plan: MissionFile) -> float:
    """Distance of the column's depths [m]: fine in a pool, 2 m at sea."""
    return min(2.0, plan.dives.depth_m / 20.0)


def _loop(plan: MissionFile) -> Loop:
    cut = plan.integration
    return Loop(
        start=plan.start_seconds,
        control_step=cut.control_step_s,
        steady_steps=cut.steady_steps,
        moving_steps=cut.moving_steps,
        settle_time=cut.settle_s,
        column_period=cut.ocean_s,
        record_every=round(plan.output_every_s / cut.control_step_s),
    )


def sensors_of(plan: MissionFile) -> Sensors:
    """Sensor errors of a plan, SI units and radians."""
    s = plan.sensors
    dip = radians(s.magnetic_inclination_deg)
    rows = s.soft_iron
    return Sensors(
        attitude_noise=radians(s.attitude_noise_deg),
        heading_noise=radians(s.heading_noise_deg),
        pressure_noise=s.pressure_noise_m,
        pressure_bias=s.pressure_bias_m,
        position_noise=s.gps_noise_m,
        first_fix_time=s.first_fix_s,
        altimeter_range=s.altimeter_range_m,
        field=(float(np.cos(dip)), 0.0, float(np.sin(dip))),
        hard_iron=s.hard_iron,
        soft_iron=(*rows[0], *rows[1], *rows[2]),
        pump_field=s.pump_field,
        valve_field=s.valve_field,
        mass_field=s.pitch_drive_field,
        steering_field=s.steering_field,
        shielding=s.shielding,
    )


def neutral_volumes(mission: Mission) -> Array:
    """Ballast volumes at which the vehicle is neutral from the surface to the dive depth, at the start [m3]."""
    plan, record = mission.plan, pack(mission.vehicle, PHYSICS[mission.plan.physics])
    volumes = []
    for depth in np.linspace(0.0, plan.dives.depth_m, 41):
        here = mission.ocean.at(plan.start_seconds, plan.start.latitude_deg, plan.start.longitude_deg, float(depth))
        hull = 1.0 - record.kappa * here.pressure + record.alpha_T * (here.temperature - record.T_0)
        volumes.append(record.m / here.density - record.V_0 * hull)
    return np.array(volumes)


def ballast_volumes(mission: Mission, plant: Plant) -> tuple[float, float]:
    """Ballast volumes of descent and ascent [m3], so that the vehicle keeps its drive through all of the water.

    The wanted drive (from the trim at the wanted speed, or given) is added to the volume of neutral buoyancy where the
    water is lightest on the way down, and where it is heaviest for the hull on the way up.

    Raises
    ------
    StommelError
        The density of the water varies more than the buoyancy engine can follow.
    """
    plan, dives = mission.plan, mission.plan.dives
    if dives.ballast_ml is not None:
        drive_down = drive_up = dives.ballast_ml / 1e6
    else:
        assert dives.speed_m_s is not None
        physics = PHYSICS[plan.physics]
        drive_down, drive_up = (
            abs(trim(mission.vehicle, speed_m_s=dives.speed_m_s, pitch_deg=sign * dives.pitch_deg, physics=physics).V_b)
            for sign in (-1.0, 1.0)
        )
    neutral = neutral_volumes(mission)
    down, up = float(neutral.min()) - drive_down, float(neutral.max()) + drive_up
    if down < plant.ballast_low - 1e-9 or up > plant.ballast_high + 1e-9:
        raise StommelError(
            f"{mission.origin}: dives: the water between 0 and {dives.depth_m:g} m is neutral from "
            f"{neutral.min() * 1e6:.0f} to {neutral.max() * 1e6:.0f} ml; with the wanted drive the engine needs "
            f"{down * 1e6:.0f} to {up * 1e6:.0f} ml and has {plant.ballast_low * 1e6:.0f} to "
            f"{plant.ballast_high * 1e6:.0f} ml: dive slower, shallower, or set ballasting.neutral_depth_m"
        )
    return down, up


def _dive_plan(mission: Mission, plant: Plant) -> DivePlan:
    plan = mission.plan
    dives, theta = plan.dives, radians(plan.dives.pitch_deg)
    down, up = ballast_volumes(mission, plant)
    surface = plan.surface.ballast_ml
    return DivePlan(
        depth=dives.depth_m,
        theta=theta,
        V_b_dive=down,
        V_b_climb=up,
        V_b_surface=plant.ballast_high if surface is None else surface / 1e6,
        surface_time=plan.surface.session_s,
        least_altitude=dives.least_altitude_m,
        shallow_depth=plan.surface.depth_m,
        dives_per_surfacing=float(dives.per_surfacing),
        turn_depth=dives.turn_depth_m,
        abort_depth=plan.abort.depth_m or 1.1 * dives.depth_m,
        abort_time=plan.abort.dive_hours * 3600.0,
    )


def _pitch_law(plan: MissionFile) -> PitchLaw:
    law = plan.pitch_control
    return PitchLaw(
        gain=law.gain_mm_per_deg / 1e3 / radians(1.0),
        dead_band=radians(law.dead_band_deg),
        period=law.period_s,
        tolerance=law.tolerance_mm / 1e3,
    )


def _heading_law(plan: MissionFile) -> HeadingLaw:
    law = plan.heading_control
    return HeadingLaw(law.gain, law.damping_s, radians(law.dead_band_deg), radians(law.limit_deg))


def _waypoints(plan: MissionFile) -> Array:
    """Waypoints in radians; with `repeat`, as often as the mission could reach them."""
    places = [(radians(place.latitude_deg), radians(place.longitude_deg)) for place in plan.waypoints]
    if plan.guidance.repeat and places:
        places *= max(1, int(2000 / len(places)))
    return np.array(places, dtype=float).reshape(-1, 2)


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
    software.heading_wanted = heading
    rest = (0.0, 0.0, 0.0)
    Q = quaternion_from_euler(0.0, radians(plan.dives.pitch_deg), heading)
    r_px = vehicle.description.moving_mass.neutral_position_m
    record = pack(vehicle, PHYSICS[plan.physics])
    state = state_of(record, rest, rest, rest, Q, r_px, plant.ballast_high, Actuation(), reference_water(vehicle))
    x = np.array([*state.X, *state.Q, *state.p, *state.h, state.r_px, state.p_px, state.V_b])
    return x, software, world
