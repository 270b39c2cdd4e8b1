"""Energy balance of the glider in still water.

Oracle: kinetic energy 1/2 eta' M(s) eta with a 9 x 9 inertia matrix of eta = (v, omega, r_px', V_b', mu') written here
from the velocities of the single masses, and the potential energy of masses and displaced water. Their exact rate along
the equations of motion must be the power of the water's viscosity and of the actuators.
"""

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from stommel.dynamics.equations import derivative
from stommel.dynamics.hydrodynamics import viscous_forces
from stommel.dynamics.integration import integrate
from stommel.dynamics.parameters import parameter_record
from stommel.dynamics.state import STATE_SIZE, Actuation
from stommel.seawater.water import Water

Vector = NDArray[Any]  # real or complex

COMPLEX_STEP = 1e-40
R_PX, V_B, MU = 6, 7, 8  # the internal coordinates s in eta
RHO = 1025.0
WATER = Water(RHO, 0.0, 15.0)
MODES = pytest.mark.parametrize("free", [True, False], ids=["free", "driven"])


def _skew(a: Vector) -> Vector:
    return np.array([[0 * a[0], -a[2], a[1]], [a[2], 0 * a[0], -a[0]], [-a[1], a[0], 0 * a[0]]])


def _definite(rng: np.random.Generator, low: float, high: float) -> Vector:
    axes = np.linalg.qr(rng.normal(size=(3, 3)))[0]
    return axes @ np.diag(rng.uniform(low, high, 3)) @ axes.T


def _glider(rng: np.random.Generator) -> SimpleNamespace:
    """A random glider near neutral, with its centre of mass below the axis."""
    d = SimpleNamespace(
        m_rb=45.0, r_rb=np.append(rng.uniform(-0.02, 0.02, 2), rng.uniform(0.02, 0.08)),
        m_b=5.0, r_b=rng.uniform(-0.5, 0.1, 3), m_p=rng.uniform(5, 15), R_p=rng.uniform(0.01, 0.06),
        J_p=_definite(rng, 0.02, 0.2), M_f=_definite(rng, 3, 70), C_f=rng.uniform(-1, 1, (3, 3)),
        J_f=_definite(rng, 1, 4), g=9.81,
        r_bl=rng.uniform(-0.8, 0.1, 3), r_res=rng.uniform(-0.4, 0.4, 3), rho_oil=870.0,
    )  # fmt: skip
    d.J_rb = _definite(rng, 3, 12) - d.m_rb * _skew(d.r_rb) @ _skew(d.r_rb)
    d.m = d.m_rb + d.m_b + d.m_p
    d.V_0 = d.m / RHO * rng.uniform(0.999, 1.001)
    return d


HYDRODYNAMICS = {
    "K_D0": 3.0, "K_D": 45.0, "S_beta": 20.0, "S_delta": 5.0, "K_L0": 0.5, "K_L": 135.0, "K_beta": -20.0,
    "K_delta": 0.5, "M_zero": 0.3, "M_alpha": -50.0, "N_beta": 40.0, "N_delta": 6.0, "D_omega": [-20.0, -60.0, -20.0],
    "D_omega_V": [-1.0, -4.0, -3.0], "Y_r": 1.0, "Z_q": -2.0, "K_N": 240.0,
}  # fmt: skip


def _six(S: Vector) -> list[float]:
    return [S[0, 0], S[1, 1], S[2, 2], S[0, 1], S[0, 2], S[1, 2]]


def _record(d: SimpleNamespace, viscous: float = 1.0) -> np.record:
    """Parameter record; the hydrodynamic coefficients times `viscous`."""
    r_rb, r_b, fixed = _skew(d.r_rb), _skew(d.r_b), d.m_rb + d.m_b
    return parameter_record(
        **{name: viscous * np.asarray(value) for name, value in HYDRODYNAMICS.items()},
        **{name: getattr(d, name) for name in ("m", "m_p", "R_p", "g", "V_0", "r_bl", "r_res", "rho_oil")},
        J_p=_six(d.J_p),
        s_0=d.m_rb * d.r_rb + d.m_b * d.r_b,
        M_0=_six(fixed * np.eye(3) + d.M_f),
        C_0=(d.m_rb * r_rb + d.m_b * r_b + d.C_f).ravel(),
        J_0=_six(d.J_rb - d.m_b * r_b @ r_b + d.J_f),
        M_f=_six(d.M_f),
        C_f=d.C_f.ravel(),
        kappa=0.0,
        alpha_T=0.0,
        T_0=15.0,
        moments_in_flow_frame=0.0,
        alpha_attached=0.3,
        alpha_separated=0.6,
    )


