r"""Kinetic energy and momenta: the generalised inertia matrix M(r_p) and its inverse (section 2.2 of the paper).

T = 1/2 eta' M(r_p) eta with eta = (v, omega, r_px'), and (p, h, p_px) = dT/d eta. The matrix is kept as three blocks,

    [ M  C' ]
    [ C  J  ]

and solved by its Schur complement, unrolled. The moving mass enters in one of two ways:

* driven: its axial speed r_px' is prescribed; its relative momentum is taken off before the solve;
* free: its axial momentum p_px is a state; the particle then adds inertia across b1 only, since along b1 it moves on
  its own.
"""

from typing import NamedTuple

import numpy as np

from stommel.compilation import inlined
from stommel.dynamics.state import Actuation, State
from stommel.geometry.elementary import cos, sin
from stommel.geometry.vectors import (
    Matrix,
    Symmetric,
    Vector,
    add,
    cross,
    dot,
    matrix_times,
    scale,
    subtract,
    symmetric_inverse,
    symmetric_times,
    to_body,
    transpose_times,
)
from stommel.seawater.water import Water


class Inertia(NamedTuple):
    """Blocks of the 6 x 6 generalised inertia matrix of (v, omega)."""

    M: Symmetric
    C: Matrix
    J: Symmetric


class Factors(NamedTuple):
    """The inertia matrix ready to be solved: what depends on the places of the masses alone."""

    C: Matrix
    M_inverse: Symmetric
    D: tuple[Vector, Vector, Vector]
    """Rows of C M^-1."""
    schur_inverse: Symmetric
    """(J - C M^-1 C')^-1."""


class Momenta(NamedTuple):
    """Momenta in the body frame."""

    p: Vector
    h: Vector


class Velocities(NamedTuple):
    """Generalised velocities eta in the body frame, and the velocity relative to the water."""

    v: Vector
    omega: Vector
    r_px_dot: float
    v_r: Vector


@inlined
def moving_mass_position(vehicle: np.record, r_px: float, mu: float) -> Vector:
    """r_p: position of the moving mass in the body frame [m]; it hangs below b1 for mu = 0."""
    c, s = cos(mu), sin(mu)
    return (r_px, -vehicle.R_p * s, vehicle.R_p * c)


@inlined
def oil_moment(vehicle: np.record, V_b: float) -> Vector:
    """Static moment of the oil that has moved from the reservoir to the bladder [kg m]."""
    m_oil = vehicle.rho_oil * V_b
    r_bl, r_res = vehicle.r_bl, vehicle.r_res
    return (m_oil * (r_bl[0] - r_res[0]), m_oil * (r_bl[1] - r_res[1]), m_oil * (r_bl[2] - r_res[2]))


