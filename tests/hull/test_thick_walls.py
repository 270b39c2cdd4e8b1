"""Oracles: the equations of elasticity solved numerically, and limits that textbooks give in closed form."""

import numpy as np
import pytest
from scipy.integrate import solve_bvp

from stommel.machinery.hull import end_caps
from stommel.machinery.hull.elasticity import (
    sphere_first_yield,
    tube_compressibility,
    tube_first_yield,
    tube_plastic_collapse,
)

E, NU = 1.06e11, 0.34


def closed_tube(D_i: float, D_o: float, p: float) -> tuple[float, float]:
    """Loss of volume per unit of pressure, and von Mises' stress inside, by solving for u(r) and the axial strain."""
    a, b = 0.5 * D_i, 0.5 * D_o
    lame, mu = E * NU / ((1 + NU) * (1 - 2 * NU)), E / (2 * (1 + NU))

    def stresses(r, u, u_r, e_z):  # type: ignore[no-untyped-def]
        trace = u_r + u / r + e_z
        return lame * trace + 2 * mu * u_r, lame * trace + 2 * mu * u / r, lame * trace + 2 * mu * e_z

    def slope(r, y, q):  # type: ignore[no-untyped-def]
        # u'' + u'/r - u/r^2 = 0; the axial force is integrated beside it
        axial = stresses(r, y[0], y[1], q[0])[2]
        return np.vstack([y[1], y[0] / r**2 - y[1] / r, 2 * np.pi * r * axial])

    def ends(y_a, y_b, q):  # type: ignore[no-untyped-def]
        return np.array(
            [
                stresses(a, y_a[0], y_a[1], q[0])[0] / p,
                stresses(b, y_b[0], y_b[1], q[0])[0] / p + 1.0,
                y_a[2],
                (y_b[2] + np.pi * b**2 * p) / p,
            ]
        )

    r = np.linspace(a, b, 60)
    guess = np.vstack([-1e-5 * r, np.full_like(r, -1e-5), np.zeros_like(r)])
    found = solve_bvp(slope, ends, r, guess, p=[-1e-5], tol=1e-8)
    assert found.success
    s_r, s_t, s_z = stresses(a, found.y[0][0], found.y[1][0], found.p[0])
    equivalent = np.sqrt(0.5 * ((s_r - s_t) ** 2 + (s_t - s_z) ** 2 + (s_z - s_r) ** 2))
    return -(2 * found.y[0][-1] / b + found.p[0]) / p, float(equivalent)


@pytest.mark.parametrize("D_i", [0.10, 0.18, 0.2116])
def test_against_the_boundary_value_problem(D_i: float) -> None:
    kappa, equivalent = closed_tube(D_i, 0.22, 2e6)
    assert tube_compressibility(D_i, 0.22, E, NU) == pytest.approx(kappa, rel=1e-5)
    assert tube_first_yield(D_i, 0.22, 824e6) == pytest.approx(824e6 / equivalent * 2e6, rel=1e-5)


def test_solid_bar_has_the_bulk_modulus() -> None:
    assert tube_compressibility(0.0, 0.22, E, NU) == pytest.approx(3 * (1 - 2 * NU) / E, rel=1e-14)
    assert tube_compressibility(1e-9, 0.22, E, NU) == pytest.approx(3 * (1 - 2 * NU) / E, rel=1e-12)


def test_thin_tube() -> None:
    """(5 - 4 nu) R / (2 E delta): hoop strain twice and axial strain once of the membrane."""
    wall = 1e-5
    thin = (5 - 4 * NU) * 0.11 / (2 * E * wall)
    assert tube_compressibility(0.22 - 2 * wall, 0.22, E, NU) == pytest.approx(thin, rel=1e-3)


def test_thin_walls_yield_as_membranes() -> None:
    sigma, wall, R = 824e6, 1e-6, 0.11
    assert tube_first_yield(2 * (R - wall), 2 * R, sigma) == pytest.approx(2 / 3**0.5 * sigma * wall / R, rel=1e-4)
    assert tube_plastic_collapse(2 * (R - wall), 2 * R, sigma) == pytest.approx(2 / 3**0.5 * sigma * wall / R, rel=1e-4)
    assert sphere_first_yield(R - wall, R, sigma) == pytest.approx(2 * sigma * wall / R, rel=1e-4)


def test_flat_caps_of_a_plate_solved_numerically() -> None:
    """Axisymmetric plate by collocation: largest bending stress 6 M / t^2, at the rim or at the centre."""
    P, a, t = 2e6, 0.11, 0.01
    D = E * t**3 / (12 * (1 - NU**2))

    def stress(clamped: bool) -> float:
        # slope phi(r) = -w': (1/r (r phi)')' = P r / (2 D) with the sign of a downward load
        def slope(r, y):  # type: ignore[no-untyped-def]
            return np.vstack([y[1], -P * r / (2 * D) - y[1] / r + y[0] / r**2])

        def moment(r, y):  # type: ignore[no-untyped-def]
            return D * (y[1] + NU * y[0] / r)

        def ends(y_0, y_a):  # type: ignore[no-untyped-def]
            return np.array([y_0[0] - y_0[1] * 1e-5, y_a[0] if clamped else moment(a, y_a)])

        r = np.linspace(1e-5, a, 400)
        found = solve_bvp(slope, ends, r, np.zeros((2, len(r))), tol=1e-9, max_nodes=20000)
        assert found.success
        return float(6 * np.abs(moment(found.x, found.y)).max() / t**2)

    assert end_caps.flat_wall_clamped(P, a, stress(True)) == pytest.approx(t, rel=1e-4)
    assert end_caps.flat_wall_supported(P, a, stress(False), NU) == pytest.approx(t, rel=1e-4)


def test_hemisphere_meets_both_of_its_criteria() -> None:
    P, R_o = 60e6, 0.11
    strength = end_caps.hemisphere_wall(P, R_o, 298.3e6, E, 2.0)
    assert sphere_first_yield(R_o - strength, R_o, 298.3e6) == pytest.approx(P, rel=1e-12)
    thin = end_caps.hemisphere_wall(1e5, R_o, 298.3e6, E, 2.0)
    assert end_caps.machined_sphere(thin, R_o, E) == pytest.approx(2e5, rel=1e-12)
    assert end_caps.hemisphere_wall(300e6, R_o, 298.3e6, E, 2.0) == float("inf")


def test_machined_spheres_keep_0_7_of_zoelly() -> None:
    """Krenzke and Kiernan's constant is 0.7 of the classical one at nu = 0.3."""
    ratio = end_caps.machined_sphere(1e-3, 0.1, E) / end_caps.zoelly(1e-3, 0.1, E, 0.3)
    assert ratio == pytest.approx(0.7, abs=0.01)
