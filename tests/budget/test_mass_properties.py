"""Oracle: integration over the bodies, parts cut in two, and the published table of spheroids."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from stommel.design.budget.added_inertia import spheroid_added_inertia
from stommel.design.budget.mass_properties import mass_properties, own_inertia
from stommel.vehicle.schema.budget import Part


def box(mass: float, sides: tuple[float, float, float], at: tuple[float, float, float] = (0.0, 0.0, 0.0)) -> Part:
    return Part(name="box", bay="bay", mass_kg=mass, position_m=at, box_mm=sides)


def test_hollow_cylinder_by_integration() -> None:
    """Rings of a tube summed, 200 along the radius and 200 along the length."""
    tube = Part(
        name="t",
        bay="b",
        mass_kg=5.0,
        position_m=(0, 0, 0),
        length_mm=400.0,
        diameter_mm=220.0,
        inner_diameter_mm=200.0,
    )
    n = 200
    r = 0.1 + 0.01 * (np.arange(n) + 0.5) / n
    x = -0.2 + 0.4 * (np.arange(n) + 0.5) / n
    R, X = np.meshgrid(r, x)
    weight = 5.0 * R / R.sum()
    assert own_inertia(tube)[0, 0] == pytest.approx(float((weight * R**2).sum()), rel=1e-4)
    assert own_inertia(tube)[1, 1] == pytest.approx(float((weight * (R**2 / 2 + X**2)).sum()), rel=1e-4)


@given(
    mass=st.floats(0.1, 50.0),
    sides=st.tuples(*[st.floats(1.0, 500.0)] * 3),
    x=st.floats(-1.0, 1.0),
    y=st.floats(-0.1, 0.1),
    z=st.floats(-0.1, 0.1),
)
def test_a_box_cut_in_two_is_the_same_body(
    mass: float, sides: tuple[float, float, float], x: float, y: float, z: float
) -> None:
    half = sides[0] / 4e3
    whole = mass_properties([box(mass, sides, (x, y, z))])
    cut = (sides[0] / 2, sides[1], sides[2])
    halves = mass_properties([box(mass / 2, cut, (x - half, y, z)), box(mass / 2, cut, (x + half, y, z))])
    assert halves.mass == pytest.approx(whole.mass)
    np.testing.assert_allclose(halves.centre, whole.centre, atol=1e-12)
    np.testing.assert_allclose(halves.inertia, whole.inertia, rtol=1e-9, atol=1e-12)
    np.testing.assert_allclose(whole.inertia_about_centre, own_inertia(box(mass, sides)), rtol=1e-6, atol=1e-9)


@pytest.mark.parametrize(
    ("slenderness", "k"), [(1.5, 0.094), (2.0, 0.240), (2.99, 0.465), (3.99, 0.608), (6.01, 0.764), (9.97, 0.883)]
)
def test_spheroid_against_lambs_table(slenderness: float, k: float) -> None:
    """Lamb, Hydrodynamics, art. 115: inertia coefficient k' of prolate spheroids, printed to three digits."""
    width, rho = 0.2, 1000.0
    length = slenderness * width
    displaced = rho * np.pi / 6 * length * width**2
    solid = displaced * (length**2 + width**2) / 20
    assert spheroid_added_inertia(length, width, rho) / solid == pytest.approx(k, abs=0.0015)


def test_spheroid_must_be_long() -> None:
    with pytest.raises(ValueError, match="greater than diameter"):
        spheroid_added_inertia(0.2, 0.2, 1000.0)
