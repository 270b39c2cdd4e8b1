"""Viscous forces and moments f_v, m_v in the body frame (section 2.2 of the paper), bounded at every angle.

Up to the angle `alpha_attached` the paper's linear and quadratic coefficients hold exactly. Beyond `alpha_separated` a
flat plate's normal force K_N sin|sin| replaces them, blended in between with a continuous second derivative, so that
launch, inflection and tail-slides integrate. A vehicle packed for the paper's physics never separates.
"""

from typing import NamedTuple

import numpy as np

from stommel.compilation import inlined
from stommel.geometry.elementary import asin, atan2, real_part, sqrt
from stommel.geometry.vectors import Vector, add, scale, subtract


class ViscousForces(NamedTuple):
    """Force [N] and moment [N m] of the water's viscosity, in the body frame."""

    f_v: Vector
    m_v: Vector


class _Coefficients(NamedTuple):
    """Forces and moments divided by V^2."""

    D: float
    S: float
    L: float
    K: float
    M: float
    N: float


@inlined
def _separation(vehicle, angle):  # type: ignore[no-untyped-def]  # real or complex
    """Share of separated flow: 0 up to alpha_attached, 1 from alpha_separated on (smootherstep)."""
    magnitude = angle if real_part(angle) >= 0.0 else -angle
    s = (magnitude - vehicle.alpha_attached) / (vehicle.alpha_separated - vehicle.alpha_attached)
    if real_part(s) <= 0.0:
        return 0.0 * s
    if real_part(s) >= 1.0:
        return 0.0 * s + 1.0
    return s * s * s * (10.0 + s * (6.0 * s - 15.0))


@inlined
def _attached(vehicle: np.record, alpha: float, beta: float, delta_r: float) -> _Coefficients:
    return _Coefficients(
        D=vehicle.K_D0 + vehicle.K_D * alpha * alpha,
        S=vehicle.S_beta * beta + vehicle.S_delta * delta_r,
        L=vehicle.K_L0 + vehicle.K_L * alpha,
        K=vehicle.K_beta * beta + vehicle.K_delta * delta_r,
        M=vehicle.M_zero + vehicle.M_alpha * alpha,
        N=vehicle.N_beta * beta + vehicle.N_delta * delta_r,
    )


@inlined
def _blend(weight, a, b):  # type: ignore[no-untyped-def]  # real or complex
    return a + weight * (b - a)


@inlined
def _separated(  # type: ignore[no-untyped-def]  # real or complex
    vehicle, attached, alpha, beta, delta_r, sin_alpha, cos_alpha, sin_beta, cos_beta
):
    """Flat plate beyond stall, in the plane of incidence and in the plane of sideslip."""
    abs_sin_alpha = sin_alpha if real_part(sin_alpha) >= 0.0 else -sin_alpha
    abs_sin_beta = sin_beta if real_part(sin_beta) >= 0.0 else -sin_beta
    normal = vehicle.K_N * sin_alpha * abs_sin_alpha
    a, b = _separation(vehicle, alpha), _separation(vehicle, beta)
    in_plane = _blend(b, 1.0, cos_beta * cos_beta)  # incidence means nothing in pure sideways flow
    # the rudder loses its grip as the flow comes from abeam or astern
    astern = _blend(a, 1.0, cos_alpha) * _blend(b, 1.0, cos_beta)
    D = _blend(a, attached.D, vehicle.K_D0 + normal * sin_alpha)
    return _Coefficients(
        D=_blend(b, D, D * cos_beta * cos_beta + vehicle.K_N * sin_beta * sin_beta * abs_sin_beta),
        S=_blend(b, vehicle.S_beta * beta, vehicle.K_N * sin_beta * abs_sin_beta * cos_beta)
        + astern * vehicle.S_delta * delta_r,
        L=in_plane * _blend(a, attached.L, normal * cos_alpha),
        K=_blend(b, vehicle.K_beta * beta, vehicle.K_beta * sin_beta * cos_beta) + astern * vehicle.K_delta * delta_r,
        M=in_plane * _blend(a, attached.M, vehicle.M_zero * cos_alpha + vehicle.M_alpha * sin_alpha * cos_alpha),
        N=astern * (_blend(b, vehicle.N_beta * beta, vehicle.N_beta * sin_beta * cos_beta) + vehicle.N_delta * delta_r),
    )


@inlined
def from_flow_to_body(a: Vector, sin_alpha: float, cos_alpha: float, sin_beta: float, cos_beta: float) -> Vector:
    """R_BC a with R_BC(alpha, beta) = exp(-e2^ alpha) exp(e3^ beta)."""
    x = a[0] * cos_beta - a[1] * sin_beta
    y = a[0] * sin_beta + a[1] * cos_beta
    return (x * cos_alpha - a[2] * sin_alpha, y, x * sin_alpha + a[2] * cos_alpha)


@inlined
def viscous_forces(vehicle: np.record, v_r: Vector, omega: Vector, delta_r: float) -> ViscousForces:
    """f_v and m_v for the velocity `v_r` relative to the water [m/s], rates `omega` [rad/s] and rudder angle [rad].

    D, S and L act along the flow's axes: drag opposes the motion, side force opposes sideslip, lift is up for positive
    alpha.
    """
    u, v, w = v_r
    in_plane_square = u * u + w * w
    V_square = in_plane_square + v * v
    if real_part(V_square) < 1e-24:  # at rest nothing acts, and angles have no meaning
        rest = (0.0 * u, 0.0 * u, 0.0 * u)
        return ViscousForces(rest, rest)
    V = sqrt(V_square)
    if real_part(in_plane_square) < 1e-20 * real_part(V_square):
        sin_alpha, cos_alpha, cos_beta, alpha = 0.0 * u, 1.0 + 0.0 * u, 0.0 * u, 0.0 * u
        beta = atan2(v, cos_beta)
    else:
        in_plane = sqrt(in_plane_square)
        sin_alpha, cos_alpha, cos_beta = w / in_plane, u / in_plane, in_plane / V
        alpha = atan2(w, u)
        beta = asin(v / V)
    sin_beta = v / V

    c = _attached(vehicle, alpha, beta, delta_r)
    if abs(real_part(alpha)) > vehicle.alpha_attached or abs(real_part(beta)) > vehicle.alpha_attached:
        c = _separated(vehicle, c, alpha, beta, delta_r, sin_alpha, cos_alpha, sin_beta, cos_beta)

    f_v = scale(-V_square, from_flow_to_body((c.D, c.S, c.L), sin_alpha, cos_alpha, sin_beta, cos_beta))
    f_v = add(f_v, (0.0 * u, vehicle.Y_r * V * omega[2], vehicle.Z_q * V * omega[1]))

    D_omega, D_omega_V = vehicle.D_omega, vehicle.D_omega_V
    m_v = (
        (D_omega[0] * V_square + D_omega_V[0] * V) * omega[0] + c.K * V_square,
        (D_omega[1] * V_square + D_omega_V[1] * V) * omega[1] + c.M * V_square,
        (D_omega[2] * V_square + D_omega_V[2] * V) * omega[2] + c.N * V_square,
    )
    if vehicle.moments_in_flow_frame != 0.0:
        # beyond stall along the body's axes: turned by 180 degrees, the damping would drive
        m_flow = from_flow_to_body(m_v, sin_alpha, cos_alpha, sin_beta, cos_beta)
        a, b = _separation(vehicle, alpha), _separation(vehicle, beta)
        m_v = add(m_flow, scale(a + b - a * b, subtract(m_v, m_flow)))
    return ViscousForces(f_v, m_v)
