"""Equations of motion against an independent derivation by Lagrange.

Oracle: L = T - U in the generalised coordinates q = (north, east, down, roll, pitch, yaw, r_px), written here from the
velocities of the single masses, with every derivative by automatic differentiation (autograd). Viscous forces are coded
here anew from section 2.2 of Fan et al. (2013). Nothing but the vehicle's numbers is shared with `stommel`.
"""

from functools import cache
from types import SimpleNamespace
from typing import Any

import autograd.numpy as anp
import numpy as np
import pytest
from autograd import grad
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from stommel.dynamics.acceleration import accelerations, state_of, velocities_of
from stommel.dynamics.equations import derivative
from stommel.dynamics.parameters import parameter_record
from stommel.dynamics.state import STATE_SIZE, Actuation, State
from stommel.seawater.water import Water

Array = NDArray[np.float64]

N = 1000
COORDINATES = 7
COMPLEX_STEP = 1e-40
TOLERANCE = 1e-10
"""Relative to the norm of the accelerations. Both sides solve systems of condition about 1e3 in double precision, and
the Euler angles add 1 / cos(pitch) < 5: rounding reaches about 1e-12. A wrong term shows from 1e-6 on."""


# ---------------------------------------------------------------- random vehicles, states and inputs, N at once


def _definite(rng: np.random.Generator, low: float, high: float) -> Array:
    """N random symmetric matrices with eigenvalues between `low` and `high`."""
    axes = Rotation.random(N, random_state=rng).as_matrix()
    return np.einsum("nij,nj,nkj->nik", axes, rng.uniform(low, high, (N, 3)), axes)


@cache
def samples(seed: int, actuated: bool) -> SimpleNamespace:
    """N vehicles in N states; `actuated` adds a rolling mass and unsteady water."""
    rng = np.random.default_rng(seed)

    def uniform(low: float, high: float, *shape: int) -> Array:
        return rng.uniform(low, high, (N, *shape))

    s = SimpleNamespace(
        m_rb=uniform(30, 60), r_rb=uniform(-0.1, 0.1, 3), m_b=uniform(1, 8), r_b=uniform(-0.6, 0.6, 3),
        m_p=uniform(5, 15), R_p=uniform(0, 0.08), J_p=_definite(rng, 0.02, 0.3),
        M_f=_definite(rng, 3, 80), J_f=_definite(rng, 0.5, 5), C_f=uniform(-2, 2, 3, 3),
        g=uniform(9.7, 9.9), rho=uniform(990, 1040), V_0=uniform(0.055, 0.065),
        r_bl=uniform(-0.9, 0.9, 3), r_res=uniform(-0.6, 0.6, 3), rho_oil=uniform(800, 950),
        K_D0=uniform(1, 8), K_D=uniform(10, 200), S_beta=uniform(5, 40), S_delta=uniform(1, 10),
        K_L0=uniform(-3, 3), K_L=uniform(50, 300), K_beta=uniform(-80, 20), K_delta=uniform(-2, 2),
        M_zero=uniform(-2, 2), M_alpha=uniform(-80, 20), N_beta=uniform(-20, 120), N_delta=uniform(-8, 8),
        D_omega=uniform(-80, 0, 3), D_omega_V=uniform(-10, 0, 3), Y_r=uniform(-5, 5), Z_q=uniform(-5, 5),
        flow_frame=np.arange(N) % 2.0,
        # state and inputs
        X=uniform(-100, 100, 3), angles=uniform(-1, 1, 3) * (np.pi, np.radians(78), np.pi), r_px=uniform(-0.5, 0.6),
        v=uniform(-0.6, 0.6, 3), omega=uniform(-0.8, 0.8, 3), r_px_dot=uniform(-0.1, 0.1), V_b=uniform(-5e-4, 5e-4),
        u_px=uniform(-30, 30), u_b=uniform(-2e-5, 2e-5), delta_r=uniform(-1, 1), mu=uniform(-np.pi, np.pi),
        U=uniform(-0.5, 0.5, 3),
        mu_dot=uniform(-1, 1) * actuated, U_dot=uniform(-0.1, 0.1, 3) * actuated,
    )  # fmt: skip
    # rigid body: the inertia of a body of that mass about its own centre, moved to the origin
    s.J_rb = _definite(rng, 2, 14) + s.m_rb[:, None, None] * _parallel_axes(s.r_rb)
    s.u_b[::5] = 0.0
    s.r_px_dot[::7] = 0.0
    return s


