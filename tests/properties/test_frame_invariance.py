"""Symmetries of the equations of motion.

Oracle: Galilei (a uniform steady current carries the glider along and does nothing else), homogeneity and isotropy of
the horizontal plane, port and starboard, up and down.
"""

import math
from collections.abc import Sequence

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from stommel.analysis.wings_level import trim_into
from stommel.dynamics.acceleration import Accelerations, accelerations, state_of, velocities_of
from stommel.dynamics.integration import integrate
from stommel.dynamics.packing import pack, reference_water
from stommel.dynamics.parameters import VEHICLE_RECORD, parameter_record
from stommel.dynamics.state import STATE_SIZE, Actuation, State
from stommel.seawater.water import Water
from stommel.vehicle import FULL, PAPER, Physics, load_vehicle

Array = NDArray[np.float64]
Vector = tuple[float, float, float]
Quaternion = tuple[float, float, float, float]

ZJU = load_vehicle("zju")
STILL = Water(1026.0, 2e5, 12.0)
MODES = pytest.mark.parametrize("free", [True, False], ids=["free", "driven"])


def _changed(vehicle: np.record, **values: object) -> np.record:
    """`vehicle` with some fields of its record replaced."""
    return parameter_record(**({name: vehicle[name] for name in VEHICLE_RECORD.names or ()} | values))


def _skewed() -> np.record:
    """ZJU in full physics with a heavy mass off the axis and added inertia that couples all motions."""
    zju = pack(ZJU, FULL)
    coupling = np.array([0.0, 0.3, -0.2, 0.4, 0.1, 1.0, 0.2, -0.8, 0.0])
    off_diagonal = np.array([0.0, 0.0, 0.0, 1.0, -0.7, 2.0])
    return _changed(
        zju,
        R_p=0.03,
        J_p=np.array([0.05, 0.2, 0.21, 0.01, -0.02, 0.005]),
        M_0=zju["M_0"] + off_diagonal,
        M_f=zju["M_f"] + off_diagonal,
        C_0=zju["C_0"] + coupling,
        C_f=zju["C_f"] + coupling,
        Y_r=1.5,
        Z_q=-2.0,
        D_omega_V=np.array([-1.0, -2.0, -3.0]),
    )


SKEWED = _skewed()

# ---------------------------------------------------------------- motions to start from


def _numbers(limit: float, count: int) -> st.SearchStrategy[Sequence[float]]:
    return st.tuples(*[st.floats(-limit, limit) for _ in range(count)])


ATTITUDES = _numbers(1.0, 4).filter(lambda Q: math.hypot(*Q) > 0.1).map(lambda Q: tuple(e / math.hypot(*Q) for e in Q))
# forwards: in the paper's physics the angle of attack, and with it the lift, jumps where the flow comes from astern
SPEEDS = st.tuples(st.floats(0.05, 0.6), st.floats(-0.6, 0.6), st.floats(-0.6, 0.6))
RATES = _numbers(0.5, 3)
CURRENTS = _numbers(1.0, 3)
ACTUATIONS = st.builds(
    Actuation,
    r_px_dot=st.floats(-0.05, 0.05),
    u_px=st.floats(-20, 20),
    u_b=st.floats(-1e-5, 1e-5),
    delta_r=st.floats(-1, 1),
    mu=st.floats(-3, 3),
    mu_dot=st.just(0.0),
)


def _rotation(Q: Quaternion) -> Array:
    """R_IB by Rodrigues."""
    e = np.array(Q[1:])
    cross = np.array([[0, -e[2], e[1]], [e[2], 0, -e[0]], [-e[1], e[0], 0]])
    R: Array = np.eye(3) + 2 * Q[0] * cross + 2 * cross @ cross
    return R


def _vector(a: Sequence[float] | Array) -> Vector:
    return float(a[0]), float(a[1]), float(a[2])


def _flat(state: State) -> Array:
    return np.array([*state.X, *state.Q, *state.p, *state.h, state.r_px, state.p_px, state.V_b])


def _state(x: Array) -> State:
    e = [float(value) for value in x]
    return State(
        (e[0], e[1], e[2]), (e[3], e[4], e[5], e[6]), (e[7], e[8], e[9]), (e[10], e[11], e[12]), e[13], e[14], e[15]
    )