# ---------------------------------------------------------------- energies, of real or complex arguments


def _velocity_map(r: Vector, internal: dict[int, Vector]) -> Vector:
    """3 x 9 matrix of the velocity of a point at `r`: v + omega x r + what internal coordinates add."""
    A = np.zeros((3, 9), dtype=complex)
    A[:, :3], A[:, 3:6] = np.eye(3), -_skew(r)
    for column, direction in internal.items():
        A[:, column] = direction
    return A


def _inertia(d: SimpleNamespace, s: Vector) -> Vector:
    """M(s) of eta = (v, omega, r_px', V_b', mu') at s = (r_px, V_b, mu)."""
    r_px, V_b, mu = s
    cos, sin = np.cos(mu), np.sin(mu)
    M = np.zeros((9, 9), dtype=complex)

    body = np.zeros((9, 9))
    body[:3, :3], body[3:6, 3:6] = d.m_rb * np.eye(3) + d.M_f, d.J_rb + d.J_f
    body[3:6, :3] = d.m_rb * _skew(d.r_rb) + d.C_f
    body[:3, 3:6] = body[3:6, :3].T
    M += body

    r_p = np.array([r_px, -d.R_p * sin, d.R_p * cos])
    e_1 = np.array([1.0, 0.0, 0.0])
    A = _velocity_map(r_p, {R_PX: e_1, MU: np.array([0.0, -d.R_p * cos, -d.R_p * sin])})
    M += d.m_p * A.T @ A
    turn = np.array([[1.0, 0.0, 0.0], [0.0, cos, -sin], [0.0, sin, cos]])
    spin = np.zeros((3, 9), dtype=complex)
    spin[:, 3:6] = np.eye(3)
    spin[:, MU] = e_1
    M += spin.T @ turn @ d.J_p @ turn.T @ spin

    ballast, bladder, reservoir = (_velocity_map(r, {}) for r in (d.r_b, d.r_bl, d.r_res))
    M += d.m_b * ballast.T @ ballast + d.rho_oil * V_b * (bladder.T @ bladder - reservoir.T @ reservoir)
    pipe = d.rho_oil * np.concatenate([d.r_bl - d.r_res, np.cross(d.r_res, d.r_bl)])
    M[:6, V_B] += pipe
    M[V_B, :6] += pipe
    return M


def _potential_energy(d: SimpleNamespace, Z: Any, zeta: Vector, s: Vector) -> Any:
    r_px, V_b, mu = s
    r_p = np.array([r_px, -d.R_p * np.sin(mu), d.R_p * np.cos(mu)])
    depths = [(d.m_rb, d.r_rb), (d.m_b, d.r_b), (d.m_p, r_p), (d.rho_oil * V_b, d.r_bl), (-d.rho_oil * V_b, d.r_res)]
    heavy = sum(m * (Z + r @ zeta) for m, r in depths)
    return -d.g * (heavy - RHO * (d.V_0 * Z + V_b * (Z + d.r_bl @ zeta)))


def _zeta(Q: Vector) -> Vector:
    """Third row of the rotation matrix of a unit quaternion."""
    return np.array([2 * (Q[1] * Q[3] - Q[0] * Q[2]), 2 * (Q[2] * Q[3] + Q[0] * Q[1]), 1 - 2 * (Q[1] ** 2 + Q[2] ** 2)])


def _generalised_velocities(M: Vector, x: Vector, actuation: Actuation, free: bool) -> Vector:
    """Solve M eta = momenta for the velocities that are not prescribed."""
    eta = np.zeros(9, dtype=complex)
    eta[R_PX:] = actuation.r_px_dot, actuation.u_b, actuation.mu_dot
    n = 7 if free else 6
    momenta = np.concatenate([x[7:13], x[14:15]])[:n]
    eta[:n] = np.linalg.solve(M[:n, :n], momenta - M[:n, n:] @ eta[n:])
    return eta