def _skew(a: Array) -> Array:
    return np.cross(a[..., None, :], np.eye(3), axisa=-1, axisb=-1, axisc=-1).swapaxes(-1, -2)


def _parallel_axes(r: Array) -> Array:
    return np.einsum("ni,ni->n", r, r)[:, None, None] * np.eye(3) - np.einsum("ni,nj->nij", r, r)


def _six(S: Array) -> list[float]:
    return [S[0, 0], S[1, 1], S[2, 2], S[0, 1], S[0, 2], S[1, 2]]


def _vehicle(s: SimpleNamespace, i: int) -> np.record:
    """Parameter record of the i-th vehicle."""
    m_fixed = s.m_rb[i] + s.m_b[i]
    M_0 = m_fixed * np.eye(3) + s.M_f[i]
    C_0 = s.m_rb[i] * _skew(s.r_rb[i]) + s.m_b[i] * _skew(s.r_b[i]) + s.C_f[i]
    J_0 = s.J_rb[i] + s.m_b[i] * _parallel_axes(s.r_b[i : i + 1])[0] + s.J_f[i]
    same = (
        "m_p R_p g V_0 r_bl r_res rho_oil K_D0 K_D S_beta S_delta K_L0 K_L K_beta K_delta M_zero M_alpha N_beta "
        "N_delta D_omega D_omega_V Y_r Z_q"
    )
    return parameter_record(
        **{name: getattr(s, name)[i] for name in same.split()},
        m=m_fixed + s.m_p[i],
        J_p=_six(s.J_p[i]),
        s_0=s.m_rb[i] * s.r_rb[i] + s.m_b[i] * s.r_b[i],
        M_0=_six(M_0),
        C_0=C_0.ravel(),
        J_0=_six(J_0),
        M_f=_six(s.M_f[i]),
        C_f=s.C_f[i].ravel(),
        kappa=4e-10,
        alpha_T=3e-5,
        T_0=12.0,
        moments_in_flow_frame=s.flow_frame[i],
        alpha_attached=4.0,  # beyond 180 degrees: the paper's coefficients hold everywhere
        alpha_separated=5.0,
        K_N=1.0,
    )


def _three(a: Array) -> tuple[float, float, float]:
    return float(a[0]), float(a[1]), float(a[2])


def _inputs(s: SimpleNamespace, i: int) -> tuple[Actuation, Water]:
    actuation = Actuation(
        float(s.r_px_dot[i]), float(s.u_px[i]), float(s.u_b[i]), float(s.delta_r[i]), float(s.mu[i]), float(s.mu_dot[i])
    )
    # no gauge pressure and the reference temperature: the hull has its nominal volume
    return actuation, Water(float(s.rho[i]), 0.0, 12.0, _three(s.U[i]), _three(s.U_dot[i]))


def _quaternions(angles: Array) -> Array:
    """Scalar first."""
    return np.roll(Rotation.from_euler("ZYX", angles[:, ::-1]).as_quat(), 1, axis=1)


# ---------------------------------------------------------------- the derivation


def _rotation(q: Any) -> Any:
    """R_IB = exp(e3^ psi) exp(e2^ theta) exp(e1^ phi)."""
    zero, one = 0 * q[:, 0], 1 + 0 * q[:, 0]
    c, s = [anp.cos(q[:, i]) for i in (3, 4, 5)], [anp.sin(q[:, i]) for i in (3, 4, 5)]

    def matrix(rows: list[list[Any]]) -> Any:
        return anp.stack([anp.stack(row, axis=1) for row in rows], axis=1)

    roll = matrix([[one, zero, zero], [zero, c[0], -s[0]], [zero, s[0], c[0]]])
    pitch = matrix([[c[1], zero, s[1]], [zero, one, zero], [-s[1], zero, c[1]]])
    yaw = matrix([[c[2], -s[2], zero], [s[2], c[2], zero], [zero, zero, one]])
    return anp.matmul(yaw, anp.matmul(pitch, roll))


