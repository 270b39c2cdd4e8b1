"""Dives through stratified water: the ballast that keeps a wanted mean speed, and the trim before the deployment.

Equation numbers are those of docs/theory/simulation.
"""

from dataclasses import dataclass
from math import radians
from typing import Any

import numpy as np
from numpy.typing import NDArray

from stommel.analysis.trim import trim
from stommel.dynamics.packing import pack
from stommel.ocean.kernel.column import fill_column
from stommel.ocean.kernel.grid import RHO, TEMPERATURE, P, new_cell, new_column
from stommel.ocean.ocean import Ocean
from stommel.vehicle import Physics, Vehicle

Array = NDArray[np.float64]

DEPTHS = 41
"""At which the water of a dive is looked at."""
REFERENCE_SPEED = 0.4
"""By which the speed of a given drive is told [m/s]."""
LEAST_SHARE = 0.5
"""The vehicle is nowhere slower than this part of its mean speed, unless it is told otherwise: water changes."""


@dataclass(frozen=True)
class DiveWater:
    """Water from the surface to the depth of a dive, at one place and time; columns of one length."""

    depth: Array
    """[m]."""
    pressure: Array
    """Gauge pressure [Pa]."""
    density: Array
    """[kg/m3]."""
    temperature: Array
    """In situ [deg C]."""

    @property
    def mean_temperature_c(self) -> float:
        """Mean over the depth [deg C]; what the cells of a vehicle take on that goes up and down in it."""
        return float(np.mean(self.temperature))


def dive_water(ocean: Ocean, time: float, latitude_deg: float, longitude_deg: float, depth: float) -> DiveWater:
    """Look at the water of an ocean from the surface to `depth` [m], at a time [s since 1970] and place [deg].

    Raises
    ------
    StommelError
        There is no such water.
    """
    ocean.at(time, latitude_deg, longitude_deg, depth)  # says so if there is no such water
    grid = ocean.grid()
    column = new_column(grid, depth, depth / (DEPTHS - 1))
    fill_column(grid, ocean.table, time, radians(latitude_deg), radians(longitude_deg), new_cell(), column)
    rows = column.values
    depths = np.linspace(0.0, depth, len(rows))
    return DiveWater(depths, rows[:, P].copy(), rows[:, RHO].copy(), rows[:, TEMPERATURE].copy())


def yielded(record: np.record, pressure: Any, temperature: Any) -> Any:
    """Volume of the hull at a gauge pressure [Pa] and temperature [deg C], as a part of that at the surface."""
    return 1.0 - record.kappa * pressure + record.alpha_T * (temperature - record.T_0)


def neutral_volumes(vehicle: Vehicle, physics: Physics, water: DiveWater) -> Array:
    """Ballast volumes at which the vehicle is neutral at the depths of the water [m3]."""
    record = pack(vehicle, physics)
    hull = yielded(record, water.pressure, water.temperature)
    volumes: Array = record.m / water.density - record.V_0 * hull
    return volumes


def trimmed_midway(vehicle: Vehicle, physics: Physics, water: DiveWater) -> Vehicle:
    """Trim the vehicle neutral in the middle of what its buoyancy engine must follow in this water."""
    volumes = neutral_volumes(vehicle, physics, water)
    middle = 0.5 * float(volumes.min() + volumes.max())
    neutral_volume = vehicle.description.mass_kg / vehicle.neutral_density_kg_m3 + middle
    return vehicle.trimmed_for(vehicle.description.mass_kg / neutral_volume)


@dataclass(frozen=True)
class WantedDive:
    """Dive and climb as they are asked for: by a mean speed or by ballast."""

    theta_deg: float
    """Magnitude of the pitch, down and up [deg]."""
    speed: float | None = None
    """Mean speed along the path, over the depth of the dive [m/s]."""
    least_speed: float | None = None
    """Nowhere slower than this [m/s]; `LEAST_SHARE` of the mean speed if left out."""
    drive: float | None = None
    """Ballast volume beyond neutral where the water drives least, instead of the speeds [m3]."""


@dataclass(frozen=True)
class DiveBallast:
    """Ballast of a dive in its water."""

    down: float
    """Ballast volume of the descent [m3]."""
    up: float
    """Of the ascent [m3]."""
    speed_down: float
    """Way over time of the descent at these volumes, by the trim [m/s]."""
    speed_up: float
    """Of the ascent [m/s]."""
    neutral_top: float
    """Ballast volume at which the vehicle is neutral at the surface [m3]."""
    neutral_bottom: float
    """The same at the depth of the dive [m3]."""


def drives_at(vehicle: Vehicle, physics: Physics, theta_deg: float, speed: float) -> tuple[float, float]:
    """Ballast volumes beyond neutral, down and up, that drive steady flight at a speed in one water [m3]."""
    down, up = (
        trim(vehicle, speed_m_s=speed, pitch_deg=pitch, physics=physics).V_b for pitch in (-theta_deg, theta_deg)
    )
    return abs(down), abs(up)


def ballast_for(vehicle: Vehicle, physics: Physics, neutral: Array, wanted: WantedDive) -> DiveBallast:
    """Return the ballast volumes of descent and ascent (eq-sim3).

    At a fixed pitch the speed goes with the root of the ballast volume beyond neutral, which `neutral` gives at even
    steps of depth. The volume is chosen so that the way through the water over its time is the wanted mean speed; by
    `drive` or a least speed alone, so that this much is left where the water drives least. Where the water would bring
    the vehicle below its least speed, it keeps that, and flies faster than wanted on average.
    """
    speed = wanted.speed or wanted.least_speed or REFERENCE_SPEED
    drives = drives_at(vehicle, physics, wanted.theta_deg, speed)
    spares = neutral - neutral.min(), neutral.max() - neutral
    if wanted.drive is not None:
        down, up = wanted.drive, wanted.drive
    elif wanted.speed is None:
        down, up = drives
    else:
        least = LEAST_SHARE * speed if wanted.least_speed is None else wanted.least_speed
        down, up = (_drive_of_mean(spare, drive, speed, least) for spare, drive in zip(spares, drives, strict=True))
    return DiveBallast(
        down=float(neutral.min()) - down,
        up=float(neutral.max()) + up,
        speed_down=mean_speed(spares[0], down, drives[0], speed),
        speed_up=mean_speed(spares[1], up, drives[1], speed),
        neutral_top=float(neutral[0]),
        neutral_bottom=float(neutral[-1]),
    )


def mean_speed(spare: Array, least_drive: float, drive: float, speed: float) -> float:
    """Way over time of a leg through even steps of depth [m/s].

    `drive` [m3] is what `speed` [m/s] takes, and the leg has `least_drive` + `spare` [m3].
    """
    slowness = np.sqrt(drive / (least_drive + spare)) / speed
    return float(1.0 / (np.trapezoid(slowness) / (len(slowness) - 1)))


def _drive_of_mean(spare: Array, drive: float, mean: float, least: float) -> float:
    """Least drive of a leg [m3] whose mean speed is `mean`, but no less than the drive of the speed `least`."""
    floor = drive * (least / mean) ** 2

    def excess(volume: float) -> float:
        return mean_speed(spare, volume, drive, mean) - mean

    if excess(floor) >= 0.0:
        return floor
    if excess(drive) <= 0.0:  # water of one density
        return drive
    from scipy.optimize import brentq  # noqa: PLC0415 - slow to import, seldom wanted

    return float(brentq(excess, floor, drive, xtol=1e-12))
