"""The equations of motion, Eqs. (1)-(7) of Fan et al. (2013), in the order and the symbols of the paper.

x' = f(x, u, environment): `rates` is the whole of it. Switches between the paper's model and a real glider are values
of the vehicle's parameters (`stommel.vehicle.Physics`), so that the equations below have no branches for them.
"""

import numpy as np

from stommel.compilation import compiled, inlined
from stommel.dynamics.hydrodynamics import viscous_forces
from stommel.dynamics.inertia import (
    Factors,
    factors_at,
    moving_mass_position,
    oil_moment,
    particle_momentum,
    velocities_by,
)
from stommel.dynamics.state import Actuation, State
from stommel.geometry.vectors import (
    Vector,
    add,
    cross,
    down_in_body,
    quaternion_rate,
    scale,
    subtract,
    symmetric_times,
    to_body,
    to_inertial,
    transpose_times,
)
from stommel.seawater.water import Water


@inlined
def displaced_volume(vehicle: np.record, water: Water, V_b: float) -> float:
    """V_veh: volume of the hull under pressure and heat, and of the ballast [m3]."""
    V_veh: float = vehicle.V_0 * (1.0 - vehicle.kappa * water.P + vehicle.alpha_T * (water.T - vehicle.T_0)) + V_b
    return V_veh


@inlined
def net_weight(vehicle: np.record, water: Water, V_b: float) -> float:
    """W = m g - rho g V_veh [N], positive sinks; in reference water with a rigid hull the paper's -rho g V_b."""
    W: float = (vehicle.m - water.rho * displaced_volume(vehicle, water, V_b)) * vehicle.g
    return W


@inlined
def static_moment(vehicle: np.record, water: Water, r_p: Vector, V_b: float) -> Vector:
    """Sum of m_i r_i, less the water displaced at the bladder [kg m]; g s x zeta is the restoring moment."""
    s_0, r_bl = vehicle.s_0, vehicle.r_bl
    s = add((s_0[0], s_0[1], s_0[2]), scale(vehicle.m_p, r_p))
    displaced = water.rho * V_b
    return subtract(add(s, oil_moment(vehicle, V_b)), (displaced * r_bl[0], displaced * r_bl[1], displaced * r_bl[2]))


@inlined
def rates(vehicle: np.record, x: State, actuation: Actuation, water: Water, free: bool) -> State:
    """Rates of the state.

    Parameters
    ----------
    vehicle
        Parameter record (`stommel.dynamics.parameters.VEHICLE_RECORD`).
    x
        State, SI units.
    actuation
        Inputs, SI units.
    water
        The water at the position of the vehicle.
    free
        True: the moving mass slides under the force `u_px`; false: it is locked or driven at the speed `r_px_dot`.
    """
    return rates_by(factors_at(vehicle, x.r_px, x.V_b, actuation, free), vehicle, x, actuation, water, free)


@inlined
def rates_by(factors: Factors, vehicle: np.record, x: State, actuation: Actuation, water: Water, free: bool) -> State:
    """Rates of the state with the factors of its inertia at hand: while nothing moves in the hull, they stay."""
    g, m_p, V_b = vehicle.g, vehicle.m_p, x.V_b
    zeta = down_in_body(x.Q)
    eta = velocities_by(factors, vehicle, x, actuation, water, free)
    v, omega = eta.v, eta.omega
    r_p = moving_mass_position(vehicle, x.r_px, actuation.mu)
    p_p = particle_momentum(vehicle, x.r_px, actuation, eta)
    f_v, m_v = viscous_forces(vehicle, eta.v_r, omega, actuation.delta_r)
    W = net_weight(vehicle, water, V_b)
    s = static_moment(vehicle, water, r_p, V_b)

    # what the current adds: the accelerated water pushes the hull, and its momentum follows the relative velocity
    a_U = to_body(x.Q, water.DU_Dt)
    f_U = scale(water.rho * displaced_volume(vehicle, water, V_b), a_U)
    r_bl, displaced = vehicle.r_bl, water.rho * V_b
    m_bl = cross((displaced * r_bl[0], displaced * r_bl[1], displaced * r_bl[2]), a_U)  # at the bladder
    p_f = add(symmetric_times(vehicle.M_f, eta.v_r), transpose_times(vehicle.C_f, omega))
    m_U = subtract(m_bl, cross(p_f, subtract(v, eta.v_r)))

    X_dot = to_inertial(x.Q, v)  # (1)
    Q_dot = quaternion_rate(x.Q, omega)  # (2)
    p_dot = add(add(cross(x.p, omega), scale(W, zeta)), add(f_v, f_U))  # (4)
    h_dot = add(
        add(cross(x.h, omega), cross(x.p, v)),
        add(add(scale(g, cross(s, zeta)), m_v), m_U),
    )  # (5)
    p_px_dot = cross(p_p, omega)[0] + m_p * g * zeta[0] + actuation.u_px if free else 0.0 * x.p_px  # (6)
    V_b_dot = actuation.u_b + 0.0 * V_b  # (7)
    return State(X_dot, Q_dot, p_dot, h_dot, eta.r_px_dot, p_px_dot, V_b_dot)


@inlined
def state_from_array(x: np.ndarray) -> State:
    """Read a flat state (`STATE_SIZE` numbers)."""
    return State(
        (x[0], x[1], x[2]),
        (x[3], x[4], x[5], x[6]),
        (x[7], x[8], x[9]),
        (x[10], x[11], x[12]),
        x[13],
        x[14],
        x[15],
    )


@inlined
def state_into_array(state: State, out: np.ndarray) -> None:
    """Write a flat state (`STATE_SIZE` numbers)."""
    out[0], out[1], out[2] = state.X
    out[3], out[4], out[5], out[6] = state.Q
    out[7], out[8], out[9] = state.p
    out[10], out[11], out[12] = state.h
    out[13], out[14], out[15] = state.r_px, state.p_px, state.V_b


@compiled
def derivative(
    vehicle: np.record, x: np.ndarray, actuation: Actuation, water: Water, free: bool, out: np.ndarray
) -> None:
    """Write x' for the flat state `x` into `out`."""
    state_into_array(rates(vehicle, state_from_array(x), actuation, water, free), out)
