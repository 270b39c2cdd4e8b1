"""Exact linearisation of the equations of motion about steady flight (compiled).

States as in section 3.2 of the paper, longitudinal (u, w, q, theta), then lateral-directional (v, p, r, phi); inputs
(r_px, V_b), then (delta_r, mu). Actuators are fixed ("stick-fixed"), the water is still. Each column is one complex
step through the equations of motion.
"""

import numpy as np

from stommel.analysis.steady_equations import ALPHA, BETA, COMPLEX_STEP, DELTA_R, MU, PHI, R_PX, THETA, TURN, V_B, V
from stommel.compilation import compiled, inlined
from stommel.dynamics.equations import rates
from stommel.dynamics.inertia import factors_of, inertia, momenta, solve
from stommel.dynamics.state import Actuation, State
from stommel.geometry.attitude import quaternion_from_euler
from stommel.geometry.elementary import cos, sin
from stommel.geometry.vectors import down_in_body, scale
from stommel.seawater.water import Water

U_, W_, Q_, THETA_, V_, P_, R_, PHI_ = range(8)
STATES = ("u", "w", "q", "theta", "v", "p", "r", "phi")
INPUTS = ("r_px", "V_b", "delta_r", "mu")
LONGITUDINAL, LATERAL = slice(0, 4), slice(4, 8)


@inlined
def _state_rates(vehicle, s, settings, water, out):  # type: ignore[no-untyped-def]  # s, settings real or complex
    """Write the rates of the eight states `s`; with locked actuators M(r_p) is constant, so that M eta' = (p', h')."""
    phi, theta = s[PHI_], s[THETA_]
    p, q, r = s[P_], s[Q_], s[R_]
    Q = quaternion_from_euler(phi, theta, 0.0 * phi)
    actuation = Actuation(0.0, 0.0, 0.0, settings[2], settings[3], 0.0)
    zero = 0.0 * phi
    omega = (p, q, r)
    momentum = momenta(vehicle, (s[U_], s[V_], s[W_]), omega, Q, settings[0], settings[1], actuation, water)
    x = State((zero, zero, zero), Q, momentum.p, momentum.h, settings[0], zero, settings[1])
    x_dot = rates(vehicle, x, actuation, water, False)
    v_dot, omega_dot = solve(
        factors_of(inertia(vehicle, settings[0], settings[3], settings[1], False)), x_dot.p, x_dot.h
    )
    turn = (q * sin(phi) + r * cos(phi)) / cos(theta)
    out[U_], out[V_], out[W_] = v_dot
    out[P_], out[Q_], out[R_] = omega_dot
    out[THETA_] = q * cos(phi) - r * sin(phi)
    out[PHI_] = p + turn * sin(theta)


@compiled
def linearise_into(vehicle: np.record, z: np.ndarray, water: Water, A: np.ndarray, B: np.ndarray) -> None:
    """Write A (8 x 8) and B (8 x 4) of the flight `z` (ten quantities of steady flight)."""
    s = np.empty(8, dtype=np.complex128)
    settings = np.empty(4, dtype=np.complex128)
    out = np.empty(8, dtype=np.complex128)
    s[U_] = z[V] * np.cos(z[ALPHA]) * np.cos(z[BETA])
    s[V_] = z[V] * np.sin(z[BETA])
    s[W_] = z[V] * np.sin(z[ALPHA]) * np.cos(z[BETA])
    s[P_], s[Q_], s[R_] = scale(z[TURN], down_in_body(quaternion_from_euler(z[PHI], z[THETA], 0.0)))
    s[THETA_], s[PHI_] = z[THETA], z[PHI]
    settings[0], settings[1], settings[2], settings[3] = z[R_PX], z[V_B], z[DELTA_R], z[MU]
    for j in range(8):
        kept = s[j]
        s[j] = complex(kept.real, COMPLEX_STEP)
        _state_rates(vehicle, s, settings, water, out)
        s[j] = kept
        for i in range(8):
            A[i, j] = out[i].imag / COMPLEX_STEP
    for j in range(4):
        kept = settings[j]
        settings[j] = complex(kept.real, COMPLEX_STEP)
        _state_rates(vehicle, s, settings, water, out)
        settings[j] = kept
        for i in range(8):
            B[i, j] = out[i].imag / COMPLEX_STEP
