"""Oracle: Shigley's Mechanical Engineering Design, example 8-1 and the formulas for worms; energy can only be lost."""

from math import cos, pi, radians, tan

import pytest
from hypothesis import given
from hypothesis import strategies as st

from stommel.machinery.drives import DriveError
from stommel.machinery.drives.gears import Gearbox, Helix, screw_helix, worm_helix
from stommel.vehicle.schema.drives import Screw, WormGear

LOAD_N, LEAD_M = 6400.0, 0.008
"""Example 8-1: square thread, pitch diameter 30 mm, lead 8 mm, friction 0.08, axial load 6.4 kN."""


def example_8_1() -> Helix:
    return screw_helix(Screw(lead_mm=8.0, pitch_diameter_mm=30.0, friction=0.08, flank_angle_deg=0.0))


def test_torque_to_raise_and_to_lower() -> None:
    ideal = LOAD_N * LEAD_M / (2 * pi)
    screw = example_8_1()
    assert screw.input_torque(ideal) == pytest.approx(15.94, abs=0.005)  # printed without the collar
    assert screw.input_torque(-ideal) == pytest.approx(-0.466, abs=0.0005)  # negative: the load turns the screw
    assert not screw.self_locking


@given(
    lead_angle_deg=st.floats(0.5, 40.0),
    friction=st.floats(0.0, 0.35),
    pressure_angle_deg=st.sampled_from([14.5, 20.0, 25.0]),
)
def test_worm_efficiency_is_the_handbooks(lead_angle_deg: float, friction: float, pressure_angle_deg: float) -> None:
    worm = worm_helix(
        WormGear(ratio=20.0, lead_angle_deg=lead_angle_deg, friction=friction, pressure_angle_deg=pressure_angle_deg)
    )
    gamma, phi = radians(lead_angle_deg), cos(radians(pressure_angle_deg))
    assert worm.efficiency == pytest.approx((phi - friction * tan(gamma)) / (phi + friction / tan(gamma)), rel=1e-9)
    assert worm.self_locking == (friction >= phi * tan(gamma))


@given(lead_angle=st.floats(0.01, 0.7), friction_angle=st.floats(0.0, 0.7), load=st.floats(-1e3, 1e3))
def test_a_thread_never_gains_energy(lead_angle: float, friction_angle: float, load: float) -> None:
    """Work in is at least work out, whichever way the load acts; a self-locking thread always has to be driven."""
    thread = Helix(lead_angle, friction_angle)
    torque = thread.input_torque(load)
    assert torque >= load - 1e-9 * abs(load)
    if thread.self_locking:
        assert torque >= 0.0


def test_gearbox_loses_either_way() -> None:
    box = Gearbox(10.0, 0.8)
    assert box.input_torque(8.0) == pytest.approx(1.0)
    assert box.input_torque(-8.0) == pytest.approx(-0.64)


def test_a_thread_that_jams_is_refused() -> None:
    steep = Screw(lead_mm=100.0, pitch_diameter_mm=5.0, friction=0.5)
    with pytest.raises(DriveError, match=r"drives\.pitch\.screw.*jams"):
        screw_helix(steep)
