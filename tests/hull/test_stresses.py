"""What criteria and stresses of a sized hull say; oracles: balance of forces, Lame's solution, the file's factors."""

from dataclasses import replace
from math import pi, sqrt

import pytest

from stommel.design.hull.requirement import Requirement, requirement
from stommel.design.hull.sizing import SizedHull, size
from stommel.machinery.hull import find_material, load_materials
from stommel.machinery.hull.buckling import RingSection, ring_inertia
from stommel.vehicle import load_vehicle

NEED = requirement(load_vehicle("zju"))
TITANIUM = find_material("TC4", load_materials())
WALL = 6e-3


def sized(need: Requirement = NEED) -> SizedHull:
    return size(TITANIUM, need, WALL)


def permissible(found: SizedHull, name: str) -> float:
    (criterion,) = (one for one in found.criteria if name in one.name)
    return criterion.permissible


def lame(D_i: float, D_o: float, p: float) -> float:
    """Von Mises' stress inside a closed tube under outer pressure, from Lame's constants A and B: A +- B / r2."""
    a, b = 0.5 * D_i, 0.5 * D_o
    A, B = -p * b**2 / (b**2 - a**2), -p * a**2 * b**2 / (b**2 - a**2)
    radial, hoop, axial = A - B / a**2, A + B / a**2, -p * b**2 / (b**2 - a**2)
    return sqrt(0.5 * ((radial - hoop) ** 2 + (hoop - axial) ** 2 + (axial - radial) ** 2))


@pytest.mark.parametrize(("n_y", "n_t"), [(2.0, 3.0), (1.25, 1.6), (3.0, 2.0)])
def test_at_lame_s_permissible_pressure_the_bore_bears_the_permissible_stress(n_y: float, n_t: float) -> None:
    """The lesser of yield over one factor and strength over the other."""
    found = sized(replace(NEED, n_y=n_y, n_t=n_t))
    p = TITANIUM.properties
    assert p.yield_stress_mpa is not None
    assert p.tensile_stress_mpa is not None
    allowed = 1e6 * min(p.yield_stress_mpa / n_y, p.tensile_stress_mpa / n_t)
    pressure = permissible(found, "Lame")
    assert lame(NEED.D_o - 2.0 * WALL, NEED.D_o, pressure) == pytest.approx(allowed, rel=1e-9)
    failing = next(one.pressure for one in found.criteria if "Lame" in one.name)
    assert lame(NEED.D_o - 2.0 * WALL, NEED.D_o, failing) == pytest.approx(1e6 * p.yield_stress_mpa, rel=1e-9)


@pytest.mark.parametrize("share", [1.0, 0.7])
def test_a_weld_bears_its_share_in_every_strength_criterion(share: float) -> None:
    whole, welded = sized(), sized(replace(NEED, phi_s=share))
    for name in ("Lame", "whole wall yields"):
        assert permissible(welded, name) == pytest.approx(share * permissible(whole, name), rel=1e-12)


def test_the_wall_s_allowance_bears_nothing() -> None:
    """One millimetre that may rust away: as the bore of a wall so much thinner."""
    found = sized(replace(NEED, C=1e-3))
    allowed = found.sigma
    assert lame(NEED.D_o - 2.0 * (WALL - 1e-3), NEED.D_o, permissible(found, "Lame")) == pytest.approx(allowed)


@pytest.mark.parametrize("pressure", [2e6, 5e6])
def test_axial_stress_carries_the_ends(pressure: float) -> None:
    """Stress times the wall's section at its middle is the sea's pressure on the end."""
    found = sized(replace(NEED, P=pressure))
    section = 2.0 * pi * 0.5 * (NEED.D_o - WALL) * WALL
    end = pressure * pi / 4.0 * NEED.D_o**2
    assert found.as_row()["axial_stress_mpa"] * 1e6 * section == pytest.approx(end, rel=1e-12)


def test_axial_wall_is_where_that_stress_is_critical() -> None:
    """Eq. (10) with its factor, for a wall so thin that its middle is its outside."""
    found = sized()
    stress = NEED.P * NEED.D_o / (4.0 * found.axial_wall)
    critical = 0.182 * TITANIUM.E * found.axial_wall / (NEED.m_a * 0.5 * NEED.D_o)
    assert stress == pytest.approx(critical, rel=1e-9)


def test_buckling_s_permissible_is_its_pressure_over_the_file_s_factor() -> None:
    found = sized()
    for criterion in found.criteria:
        if "Mises" in criterion.name or "Windenburg" in criterion.name:
            assert criterion.permissible == pytest.approx(criterion.pressure / 2.0)
        if "Eq. (10)" in criterion.name:
            assert criterion.permissible == pytest.approx(criterion.pressure / 3.0)


def test_a_ring_works_with_its_share_of_the_wall() -> None:
    """Ring and wall about their common centroid by parallel axes; breadth = ring + 1.56 sqrt(R wall) (Bryant 1954)."""
    R, wall, ring = 0.1, 2e-3, RingSection(spacing=0.2, height=6e-3, width=4e-3)
    breadth = 4e-3 + 1.56 * sqrt(R * wall)
    assert breadth < ring.spacing
    areas, centres = (breadth * wall, 4e-3 * 6e-3), (0.5 * wall, wall + 3e-3)
    own = breadth * wall**3 / 12.0 + 4e-3 * 6e-3**3 / 12.0
    centroid = sum(a * z for a, z in zip(areas, centres, strict=True)) / sum(areas)
    whole = own + sum(a * (z - centroid) ** 2 for a, z in zip(areas, centres, strict=True))
    assert ring_inertia(wall, R, ring) == pytest.approx(whole, rel=1e-12)
    close = ring._replace(spacing=0.02)  # nearer than that the wall between is all there is
    areas = (0.02 * wall, 4e-3 * 6e-3)
    own = 0.02 * wall**3 / 12.0 + 4e-3 * 6e-3**3 / 12.0
    centroid = sum(a * z for a, z in zip(areas, centres, strict=True)) / sum(areas)
    whole = own + sum(a * (z - centroid) ** 2 for a, z in zip(areas, centres, strict=True))
    assert ring_inertia(wall, R, close) == pytest.approx(whole, rel=1e-12)