def _start(
    vehicle: np.record,
    v_r: Vector,
    omega: Vector,
    Q: Quaternion,
    actuation: Actuation,
    water: Water,
    V_b: float = -2e-4,
) -> State:
    """State with the velocity `v_r` relative to the water."""
    v = np.array(v_r) + _rotation(Q).T @ np.array(water.U)
    return state_of(vehicle, _vector(v), omega, (0.0, 0.0, 30.0), Q, 0.3, V_b, actuation, water)


def _fly(vehicle: np.record, start: State, actuation: Actuation, water: Water, free: bool, seconds: float) -> Array:
    """Ten states at equal intervals."""
    step = 0.005
    rows = np.empty((10, STATE_SIZE))
    integrate(vehicle, _flat(start), actuation, water, free, step, round(seconds / step), rows)
    return rows


# ---------------------------------------------------------------- current


@MODES
@settings(max_examples=200, deadline=None, derandomize=True)
@given(v_r=SPEEDS, omega=RATES, Q=ATTITUDES, U=CURRENTS, actuation=ACTUATIONS)
def test_a_current_changes_no_acceleration(
    free: bool, v_r: Vector, omega: Vector, Q: Quaternion, U: Vector, actuation: Actuation
) -> None:
    current = STILL._replace(U=U)
    still, carried = (
        accelerations(SKEWED, _start(SKEWED, v_r, omega, Q, actuation, water), actuation, water, free)
        for water in (STILL, current)
    )
    U_B = _rotation(Q).T @ np.array(U)
    expected = np.array([*(np.array(still.v_dot) - np.cross(omega, U_B)), *still.omega_dot, still.r_px_ddot])
    found = np.array([*carried.v_dot, *carried.omega_dot, carried.r_px_ddot])
    # momenta of some 200 kg m/s at 1 m/s through an inertia of condition 1e3
    assert np.linalg.norm(found - expected) < 1e-11 * (1.0 + np.linalg.norm(expected))
    assert np.allclose(carried.X_dot, np.array(still.X_dot) + U, rtol=0.0, atol=1e-13)


@settings(max_examples=10, deadline=None, derandomize=True)
@given(v_r=SPEEDS, omega=RATES, Q=ATTITUDES, U=CURRENTS, delta_r=st.floats(-0.5, 0.5))
def test_a_current_carries_the_trajectory_along(
    v_r: Vector, omega: Vector, Q: Quaternion, U: Vector, delta_r: float
) -> None:
    """A minute of flight. The state holds absolute momenta, so that truncation errors differ: about 1e-8 at 5 ms."""
    actuation, current = Actuation(delta_r=delta_r), STILL._replace(U=U)
    still, carried = (
        _fly(SKEWED, _start(SKEWED, v_r, omega, Q, actuation, water), actuation, water, False, 60.0)
        for water in (STILL, current)
    )
    t = np.linspace(6.0, 60.0, 10)
    assert np.allclose(carried[:, :3] - t[:, None] * U, still[:, :3], rtol=0.0, atol=1e-6)
    assert np.allclose(carried[:, 3:7], still[:, 3:7], rtol=0.0, atol=1e-6)
    for a, b in zip(still, carried, strict=True):
        eta_a = velocities_of(SKEWED, _state(a), actuation, STILL, False)
        eta_b = velocities_of(SKEWED, _state(b), actuation, current, False)
        assert np.allclose([*eta_a.v_r, *eta_a.omega], [*eta_b.v_r, *eta_b.omega], rtol=0.0, atol=1e-6)


# ---------------------------------------------------------------- place and heading


def _turned(Q: Quaternion, psi: float) -> tuple[Array, Quaternion]:
    """The turn by `psi` to starboard about the vertical, and the attitude `Q` after it."""
    c, s = math.cos(psi), math.sin(psi)
    turn = np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])
    a, b = math.cos(0.5 * psi), math.sin(0.5 * psi)
    turned_Q = (a * Q[0] - b * Q[3], a * Q[1] - b * Q[2], a * Q[2] + b * Q[1], a * Q[3] + b * Q[0])
    return turn, turned_Q