def _times(A: Any, a: Any) -> Any:
    return anp.einsum("nij,nj->ni", A, a)


def _dot(a: Any, b: Any) -> Any:
    return anp.sum(a * b, axis=1)


def _cross(a: Any, b: Any) -> Any:
    i, j = [1, 2, 0], [2, 0, 1]
    return a[:, i] * b[:, j] - a[:, j] * b[:, i]


def _generalised_velocities(q: Any, q_dot: Any) -> Any:
    """eta = (v, omega, r_px'): body components of the velocity, body rates from Euler rates, speed of the mass."""
    phi, theta = q[:, 3], q[:, 4]
    phi_dot, theta_dot, psi_dot = q_dot[:, 3], q_dot[:, 4], q_dot[:, 5]
    v = anp.einsum("nji,nj->ni", _rotation(q), q_dot[:, :3])
    omega = anp.stack(
        [
            phi_dot - psi_dot * anp.sin(theta),
            theta_dot * anp.cos(phi) + psi_dot * anp.cos(theta) * anp.sin(phi),
            -theta_dot * anp.sin(phi) + psi_dot * anp.cos(theta) * anp.cos(phi),
        ],
        axis=1,
    )
    return anp.concatenate([v, omega, q_dot[:, 6:]], axis=1)


def _kinetic_energy(s: SimpleNamespace, eta: Any, U_B: Any, r_px: Any, t: Any) -> Any:
    """Kinetic energy of each sample; prescribed motions run with the time `t` of the sample."""
    v, omega, r_px_dot = eta[:, :3], eta[:, 3:6], eta[:, 6]
    mu = s.mu + s.mu_dot * t
    m_oil = s.rho_oil * (s.V_b + s.u_b * t)
    zero = 0 * t

    def half_m_v_square(m: Any, velocity: Any) -> Any:
        return 0.5 * m * _dot(velocity, velocity)

    def fixed_at(r: Any) -> Any:
        return v + _cross(omega, r)

    def quadratic(A: Any, a: Any) -> Any:
        return 0.5 * _dot(a, _times(A, a))

    rigid = 0.5 * s.m_rb * _dot(v, v) + s.m_rb * _dot(v, _cross(omega, s.r_rb)) + quadratic(s.J_rb, omega)
    ballast = half_m_v_square(s.m_b, fixed_at(s.r_b))

    # moving mass: its centre, and its own rotation at the rate omega + mu' e1 about axes turned by mu about b1
    sin, cos = anp.sin(mu), anp.cos(mu)
    r_p = anp.stack([r_px, -s.R_p * sin, s.R_p * cos], axis=1)
    r_p_dot = anp.stack([r_px_dot, -s.R_p * cos * s.mu_dot, -s.R_p * sin * s.mu_dot], axis=1)
    spin = omega + anp.stack([s.mu_dot + zero, zero, zero], axis=1)
    own = anp.stack([spin[:, 0], cos * spin[:, 1] + sin * spin[:, 2], -sin * spin[:, 1] + cos * spin[:, 2]], axis=1)
    moving = half_m_v_square(s.m_p, fixed_at(r_p) + r_p_dot) + quadratic(s.J_p, own)

    # oil: gone from the reservoir, arrived at the bladder, and on its way in a straight pipe between them
    oil = half_m_v_square(m_oil, fixed_at(s.r_bl)) - half_m_v_square(m_oil, fixed_at(s.r_res))
    in_pipe = s.rho_oil * s.u_b * (_dot(v, s.r_bl - s.r_res) + _dot(omega, _cross(s.r_res, s.r_bl)))

    v_r = v - U_B
    water = quadratic(s.M_f, v_r) + _dot(omega, _times(s.C_f, v_r)) + quadratic(s.J_f, omega)
    return rigid + ballast + moving + oil + in_pipe + water