@inlined
def inertia(vehicle: np.record, r_px: float, mu: float, V_b: float, free: bool) -> Inertia:
    """M_p(r_p) + M_b + M_rb + M_f without the row and column of the moving mass, which `free` leaves out along b1."""
    axial = 0.0 if free else 1.0
    m_p = vehicle.m_p
    c, s = cos(mu), sin(mu)
    x, y, z = r_px, -vehicle.R_p * s, vehicle.R_p * c
    M_0, C_0, J_0, J_p = vehicle.M_0, vehicle.C_0, vehicle.J_0, vehicle.J_p

    M = (M_0[0] + axial * m_p, M_0[1] + m_p, M_0[2] + m_p, M_0[3], M_0[4], M_0[5])

    # oil moved from the reservoir to the bladder: mass taken here, added there
    o = oil_moment(vehicle, V_b)
    C = (
        C_0[0],
        C_0[1] - m_p * z - o[2],
        C_0[2] + m_p * y + o[1],
        C_0[3] + axial * m_p * z + o[2],
        C_0[4],
        C_0[5] - m_p * x - o[0],
        C_0[6] - axial * m_p * y - o[1],
        C_0[7] + m_p * x + o[0],
        C_0[8],
    )

    b, d = vehicle.r_bl, vehicle.r_res
    m_oil = vehicle.rho_oil * V_b
    o_xx, o_yy, o_zz = (
        m_oil * (b[0] * b[0] - d[0] * d[0]),
        m_oil * (b[1] * b[1] - d[1] * d[1]),
        m_oil * (b[2] * b[2] - d[2] * d[2]),
    )
    J = (
        J_0[0] + m_p * (z * z + y * y) + J_p[0] + o_yy + o_zz,
        J_0[1] + m_p * (axial * z * z + x * x) + c * c * J_p[1] + s * s * J_p[2] - 2.0 * c * s * J_p[5] + o_xx + o_zz,
        J_0[2] + m_p * (axial * y * y + x * x) + s * s * J_p[1] + c * c * J_p[2] + 2.0 * c * s * J_p[5] + o_xx + o_yy,
        J_0[3] - m_p * x * y + c * J_p[3] - s * J_p[4] - m_oil * (b[0] * b[1] - d[0] * d[1]),
        J_0[4] - m_p * x * z + s * J_p[3] + c * J_p[4] - m_oil * (b[0] * b[2] - d[0] * d[2]),
        J_0[5]
        - axial * m_p * y * z
        + c * s * (J_p[1] - J_p[2])
        + (c * c - s * s) * J_p[5]
        - m_oil * (b[1] * b[2] - d[1] * d[2]),
    )
    return Inertia(M, C, J)


@inlined
def actuator_momenta(vehicle: np.record, r_px: float, actuation: Actuation, axial_momentum: float) -> Momenta:
    """Momenta of what moves inside the hull, relative to it: moving mass (axial, rolling) and flowing oil."""
    m_p, mu_dot = vehicle.m_p, actuation.mu_dot
    c, s = cos(actuation.mu), sin(actuation.mu)
    y, z = -vehicle.R_p * s, vehicle.R_p * c
    J_p = vehicle.J_p
    flow = vehicle.rho_oil * actuation.u_b
    b, d = vehicle.r_bl, vehicle.r_res

    # relative velocity of the particle: r_px' e1 + mu' e1 x r_p
    p = (
        axial_momentum + flow * (b[0] - d[0]),
        -m_p * mu_dot * z + flow * (b[1] - d[1]),
        m_p * mu_dot * y + flow * (b[2] - d[2]),
    )
    h = (
        mu_dot * (m_p * (y * y + z * z) + J_p[0]) + flow * (d[1] * b[2] - d[2] * b[1]),
        axial_momentum * z + mu_dot * (-m_p * r_px * y + c * J_p[3] - s * J_p[4]) + flow * (d[2] * b[0] - d[0] * b[2]),
        -axial_momentum * y + mu_dot * (-m_p * r_px * z + s * J_p[3] + c * J_p[4]) + flow * (d[0] * b[1] - d[1] * b[0]),
    )
    return Momenta(p, h)


@inlined
def velocities(vehicle: np.record, x: State, actuation: Actuation, water: Water, free: bool) -> Velocities:
    """Solve (p, h, p_px) = M(r_p) eta for eta = (v, omega, r_px')."""
    return velocities_by(factors_at(vehicle, x.r_px, x.V_b, actuation, free), vehicle, x, actuation, water, free)


@inlined
def velocities_by(
    factors: Factors, vehicle: np.record, x: State, actuation: Actuation, water: Water, free: bool
) -> Velocities:
    """Solve (p, h, p_px) = M(r_p) eta with the inertia's factors at hand.

    The rigid body's momentum follows the absolute velocity, the water's the relative one, so that the added inertia
    times the current moves to the left-hand side.
    """
    axial_momentum = x.p_px if free else vehicle.m_p * actuation.r_px_dot + 0.0 * x.p_px
    inside = actuator_momenta(vehicle, x.r_px, actuation, axial_momentum)
    U_B = to_body(x.Q, water.U)
    p = add(subtract(x.p, inside.p), symmetric_times(vehicle.M_f, U_B))
    h = add(subtract(x.h, inside.h), matrix_times(vehicle.C_f, U_B))

    v, omega = solve(factors, p, h)

    r_px_dot = actuation.r_px_dot + 0.0 * v[0]
    if free:
        r_p = moving_mass_position(vehicle, x.r_px, actuation.mu)
        r_px_dot = x.p_px / vehicle.m_p - v[0] - (omega[1] * r_p[2] - omega[2] * r_p[1])
    return Velocities(v, omega, r_px_dot, subtract(v, U_B))