@MODES
@settings(max_examples=25, deadline=None, derandomize=True)
@given(v_r=SPEEDS, omega=RATES, Q=ATTITUDES, psi=st.floats(-math.pi, math.pi), actuation=ACTUATIONS)
def test_turned_and_shifted_starts_fly_turned_and_shifted_trajectories(
    free: bool, v_r: Vector, omega: Vector, Q: Quaternion, psi: float, actuation: Actuation
) -> None:
    turn, turned_Q = _turned(Q, psi)
    shift = np.array([1000.0, -300.0, 7.0])

    start = _start(SKEWED, v_r, omega, Q, actuation, STILL)
    moved = _start(SKEWED, v_r, omega, turned_Q, actuation, STILL)
    moved = moved._replace(X=_vector(turn @ np.array(start.X) + shift))
    rows = _fly(SKEWED, start, actuation, STILL, free, 5.0)
    rows_moved = _fly(SKEWED, moved, actuation, STILL, free, 5.0)
    # every operation is the same up to the turn: rounding of a position of 1 km, and 5 s of tumbling
    assert np.allclose(rows_moved[:, :3], rows[:, :3] @ turn.T + shift, rtol=0.0, atol=1e-9)
    assert np.allclose(rows_moved[:, 7:], rows[:, 7:], rtol=1e-9, atol=1e-9)


@MODES
@settings(max_examples=200, deadline=None, derandomize=True)
@given(v_r=SPEEDS, omega=RATES, Q=ATTITUDES, U=CURRENTS, psi=st.floats(-math.pi, math.pi), actuation=ACTUATIONS)
def test_a_turned_current_turns_the_motion(
    free: bool, v_r: Vector, omega: Vector, Q: Quaternion, U: Vector, psi: float, actuation: Actuation
) -> None:
    turn, turned_Q = _turned(Q, psi)
    here, there = STILL._replace(U=U, DU_Dt=U), STILL._replace(U=_vector(turn @ U), DU_Dt=_vector(turn @ U))
    found = accelerations(SKEWED, _start(SKEWED, v_r, omega, Q, actuation, here), actuation, here, free)
    turned = accelerations(SKEWED, _start(SKEWED, v_r, omega, turned_Q, actuation, there), actuation, there, free)
    body = np.array([*found.v_dot, *found.omega_dot, found.r_px_ddot])
    # momenta of some 200 kg m/s at 1 m/s through an inertia of condition 1e3
    difference = np.array([*turned.v_dot, *turned.omega_dot, turned.r_px_ddot]) - body
    assert np.linalg.norm(difference) < 1e-11 * (1.0 + np.linalg.norm(body))
    assert np.allclose(turned.X_dot, turn @ found.X_dot, rtol=0.0, atol=1e-12)


# ---------------------------------------------------------------- port and starboard


@MODES
@pytest.mark.parametrize("physics", [PAPER, FULL], ids=["paper", "full"])
@settings(max_examples=100, deadline=None, derandomize=True)
@given(v_r=SPEEDS, omega=RATES, Q=ATTITUDES, U=CURRENTS, actuation=ACTUATIONS)
def test_port_mirrors_starboard(
    physics: Physics, free: bool, v_r: Vector, omega: Vector, Q: Quaternion, U: Vector, actuation: Actuation
) -> None:
    vehicle = _changed(
        pack(ZJU, physics),
        R_p=0.05,
        J_p=np.array([0.05, 0.2, 0.21, 0.0, -0.02, 0.0]),
        Y_r=1.5,
    )
    # reflection of the plane b1-b3 and of north-down: what is a rotation changes the sign of its parts in the plane
    polar, axial = np.array([1.0, -1.0, 1.0]), np.array([-1.0, 1.0, -1.0])
    mirrored_Q = (Q[0], -Q[1], Q[2], -Q[3])
    mirrored_actuation = actuation._replace(delta_r=-actuation.delta_r, mu=-actuation.mu)
    water, mirrored_water = STILL._replace(U=U), STILL._replace(U=_vector(polar * U))

    found = accelerations(vehicle, _start(vehicle, v_r, omega, Q, actuation, water), actuation, water, free)
    mirrored = accelerations(
        vehicle,
        _start(vehicle, _vector(polar * v_r), _vector(axial * omega), mirrored_Q, mirrored_actuation, mirrored_water),
        mirrored_actuation,
        mirrored_water,
        free,
    )
    _assert_mirrored(found, mirrored, polar, axial)


