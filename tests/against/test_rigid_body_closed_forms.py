"""Motions with a closed form: Euler, Galilei, Kirchhoff, and the pendulum.

Oracle: textbook solutions in elementary and in Jacobi elliptic functions (scipy.special). Where nothing else is said,
differences are the truncation of the fourth-order integration at the steps used, below 1e-9.
"""

import math
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation
from scipy.special import ellipj

from stommel.dynamics.acceleration import accelerations, state_of, velocities_of
from stommel.dynamics.equations import derivative
from stommel.dynamics.integration import integrate
from stommel.dynamics.parameters import VEHICLE_RECORD, parameter_record
from stommel.dynamics.state import STATE_SIZE, Actuation, State
from stommel.seawater.water import Water

Array = NDArray[np.float64]
Vector = tuple[float, float, float]
Quaternion = tuple[float, float, float, float]

REST: Vector = (0.0, 0.0, 0.0)
LEVEL: Quaternion = (1.0, 0.0, 0.0, 0.0)
NOSE_DOWN: Quaternion = (math.sqrt(0.5), 0.0, -math.sqrt(0.5), 0.0)
WATER = Water(1000.0)
G = 9.8
MASS = 60.0
MOVING_MASS = 10.0
FIXED_MASS = MASS - MOVING_MASS


def _body(
    J: tuple[float, float, float] = (4.0, 12.0, 12.0),
    M_f: tuple[float, float, float] = (0.0, 0.0, 0.0),
    z: float = 0.0,
    **changed: Any,
) -> np.record:
    """A neutral body of principal inertia `J` [kg m2] without viscosity, its centre of mass `z` [m] below the axis.

    The moving mass counts in the mass; at the origin it adds no inertia.
    """
    zeros: dict[str, Any] = dict.fromkeys(VEHICLE_RECORD.names or (), 0.0)
    static = FIXED_MASS * z
    values = {
        "m": MASS,
        "m_p": MOVING_MASS,
        "g": G,
        "V_0": MASS / WATER.rho,
        "s_0": [0.0, 0.0, static],
        "M_0": [FIXED_MASS + M_f[0], FIXED_MASS + M_f[1], FIXED_MASS + M_f[2], 0.0, 0.0, 0.0],
        "C_0": [0.0, -static, 0.0, static, 0.0, 0.0, 0.0, 0.0, 0.0],
        "J_0": [*J, 0.0, 0.0, 0.0],
        "M_f": [*M_f, 0.0, 0.0, 0.0],
        "alpha_attached": 4.0,
        "alpha_separated": 5.0,
    }
    return parameter_record(**(zeros | values | changed))


def _start(
    vehicle: np.record,
    v: Vector = REST,
    omega: Vector = REST,
    Q: Quaternion = LEVEL,
    r_px: float = 0.0,
    V_b: float = 0.0,
    actuation: Actuation | None = None,
) -> Array:
    x = state_of(vehicle, v, omega, REST, Q, r_px, V_b, actuation or Actuation(), WATER)
    return np.array([*x.X, *x.Q, *x.p, *x.h, x.r_px, x.p_px, x.V_b])


def _fly(
    vehicle: np.record,
    x: Array,
    seconds: float,
    step: float = 0.002,
    free: bool = False,
    actuation: Actuation | None = None,
) -> tuple[Array, Array]:
    """Times and states of 20 equal intervals."""
    rows = np.empty((20, STATE_SIZE))
    integrate(vehicle, x.copy(), actuation or Actuation(), WATER, free, step, round(seconds / step), rows)
    return seconds * np.arange(1, 21) / 20, rows


def _velocities(vehicle: np.record, rows: Array, free: bool = False) -> tuple[Array, Array]:
    """v and omega of each state."""
    found = []
    for row in rows:
        e = [float(value) for value in row]
        state = State(
            (e[0], e[1], e[2]), (e[3], e[4], e[5], e[6]), (e[7], e[8], e[9]), (e[10], e[11], e[12]), e[13], e[14], e[15]
        )
        eta = velocities_of(vehicle, state, Actuation(), WATER, free)
        found.append([*eta.v, *eta.omega])
    array = np.array(found)
    return array[:, :3], array[:, 3:]


def _matrices(rows: Array) -> Array:
    """R_IB of each state."""
    R: Array = Rotation.from_quat(np.roll(rows[:, 3:7], -1, axis=1)).as_matrix()
    return R


