"""The sea state around a floating vehicle: a JONSWAP spectrum, and what of it the vehicle does not follow."""

import math
from math import pi, sqrt
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from stommel.compilation import inlined
from stommel.geometry.vectors import Vector
from stommel.machinery.hull.floating import hull_form, slice_at
from stommel.planning.ballasting import surplus_afloat
from stommel.simulation.scenario.mission import Mission

Array = NDArray[np.float64]


class Waves(NamedTuple):
    """Elevation of the sea surface above a floating vehicle that follows it in part, as a sum of cosines."""

    amplitude: Array
    """Of the elevation relative to the vehicle [m]."""
    omega: Array
    """Angular frequency [rad/s]."""
    phase: Array
    """[rad]"""


COMPONENTS = 32
"""Cosines that make up the sea."""
HEAVE_DAMPING = 0.2
"""Damping ratio of the heave of a floating hull, as an assumption."""
HEAVE_PERIOD = 3.0
"""Natural period of heave where the vehicle file does not tell the hull's diameter [s]."""
PEAKEDNESS = 3.3
"""gamma of the mean JONSWAP spectrum (Hasselmann et al. 1973)."""


def waves_of(mission: Mission) -> Waves:
    """Elevation of the sea relative to the floating vehicle.

    Frequencies and phases are drawn from the mission's seed, apart from the noise of the sensors.
    """
    sea = mission.scenario.waves
    if sea.significant_height_m <= 0.0:
        return Waves(np.empty(0), np.empty(0), np.empty(0))
    draw = np.random.default_rng([mission.scenario.seed, 1])
    peak = 2.0 * pi / sea.peak_period_s
    edges = np.linspace(0.5 * peak, 4.0 * peak, COMPONENTS + 1)
    # uneven frequencies, so that the sea does not repeat itself
    omega = edges[:-1] + np.diff(edges) * draw.random(COMPONENTS)
    amplitude = np.sqrt(2.0 * jonswap(omega, peak) * np.diff(edges))
    # the significant height is four standard deviations of the elevation
    amplitude *= sea.significant_height_m / (4.0 * sqrt(0.5 * float(np.sum(amplitude**2))))
    return Waves(amplitude * not_followed(omega, heave_period(mission)), omega, draw.uniform(0.0, 2.0 * pi, COMPONENTS))


def jonswap(omega: Array, peak: float) -> Array:
    """Shape of the JONSWAP spectrum over angular frequency [rad/s], of any height."""
    width = np.where(omega <= peak, 0.07, 0.09)
    enhanced = PEAKEDNESS ** np.exp(-((omega / peak - 1.0) ** 2) / (2.0 * width**2))
    return np.asarray(omega**-5.0 * np.exp(-1.25 * (peak / omega) ** 4) * enhanced)


def not_followed(omega: Array, period: float) -> Array:
    """Part of a wave's elevation by which the water rises along a vehicle that heaves as a damped oscillator."""
    ratio = omega * period / (2.0 * pi)
    followed = 1.0 / (1.0 - ratio**2 + 2j * HEAVE_DAMPING * ratio)
    return np.abs(1.0 - followed)


def heave_period(mission: Mission) -> float:
    """Natural period of heave [s] of the vehicle as it floats in its mission, at the pitch of the surface.

    The slice of the hull at the water line gives the stiffness; mass and added mass in heave resist.
    """
    d, theta = mission.vehicle.description, float(np.radians(mission.scenario.surface.pitch_deg))
    form = hull_form(d)
    if len(form.tail_volume) == 0 or abs(np.sin(theta)) < 0.1:
        return HEAVE_PERIOD
    area = slice_at(form, theta, surplus_afloat(mission.deployment)) / abs(float(np.sin(theta)))
    stiffness = mission.vehicle.neutral_density_kg_m3 * d.water.gravity_m_s2 * area
    return 2.0 * pi * sqrt((d.mass_kg + d.added_inertia.heave_kg) / stiffness)


@inlined
def antenna_height(antenna: Vector, line: float, theta: float) -> float:
    """Height of the antenna over the calm surface, which crosses the axis at `line` [m]."""
    return (antenna[0] - line) * math.sin(theta) - antenna[2] * math.cos(theta)


@inlined
def antenna_emerges(waves: Waves, antenna: Vector, line: float, theta: float, t: float) -> bool:
    """Whether the antenna of a vehicle that floats with wings level at pitch `theta` is out of the water now.

    The calm surface crosses the axis at `line` [m]; waves that the vehicle does not follow wash over the antenna. One
    whose place is not known always emerges.
    """
    if math.isnan(antenna[0]):
        return True
    height = antenna_height(antenna, line, theta)
    for i in range(len(waves.omega)):
        height -= waves.amplitude[i] * math.cos(waves.omega[i] * t + waves.phase[i])
    return height > 0.0
