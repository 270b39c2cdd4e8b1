"""Exact derivatives by a complex step through the equations of motion.

Oracle: central differences of the same equations in real arithmetic; closed forms for the elementary functions.
"""

import math
from collections.abc import Callable

import numba
import numpy as np
import pytest
from numpy.typing import NDArray

from stommel.dynamics.acceleration import state_of
from stommel.dynamics.equations import derivative
from stommel.dynamics.packing import pack
from stommel.dynamics.state import STATE_SIZE, Actuation
from stommel.geometry.attitude import quaternion_from_euler
from stommel.geometry.elementary import asin, atan2, real_part, sqrt
from stommel.seawater.water import Water
from stommel.vehicle import FULL, PAPER, Physics, load_vehicle

Array = NDArray[np.float64]

COMPLEX_STEP = 1e-40


@numba.njit
def _sqrt(x):  # type: ignore[no-untyped-def]  # real or complex
    return sqrt(x)


@numba.njit
def _atan2(y, x):  # type: ignore[no-untyped-def]  # real or complex
    return atan2(y, x)


@numba.njit
def _asin(x):  # type: ignore[no-untyped-def]  # real or complex
    return asin(x)


@numba.njit
def _real_part(x):  # type: ignore[no-untyped-def]  # real or complex
    return real_part(x)


def _slope(f: Callable[[complex], complex], x: float) -> float:
    return f(complex(x, COMPLEX_STEP)).imag / COMPLEX_STEP


@pytest.mark.parametrize("x", [1e-12, 0.3, 2.0, 1e9])
def test_square_root(x: float) -> None:
    assert _sqrt(x) == math.sqrt(x) == _sqrt(complex(x, COMPLEX_STEP)).real
    assert math.isclose(_slope(_sqrt, x), 0.5 / math.sqrt(x), rel_tol=1e-15)


@pytest.mark.parametrize("x", [-0.999, -0.5, 0.0, 1e-9, 0.7])
def test_arcsine(x: float) -> None:
    assert _asin(x) == math.asin(x) == _asin(complex(x, COMPLEX_STEP)).real
    assert math.isclose(_slope(_asin, x), 1.0 / math.sqrt(1.0 - x * x), rel_tol=1e-15)


@pytest.mark.parametrize("angle", np.radians([-179.0, -90.0, -30.0, 0.0, 45.0, 90.0, 135.0, 180.0]))
@pytest.mark.parametrize("radius", [1e-9, 0.4, 1e6])
def test_arctangent(angle: float, radius: float) -> None:
    y, x = radius * math.sin(angle), radius * math.cos(angle)
    assert _atan2(y, x) == math.atan2(y, x) == _atan2(complex(y, COMPLEX_STEP), complex(x, 0.0)).real
    slope_y, slope_x = math.cos(angle) / radius, -math.sin(angle) / radius
    tolerance = 1e-15 / radius
    assert math.isclose(_slope(lambda z: _atan2(z, complex(x, 0.0)), y), slope_y, rel_tol=0.0, abs_tol=tolerance)
    assert math.isclose(_slope(lambda z: _atan2(complex(y, 0.0), z), x), slope_x, rel_tol=0.0, abs_tol=tolerance)
    # one argument real
    assert math.isclose(_slope(lambda z: _atan2(z, x), y), slope_y, rel_tol=0.0, abs_tol=tolerance)
    assert math.isclose(_slope(lambda z: _atan2(y, z), x), slope_x, rel_tol=0.0, abs_tol=tolerance)


def test_real_part() -> None:
    assert _real_part(-1.5) == -1.5
    assert _real_part(complex(-1.5, COMPLEX_STEP)) == -1.5


