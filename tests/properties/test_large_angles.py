"""Forces at every angle of attack and sideslip, in full physics: bounded, continuous, dissipative, and flyable.

Oracle: the paper's formulas below stall, and what any steady force of a viscous fluid must satisfy beyond it.
"""

import math

import numpy as np
import pytest
from numpy.typing import NDArray

from stommel.compilation import compiled
from stommel.dynamics.acceleration import state_of
from stommel.dynamics.hydrodynamics import viscous_forces
from stommel.dynamics.integration import integrate
from stommel.dynamics.packing import pack, reference_water
from stommel.dynamics.state import STATE_SIZE, Actuation
from stommel.geometry.attitude import quaternion_from_euler
from stommel.vehicle import FULL, PAPER, builtin_names, load_vehicle

Array = NDArray[np.float64]
NAMES = builtin_names()
RATES = (0.1, -0.2, 0.15)
NO_RATES = (0.0, 0.0, 0.0)


@compiled
def _sweep(vehicle, alpha, beta, V, omega, delta_r, out):  # type: ignore[no-untyped-def]
    for i in range(len(alpha)):
        cos_beta = math.cos(beta[i])
        v_r = (
            V * math.cos(alpha[i]) * cos_beta,
            V * math.sin(beta[i]),
            V * math.sin(alpha[i]) * cos_beta,
        )
        forces = viscous_forces(vehicle, v_r, omega, delta_r)
        out[i, 0], out[i, 1], out[i, 2] = forces.f_v
        out[i, 3], out[i, 4], out[i, 5] = forces.m_v
        out[i, 6], out[i, 7], out[i, 8] = v_r


def _forces(
    vehicle: np.record,
    alpha: Array,
    beta: Array,
    delta_r: float = 0.0,
    omega: tuple[float, float, float] = NO_RATES,
    V: float = 0.5,
) -> tuple[Array, Array, Array]:
    """f_v, m_v and v_r in the body frame at every pair of angles."""
    out = np.empty((alpha.size, 9))
    _sweep(vehicle, alpha.ravel(), beta.ravel(), V, omega, delta_r, out)
    return out[:, :3], out[:, 3:6], out[:, 6:]


def _all_angles() -> tuple[Array, Array]:
    # half-degree steps, and the neighbourhood of the ends and of the stall angles
    alpha = np.radians(np.concatenate([np.linspace(-180, 180, 721), [-179.999999, 179.999999, 1e-9, -1e-9]]))
    beta = np.radians(np.concatenate([np.linspace(-90, 90, 181), [-89.999999, 89.999999, 1e-9, -1e-9]]))
    grid: tuple[Array, Array] = tuple(np.meshgrid(alpha, beta))  # type: ignore[assignment]
    return grid


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("delta_r", [0.0, 0.5, -1.0])
def test_forces_are_finite_and_bounded_at_every_angle(name: str, delta_r: float) -> None:
    vehicle = pack(load_vehicle(name), FULL)
    f_v, m_v, _ = _forces(vehicle, *_all_angles(), delta_r, RATES)
    assert np.all(np.isfinite(f_v))
    assert np.all(np.isfinite(m_v))
    # no coefficient grows beyond what it is at the end of attached flow, or than the broadside plate
    stall, square = vehicle.alpha_separated, 0.25
    force = (
        vehicle.K_D0 + vehicle.K_D * stall**2 + 2 * vehicle.K_N + abs(vehicle.K_L0) + vehicle.K_L * stall
        + vehicle.S_beta * stall + vehicle.S_delta * abs(delta_r)
    ) * square + 0.5 * (abs(vehicle.Y_r * RATES[2]) + abs(vehicle.Z_q * RATES[1]))  # fmt: skip
    moment = (
        np.abs([vehicle.K_beta, vehicle.M_alpha, vehicle.N_beta, vehicle.M_zero]).sum()
        + np.abs([vehicle.K_delta, vehicle.N_delta]).sum() * abs(delta_r)
    ) * square + np.abs((vehicle.D_omega * 0.25 + vehicle.D_omega_V * 0.5) * RATES).sum()  # fmt: skip
    assert np.linalg.norm(f_v, axis=1).max() <= force
    assert np.linalg.norm(m_v, axis=1).max() <= moment


