"""How far a dive goes on sinking after the decision to turn.

Oil and moving mass take their time, and so does the vehicle's inertia. Until the mass has brought the nose up, the
vehicle goes on down along its path, ever slower: its speed along a path that flattens is integrated through the water
of the dive, from the surface on, as a sharp thermocline is passed faster than it would be flown steadily.
"""

from dataclasses import dataclass
from math import atan, sin, tan

import numpy as np
from numpy.typing import NDArray

from stommel.analysis.stratified import REFERENCE_SPEED, DiveBallast
from stommel.analysis.trim import trim
from stommel.machinery.drives.pitch import PitchDrive
from stommel.planning.ballasting import pump_flow
from stommel.planning.deployment import Deployment

Array = NDArray[np.float64]

STEP = 0.5
"""Of the integration [s]."""
LONGEST = 600.0
"""Time after which a turn is given up [s]."""
MASS_SPEED = 5e-3
"""Of a moving mass whose file says nothing of its drive [m/s]."""
MOST_STEPS = 100_000
"""Of a descent: fourteen hours."""
ALLOWED_M, ALLOWED_SHARE, MOST_ALLOWED = 1.0, 0.01, 0.05
"""Allowed for where a dive turns: metres and a share of its depth, up to a share of it. The pitch follows later than
the mass, and sensors err."""
MOST_OF_DEPTH = 0.5
"""No dive turns above this part of its depth."""


@dataclass(frozen=True)
class _Descent:
    """A vehicle on its way down, and what ends it. SI units."""

    depth: Array
    neutral: Array
    """Ballast volume at which it is neutral at each depth."""
    down: float
    up: float
    """Ballast volumes of descent and ascent."""
    steepness: float
    """Tangent of the path down."""
    drive: float
    """Ballast volume beyond neutral that drives `speed`."""
    speed: float
    mass: float
    """Of the vehicle with the water that it carries along its axis."""
    weight: float
    """Of displaced water, rho g."""
    flow: float
    turn_time: float
    """In which the moving mass goes from its place in the dive to that in the climb."""

    def steady(self, z: float) -> float:
        """Speed at which it would go on in the water of a depth."""
        return float(self.speed * np.sqrt(max(self._heavy(z, self.down), 0.0) / self.drive))

    def _heavy(self, z: float, V_b: float) -> float:
        return float(np.interp(z, self.depth, self.neutral)) - V_b

    def slowed(self, V: float, z: float, V_b: float, slope: float) -> float:
        """Speed one step later: V' = (rho g (neutral - V_b) sin - K V2) / m (eq-sim15)."""
        drag = self.drive * sin(atan(self.steepness)) * (V / self.speed) ** 2
        force = self.weight * (self._heavy(z, V_b) * sin(slope) - drag)
        return max(0.0, V + STEP * force / self.mass)

    def speeds(self) -> tuple[Array, Array]:
        """Depths from the surface down, and the speed there on the way down."""
        slope, z, V = atan(self.steepness), 0.0, self.steady(0.0)
        depths, speeds = [z], [V]
        while z < self.depth[-1] and V > 0.0 and len(depths) < MOST_STEPS:
            V = self.slowed(V, z, self.down, slope)
            z += STEP * V * sin(slope)
            depths.append(z)
            speeds.append(V)
        return np.array(depths), np.array(speeds)

    def deepest(self, start: float, V: float) -> float:
        """Depth that it reaches after the decision to turn at a depth and speed: until the nose is up, or it stands."""
        z, V_b, t = start, self.down, 0.0
        while t < min(0.5 * self.turn_time, LONGEST) and V > 0.0:
            slope = atan(self.steepness * (1.0 - 2.0 * t / self.turn_time))
            V_b = min(self.up, V_b + self.flow * STEP)
            V = self.slowed(V, z, V_b, slope)
            z += STEP * V * sin(slope)
            t += STEP
        return z


def overshoot(deployment: Deployment, ballast: DiveBallast, neutral: Array, step: float) -> float:
    """Way by which a dive goes on sinking after the decision to turn [m] (eq-sim15).

    With the way of two decisions a `step` [s] apart, and what is allowed for besides.
    """
    depth = deployment.plan.dives.depth_m
    descent = _descent(deployment, ballast, neutral)
    allowed = min(ALLOWED_M + ALLOWED_SHARE * depth, MOST_ALLOWED * depth)
    depths, speeds = descent.speeds()
    sine = sin(atan(descent.steepness))

    def below(start: float) -> float:
        V = float(np.interp(start, depths, speeds))
        return descent.deepest(start, V) + 2.0 * step * V * sine + allowed - depth

    high, low = (1.0 - MOST_OF_DEPTH) * depth, depth
    for _ in range(16):
        middle = 0.5 * (high + low)
        if below(middle) > 0.0:
            low = middle
        else:
            high = middle
    return depth - high


def _descent(deployment: Deployment, ballast: DiveBallast, neutral: Array) -> _Descent:
    dives, vehicle, physics = deployment.plan.dives, deployment.vehicle, deployment.physics
    d, speed = vehicle.description, dives.speed_m_s or dives.least_speed_m_s or REFERENCE_SPEED
    dive, climb = (
        trim(vehicle, speed_m_s=speed, pitch_deg=pitch, physics=physics)
        for pitch in (-dives.pitch_deg, dives.pitch_deg)
    )
    return _Descent(
        depth=np.linspace(0.0, dives.depth_m, len(neutral)),
        neutral=neutral,
        down=ballast.down,
        up=ballast.up,
        steepness=tan(-dive.gamma),
        drive=abs(dive.V_b),
        speed=dive.V,
        mass=d.mass_kg + d.added_inertia.surge_kg,
        weight=vehicle.neutral_density_kg_m3 * d.water.gravity_m_s2,
        flow=pump_flow(deployment),
        turn_time=abs(climb.r_px - dive.r_px) / _mass_speed(deployment, dive.theta),
    )


def _mass_speed(deployment: Deployment, theta: float) -> float:
    """Speed of the moving mass on its way aft, uphill at the dive's pitch [m/s]."""
    d = deployment.vehicle.description
    if d.drives is not None and d.drives.pitch is not None:
        speed = PitchDrive.of(deployment.vehicle).point(theta, -1).speed
        if speed > 0.0:  # one that stalls is told of elsewhere
            return speed
    stated = d.actuators.moving_mass.speed_mm_s if d.actuators.moving_mass is not None else None
    return MASS_SPEED if stated is None else stated / 1e3
