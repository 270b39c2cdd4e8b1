"""Ballast of a mission: how the vehicle is trimmed before it, and how much oil its dives need."""

from math import inf

import numpy as np
from numpy.typing import NDArray

from stommel.analysis.stratified import (
    DiveBallast,
    DiveWater,
    WantedDive,
    ballast_for,
    dive_water,
    drives_at,
    neutral_volumes,
    trimmed_midway,
    yielded,
)
from stommel.compilation import compiled
from stommel.dynamics.equations import static_moment
from stommel.dynamics.inertia import moving_mass_position
from stommel.dynamics.packing import pack, reference_water
from stommel.errors import StommelError
from stommel.geometry.vectors import Vector
from stommel.machinery.hull.floating import emerged_moment, hull_form
from stommel.machinery.power.engine_work import pump_by_engine
from stommel.planning.deployment import Deployment
from stommel.seawater.water import Water
from stommel.vehicle import Vehicle

Array = NDArray[np.float64]


def water_of(deployment: Deployment) -> DiveWater:
    """Water of the dives, where and when the mission begins."""
    return dive_water(
        deployment.ocean,
        deployment.time,
        deployment.latitude_deg,
        deployment.longitude_deg,
        deployment.plan.dives.depth_m,
    )


def ballasted(deployment: Deployment) -> Vehicle:
    """Trim the vehicle neutral in the water it will fly in, as before any deployment.

    At `ballasting.neutral_depth_m`; if that is left out, in the middle of what the buoyancy engine must follow.
    """
    vehicle = deployment.vehicle
    depth = deployment.neutral_depth_m
    if depth is None:
        return trimmed_midway(vehicle, deployment.physics, water_of(deployment))
    here = deployment.ocean.at(deployment.time, deployment.latitude_deg, deployment.longitude_deg, depth)
    record = pack(vehicle, deployment.physics)
    return vehicle.trimmed_for(float(here.density * yielded(record, here.pressure, here.temperature)))


def neutral_ballast(deployment: Deployment) -> Array:
    """Ballast volumes at which the vehicle is neutral from the surface to the dive depth, at the start [m3]."""
    return neutral_volumes(deployment.vehicle, deployment.physics, water_of(deployment))


def drives(deployment: Deployment) -> tuple[float, float]:
    """Ballast volumes beyond neutral, down and up, that drive the dives: given, or of the wanted speed [m3]."""
    dives = deployment.plan.dives
    if dives.ballast_ml is not None:
        return dives.ballast_ml / 1e6, dives.ballast_ml / 1e6
    speed = dives.least_speed_m_s if dives.speed_m_s is None else dives.speed_m_s
    assert speed is not None
    return drives_at(deployment.vehicle, deployment.physics, dives.pitch_deg, speed)


def wanted_dive(deployment: Deployment) -> WantedDive:
    """What the plan asks of its dives."""
    dives = deployment.plan.dives
    drive = None if dives.ballast_ml is None else dives.ballast_ml / 1e6
    return WantedDive(dives.pitch_deg, dives.speed_m_s, dives.least_speed_m_s, drive)


def ballast_volumes(deployment: Deployment, neutral: Array) -> DiveBallast:
    """Ballast volumes of descent and ascent, by `neutral_ballast` of the dive.

    Raises
    ------
    StommelError
        The density of the water varies more than the buoyancy engine can follow, or the vehicle is trimmed so far from
        it that it would dive with oil outside: the flight software takes the sign of the volume for the way.
    """
    dives = deployment.plan.dives
    low, high = deployment.ballast_range
    found = ballast_for(deployment.vehicle, deployment.physics, neutral, wanted_dive(deployment))
    down, up = found.down, found.up
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
    return found


def pump_flow(deployment: Deployment) -> float:
    """Flow of the pump at the depth of the dives, by its machinery or as the file states it [m3/s]."""
    d = deployment.vehicle.description
    if d.engine is None:
        stated = d.actuators.buoyancy.flow_ml_s if d.actuators.buoyancy else None
        return inf if stated is None else stated / 1e6
    P = float(water_of(deployment).pressure[-1])
    flow = float(pump_by_engine(d.engine, P).inflating_m3_s[-1])
    return flow if flow > 0.0 else inf  # one that stalls is refused elsewhere


def afloat_volume(deployment: Deployment) -> float:
    """Ballast volume at the surface: the plan's, or the greatest of the buoyancy engine [m3]."""
    stated = deployment.plan.surface.ballast_ml
    return deployment.ballast_range[1] if stated is None else stated / 1e6


def surplus_afloat(deployment: Deployment) -> float:
    """Volume that stands out of the water at the surface, by the water at the start [m3]."""
    return max(0.0, afloat_volume(deployment) - float(neutral_ballast(deployment)[0]))


def mass_position_at_rest(deployment: Deployment, V_b: float, theta: float, surplus: float = 0.0) -> float:
    """Moving-mass position at which the vehicle rests at pitch `theta` [rad] with ballast volume `V_b` [m3]; [m].

    Gravity and the bladder's buoyancy balance about the centre of buoyancy, at the surface also what the end carries
    that stands out with a volume `surplus` [m3]; the limit switches bound the answer.
    """
    record, water = pack(deployment.vehicle, deployment.physics), reference_water(deployment.vehicle)
    # the moment is linear in the position: two looks tell it all
    a, b = (_moment_at_rest(record, water, r_px, V_b) for r_px in (0.0, 1.0))
    tangent = np.tan(theta)
    lifted = water.rho * emerged_moment(hull_form(deployment.vehicle.description), theta, surplus)
    # at rest tan(theta) = -s_1 / s_3
    r_px = -(a[0] + lifted + tangent * a[2]) / ((b[0] - a[0]) + tangent * (b[2] - a[2]))
    return float(np.clip(r_px, *deployment.mass_range))


@compiled
def _moment_at_rest(vehicle: np.record, water: Water, r_px: float, V_b: float) -> Vector:
    """Building blocks called one by one would be compiled anew in every process: they are kept within their callers."""
    return static_moment(vehicle, water, moving_mass_position(vehicle, r_px, 0.0), V_b)