def _balance(d: SimpleNamespace, x: Vector, actuation: Actuation, free: bool) -> tuple[float, Vector]:
    """Rate of the energy and the powers that make it up [W]."""
    vehicle, x_dot = _record(d), np.empty(STATE_SIZE)
    derivative(vehicle, x, actuation, WATER, free, x_dot)
    s = np.array([x[13], x[15], actuation.mu])
    s_dot = np.array([x_dot[13], actuation.u_b, actuation.mu_dot])

    def at(x: Vector, s: Vector) -> tuple[Any, Vector, Vector]:
        M = _inertia(d, s)
        eta = _generalised_velocities(M, x, actuation, free)
        U = _potential_energy(d, x[2], _zeta(x[3:7]), s)
        return 0.5 * eta @ M @ eta + U, M @ eta, eta

    E, momenta, _ = at(x + 1j * COMPLEX_STEP * x_dot, s + 1j * COMPLEX_STEP * s_dot)
    eta = at(x.astype(complex), s.astype(complex))[2].real

    forces = viscous_forces(vehicle, tuple(eta[:3]), tuple(eta[3:6]), actuation.delta_r)
    powers = [*(np.array(forces.f_v) * eta[:3]), *(np.array(forces.m_v) * eta[3:6])]
    for k, column in enumerate((R_PX, V_B, MU)):
        if free and column == R_PX:
            powers.append(actuation.u_px * eta[R_PX])
            continue
        # force of the drive on a prescribed coordinate s: d/dt dT/ds' - dT/ds + dU/ds
        step = s + 1j * COMPLEX_STEP * np.eye(3)[k]
        dT_ds = 0.5 * eta @ _inertia(d, step).imag @ eta / COMPLEX_STEP
        dU_ds = _potential_energy(d, x[2], _zeta(x[3:7]), step).imag / COMPLEX_STEP
        powers.append((momenta[column].imag / COMPLEX_STEP - dT_ds + dU_ds) * eta[column])
    return E.imag / COMPLEX_STEP, np.array(powers)


def _start(rng: np.random.Generator, d: SimpleNamespace) -> Vector:
    """Random state with speeds of a glider."""
    Q = rng.normal(size=4)
    s = np.array([rng.uniform(-0.3, 0.5), rng.uniform(-2.5e-4, 2.5e-4), 0.0])
    eta = np.concatenate(
        [rng.uniform(-0.5, 0.5, 3), rng.uniform(-0.3, 0.3, 3), rng.uniform(-0.05, 0.05, 1), [0.0, 0.0]]
    )
    P = (_inertia(d, s) @ eta).real
    return np.concatenate([rng.uniform(0, 100, 3), Q / np.linalg.norm(Q), P[:6], [s[0], P[6], s[1]]])


@MODES
def test_the_rate_of_the_energy_is_the_power_of_water_and_actuators(free: bool) -> None:
    rng = np.random.default_rng(42)
    for _ in range(20):
        d = _glider(rng)
        x, rows = _start(rng, d), np.empty((20, STATE_SIZE))
        actuation = Actuation(
            r_px_dot=rng.uniform(-0.02, 0.02),
            u_px=rng.uniform(-20, 20),
            u_b=rng.uniform(-1e-5, 1e-5),
            delta_r=rng.uniform(-0.5, 0.5),
            mu=rng.uniform(-1, 1),
            mu_dot=0.0,
        )
        integrate(_record(d), x, actuation, WATER, free, 0.002, 2000, rows)
        for row in rows:
            row[3:7] /= np.linalg.norm(row[3:7])  # else the pull back to unit length does work
            # the trajectory holds the roll angle; at each of its states the mass may as well be rolling
            rolling = actuation._replace(mu_dot=rng.uniform(-0.5, 0.5))
            rate, powers = _balance(d, row, rolling, free)
            # rounding of the momenta times the rates is about 1e-13 of the largest power
            assert abs(rate - powers.sum()) < 1e-10 * np.abs(powers).sum()


@MODES
def test_energy_stays_constant_without_viscosity_and_drives(free: bool) -> None:
    """Ten seconds of free tumbling: what remains is the truncation of the fourth-order integration."""
    rng = np.random.default_rng(7)
    for _ in range(5):
        d = _glider(rng)
        x = _start(rng, d)
        actuation = Actuation(mu=rng.uniform(-1, 1))

        def energy(x: Vector, d: SimpleNamespace = d, actuation: Actuation = actuation) -> tuple[float, float]:
            s = np.array([x[13], x[15], actuation.mu])
            M = _inertia(d, s).real
            eta = _generalised_velocities(M, x, actuation, free).real
            return float(0.5 * eta @ M @ eta), float(_potential_energy(d, x[2], _zeta(x[3:7]), s))

        kinetic, potential = energy(x)
        integrate(_record(d, viscous=0.0), x, actuation, WATER, free, 0.001, 10_000, np.empty((0, STATE_SIZE)))
        kinetic_after, potential_after = energy(x)
        change = (kinetic_after - kinetic) + (potential_after - potential)
        assert abs(kinetic_after - kinetic) > 1e-3 * kinetic
        assert abs(change) < 1e-8 * (kinetic + kinetic_after)