def _lagrangian(s: SimpleNamespace, q: Any, q_dot: Any, t: Any) -> Any:
    R = _rotation(q)
    U = s.U + s.U_dot * t[:, None]
    T = _kinetic_energy(s, _generalised_velocities(q, q_dot), anp.einsum("nji,nj->ni", R, U), q[:, 6], t)

    mu, V_b = s.mu + s.mu_dot * t, s.V_b + s.u_b * t
    r_p = anp.stack([q[:, 6], -s.R_p * anp.sin(mu), s.R_p * anp.cos(mu)], axis=1)

    def down(r: Any) -> Any:
        return q[:, 2] + _dot(R[:, 2, :], r)

    masses = s.m_rb * down(s.r_rb) + s.m_b * down(s.r_b) + s.m_p * down(r_p)
    oil = s.rho_oil * V_b * (down(s.r_bl) - down(s.r_res))
    displaced = s.rho * (s.V_0 * q[:, 2] + V_b * down(s.r_bl))
    # the pressure gradient of accelerated water pushes every displaced volume where it is, as gravity's does
    at_bladder = q[:, :3] + anp.einsum("nij,nj->ni", R, s.r_bl)
    accelerated_water = s.rho * (s.V_0 * _dot(s.U_dot, q[:, :3]) + V_b * _dot(s.U_dot, at_bladder))
    return T + s.g * (masses + oil - displaced) + accelerated_water


def _viscous(s: SimpleNamespace, v_r: Array, omega: Array) -> Array:
    """f_v and m_v in the body frame (N x 6), section 2.2 of the paper and the damping of wing and rudder."""
    V = np.linalg.norm(v_r, axis=1)
    alpha, beta = np.arctan2(v_r[:, 2], v_r[:, 0]), np.arcsin(v_r[:, 1] / V)
    R_BC = Rotation.from_rotvec(-alpha[:, None] * (0, 1, 0)) * Rotation.from_rotvec(beta[:, None] * (0, 0, 1))
    D = s.K_D0 + s.K_D * alpha**2
    S = s.S_beta * beta + s.S_delta * s.delta_r
    L = s.K_L0 + s.K_L * alpha
    f_v = -R_BC.apply(np.stack([D, S, L], axis=1) * V[:, None] ** 2)
    f_v[:, 1] += s.Y_r * V * omega[:, 2]
    f_v[:, 2] += s.Z_q * V * omega[:, 1]
    K = s.K_beta * beta + s.K_delta * s.delta_r
    M = s.M_zero + s.M_alpha * alpha
    N_ = s.N_beta * beta + s.N_delta * s.delta_r
    V = V[:, None]
    m_v = np.stack([K, M, N_], axis=1) * V**2 + (s.D_omega * V**2 + s.D_omega_V * V) * omega
    m_v = np.where(s.flow_frame[:, None] == 1.0, R_BC.apply(m_v), m_v)
    return np.concatenate([f_v, m_v], axis=1)


