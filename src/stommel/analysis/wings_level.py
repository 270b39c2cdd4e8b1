"""Wings-level steady flight, compiled: from the wanted flight to the actuators, one or a hundred thousand at a time."""

import math

import numpy as np

from stommel.analysis.steady_equations import (
    ALPHA,
    CONVERGED,
    GLIDE_PATH,
    H_2,
    P_1,
    P_3,
    QUANTITIES,
    R_PX,
    STALLED_ITERATION,
    THETA,
    V_B,
    V,
    newton,
)
from stommel.compilation import compiled, inlined
from stommel.seawater.water import Water

TOO_SHALLOW = 3
"""No angle of attack gives enough lift for its drag on so shallow a path."""

_PITCH_EQUATIONS = np.array([P_1, P_3, H_2])
_PITCH_UNKNOWNS = np.array([ALPHA, R_PX, V_B])
_PATH_EQUATIONS = np.array([P_1, P_3, H_2, GLIDE_PATH])
_PATH_UNKNOWNS = np.array([ALPHA, R_PX, V_B, THETA])


@inlined
def _tilted_force(vehicle: np.record, alpha: float, gamma: float) -> float:
    """Force across gravity, divided by V^2 [kg/m]: D cos(gamma) + L sin(gamma), zero in steady flight."""
    D: float = vehicle.K_D0 + vehicle.K_D * alpha * alpha
    L: float = vehicle.K_L0 + vehicle.K_L * alpha
    return D * math.cos(gamma) + L * math.sin(gamma)


@compiled
def angle_of_attack_at_pitch(vehicle: np.record, theta: float) -> float:
    """Smallest angle of attack [rad] of steady flight at pitch `theta` [rad] in attached flow; NaN if none.

    Newton from zero: the force is concave there, so that the second step onwards converges from one side.
    """
    alpha = 0.0
    for _ in range(50):
        F = _tilted_force(vehicle, alpha, theta - alpha)
        slope = (_tilted_force(vehicle, alpha + 1e-7, theta - alpha - 1e-7) - F) / 1e-7
        if slope == 0.0:
            return math.nan
        step = -F / slope
        step = max(-0.2, min(0.2, step))
        alpha += step
        if abs(alpha) > 0.5 * math.pi:
            return math.nan
        if abs(step) < 1e-12:
            return alpha
    return math.nan


@compiled
def angle_of_attack_on_path(vehicle: np.record, gamma: float) -> float:
    """Smallest angle of attack [rad] of steady flight on the path `gamma` [rad]; NaN if it is too shallow."""
    slope = math.tan(gamma)
    b = vehicle.K_L * slope
    c = vehicle.K_D0 + vehicle.K_L0 * slope
    if vehicle.K_D == 0.0:
        linear: float = -c / b if b != 0.0 else math.nan
        return linear
    discriminant = b * b - 4.0 * vehicle.K_D * c
    if discriminant < 0.0:
        return math.nan
    # of the two roots the one nearer zero, in the form without cancellation
    root: float = -2.0 * c / (b + math.copysign(math.sqrt(discriminant), b))
    return root


@inlined
def _guess(vehicle: np.record, z: np.ndarray, gamma: float, water: Water) -> None:
    """First guess of ballast volume and moving mass for the speed, pitch and angle of attack in `z`."""
    D = vehicle.K_D0 + vehicle.K_D * z[ALPHA] * z[ALPHA]
    W = -D * z[V] * z[V] / math.sin(gamma)
    z[V_B] = -W / (water.rho * vehicle.g)
    z[R_PX] = -vehicle.s_0[0] / vehicle.m_p


@compiled
def trim_into(vehicle: np.record, speed: float, angle: float, along_path: bool, water: Water, z: np.ndarray) -> int:
    """Find the wings-level flight at `speed` [m/s] with pitch, or glide path if `along_path`, `angle` [rad].

    Writes the ten quantities into `z` and returns a code of `steady_equations`, or TOO_SHALLOW.
    """
    z[:] = 0.0
    z[V] = speed
    if along_path:
        alpha = angle_of_attack_on_path(vehicle, angle)
        theta, gamma = angle + alpha, angle
    else:
        alpha = angle_of_attack_at_pitch(vehicle, angle)
        theta, gamma = angle, angle - alpha
    if math.isnan(alpha) or gamma == 0.0:
        return TOO_SHALLOW
    z[ALPHA], z[THETA] = alpha, theta
    _guess(vehicle, z, gamma, water)
    if along_path:
        return newton(vehicle, z, _PATH_UNKNOWNS, _PATH_EQUATIONS, water, math.sin(angle), 0.0)
    return newton(vehicle, z, _PITCH_UNKNOWNS, _PITCH_EQUATIONS, water, 0.0, 0.0)


