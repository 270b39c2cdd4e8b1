"""Accelerations from velocities: the equations of motion as other codes state them (compiled).

The state of stommel is momenta; other codes differentiate velocities. Since (v, omega, r_px') is a function of the
state, its rate is the exact derivative of that function along x', which one complex step gives.
"""

from typing import NamedTuple

import numpy as np

from stommel.compilation import compiled, inlined
from stommel.dynamics.equations import rates
from stommel.dynamics.inertia import Velocities, momenta, moving_mass_position, velocities
from stommel.dynamics.state import Actuation, State
from stommel.geometry.vectors import Quaternion, Vector, cross
from stommel.seawater.water import Water

COMPLEX_STEP = 1e-40


class Accelerations(NamedTuple):
    """Rates of the generalised velocities in the body frame, and the inertial velocity."""

    v_dot: Vector
    """[m/s2]"""
    omega_dot: Vector
    """[rad/s2]"""
    r_px_ddot: float
    """Of the moving mass along b1 relative to the body [m/s2]; zero in the driven mode."""
    X_dot: Vector
    """Velocity in the inertial frame [m/s]."""


@inlined
def state_from_velocities(
    vehicle: np.record,
    v: Vector,
    omega: Vector,
    X: Vector,
    Q: Quaternion,
    r_px: float,
    V_b: float,
    actuation: Actuation,
    water: Water,
) -> State:
    """Return the state whose velocities are `v` [m/s] and `omega` [rad/s], the mass moving at `actuation.r_px_dot`."""
    p, h = momenta(vehicle, v, omega, Q, r_px, V_b, actuation, water)
    r_p = moving_mass_position(vehicle, r_px, actuation.mu)
    p_px = vehicle.m_p * (v[0] + cross(omega, r_p)[0] + actuation.r_px_dot)
    return State(X, Q, p, h, r_px, p_px, V_b)


@inlined
def _step(a, b):  # type: ignore[no-untyped-def]  # its result is complex
    return complex(a, COMPLEX_STEP * b)


@inlined
def _step_vector(a, b):  # type: ignore[no-untyped-def]  # its result is complex
    return (_step(a[0], b[0]), _step(a[1], b[1]), _step(a[2], b[2]))


@inlined
def stepped(x: State, x_dot: State) -> State:
    """x + i h x': the state moved by a complex step along its rate."""
    Q, Q_dot = x.Q, x_dot.Q
    return State(
        _step_vector(x.X, x_dot.X),
        (_step(Q[0], Q_dot[0]), _step(Q[1], Q_dot[1]), _step(Q[2], Q_dot[2]), _step(Q[3], Q_dot[3])),
        _step_vector(x.p, x_dot.p),
        _step_vector(x.h, x_dot.h),
        _step(x.r_px, x_dot.r_px),
        _step(x.p_px, x_dot.p_px),
        _step(x.V_b, x_dot.V_b),
    )


@compiled
def accelerations(vehicle: np.record, x: State, actuation: Actuation, water: Water, free: bool) -> Accelerations:
    """Accelerations in the state `x`: speed of the moving mass, its rolling, rudder and pump flow stay as they are.

    The current is taken as steady and uniform along the way: its change would enter through the added inertia.
    """
    h = COMPLEX_STEP
    x_dot = rates(vehicle, x, actuation, water, free)
    u = actuation
    moved = Actuation(u.r_px_dot, u.u_px, u.u_b, u.delta_r, _step(u.mu, u.mu_dot), u.mu_dot)
    eta = velocities(vehicle, stepped(x, x_dot), moved, water, free)
    v, omega = eta.v, eta.omega
    return Accelerations(
        (v[0].imag / h, v[1].imag / h, v[2].imag / h),
        (omega[0].imag / h, omega[1].imag / h, omega[2].imag / h),
        eta.r_px_dot.imag / h,
        x_dot.X,
    )


@compiled
def velocities_of(vehicle: np.record, x: State, actuation: Actuation, water: Water, free: bool) -> Velocities:
    """Generalised velocities of the state `x`."""
    return velocities(vehicle, x, actuation, water, free)


@compiled
def state_of(
    vehicle: np.record,
    v: Vector,
    omega: Vector,
    X: Vector,
    Q: Quaternion,
    r_px: float,
    V_b: float,
    actuation: Actuation,
    water: Water,
) -> State:
    """As `state_from_velocities`, for callers that are not compiled."""
    return state_from_velocities(vehicle, v, omega, X, Q, r_px, V_b, actuation, water)
