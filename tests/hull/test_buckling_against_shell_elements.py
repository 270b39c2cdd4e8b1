"""Oracle: finite elements of Sanders and Koiter's shell theory (shell_elements.py), checked here against closed forms.

No published worked example of a tube like these could be had in full text; the reference is therefore computed in the
test, from an energy that the formulas under test do not use.
"""

import numpy as np
import pytest

from stommel.machinery.hull import find_material, load_materials
from stommel.machinery.hull.buckling import (
    RingSection,
    bryant,
    critical_length,
    long_tube,
    ring_inertia,
    von_mises,
    windenburg_trilling,
)
from stommel.machinery.hull.paper_formulas import circumferential_pressure
from tests.hull.shell_elements import Cylinder, bifurcation_pressure

WALLS_MM = {"12Cr1MoV": 3.3, "LY12": 5.2, "TC4": 4.2, "6061-T6": 5.0}


def test_elements_know_the_ring() -> None:
    """A very long tube under lateral pressure is a ring: 3 D / R^3, two lobes (Timoshenko and Gere 1961, Art. 7.3)."""
    pressure, lobes = bifurcation_pressure(Cylinder(1.06e5, 0.3, 107.9, 4.2, 1e5, hydrostatic=False), elements=40)
    assert lobes == 2
    assert pressure == pytest.approx(3 * 1.06e5 * 4.2**3 / (12 * 0.91) / 107.9**3, rel=5e-4)


def test_elements_have_converged() -> None:
    tube = Cylinder(1.06e5, 0.34, 107.9, 4.2, 750.0)
    assert bifurcation_pressure(tube, 12)[0] == pytest.approx(bifurcation_pressure(tube, 36)[0], rel=1e-5)


@pytest.mark.parametrize("length_mm", [200.0, 375.0, 750.0, 1500.0])
@pytest.mark.parametrize("name", WALLS_MM)
def test_von_mises_within_1_percent(name: str, length_mm: float) -> None:
    """The bar is 2 % for the chosen tube (TC4, 4.2 mm, 750 mm); 1 % holds for every one of these."""
    material, wall = find_material(name, load_materials()), WALLS_MM[name]
    radius = 0.5 * (220.0 - wall)
    exact, lobes = bifurcation_pressure(Cylinder(material.E / 1e6, material.nu, radius, wall, length_mm))
    found = von_mises(wall / 1e3, radius / 1e3, length_mm / 1e3, material.E, material.nu)
    assert found.pressure / 1e6 == pytest.approx(exact, rel=0.01)
    assert found.n == lobes


def test_the_chosen_tube() -> None:
    """5.1 MPa with two lobes, where Eq. (9) gives 4.1 MPa."""
    found = von_mises(4.2e-3, 0.1079, 0.75, 1.06e11, 0.34)
    assert found.n == 2
    assert found.pressure / 1e6 == pytest.approx(5.1, abs=0.05)
    assert circumferential_pressure(4.2e-3, 0.22, 0.75, 1.06e11) / 1e6 == pytest.approx(4.06, abs=0.005)


def test_fixed_ends_only_help() -> None:
    tube = (1.06e5, 0.34, 107.9, 4.2, 750.0)
    assert bifurcation_pressure(Cylinder(*tube, ends="clamped"))[0] > bifurcation_pressure(Cylinder(*tube))[0]


@pytest.mark.parametrize(
    ("length_mm", "windenburg", "eq_9"),
    [
        (375.0, 1.01, 0.92),
        (500.0, 1.05, 0.97),
        (750.0, 0.86, 0.80),
        (900.0, 1.05, 0.98),
        (1000.0, 1.12, 1.05),
        (1200.0, 1.15, 1.08),
        (1400.0, 1.11, 1.04),
        (1600.0, 1.03, 0.97),
        (1800.0, 0.95, 0.89),
    ],
)
def test_fits_lie_on_both_sides_of_the_elements(length_mm: float, windenburg: float, eq_9: float) -> None:
    """Neither formula is on the safe side within its own limits: the shares that theory/hull.md states."""
    exact, _ = bifurcation_pressure(Cylinder(1.06e5, 0.34, 107.9, 4.2, length_mm))
    assert length_mm / 1e3 < critical_length(4.2e-3, 0.22)
    fit = windenburg_trilling(4.2e-3, 0.1079, length_mm / 1e3, 1.06e11, 0.34) / 1e6
    assert fit / exact == pytest.approx(windenburg, abs=0.006)
    assert circumferential_pressure(4.2e-3, 0.22, length_mm / 1e3, 1.06e11) / 1e6 / exact == pytest.approx(
        eq_9, abs=0.006
    )