@pytest.mark.parametrize("name", NAMES)
def test_forces_below_stall_are_those_of_the_paper(name: str) -> None:
    vehicle = load_vehicle(name)
    full, paper = pack(vehicle, FULL), pack(vehicle, PAPER)
    stall = float(full.alpha_attached)
    alpha, beta = np.meshgrid(np.linspace(-stall, stall, 101), np.linspace(-stall, stall, 101))
    inside = (np.abs(alpha) < stall) & (np.abs(beta) < stall)
    for delta_r in (0.0, 0.4):
        f_v, m_v, _ = _forces(full, alpha[inside], beta[inside], delta_r, RATES)
        f_paper, m_paper, _ = _forces(paper, alpha[inside], beta[inside], delta_r, RATES)
        assert np.array_equal(f_v, f_paper)
        assert np.array_equal(m_v, m_paper)


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("omega", [NO_RATES, RATES], ids=["straight", "turning"])
@pytest.mark.parametrize("delta_r", [0.0, 0.5])
def test_forces_are_continuous_in_the_direction_of_the_flow(
    name: str, delta_r: float, omega: tuple[float, float, float]
) -> None:
    """A turn of the flow by 1e-6 rad, in any direction on the sphere, changes the forces by about 1e-6 of them."""
    vehicle = pack(load_vehicle(name), FULL)
    alpha, beta = _all_angles()
    rng = np.random.default_rng(5)
    step = 1e-6
    f_1, m_1, v_1 = _forces(vehicle, alpha, beta, delta_r, omega)
    aside = np.cross(v_1, rng.normal(size=v_1.shape))
    v_2 = v_1 + step * np.linalg.norm(v_1, axis=1, keepdims=True) * aside / np.linalg.norm(aside, axis=1, keepdims=True)
    alpha_2 = np.arctan2(v_2[:, 2], v_2[:, 0])
    beta_2 = np.arctan2(v_2[:, 1], np.hypot(v_2[:, 0], v_2[:, 2]))
    f_2, m_2, _ = _forces(vehicle, alpha_2, beta_2, delta_r, omega)
    # slopes: the blend of two curves over 15 degrees steepens them by at most 1.9 / 0.26 rad = 7, the angle of attack
    # itself by 1 / cos(beta), which stall in sideslip takes off; a jump would be a million times larger than a step
    for change, forces in ((f_2 - f_1, f_1), (m_2 - m_1, m_1)):
        largest = np.linalg.norm(forces, axis=1).max()
        assert np.linalg.norm(change, axis=1).max() < 30 * step * largest


@pytest.mark.parametrize("name", NAMES)
def test_drag_takes_energy_out_at_every_angle(name: str) -> None:
    f_v, _, v_r = _forces(pack(load_vehicle(name), FULL), *_all_angles())
    assert np.einsum("ni,ni->n", f_v, v_r).max() < 0.0


@pytest.mark.parametrize("name", NAMES)
def test_rotation_is_damped_at_every_angle(name: str) -> None:
    """Also when the flow comes from astern, as in a tail-slide."""
    vehicle = pack(load_vehicle(name), FULL)
    alpha, beta = _all_angles()
    _, at_rest, _ = _forces(vehicle, alpha, beta)
    rng = np.random.default_rng(11)
    for omega in [*np.eye(3), *rng.normal(size=(5, 3))]:
        _, turning, _ = _forces(vehicle, alpha, beta, 0.0, (float(omega[0]), float(omega[1]), float(omega[2])))
        power, size = (turning - at_rest) @ omega, np.linalg.norm(turning - at_rest, axis=1).max()
        assert power.max() <= 1e-13 * size  # rounding of the difference


@pytest.mark.parametrize("name", NAMES)
def test_at_rest_no_force_acts(name: str) -> None:
    zero = np.zeros(1)
    f_v, m_v, _ = _forces(pack(load_vehicle(name), FULL), zero, zero, 0.5, RATES, V=0.0)
    assert not f_v.any()
    assert not m_v.any()


def test_a_body_without_flow_along_b1_feels_its_side_as_a_plate() -> None:
    """In pure sideways flow the force is the broadside drag against the motion, whatever way it came to be so."""
    vehicle = pack(load_vehicle("zju"), FULL)
    alpha = np.linspace(-math.pi, math.pi, 33)
    for sign in (1.0, -1.0):
        f_v, _, _ = _forces(vehicle, alpha, np.full_like(alpha, sign * (0.5 * math.pi - 1e-7)), V=1.0)
        assert np.allclose(f_v, [0.0, -sign * vehicle.K_N, 0.0], rtol=0.0, atol=1e-3)


@pytest.mark.parametrize("pitch", [80.0, -80.0])
@pytest.mark.parametrize("V_b", [-2e-4, 2e-4])
@pytest.mark.parametrize("speed", [0.0, -0.4], ids=["from rest", "tail-slide"])
@pytest.mark.parametrize("sideways", [0.0, 0.05], ids=["in the plane", "sideways"])
def test_launches_and_tail_slides_integrate(pitch: float, V_b: float, speed: float, sideways: float) -> None:
    """300 s from a start far beyond stall, at a step that resolves the first swings (2 rad/s)."""
    glider = load_vehicle("zju")
    vehicle, water = pack(glider, FULL), reference_water(glider)
    Q = quaternion_from_euler(0.1 * sideways, math.radians(pitch), 0.3)
    actuation = Actuation()
    state = state_of(vehicle, (speed, sideways, 0.0), (0.0, 0.0, 0.0), (0.0, 0.0, 50.0), Q, 0.3, V_b, actuation, water)
    x = np.array([*state.X, *state.Q, *state.p, *state.h, state.r_px, state.p_px, state.V_b])
    rows = np.empty((300, STATE_SIZE))
    integrate(vehicle, x, actuation, water, False, 0.01, 30_000, rows)
    assert np.all(np.isfinite(rows))
    # the pull of the attitude back to unit length leaves the truncation error of a step
    assert np.abs(np.linalg.norm(rows[:, 3:7], axis=1) - 1.0).max() < 1e-9
    speed_of_fall = np.abs(np.diff(rows[:, 2], prepend=50.0)).max()
    assert speed_of_fall < 2.0  # m/s: 2 N of net weight cannot drive the vehicle faster than sqrt(2 N / K_D0)
