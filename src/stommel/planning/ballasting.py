"""Ballast of a mission: how the vehicle is trimmed before it, and how much oil its dives need."""

from math import radians
from typing import Any

import numpy as np
from numpy.typing import NDArray

from stommel.analysis.trim import trim
from stommel.compilation import compiled
from stommel.dynamics.equations import static_moment
from stommel.dynamics.inertia import moving_mass_position
from stommel.dynamics.packing import pack, reference_water
from stommel.errors import StommelError
from stommel.geometry.vectors import Vector
from stommel.ocean.kernel.column import fill_column
from stommel.ocean.kernel.grid import RHO, TEMPERATURE, P, new_cell, new_column
from stommel.planning.deployment import Deployment
from stommel.seawater.water import Water
from stommel.vehicle import Vehicle

Array = NDArray[np.float64]


_DEPTHS = 41
"""At which the water of a dive is looked at."""


def ballasted(deployment: Deployment) -> Vehicle:
    """Trim the vehicle neutral in the water it will fly in, as before any deployment.

    At `ballasting.neutral_depth_m`; if that is left out, in the middle of what the buoyancy engine must follow.
    """
    vehicle = deployment.vehicle
    depth = deployment.neutral_depth_m
    if depth is None:
        volumes = neutral_volumes(deployment)
        middle = 0.5 * float(volumes.min() + volumes.max())
        neutral_volume = vehicle.description.mass_kg / vehicle.neutral_density_kg_m3 + middle
        return vehicle.trimmed_for(vehicle.description.mass_kg / neutral_volume)
    here = deployment.ocean.at(deployment.time, deployment.latitude_deg, deployment.longitude_deg, depth)
    record = pack(vehicle, deployment.physics)
    yielded = _yielded(record, here.pressure, here.temperature)
    return vehicle.trimmed_for(float(here.density * yielded))


def _yielded(record: np.record, pressure: Any, temperature: Any) -> Any:
    """Volume of the hull at a gauge pressure [Pa] and temperature [deg C], as a part of that at the surface."""
    return 1.0 - record.kappa * pressure + record.alpha_T * (temperature - record.T_0)


def neutral_volumes(deployment: Deployment) -> Array:
    """Ballast volumes at which the vehicle is neutral from the surface to the dive depth, at the start [m3]."""
    plan, record = deployment.plan, pack(deployment.vehicle, deployment.physics)
    water = _water_below(deployment, plan.dives.depth_m)
    hull = _yielded(record, water[:, P], water[:, TEMPERATURE])
    volumes: Array = record.m / water[:, RHO] - record.V_0 * hull
    return volumes


def _water_below(deployment: Deployment, depth: float) -> Array:
    """Rows of an ocean column from the surface to `depth` [m] at the start."""
    ocean = deployment.ocean
    latitude, longitude = deployment.latitude_deg, deployment.longitude_deg
    ocean.at(deployment.time, latitude, longitude, depth)  # says so if there is no such water
    column = new_column(ocean.grid(), depth, depth / (_DEPTHS - 1))
    fill_column(ocean.grid(), ocean.table, deployment.time, radians(latitude), radians(longitude), new_cell(), column)
    return column.values


def drives(deployment: Deployment) -> tuple[float, float]:
    """Ballast volumes beyond neutral, down and up, that drive the dives: given, or of the wanted speed [m3]."""
    dives = deployment.plan.dives
    if dives.ballast_ml is not None:
        return dives.ballast_ml / 1e6, dives.ballast_ml / 1e6
    assert dives.speed_m_s is not None
    down, up = (
        trim(deployment.vehicle, speed_m_s=dives.speed_m_s, pitch_deg=pitch, physics=deployment.physics).V_b
        for pitch in (-dives.pitch_deg, dives.pitch_deg)
    )
    return abs(down), abs(up)


def ballast_volumes(deployment: Deployment, neutral: Array) -> tuple[float, float]:
    """Ballast volumes of descent and ascent [m3], so that the vehicle keeps its drive through all of the water.

    `neutral` are the `neutral_volumes` of the dive.

    The wanted drive (from the trim at the wanted speed, or given) is added to the volume of neutral buoyancy where the
    water is lightest on the way down, and where it is heaviest for the hull on the way up.

    Raises
    ------
    StommelError
        The density of the water varies more than the buoyancy engine can follow, or the vehicle is trimmed so far from
        it that it would dive with oil outside: the flight software takes the sign of the volume for the way.
    """
    dives, (drive_down, drive_up) = deployment.plan.dives, drives(deployment)
    low, high = deployment.ballast_range
    down, up = float(neutral.min()) - drive_down, float(neutral.max()) + drive_up
    if down < low - 1e-9 or up > high + 1e-9:
        raise StommelError(
            f"{deployment.origin}: dives: the water between 0 and {dives.depth_m:g} m is neutral from "
            f"{neutral.min() * 1e6:.0f} to {neutral.max() * 1e6:.0f} ml; with the wanted drive the engine needs "
            f"{down * 1e6:.0f} to {up * 1e6:.0f} ml and has {low * 1e6:.0f} to "
            f"{high * 1e6:.0f} ml: dive slower, shallower, or set ballasting.neutral_depth_m"
        )
    if down >= 0.0 or up <= 0.0:
        raise StommelError(
            f"{deployment.origin}: ballasting.neutral_depth_m: trimmed there, it would dive with {down * 1e6:.0f} "
            f"and climb with {up * 1e6:.0f} ml; needed are less and more than 0 ml: choose a depth between 0 and "
            f"{dives.depth_m:g} m, or leave it out"
        )
    return down, up


def mass_position_at_rest(deployment: Deployment, V_b: float, theta: float) -> float:
    """Moving-mass position at which the vehicle rests at pitch `theta` [rad] with ballast volume `V_b` [m3]; [m].

    Gravity and the bladder's buoyancy balance about the centre of buoyancy; the limit switches bound the answer.
    """
    record, water = pack(deployment.vehicle, deployment.physics), reference_water(deployment.vehicle)
    # the moment is linear in the position: two looks tell it all
    a, b = (_moment_at_rest(record, water, r_px, V_b) for r_px in (0.0, 1.0))
    tangent = np.tan(theta)
    # at rest tan(theta) = -s_1 / s_3
    r_px = -(a[0] + tangent * a[2]) / ((b[0] - a[0]) + tangent * (b[2] - a[2]))
    return float(np.clip(r_px, *deployment.mass_range))


@compiled
def _moment_at_rest(vehicle: np.record, water: Water, r_px: float, V_b: float) -> Vector:
    """Building blocks called one by one would be compiled anew in every process: they are kept within their callers."""
    return static_moment(vehicle, water, moving_mass_position(vehicle, r_px, 0.0), V_b)