@pytest.mark.parametrize("nu", [0.2, 0.3, 0.34])
@pytest.mark.parametrize("wall", [1e-3, 2e-3, 4.2e-3, 8e-3])
def test_how_far_the_fits_lie_above_the_lobes(wall: float, nu: float) -> None:
    """Oracle: von Mises's formula, within 1 % of the elements; lengths from 0.4 diameters to the stated limit."""
    lengths = np.linspace(0.088, critical_length(wall, 0.22), 300)
    lobes = [von_mises(wall, 0.11 - wall / 2, L, 1e11, nu).pressure for L in lengths]
    fits = [windenburg_trilling(wall, 0.11 - wall / 2, L, 1e11, nu) for L in lengths]
    shares = np.array(fits) / np.array(lobes)
    assert 0.84 < shares.min() < 0.87
    assert 1.13 < shares.max() < 1.16
    assert 0.6 < np.mean(shares > 1.0) < 0.7  # above the lobes over about two thirds of the lengths
    paper = np.array([circumferential_pressure(wall, 0.22, L, 1e11) for L in lengths]) / np.array(lobes)
    assert paper.max() < 1.19
    assert paper.max() > 1.03


@pytest.mark.parametrize(("count", "height", "width"), [(3, 8.0, 4.0), (5, 10.0, 4.0), (9, 6.0, 3.0), (5, 20.0, 5.0)])
def test_rings_are_safe_and_near(count: int, height: float, width: float) -> None:
    """The lower of Bryant (all together) and von Mises (between rings) lies at most 18 % below the elements."""
    E, nu, R, wall, L = 1.06e5, 0.34, 107.9, 2.0, 750.0
    tube = Cylinder(E, nu, R, wall, L, rings=count, ring_height=height, ring_width=width)
    exact, _ = bifurcation_pressure(tube, elements=10 * (count + 1), lobes=range(2, 8))
    spacing = L / (count + 1) / 1e3
    whole = bryant(wall / 1e3, R / 1e3, L / 1e3, RingSection(spacing, height / 1e3, width / 1e3), E * 1e6)
    between = von_mises(wall / 1e3, R / 1e3, spacing, E * 1e6, nu)
    assert 0.82 < min(whole.pressure, between.pressure) / 1e6 / exact < 1.01


def test_bryant_of_a_long_tube_is_the_ring() -> None:
    """3 EI / (R^3 L_f), two lobes."""
    ring = RingSection(0.1, 0.01, 0.004)
    EI = 1.06e11 * ring_inertia(2e-3, 0.1, ring)
    found = bryant(2e-3, 0.1, 1e4, ring, 1.06e11)
    assert found.n == 2
    assert found.pressure == pytest.approx(3 * EI / (0.1**3 * 0.1), rel=1e-6)


def test_von_mises_of_a_long_tube_is_bresse() -> None:
    found = von_mises(4e-3, 0.1, 1e4, 1.06e11, 0.3)
    assert found.pressure == pytest.approx(long_tube(4e-3, 0.1, 1.06e11, 0.3), rel=1e-6)


def test_critical_length_is_where_eq_9_meets_the_long_tube() -> None:
    """1.17 D sqrt(D / delta) is where 2.59 E (delta / D)^2.5 D / L falls to 2.2 E (delta / D)^3."""
    D, wall, E = 0.22, 2.2e-3, 2e11
    at = circumferential_pressure(wall, D, critical_length(wall, D), E)
    assert at == pytest.approx(2.2 * E * (wall / D) ** 3, rel=0.01)