class Derivation:
    """Every partial derivative of the Lagrangian that the Euler-Lagrange equations need, at the N samples.

    Samples do not interact, so that the gradient of a sum over them holds each one's gradient.
    """

    def __init__(self, s: SimpleNamespace) -> None:
        self.s = s
        R = Rotation.from_euler("ZYX", s.angles[:, ::-1])
        phi, theta = s.angles[:, 0], s.angles[:, 1]
        p, q, r = s.omega.T
        psi_dot = (q * np.sin(phi) + r * np.cos(phi)) / np.cos(theta)
        euler_dot = np.stack([p + psi_dot * np.sin(theta), q * np.cos(phi) - r * np.sin(phi), psi_dot], axis=1)
        self.q = np.concatenate([s.X, s.angles, s.r_px[:, None]], axis=1)
        self.q_dot = np.concatenate([R.apply(s.v), euler_dot, s.r_px_dot[:, None]], axis=1)
        self.at = (self.q, self.q_dot, np.zeros(N))
        assert np.allclose(_generalised_velocities(self.q, self.q_dot)[:, :6], np.hstack([s.v, s.omega]), atol=1e-13)

        def total(q: Any, q_dot: Any, t: Any) -> Any:
            return anp.sum(_lagrangian(s, q, q_dot, t))

        momentum = grad(total, 1)
        self.momentum: Array = momentum(*self.at)
        self.L_q: Array = grad(total, 0)(*self.at)
        self.mass_matrix = np.empty((N, COORDINATES, COORDINATES))
        self.momentum_rate_without_acceleration = np.empty((N, COORDINATES))
        for k in range(COORDINATES):
            q_part, q_dot_part, t_part = self._gradients(lambda *at, k=k: anp.sum(momentum(*at)[:, k]))
            self.mass_matrix[:, k, :] = q_dot_part
            self.momentum_rate_without_acceleration[:, k] = _dot(q_part, self.q_dot) + t_part
        self.forces = self._generalised_forces()

    def _gradients(self, f: Any) -> tuple[Array, Array, Array]:
        gradient: tuple[Array, Array, Array] = grad(f, (0, 1, 2))(*self.at)
        return gradient

    def _generalised_forces(self) -> Array:
        """Gradient of the power with respect to q', the forces held."""
        s = self.s
        v_r = s.v - Rotation.from_euler("ZYX", s.angles[:, ::-1]).apply(s.U, inverse=True)
        F = np.hstack([_viscous(s, v_r, s.omega), s.u_px[:, None]])
        forces: Array = grad(lambda q_dot: anp.sum(F * _generalised_velocities(self.q, q_dot)))(self.q_dot)
        return forces

    def accelerations(self, free: bool) -> Array:
        """(v', omega', r_px'') of each sample."""
        n = COORDINATES if free else COORDINATES - 1
        right = self.L_q + self.forces - self.momentum_rate_without_acceleration
        q_ddot = np.zeros((N, COORDINATES))
        q_ddot[:, :n] = np.linalg.solve(self.mass_matrix[:, :n, :n], right[:, :n, None])[..., 0]
        eta_dot = np.empty((N, COORDINATES))
        for k in range(COORDINATES):
            eta = grad(lambda q, q_dot, k=k: anp.sum(_generalised_velocities(q, q_dot)[:, k]), (0, 1))
            q_part, q_dot_part = eta(self.q, self.q_dot)
            eta_dot[:, k] = _dot(q_part, self.q_dot) + _dot(q_dot_part, q_ddot)
        return eta_dot

    def body_momenta(self) -> Array:
        """(p, h, p_px): gradient of the kinetic energy with respect to eta."""
        s = self.s
        eta = _generalised_velocities(self.q, self.q_dot)
        U_B = np.einsum("nji,nj->ni", _rotation(self.q), s.U)
        momenta: Array = grad(lambda eta: anp.sum(_kinetic_energy(s, eta, U_B, s.r_px, np.zeros(N))))(eta)
        return momenta

    def body_momentum_rates(self) -> Array:
        """(p', h', p_px') without solving for any acceleration.

        The canonical momentum is B(q)' P with eta = B(q) q' and P = (p, h, p_px), and its rate is dL/dq plus the force:
        B' P' = dL/dq + Q - (dB/dt)' P.
        """
        P = self.body_momenta()
        B = np.empty((N, COORDINATES, COORDINATES))
        for k in range(COORDINATES):
            B[:, k, :] = grad(lambda q_dot, k=k: anp.sum(_generalised_velocities(self.q, q_dot)[:, k]))(self.q_dot)

        def canonical(q: Any, w: Any) -> Any:
            return anp.sum(_generalised_velocities(q, w) * P)

        turning = np.empty((N, COORDINATES))
        for k in range(COORDINATES):
            unit = np.tile(np.eye(COORDINATES)[k], (N, 1))
            turning[:, k] = _dot(grad(canonical, 0)(self.q, unit), self.q_dot)
        right = self.L_q + self.forces - turning
        rates: Array = np.linalg.solve(B.swapaxes(1, 2), right[..., None])[..., 0]
        return rates


@cache
def derived(seed: int, actuated: bool) -> Derivation:
    """The derivation at a set of samples, once."""
    return Derivation(samples(seed, actuated))


# ---------------------------------------------------------------- stommel at the same samples


