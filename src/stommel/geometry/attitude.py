"""Euler angles outside, quaternions inside: R_IB(phi, theta, psi) = exp(e3^ psi) exp(e2^ theta) exp(e1^ phi)."""

import math
from typing import NamedTuple

import numpy as np

from stommel.compilation import inlined
from stommel.geometry.elementary import cos, sin
from stommel.geometry.vectors import Quaternion, Vector, down_in_body

TURN = 2.0 * math.pi


@inlined
def quaternion_from_euler(phi: float, theta: float, psi: float) -> Quaternion:
    """Quaternion of roll `phi`, pitch `theta` and heading `psi` [rad]."""
    c1, s1 = cos(0.5 * phi), sin(0.5 * phi)
    c2, s2 = cos(0.5 * theta), sin(0.5 * theta)
    c3, s3 = cos(0.5 * psi), sin(0.5 * psi)
    return (
        c1 * c2 * c3 + s1 * s2 * s3,
        s1 * c2 * c3 - c1 * s2 * s3,
        c1 * s2 * c3 + s1 * c2 * s3,
        c1 * c2 * s3 - s1 * s2 * c3,
    )


def euler_from_quaternion(Q: Quaternion) -> Vector:
    """Roll, pitch and heading [rad]; at a pitch of +-90 degrees the split between roll and heading is arbitrary."""
    e0, e1, e2, e3 = Q
    zeta = (2 * (e1 * e3 - e0 * e2), 2 * (e2 * e3 + e0 * e1), 1 - 2 * (e1 * e1 + e2 * e2))
    phi = float(np.arctan2(zeta[1], zeta[2]))
    theta = float(np.arctan2(-zeta[0], np.hypot(zeta[1], zeta[2])))
    psi = float(np.arctan2(2 * (e1 * e2 + e0 * e3), 1 - 2 * (e2 * e2 + e3 * e3)))
    return phi, theta, psi


def euler_rates(phi: float, theta: float, omega: Vector) -> Vector | None:
    """Rates of roll, pitch and heading [rad/s] for body rates `omega` [rad/s]; None at a pitch of +-90 degrees."""
    p, q, r = omega
    cos_theta = float(np.cos(theta))
    if abs(cos_theta) < 1e-12:
        return None
    turn = (q * np.sin(phi) + r * np.cos(phi)) / cos_theta
    return float(p + turn * np.sin(theta)), float(q * np.cos(phi) - r * np.sin(phi)), float(turn)


class Attitude(NamedTuple):
    """Roll, pitch and heading [rad]."""

    phi: float
    theta: float
    psi: float


@inlined
def attitude_of(Q: Quaternion) -> Attitude:
    """True roll, pitch and heading."""
    zeta = down_in_body(Q)
    return Attitude(
        math.atan2(zeta[1], zeta[2]),
        math.atan2(-zeta[0], math.sqrt(zeta[1] * zeta[1] + zeta[2] * zeta[2])),
        math.atan2(2.0 * (Q[1] * Q[2] + Q[0] * Q[3]), 1.0 - 2.0 * (Q[2] * Q[2] + Q[3] * Q[3])),
    )


@inlined
def wrapped(angle: float) -> float:
    """The angle in (-pi, pi]."""
    return angle - TURN * math.ceil((angle - math.pi) / TURN)