def _random_state(rng: np.random.Generator, vehicle: np.record, actuation: Actuation, water: Water) -> Array:
    """Any attitude, any direction of the flow."""
    a = rng.uniform(-1, 1, 9)
    Q = quaternion_from_euler(math.pi * a[0], 1.5 * a[1], math.pi * a[2])
    v, omega = (0.5 * a[3], 0.5 * a[4], 0.5 * a[5]), (0.3 * a[6], 0.3 * a[7], 0.3 * a[8])
    x = state_of(vehicle, v, omega, (1.0, 2.0, 30.0), Q, rng.uniform(0, 0.5), 1e-4, actuation, water)
    return np.array([*x.X, *x.Q, *x.p, *x.h, x.r_px, x.p_px, x.V_b])


@pytest.mark.parametrize("name", ["zju", "seawing"])
@pytest.mark.parametrize("physics", [PAPER, FULL], ids=["paper", "full"])
@pytest.mark.parametrize("free", [True, False], ids=["free", "driven"])
def test_jacobian_of_the_equations_of_motion(name: str, physics: Physics, free: bool) -> None:
    rng = np.random.default_rng(8)
    vehicle = pack(load_vehicle(name), physics)
    water = Water(1025.0, 2e5, 12.0, (0.2, -0.1, 0.05), (0.01, 0.0, -0.02))
    scale = np.array([1, 1, 1, 1, 1, 1, 1, 50, 50, 50, 5, 5, 5, 0.3, 5, 2e-4], dtype=float)
    for _ in range(50):
        actuation = Actuation(
            rng.uniform(-0.05, 0.05), rng.uniform(-20, 20), 1e-5, rng.uniform(-0.5, 0.5), rng.uniform(-1, 1), 0.1
        )
        x = _random_state(rng, vehicle, actuation, water)
        exact, differences = np.empty((STATE_SIZE, STATE_SIZE)), np.empty((STATE_SIZE, STATE_SIZE))
        for j in range(STATE_SIZE):
            z, z_dot = x.astype(complex), np.empty(STATE_SIZE, dtype=complex)
            z[j] += 1j * COMPLEX_STEP
            derivative(vehicle, z, actuation, water, free, z_dot)
            exact[:, j] = z_dot.imag / COMPLEX_STEP
            differences[:, j] = _central_difference(vehicle, x, j, 1e-4 * scale[j], actuation, water, free)
        # columns in units of the state; fourth-order differences leave about 1e-9, a wrong term far more
        for j in range(STATE_SIZE):
            size = np.linalg.norm(exact[:, j]) + np.linalg.norm(exact * scale) / scale[j] * 1e-3
            assert np.linalg.norm(exact[:, j] - differences[:, j]) < 1e-6 * size


def _central_difference(
    vehicle: np.record, x: Array, j: int, step: float, actuation: Actuation, water: Water, free: bool
) -> Array:
    """Five points, error of fourth order."""
    total, out = np.zeros(STATE_SIZE), np.empty(STATE_SIZE)
    for places, weight in ((-2, 1.0), (-1, -8.0), (1, 8.0), (2, -1.0)):
        moved = x.copy()
        moved[j] += places * step
        derivative(vehicle, moved, actuation, water, free, out)
        total += weight * out
    return total / (12.0 * step)


@pytest.mark.parametrize("free", [True, False], ids=["free", "driven"])
def test_complex_arithmetic_without_a_step_gives_the_real_rates(free: bool) -> None:
    rng = np.random.default_rng(9)
    vehicle, water, actuation = (
        pack(load_vehicle("zju"), FULL),
        Water(1025.0, 0.0, 15.0),
        Actuation(0.01, 5.0, 1e-5, 0.2),
    )
    for _ in range(50):
        x = _random_state(rng, vehicle, actuation, water)
        real, with_zero = np.empty(STATE_SIZE), np.empty(STATE_SIZE, dtype=complex)
        derivative(vehicle, x, actuation, water, free, real)
        derivative(vehicle, x.astype(complex), actuation, water, free, with_zero)
        assert np.all(with_zero.imag == 0.0)
        # complex sums are fused differently from real ones
        assert np.allclose(with_zero.real, real, rtol=1e-12, atol=1e-12 * np.abs(real).max())