def test_torque_free_symmetric_body_precesses_as_euler_found() -> None:
    A, B = 4.0, 12.0
    p, q_0, r_0 = 1.5, 0.4, -0.2
    vehicle = _body((A, B, B))
    x = _start(vehicle, omega=(p, q_0, r_0))
    t, rows = _fly(vehicle, x, 20.0)
    rate = (B - A) / B * p  # q' = rate r, r' = -rate q
    c, s = np.cos(rate * t), np.sin(rate * t)
    _, omega = _velocities(vehicle, rows)
    assert np.allclose(omega[:, 0], p, rtol=0.0, atol=1e-9)
    assert np.allclose(omega[:, 1], q_0 * c + r_0 * s, rtol=0.0, atol=1e-9)
    assert np.allclose(omega[:, 2], r_0 * c - q_0 * s, rtol=0.0, atol=1e-9)
    # attitude: a turn about the constant angular momentum at |h| / B, after a turn about the body's own axis
    h = np.array([A * p, B * q_0, B * r_0])
    expected = Rotation.from_rotvec(np.outer(t, h / B)) * Rotation.from_rotvec(np.outer(t, [rate, 0.0, 0.0]))
    assert np.allclose(_matrices(rows), expected.as_matrix(), rtol=0.0, atol=1e-9)


def test_torque_free_asymmetric_body_follows_jacobi() -> None:
    """Spun about the axis of least inertia: cn, sn and dn [Landau and Lifshitz, Mechanics, section 37]."""
    J_1, J_2, J_3 = 12.0, 8.0, 4.0
    p, r = 0.3, 1.2
    twice_energy = J_1 * p**2 + J_3 * r**2
    h_square = (J_1 * p) ** 2 + (J_3 * r) ** 2
    a, b = twice_energy * J_1 - h_square, h_square - twice_energy * J_3
    rate = math.sqrt((J_2 - J_3) * a / (J_1 * J_2 * J_3))
    modulus_square = (J_1 - J_2) * b / ((J_2 - J_3) * a)
    assert modulus_square < 1.0
    vehicle = _body((J_1, J_2, J_3))
    t, rows = _fly(vehicle, _start(vehicle, omega=(p, 0.0, r)), 20.0)
    sn, cn, dn, _ = ellipj(rate * t, modulus_square)
    _, omega = _velocities(vehicle, rows)
    expected = np.stack([p * cn, -math.sqrt(b / (J_2 * (J_2 - J_3))) * sn, r * dn], axis=1)
    assert np.allclose(omega, expected, rtol=0.0, atol=1e-9)


def test_body_in_perfect_fluid_swings_about_broadside_as_kirchhoff_found() -> None:
    """With the impulse I at an angle chi from the axis, chi'' = I^2 / (2 J) (1 / M_x - 1 / M_z) sin(2 chi)."""
    M_x, M_z, J = 65.0, 130.0, 12.0
    vehicle = _body((4.0, J, 11.0), M_f=(M_x - MASS, 60.0, M_z - MASS))
    w, q = 0.5, 0.1  # broadside: chi = 90 degrees
    impulse = M_z * w
    frequency = impulse * math.sqrt((1 / M_x - 1 / M_z) / J)
    k = q / frequency
    t, rows = _fly(vehicle, _start(vehicle, v=(0.0, 0.0, w), omega=(0.0, q, 0.0)), 30.0)
    sn, cn, dn, _ = ellipj(frequency * t, k * k)
    v, omega = _velocities(vehicle, rows)
    # sin(chi - 90 degrees) = k sn, so that cos(chi) = -k sn and sin(chi) = dn
    assert np.allclose(v[:, 0], -impulse / M_x * k * sn, rtol=0.0, atol=1e-9)
    assert np.allclose(v[:, 2], impulse / M_z * dn, rtol=0.0, atol=1e-9)
    assert np.allclose(omega[:, 1], q * cn, rtol=0.0, atol=1e-9)
    assert np.allclose(v[:, 1], 0.0, rtol=0.0, atol=1e-12)
    # the impulse stays where it was in the inertial frame
    assert np.allclose(np.einsum("nij,nj->ni", _matrices(rows), rows[:, 7:10]), [0.0, 0.0, impulse], atol=1e-7)