@compiled
def trim_many(
    vehicle: np.record,
    speed: np.ndarray,
    angle: np.ndarray,
    along_path: bool,
    water: Water,
    flights: np.ndarray,
) -> np.ndarray:
    """Trim every pair of `speed` and `angle` into the rows of `flights` (N x 10); returns the codes."""
    codes = np.empty(len(speed), dtype=np.int64)
    for i in range(len(speed)):
        codes[i] = trim_into(vehicle, speed[i], angle[i], along_path, water, flights[i])
    return codes


@compiled
def trim_at_ballast(vehicle: np.record, theta: float, V_b: float, water: Water, z: np.ndarray) -> int:
    """Find the wings-level flight at pitch `theta` [rad] that the ballast volume `V_b` [m3] drives."""
    alpha = angle_of_attack_at_pitch(vehicle, theta)
    gamma = theta - alpha
    W = (vehicle.m - water.rho * (vehicle.V_0 + V_b)) * vehicle.g
    D = vehicle.K_D0 + vehicle.K_D * alpha * alpha
    V_square = -W * math.sin(gamma) / D
    if not V_square > 0.0:
        return STALLED_ITERATION
    z[:] = 0.0
    z[V], z[ALPHA], z[THETA], z[V_B] = math.sqrt(V_square), alpha, theta, V_b
    z[R_PX] = -vehicle.s_0[0] / vehicle.m_p
    return newton(vehicle, z, np.array([V, ALPHA, R_PX]), _PITCH_EQUATIONS, water, 0.0, 0.0)


@compiled
def trim_at_incidence(vehicle: np.record, alpha: float, V_b: float, water: Water, z: np.ndarray) -> int:
    """Find the wings-level flight at the angle of attack `alpha` [rad] that the ballast volume `V_b` [m3] drives."""
    D = vehicle.K_D0 + vehicle.K_D * alpha * alpha
    L = vehicle.K_L0 + vehicle.K_L * alpha
    W = (vehicle.m - water.rho * (vehicle.V_0 + V_b)) * vehicle.g
    gamma = -math.atan(D / L) if L != 0.0 else -0.5 * math.pi
    V_square = -W * math.sin(gamma) / D
    if not V_square > 0.0:
        return STALLED_ITERATION
    z[:] = 0.0
    z[V], z[ALPHA], z[THETA], z[V_B] = math.sqrt(V_square), alpha, gamma + alpha, V_b
    z[R_PX] = -vehicle.s_0[0] / vehicle.m_p
    return newton(vehicle, z, np.array([V, THETA, R_PX]), _PITCH_EQUATIONS, water, 0.0, 0.0)


@inlined
def principal(z: np.ndarray) -> int:
    """Bring the angle of attack that Newton wound up to (-180, 180] deg; a pitch beyond the vertical is no flight."""
    z[ALPHA] -= 2.0 * math.pi * math.ceil(z[ALPHA] / (2.0 * math.pi) - 0.5)
    return CONVERGED if abs(z[THETA]) < 0.5 * math.pi else STALLED_ITERATION


@compiled
def flight_of_settings(vehicle: np.record, r_px: float, V_b: float, water: Water, z: np.ndarray) -> int:
    """Find the wings-level flight of the moving mass at `r_px` [m] and the ballast volume `V_b` [m3].

    Pitch is bracketed by the moving-mass position that each pitch would need, then all of it is polished by Newton.
    """
    downwards = vehicle.m - water.rho * (vehicle.V_0 + V_b) > 0.0
    best = math.inf
    guess = np.empty(QUANTITIES)
    previous = math.nan
    for i in range(1, 179):
        theta = math.radians(0.5 * i)
        code = trim_at_ballast(vehicle, -theta if downwards else theta, V_b, water, guess)
        miss = guess[R_PX] - r_px if code == CONVERGED else math.nan
        if abs(miss) < best or miss * previous < 0.0:
            best = 0.0 if miss * previous < 0.0 else abs(miss)
            z[:] = guess
        if miss * previous < 0.0:
            break
        previous = miss
    if best == math.inf:
        return STALLED_ITERATION
    z[R_PX] = r_px
    code = newton(vehicle, z, np.array([V, ALPHA, THETA]), _PITCH_EQUATIONS, water, 0.0, 0.0)
    return principal(z) if code == CONVERGED else code
