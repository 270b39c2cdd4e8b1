"""Turning and spiral steady flight, compiled: continuation from the straight flight."""

import math

import numpy as np

from stommel.analysis.steady_equations import (
    ALPHA,
    BETA,
    CONVERGED,
    CURVATURE,
    DELTA_R,
    H_1,
    H_2,
    H_3,
    MU,
    P_1,
    P_2,
    P_3,
    PHI,
    R_PX,
    STALLED_ITERATION,
    THETA,
    TURN,
    V_B,
    V,
    newton,
)
from stommel.analysis.wings_level import flight_of_settings, principal, trim_into
from stommel.compilation import compiled
from stommel.seawater.water import Water

_EQUATIONS = np.array([P_1, P_2, P_3, H_1, H_2, H_3])
_CURVED_EQUATIONS = np.array([P_1, P_2, P_3, H_1, H_2, H_3, CURVATURE])
_SMALLEST_STEP = 1e-4


@compiled
def turn_of_settings(
    vehicle: np.record, r_px: float, V_b: float, delta_r: float, mu: float, water: Water, z: np.ndarray
) -> int:
    """Find the steady flight, straight or turning, of the four actuator settings (SI, rad).

    The straight flight of `r_px` and `V_b` is followed as rudder and roll angle grow from zero to their values.
    """
    code = flight_of_settings(vehicle, r_px, V_b, water, z)
    if code != CONVERGED:
        return code
    unknown = np.array([V, ALPHA, BETA, PHI, THETA, TURN])
    done, step = 0.0, 0.25
    reached = z.copy()
    while done < 1.0:
        wanted = min(1.0, done + step)
        z[:] = reached
        z[DELTA_R], z[MU] = wanted * delta_r, wanted * mu
        if newton(vehicle, z, unknown, _EQUATIONS, water, 0.0, 0.0) == CONVERGED and abs(z[PHI]) < 0.5 * math.pi:
            done = wanted
            reached[:] = z
        else:
            step *= 0.5
            if step < _SMALLEST_STEP:
                return STALLED_ITERATION
    return principal(z)


@compiled
def turn_into(
    vehicle: np.record,
    speed: float,
    theta: float,
    turn_rate: float,
    curvature: float,
    steering: int,
    water: Water,
    z: np.ndarray,
) -> int:
    """Find the turn at `speed` [m/s], pitch `theta` [rad] and `turn_rate` [rad/s], steered by DELTA_R or MU.

    Where `curvature` [1/m] is not zero it is asked for in place of the turn rate. The straight flight is followed as
    the turn tightens.
    """
    code = trim_into(vehicle, speed, theta, False, water, z)
    if code != CONVERGED:
        return code
    by_radius = curvature != 0.0
    unknown = np.array([ALPHA, BETA, PHI, R_PX, V_B, steering, TURN])
    if not by_radius:
        unknown = unknown[:6]
    equations = _CURVED_EQUATIONS if by_radius else _EQUATIONS
    done, step = 0.0, 0.25
    reached = z.copy()
    while done < 1.0:
        wanted = min(1.0, done + step)
        z[:] = reached
        if not by_radius:
            z[TURN] = wanted * turn_rate
        solved = newton(vehicle, z, unknown, equations, water, 0.0, wanted * curvature) == CONVERGED
        if solved and abs(z[PHI]) < 0.5 * math.pi:
            done = wanted
            reached[:] = z
        else:
            step *= 0.5
            if step < _SMALLEST_STEP:
                return STALLED_ITERATION
    return CONVERGED