@inlined
def factors_at(vehicle: np.record, r_px: float, V_b: float, actuation: Actuation, free: bool) -> Factors:
    """Factors of the inertia for the places of moving mass and oil."""
    return factors_of(inertia(vehicle, r_px, actuation.mu, V_b, free))


@inlined
def factors_of(blocks: Inertia) -> Factors:
    """Inverse of M and of its Schur complement, by the rows c_i of C and d_i of C M^-1."""
    M, C, J = blocks
    M_inverse = symmetric_inverse(M)
    c_1, c_2, c_3 = (C[0], C[1], C[2]), (C[3], C[4], C[5]), (C[6], C[7], C[8])
    d_1, d_2, d_3 = (
        symmetric_times(M_inverse, c_1),
        symmetric_times(M_inverse, c_2),
        symmetric_times(M_inverse, c_3),
    )
    schur_complement = (  # J - C M^-1 C'
        J[0] - dot(c_1, d_1),
        J[1] - dot(c_2, d_2),
        J[2] - dot(c_3, d_3),
        J[3] - dot(c_1, d_2),
        J[4] - dot(c_1, d_3),
        J[5] - dot(c_2, d_3),
    )
    return Factors(C, M_inverse, (d_1, d_2, d_3), symmetric_inverse(schur_complement))


@inlined
def solve(factors: Factors, p: Vector, h: Vector) -> tuple[Vector, Vector]:
    """Solve M v + C' omega = p and C v + J omega = h for (v, omega)."""
    C, M_inverse, (d_1, d_2, d_3), schur_inverse = factors
    omega = symmetric_times(schur_inverse, subtract(h, (dot(d_1, p), dot(d_2, p), dot(d_3, p))))
    v = symmetric_times(M_inverse, subtract(p, transpose_times(C, omega)))
    return v, omega


@inlined
def momenta(
    vehicle: np.record,
    v: Vector,
    omega: Vector,
    Q: tuple[float, float, float, float],
    r_px: float,
    V_b: float,
    actuation: Actuation,
    water: Water,
) -> Momenta:
    """(p, h) = M(r_p) eta: the inverse of `velocities`, with the moving mass at the speed `actuation.r_px_dot`."""
    M, C, J = inertia(vehicle, r_px, actuation.mu, V_b, False)
    inside = actuator_momenta(vehicle, r_px, actuation, vehicle.m_p * actuation.r_px_dot)
    U_B = to_body(Q, water.U)
    p = add(symmetric_times(M, v), transpose_times(C, omega))
    h = add(matrix_times(C, v), symmetric_times(J, omega))
    return Momenta(
        subtract(add(p, inside.p), symmetric_times(vehicle.M_f, U_B)),
        subtract(add(h, inside.h), matrix_times(vehicle.C_f, U_B)),
    )


@inlined
def particle_momentum(vehicle: np.record, r_px: float, actuation: Actuation, eta: Velocities) -> Vector:
    """p_p = m_p v_p with v_p of Eq. (3), the mass's roll about b1 included [kg m/s]."""
    r_p = moving_mass_position(vehicle, r_px, actuation.mu)
    relative = (eta.r_px_dot, -actuation.mu_dot * r_p[2], actuation.mu_dot * r_p[1])
    v_p = add(add(eta.v, cross(eta.omega, r_p)), relative)  # (3)
    return scale(vehicle.m_p, v_p)
