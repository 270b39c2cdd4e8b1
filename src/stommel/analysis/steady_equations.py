"""The equations of steady flight, p' = 0 and h' = 0, in ten quantities of which any set may be asked for (compiled).

Steady flight, straight or turning, has the angular velocity along gravity, omega = turn rate times zeta. Ten quantities
describe it: speed, angle of attack, sideslip, roll, pitch, turn rate, and four actuator settings. Six equations hold.
A question (trim, steady flight of given settings, turn) is a choice of unknowns and equations; one Newton iteration
with exact derivatives (complex step through the equations of motion) answers them all.
"""

import numpy as np

from stommel.compilation import compiled, inlined
from stommel.dynamics.equations import rates
from stommel.dynamics.inertia import momenta
from stommel.dynamics.state import Actuation, State
from stommel.geometry.attitude import quaternion_from_euler
from stommel.geometry.elementary import cos, sin, sqrt
from stommel.geometry.vectors import down_in_body, scale
from stommel.seawater.water import Water

# the quantities
V, ALPHA, BETA, PHI, THETA, TURN, R_PX, V_B, DELTA_R, MU = range(10)
QUANTITIES = 10

# the equations: p' and h' by component, then two that a request may add
P_1, P_2, P_3, H_1, H_2, H_3, GLIDE_PATH, CURVATURE = range(8)
LONGITUDINAL_EQUATIONS = (P_1, P_3, H_2)
ALL_EQUATIONS = (P_1, P_2, P_3, H_1, H_2, H_3)

CONVERGED, STALLED_ITERATION, NOT_FINITE = range(3)

TOLERANCE = 1e-11
"""Residual [N, N m] at which the iteration stops; rounding allows about 1e-13."""

COMPLEX_STEP = 1e-40


@inlined
def steady_rates(vehicle, z, water):  # type: ignore[no-untyped-def]  # z real or complex
    """Rates of the state in the flight `z`; p' and h' vanish in steady flight."""
    cos_beta = cos(z[BETA])
    v = (
        z[V] * cos(z[ALPHA]) * cos_beta,
        z[V] * sin(z[BETA]),
        z[V] * sin(z[ALPHA]) * cos_beta,
    )
    Q = quaternion_from_euler(z[PHI], z[THETA], 0.0 * z[PHI])
    omega = scale(z[TURN], down_in_body(Q))
    actuation = Actuation(0.0, 0.0, 0.0, z[DELTA_R], z[MU], 0.0)
    p, h = momenta(vehicle, v, omega, Q, z[R_PX], z[V_B], actuation, water)
    here = (0.0 * z[V], 0.0 * z[V], 0.0 * z[V])
    return rates(vehicle, State(here, Q, p, h, z[R_PX], 0.0 * z[V], z[V_B]), actuation, water, False)


@inlined
def _residuals(vehicle, z, water, sin_glide_path, curvature, out):  # type: ignore[no-untyped-def]  # z real or complex
    x_dot = steady_rates(vehicle, z, water)
    out[P_1], out[P_2], out[P_3] = x_dot.p
    out[H_1], out[H_2], out[H_3] = x_dot.h
    north, east, down = x_dot.X
    out[GLIDE_PATH] = down + sin_glide_path * z[V]
    out[CURVATURE] = z[TURN] - curvature * sqrt(north * north + east * east)


@compiled
def residuals(
    vehicle: np.record, z: np.ndarray, water: Water, sin_glide_path: float, curvature: float, out: np.ndarray
) -> None:
    """Write the residuals of all eight equations at `z`: N, N m, m/s, rad/s."""
    _residuals(vehicle, z, water, sin_glide_path, curvature, out)


@inlined
def _solve_in_place(A: np.ndarray, b: np.ndarray, n: int) -> bool:
    """Gaussian elimination with row pivoting, n <= 8; one LAPACK call would cost more than the whole of it."""
    for k in range(n):
        pivot = k
        for i in range(k + 1, n):
            if abs(A[i, k]) > abs(A[pivot, k]):
                pivot = i
        if not abs(A[pivot, k]) > 1e-300:
            return False
        if pivot != k:
            for j in range(n):
                A[k, j], A[pivot, j] = A[pivot, j], A[k, j]
            b[k], b[pivot] = b[pivot], b[k]
        for i in range(k + 1, n):
            factor = A[i, k] / A[k, k]
            for j in range(k + 1, n):
                A[i, j] -= factor * A[k, j]
            b[i] -= factor * b[k]
    for k in range(n - 1, -1, -1):
        for j in range(k + 1, n):
            b[k] -= A[k, j] * b[j]
        b[k] /= A[k, k]
    return True


@inlined
def _largest(values: np.ndarray, equations: np.ndarray) -> float:
    largest = 0.0
    for i in range(len(equations)):
        size = abs(values[equations[i]])
        if not size <= largest:  # lets NaN through
            largest = size
    return largest


@compiled
def newton(
    vehicle: np.record,
    z: np.ndarray,
    unknown: np.ndarray,
    equations: np.ndarray,
    water: Water,
    sin_glide_path: float,
    curvature: float,
) -> int:
    """Change the `unknown` entries of `z` in place until the chosen `equations` hold.

    Each step is exact Newton; one that would not reduce the largest residual, or that would leave positive speed, is
    shortened. Returns CONVERGED, STALLED_ITERATION (no steady flight near the start) or NOT_FINITE.
    """
    n = len(unknown)
    w = np.empty(QUANTITIES, dtype=np.complex128)
    column = np.empty(8, dtype=np.complex128)
    f, f_new = np.empty(8), np.empty(8)
    A, step, z_new = np.empty((n, n)), np.empty(n), z.copy()
    _residuals(vehicle, z, water, sin_glide_path, curvature, f)
    size = _largest(f, equations)
    polished = False
    for _ in range(60):
        if not np.isfinite(size):
            return NOT_FINITE
        if size < TOLERANCE:
            if polished:
                return CONVERGED
            polished = True  # one more step, to rounding
        for k in range(QUANTITIES):
            w[k] = z[k]
        for j in range(n):
            w[unknown[j]] = complex(z[unknown[j]], COMPLEX_STEP)
            _residuals(vehicle, w, water, sin_glide_path, curvature, column)
            w[unknown[j]] = z[unknown[j]]
            for i in range(n):
                A[i, j] = column[equations[i]].imag / COMPLEX_STEP
        for i in range(n):
            step[i] = -f[equations[i]]
        if not _solve_in_place(A, step, n):
            return CONVERGED if polished else STALLED_ITERATION
        fraction = 1.0
        while True:
            for j in range(n):
                z_new[unknown[j]] = z[unknown[j]] + fraction * step[j]
            if z_new[V] > 0.0:
                _residuals(vehicle, z_new, water, sin_glide_path, curvature, f_new)
                size_new = _largest(f_new, equations)
                if size_new < size:
                    break
            fraction *= 0.5
            if fraction < 1e-4:
                return CONVERGED if polished else STALLED_ITERATION
        for j in range(n):
            z[unknown[j]] = z_new[unknown[j]]
        f[:] = f_new
        size = size_new
    return STALLED_ITERATION