def _assert_mirrored(found: Accelerations, mirrored: Accelerations, polar: Array, axial: Array) -> None:
    size = 1.0 + np.linalg.norm([*found.v_dot, *found.omega_dot])
    # mirrored operands give mirrored results; compiled sums may be fused differently
    assert np.allclose(mirrored.v_dot, polar * found.v_dot, rtol=0.0, atol=1e-13 * size)
    assert np.allclose(mirrored.omega_dot, axial * found.omega_dot, rtol=0.0, atol=1e-13 * size)
    assert np.allclose(mirrored.X_dot, polar * found.X_dot, rtol=0.0, atol=1e-13 * size)
    assert math.isclose(mirrored.r_px_ddot, found.r_px_ddot, abs_tol=1e-13 * size)


# ---------------------------------------------------------------- up and down


@MODES
@settings(max_examples=100, deadline=None, derandomize=True)
@given(v_r=SPEEDS, omega=RATES, Q=ATTITUDES, V_b=st.floats(-3e-4, 3e-4), u_px=st.floats(-20, 20))
def test_up_mirrors_down_when_gravity_and_masses_are_mirrored(
    free: bool, v_r: Vector, omega: Vector, Q: Quaternion, V_b: float, u_px: float
) -> None:
    """The centre of mass below the axis goes above it, gravity upwards, and the fin's roll moments change sign."""
    vehicle = pack(ZJU, PAPER)
    z = np.array([1.0, 1.0, -1.0])
    mirrored_vehicle = _changed(
        vehicle,
        g=-vehicle["g"],
        s_0=z * vehicle["s_0"],
        # static moments as products a^: entries with z among (x, y, z) of the moment change sign
        C_0=vehicle["C_0"] * np.array([1, -1, 1, -1, 1, 1, 1, 1, 1]),
        J_0=vehicle["J_0"] * np.array([1, 1, 1, 1, -1, -1]),
        K_beta=-vehicle["K_beta"],
        K_delta=-vehicle["K_delta"],
    )
    polar, axial = z, -z
    mirrored_Q = (Q[0], -Q[1], -Q[2], Q[3])
    water, actuation = reference_water(ZJU), Actuation(u_px=u_px, delta_r=0.3)
    found = accelerations(vehicle, _start(vehicle, v_r, omega, Q, actuation, water, V_b), actuation, water, free)
    mirrored = accelerations(
        mirrored_vehicle,
        _start(mirrored_vehicle, _vector(polar * v_r), _vector(axial * omega), mirrored_Q, actuation, water, V_b),
        actuation,
        water,
        free,
    )
    _assert_mirrored(found, mirrored, polar, axial)


@settings(max_examples=100, deadline=None, derandomize=True)
@given(speed=st.floats(0.1, 1.0), pitch=st.floats(10, 65))
def test_climbs_mirror_dives(speed: float, pitch: float) -> None:
    """Wings level, in the paper's physics: angle of attack, ballast and shift of the moving mass change sign."""
    vehicle, water = pack(ZJU, PAPER), reference_water(ZJU)
    dive, climb = np.empty(10), np.empty(10)
    assert trim_into(vehicle, speed, -math.radians(pitch), False, water, dive) == 0
    assert trim_into(vehicle, speed, math.radians(pitch), False, water, climb) == 0
    neutral = -vehicle["s_0"][0] / vehicle["m_p"]
    V, alpha, theta, r_px, V_b = 0, 1, 4, 6, 7  # stommel.analysis.steady_equations
    # Newton stops at a residual of 1e-11 N out of newtons
    assert math.isclose(climb[V], dive[V], rel_tol=1e-14)
    assert math.isclose(climb[alpha], -dive[alpha], rel_tol=1e-10)
    assert math.isclose(climb[theta], -dive[theta], rel_tol=1e-14)
    assert math.isclose(climb[r_px] - neutral, neutral - dive[r_px], rel_tol=1e-10)
    assert math.isclose(climb[V_b], -dive[V_b], rel_tol=1e-10)