def test_pendulum_with_the_origin_held_swings_as_jacobi_found() -> None:
    """Roll under a low centre of mass, 70 degrees to either side, sway and heave locked by a large added mass.

    The lock of 1e9 kg moves the frequency by (m z)^2 / (M J) = 1e-9 of itself.
    """
    z, J = 0.06, 4.0
    vehicle = _body((J, 12.0, 11.0), M_f=(1e9, 1e9, 1e9), z=z)
    frequency = math.sqrt(FIXED_MASS * G * z / J)
    k = math.sin(math.radians(35.0))
    t, rows = _fly(vehicle, _start(vehicle, omega=(2 * k * frequency, 0.0, 0.0)), 10.0, step=0.001)
    sn, _, _, _ = ellipj(frequency * t, k * k)
    phi = np.arctan2(_matrices(rows)[:, 2, 1], _matrices(rows)[:, 2, 2])
    assert np.allclose(np.sin(0.5 * phi), k * sn, rtol=0.0, atol=1e-7)


def test_small_roll_of_a_free_body_has_the_frequency_of_its_coupled_inertia() -> None:
    """Sway follows the roll so that no momentum arises: J is less by (m z)^2 / M_y."""
    z, J, sway = 0.06, 4.0, 20.0
    vehicle = _body((J, 12.0, 11.0), M_f=(5.0, sway, 70.0), z=z)
    static = FIXED_MASS * z
    frequency = math.sqrt(static * G / (J - static**2 / (MASS + sway)))
    p = 1e-6
    t, rows = _fly(vehicle, _start(vehicle, omega=(p, 0.0, 0.0), v=(0.0, static / (MASS + sway) * p, 0.0)), 10.0)
    _, omega = _velocities(vehicle, rows)
    # amplitude 4e-7 rad: what is quadratic in it is below 1e-6 of it
    assert np.allclose(omega[:, 0], p * np.cos(frequency * t), rtol=0.0, atol=1e-6 * p)


def test_vertical_dive_from_rest_approaches_its_terminal_speed_as_a_hyperbolic_tangent() -> None:
    K_D0, surge, V_b = 2.0, 5.0, -2e-4
    # the pitch moment exceeds the Munk moment of 65 kg V^2, so that rounding does not grow
    vehicle = _body(M_f=(surge, 60.0, 70.0), K_D0=K_D0, K_D=45.0, K_L=135.0, M_alpha=-80.0)
    W = -WATER.rho * G * V_b
    terminal = math.sqrt(W / K_D0)
    time_constant = (MASS + surge) * terminal / W
    t, rows = _fly(vehicle, _start(vehicle, Q=NOSE_DOWN, V_b=V_b), 100.0, step=0.01)
    v, _ = _velocities(vehicle, rows)
    assert np.allclose(v[:, 0], terminal * np.tanh(t / time_constant), rtol=0.0, atol=1e-9)
    depth = terminal * time_constant * np.log(np.cosh(t / time_constant))
    assert np.allclose(rows[:, 2], depth, rtol=0.0, atol=1e-7)
    assert math.isclose(v[-1, 0], terminal, rel_tol=1e-2)


@pytest.mark.parametrize("V_b", [-2e-4, 2e-4])
def test_level_body_without_viscosity_falls_with_its_added_mass(V_b: float) -> None:
    heave = 70.0
    vehicle = _body(M_f=(5.0, 60.0, heave))
    t, rows = _fly(vehicle, _start(vehicle, V_b=V_b), 10.0, step=0.01)
    acceleration = -WATER.rho * G * V_b / (MASS + heave)
    # a quadratic: Runge-Kutta is exact
    assert np.allclose(rows[:, 2], 0.5 * acceleration * t**2, rtol=0.0, atol=1e-11)
    assert np.allclose(rows[:, :2], 0.0, rtol=0.0, atol=1e-12)


@pytest.mark.parametrize("u_px", [0.0, -150.0])
def test_mass_sliding_down_a_vertical_hull_shares_its_momentum_with_the_hull(u_px: float) -> None:
    """Neutral and nose down: the whole keeps its momentum, the parts accelerate by the reduced mass."""
    surge = 5.0
    vehicle = _body(M_f=(surge, 60.0, 70.0))
    actuation = Actuation(u_px=u_px)
    t, rows = _fly(vehicle, _start(vehicle, Q=NOSE_DOWN), 2.0, step=0.01, free=True, actuation=actuation)
    whole = MASS + surge
    relative = (G + u_px / MOVING_MASS) * whole / (whole - MOVING_MASS)
    assert np.allclose(rows[:, 13], 0.5 * relative * t**2, rtol=0.0, atol=1e-10)
    assert np.allclose(rows[:, 2], -0.5 * MOVING_MASS / whole * relative * t**2, rtol=0.0, atol=1e-10)


