"""Oracle: Tables 1 and 2 of Fan et al. (2013), as printed.

The bars are 0.05 mm, 0.007 deg and 0.06 ml, a little more than half a unit of the last printed digit, because the
paper's own parameters are known only from its tables.
"""

from math import degrees

import pytest

import stommel

# speed m/s, pitch deg, moving mass mm, angle of attack deg, ballast ml
TABLE_1 = [
    (0.4, -5, 272.0, 5.52, -215.9),
    (0.4, -10, 291.3, 3.80, -150.3),
    (0.4, -15, 311.5, 2.78, -112.5),
    (0.4, -20, 332.9, 2.15, -89.2),
    (0.4, -25, 355.7, 1.72, -74.0),
    (0.4, -30, 380.6, 1.41, -63.4),
    (0.4, -35, 408.2, 1.17, -55.8),
    (0.4, -40, 439.3, 0.99, -50.1),
    (0.4, -45, 475.5, 0.83, -45.7),
    (0.4, -50, 518.6, 0.70, -42.3),
    (0.4, -55, 571.8, 0.58, -39.6),
    (0.4, -60, 640.1, 0.48, -37.5),
]
TABLE_2 = [
    (0.1, -35, 407.6, 1.17, -3.5),
    (0.2, -35, 407.7, 1.17, -13.9),
    (0.3, -35, 407.9, 1.17, -31.4),
    (0.4, -35, 408.2, 1.17, -55.8),
    (0.5, -35, 408.5, 1.17, -87.2),
    (0.6, -35, 408.9, 1.17, -125.5),
    (0.7, -35, 409.4, 1.17, -170.8),
    (0.8, -35, 410.0, 1.17, -223.1),
]


@pytest.mark.parametrize("row", TABLE_1 + TABLE_2, ids=lambda row: f"{row[0]} m/s, {row[1]} deg")
def test_row(row: tuple[float, float, float, float, float]) -> None:
    speed, pitch, moving_mass_mm, angle_of_attack_deg, ballast_ml = row
    zju = stommel.load_vehicle("zju")
    ((flight, _),) = ((r.flight, r.beyond) for r in stommel.trim_table(zju, speeds_m_s=[speed], pitches_deg=[pitch]))
    assert flight.r_px * 1e3 == pytest.approx(moving_mass_mm, abs=0.05)
    assert degrees(flight.alpha) == pytest.approx(angle_of_attack_deg, abs=0.007)
    assert flight.V_b * 1e6 == pytest.approx(ballast_ml, abs=0.06)
    assert flight.residual < 1e-10


def test_paper_chooses_its_design_ranges() -> None:
    """Section 3.1: +-300 mm and +-250 ml, for at least 50 deg and 0.8 m/s."""
    zju = stommel.load_vehicle("zju")
    wanted = [(row[0], row[1]) for row in TABLE_1 if abs(row[1]) <= 50] + [(row[0], row[1]) for row in TABLE_2]
    needed = stommel.ranges_needed(zju, wanted)
    assert needed.moving_mass_choice_mm == 300.0
    assert needed.ballast_choice_ml == 250.0
    assert needed.moving_mass_mm == pytest.approx(518.6 - 250.0, abs=0.05)
    assert needed.ballast_ml == pytest.approx(223.1, abs=0.06)


def test_largest_pitch_and_speed_of_the_chosen_ranges() -> None:
    """Section 3.1: the chosen ranges give 50 deg of pitch and 0.8 m/s at least."""
    zju = stommel.load_vehicle("zju")
    (row,) = stommel.flight_envelope(zju, pitches_deg=[-35.0])
    assert row.fastest is not None
    assert row.fastest.V >= 0.8
    assert row.limited_by == "ballast volume"
    stommel.trim(zju, speed_m_s=0.4, pitch_deg=-50.0)
    with pytest.raises(stommel.UnreachableFlightError):
        stommel.trim(zju, speed_m_s=0.4, pitch_deg=-55.0)


def test_slip_of_section_3_2() -> None:
    """The text calls -35 deg the glide path; in Table 2's row it is the pitch, and the path is -36.17 deg."""
    flight = stommel.trim(stommel.load_vehicle("zju"), speed_m_s=0.4, pitch_deg=-35.0)
    assert degrees(flight.gamma) == pytest.approx(-36.17, abs=0.005)


def test_bladder_moment_that_the_tables_leave_out() -> None:
    """Full physics: about 1.2 N m at 250 ml (design notes), so the moving mass sits elsewhere than in the table."""
    zju = stommel.load_vehicle("zju")
    paper = stommel.trim(zju, speed_m_s=0.8, pitch_deg=-35.0)
    full = stommel.trim(zju, speed_m_s=0.8, pitch_deg=-35.0, physics=stommel.FULL)
    V_b, rho, rho_oil, g = paper.V_b, 1000.0, 870.0, 9.81
    # volume displaced at the bladder at -0.75 m; oil brought there from -0.5 m
    moment = -rho * g * V_b * -0.75 + rho_oil * g * V_b * (-0.75 + 0.5)
    assert full.r_px - paper.r_px == pytest.approx(-moment / (10 * g), rel=1e-6)
    assert full.residual < 1e-10
