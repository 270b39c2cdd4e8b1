"""What the battery loses is what the parts take, in every dive."""

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from stommel.analysis import UnreachableFlightError
from stommel.design.endurance import endurance
from stommel.vehicle import load_vehicle

ZJU = load_vehicle("zju")


@settings(max_examples=40, deadline=None)
@given(
    speed=st.floats(0.15, 0.7), pitch=st.floats(-50.0, -8.0), depth=st.floats(20.0, 200.0), heat=st.floats(-2.0, 30.0)
)
def test_parts_times_dives_are_the_usable_energy(speed: float, pitch: float, depth: float, heat: float) -> None:
    try:
        found = endurance(ZJU, speed_m_s=speed, pitch_deg=pitch, depth_m=depth, temperature_c=heat)
    except UnreachableFlightError:
        return
    energies = found.energy_per_dive_j
    assert all(energy >= 0.0 for energy in energies.values())
    assert sum(energies.values()) * found.dives == pytest.approx(found.stored.usable_j, rel=1e-12)
    assert sum(found.as_row()["share"].values()) == pytest.approx(1.0, rel=1e-12)
    assert found.dives * float(found.cycle.duration_s) == pytest.approx(found.endurance_s, rel=1e-12)


def test_deeper_dives_pay_for_surfacing_less_often() -> None:
    days = [endurance(ZJU, depth_m=depth).days for depth in (25.0, 50.0, 100.0, 200.0)]
    assert days == sorted(days)


def test_colder_water_shortens_the_mission() -> None:
    assert endurance(ZJU, temperature_c=0.0).days < endurance(ZJU, temperature_c=20.0).days