def test_driven_mass_moves_the_hull_the_other_way() -> None:
    """At rest and neutral no momentum arises; the common centre of mass, added mass included, stays."""
    surge, speed = 5.0, 0.05
    vehicle = _body(M_f=(surge, 60.0, 70.0))
    actuation = Actuation(r_px_dot=speed)
    hull = -MOVING_MASS * speed / (MASS + surge)
    x = _start(vehicle, v=(hull, 0.0, 0.0), Q=NOSE_DOWN, actuation=actuation)
    assert np.allclose(x[7:13], 0.0, rtol=0.0, atol=1e-15)
    t, rows = _fly(vehicle, x, 5.0, step=0.01, actuation=actuation)
    assert np.allclose(rows[:, 2], hull * t, rtol=0.0, atol=1e-13)


def test_rolling_battery_turns_the_hull_the_other_way() -> None:
    """On the axis, the battery's and the hull's roll share the angular momentum zero."""
    J, J_p, mu_dot = 4.0, 0.5, 0.2
    vehicle = _body((J, 12.0, 11.0), J_p=[J_p, 0.3, 0.3, 0.0, 0.0, 0.0])
    actuation = Actuation(mu_dot=mu_dot)
    hull = -J_p * mu_dot / (J + J_p)
    x = _start(vehicle, omega=(hull, 0.0, 0.0), actuation=actuation)
    assert np.allclose(x[7:13], 0.0, rtol=0.0, atol=1e-15)
    t, rows = _fly(vehicle, x, 5.0, step=0.01, actuation=actuation)
    phi = np.arctan2(_matrices(rows)[:, 2, 1], _matrices(rows)[:, 2, 2])
    assert np.allclose(phi, hull * t, rtol=0.0, atol=1e-11)


def test_munk_moment_of_a_body_held_at_incidence() -> None:
    """q' = (M_z - M_x) u w / J at the first instant."""
    M_x, M_z, J = 65.0, 130.0, 12.0
    u, w = 0.4, 0.05
    vehicle = _body((4.0, J, 11.0), M_f=(M_x - MASS, 60.0, M_z - MASS))
    x = state_of(vehicle, (u, 0.0, w), REST, REST, LEVEL, 0.0, 0.0, Actuation(), WATER)
    a = accelerations(vehicle, x, Actuation(), WATER, False)
    assert math.isclose(a.omega_dot[1], (M_z - M_x) * u * w / J, rel_tol=1e-14)
    assert np.allclose(a.v_dot, 0.0, rtol=0.0, atol=1e-15)


def test_water_that_accelerates_carries_a_neutral_body_along() -> None:
    """Where the whole sea accelerates, a neutral body at rest in it has no reason to slip."""
    vehicle = _body((4.0, 12.0, 11.0), M_f=(5.0, 60.0, 70.0))
    acceleration = (0.3, -0.2, 0.1)
    U = (0.5, 0.1, -0.2)
    water = Water(WATER.rho, 0.0, 0.0, U, acceleration)
    Q = (0.5, 0.5, -0.5, 0.5)
    R = Rotation.from_quat([0.5, -0.5, 0.5, 0.5]).as_matrix()
    v = R.T @ U
    x = state_of(vehicle, (v[0], v[1], v[2]), REST, REST, Q, 0.0, 0.0, Actuation(), water)
    # momentum of the body alone: the water's relative momentum is zero, and its rate is the body's mass times U'
    rows = np.array([*x.X, *x.Q, *x.p, *x.h, x.r_px, x.p_px, x.V_b])
    assert np.allclose(rows[7:10], MASS * v, rtol=1e-15)
    rate = np.empty(STATE_SIZE)
    derivative(vehicle, rows, Actuation(), water, False, rate)
    assert np.allclose(rate[7:10], MASS * R.T @ acceleration, rtol=1e-13)
    assert np.allclose(rate[10:13], 0.0, rtol=0.0, atol=1e-13)
