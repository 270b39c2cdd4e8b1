"""How a hull floats by one end; oracles: volumes and moments of cone, cylinder and half ellipsoid in closed form."""

from math import pi, radians

import numpy as np
import pytest
from scipy.optimize import brentq

from stommel.machinery.hull.floating import HullForm, emerged_moment, hull_form, slice_at, tilt_share, water_line
from stommel.vehicle import Vehicle, load_vehicle

RADIUS, LENGTH, NOSE, TAIL = 0.11, 1.5, 0.11, 0.49
"""Of the zju glider [m]; its hull reaches 0.75 m fore and aft of the origin."""
AFT_END, FORWARD_END = -0.75, 0.75
UP, DOWN = radians(50.0), radians(-50.0)


@pytest.fixture(scope="module")
def form(zju: Vehicle) -> HullForm:
    return hull_form(zju.description)


def cone(height: float) -> tuple[float, float]:
    """Volume of the cone's tip of this height, and its first moment about the origin."""
    r = RADIUS * height / TAIL
    volume = pi / 3.0 * r**2 * height
    return volume, volume * (AFT_END - TAIL + 0.75 * height)


def tail_out(line: float) -> tuple[float, float]:
    """Volume aft of `line`, and its first moment: cone and cylinder."""
    if line <= AFT_END:
        return cone(line - AFT_END + TAIL)
    volume, moment = cone(TAIL)
    cylinder = pi * RADIUS**2 * (line - AFT_END)
    return volume + cylinder, moment + cylinder * 0.5 * (line + AFT_END)


def nose_out(line: float) -> tuple[float, float]:
    """Volume ahead of `line`, and its first moment: half an ellipsoid, r = R sqrt(1 - (x / a)2), and cylinder."""
    s = max(line - FORWARD_END, 0.0)
    volume = pi * RADIUS**2 * ((NOSE - s) - (NOSE**3 - s**3) / (3.0 * NOSE**2))
    moment = pi * RADIUS**2 * (0.5 * (NOSE**2 - s**2) - (NOSE**4 - s**4) / (4.0 * NOSE**2)) + FORWARD_END * volume
    if line < FORWARD_END:
        cylinder = pi * RADIUS**2 * (FORWARD_END - line)
        volume, moment = volume + cylinder, moment + cylinder * 0.5 * (line + FORWARD_END)
    return volume, moment


@pytest.mark.parametrize("line", [-1.05, -0.9, -0.75, -0.6, -0.2])
def test_tail_comes_out_as_cone_and_cylinder(form: HullForm, line: float) -> None:
    volume, moment = tail_out(line)
    assert water_line(form, DOWN, volume) == pytest.approx(line, abs=1e-3)
    assert emerged_moment(form, DOWN, volume) == pytest.approx(moment, rel=2e-3)


@pytest.mark.parametrize("line", [0.84, 0.8, 0.75, 0.6, 0.2])
def test_nose_comes_out_as_half_an_ellipsoid_and_cylinder(form: HullForm, line: float) -> None:
    volume, moment = nose_out(line)
    assert water_line(form, UP, volume) == pytest.approx(line, abs=1e-3)
    assert emerged_moment(form, UP, volume) == pytest.approx(moment, rel=2e-3)


def test_centre_of_what_is_out_lies_within_it(form: HullForm) -> None:
    for millilitres in (50.0, 200.0, 500.0, 2000.0):
        for theta, tip in ((DOWN, AFT_END - TAIL), (UP, FORWARD_END + NOSE)):
            line = water_line(form, theta, millilitres / 1e6)
            centre = emerged_moment(form, theta, millilitres / 1e6) / (millilitres / 1e6)
            assert min(tip, line) < centre < max(tip, line)


def test_nothing_out_means_the_tip_touches_the_surface(form: HullForm) -> None:
    assert water_line(form, DOWN, 0.0) == pytest.approx(AFT_END - TAIL)
    assert water_line(form, UP, 0.0) == pytest.approx(FORWARD_END + NOSE)
    assert emerged_moment(form, DOWN, 0.0) == 0.0


def test_a_vehicle_that_lies_flat_has_no_end_out(form: HullForm) -> None:
    """Less as the tangent below the slenderness of 220 mm over 2.1 m."""
    slender = 2.0 * RADIUS / (LENGTH + NOSE + TAIL)
    assert tilt_share(form, 0.0) == 0.0
    assert tilt_share(form, np.arctan(0.5 * slender)) == pytest.approx(0.5)
    assert tilt_share(form, -np.arctan(0.25 * slender)) == pytest.approx(0.25)
    assert tilt_share(form, DOWN) == 1.0
    assert water_line(form, 0.0, 2e-4) == 0.0
    half = emerged_moment(form, -np.arctan(0.5 * slender), 2e-4)
    assert half == pytest.approx(0.5 * emerged_moment(form, DOWN, 2e-4))


@pytest.mark.parametrize("millilitres", [150.0, 1000.0, 6500.0])
def test_section_at_the_water_line_is_of_the_cone_or_of_the_cylinder(form: HullForm, millilitres: float) -> None:
    """Of a cone, V = pi / 3 R2 h3 / L2: the section grows with h2."""
    volume = millilitres / 1e6
    height = (3.0 * volume * TAIL**2 / (pi * RADIUS**2)) ** (1.0 / 3.0)
    radius = RADIUS * min(height / TAIL, 1.0)
    assert slice_at(form, DOWN, volume) == pytest.approx(pi * radius**2, rel=0.02)


def test_nose_s_section_is_the_ellipsoid_s(form: HullForm) -> None:
    line = brentq(lambda x: nose_out(x)[0] - 3e-4, FORWARD_END, FORWARD_END + NOSE)
    section = pi * RADIUS**2 * (1.0 - ((line - FORWARD_END) / NOSE) ** 2)
    assert slice_at(form, UP, 3e-4) == pytest.approx(section, rel=0.02)


def test_a_file_without_a_diameter_has_no_form() -> None:
    form = hull_form(load_vehicle("rogue").description)
    assert len(form.tail_volume) == 0
    assert water_line(form, DOWN, 1e-3) == 0.0
    assert emerged_moment(form, UP, 1e-3) == 0.0


def test_plain_cylinder(zju: Vehicle) -> None:
    """Without nose and tail, a volume of pi R2 h is out to a height h along the axis."""
    plain = zju.with_value("hull.nose_length_m", 0.0).with_value("hull.tail_length_m", 0.0)
    form = hull_form(plain.description)
    for h in (0.05, 0.3, 0.7):
        volume = pi * RADIUS**2 * h
        assert water_line(form, DOWN, volume) == pytest.approx(AFT_END + h, abs=1e-3)
        assert water_line(form, UP, volume) == pytest.approx(FORWARD_END - h, abs=1e-3)
        assert emerged_moment(form, DOWN, volume) == pytest.approx(volume * (AFT_END + 0.5 * h), rel=2e-3)
        assert slice_at(form, UP, volume) == pytest.approx(pi * RADIUS**2, rel=1e-3)