def _state(s: SimpleNamespace, i: int, Q: Array) -> State:
    actuation, water = _inputs(s, i)
    attitude = (float(Q[i, 0]), float(Q[i, 1]), float(Q[i, 2]), float(Q[i, 3]))
    return state_of(
        _vehicle(s, i),
        _three(s.v[i]),
        _three(s.omega[i]),
        _three(s.X[i]),
        attitude,
        float(s.r_px[i]),
        float(s.V_b[i]),
        actuation,
        water,
    )


def _relative_difference(found: Array, expected: Array) -> Array:
    return np.linalg.norm(found - expected, axis=1) / np.linalg.norm(expected, axis=1)


@pytest.mark.parametrize("free", [True, False], ids=["free", "driven"])
def test_accelerations_follow_from_the_lagrangian(free: bool) -> None:
    s = samples(2013, False)
    Q = _quaternions(s.angles)
    found = np.empty((N, COORDINATES))
    for i in range(N):
        a = accelerations(_vehicle(s, i), _state(s, i, Q), *_inputs(s, i), free)
        found[i] = *a.v_dot, *a.omega_dot, a.r_px_ddot
    assert _relative_difference(found, derived(2013, False).accelerations(free)).max() < TOLERANCE


def test_momenta_are_the_gradient_of_the_kinetic_energy() -> None:
    s = samples(1, True)
    Q = _quaternions(s.angles)
    found = np.array([[*x.p, *x.h, x.p_px] for x in (_state(s, i, Q) for i in range(N))])
    assert _relative_difference(found, derived(1, True).body_momenta()).max() < 1e-13  # sums of few terms


@pytest.mark.parametrize("free", [True, False], ids=["free", "driven"])
def test_momentum_rates_with_rolling_mass_flowing_oil_and_unsteady_water(free: bool) -> None:
    s = samples(1, True)
    Q = _quaternions(s.angles)
    found, out = np.empty((N, COORDINATES)), np.empty(STATE_SIZE)
    for i in range(N):
        x = _state(s, i, Q)
        flat = np.array([*x.X, *x.Q, *x.p, *x.h, x.r_px, x.p_px, x.V_b])
        derivative(_vehicle(s, i), flat, *_inputs(s, i), free, out)
        found[i] = *out[7:13], out[14]
    expected = derived(1, True).body_momentum_rates()
    n = COORDINATES if free else COORDINATES - 1  # driven, the axial momentum is not a state
    assert _relative_difference(found[:, :n], expected[:, :n]).max() < TOLERANCE


@pytest.mark.parametrize("free", [True, False], ids=["free", "driven"])
def test_velocities_change_as_derived_with_rolling_mass_flowing_oil_and_unsteady_water(free: bool) -> None:
    """The exact rate of `velocities_of` along state, roll angle and current, all stepped together."""
    s = samples(1, True)
    Q = _quaternions(s.angles)
    found, out = np.empty((N, COORDINATES)), np.empty(STATE_SIZE)
    for i in range(N):
        vehicle, (actuation, water), x = _vehicle(s, i), _inputs(s, i), _state(s, i, Q)
        flat = np.array([*x.X, *x.Q, *x.p, *x.h, x.r_px, x.p_px, x.V_b])
        derivative(vehicle, flat, actuation, water, free, out)
        z = [complex(a, COMPLEX_STEP * b) for a, b in zip(flat, out, strict=True)]
        U = tuple(complex(a, COMPLEX_STEP * b) for a, b in zip(s.U[i], s.U_dot[i], strict=True))
        eta: Any = velocities_of(
            vehicle,
            State(tuple(z[0:3]), tuple(z[3:7]), tuple(z[7:10]), tuple(z[10:13]), *z[13:]),
            actuation._replace(mu=complex(s.mu[i], COMPLEX_STEP * s.mu_dot[i])),
            water._replace(U=U),
            free,
        )
        found[i] = [a.imag / COMPLEX_STEP for a in (*eta.v, *eta.omega, eta.r_px_dot)]
    assert _relative_difference(found, derived(1, True).accelerations(free)).max() < TOLERANCE
