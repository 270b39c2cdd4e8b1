"""Oracles: trims and turns of the general solver at points of the table; tables of other vehicles, kept apart."""

from math import degrees, radians

import numpy as np
import pytest

import stommel
from stommel.analysis.flight_table import flight_table
from stommel.analysis.linearization import linearise
from stommel.dynamics.packing import reference_water
from stommel.errors import StommelError
from stommel.seawater.water import Water

POINTS = [(0, 3, 4), (0, 10, 9), (1, 10, 9), (1, 16, 2)]


@pytest.mark.parametrize(("way", "i", "j"), POINTS)
def test_flights_are_those_of_the_trim_solver(zju: stommel.Vehicle, way: int, i: int, j: int) -> None:
    table, sign = flight_table(zju), (-1.0, 1.0)[way]
    flight = stommel.trim(
        zju,
        speed_m_s=float(table.speed[way, i, j]),
        pitch_deg=sign * degrees(table.theta[i]),
        physics=stommel.FULL,
        within_limits=False,
    )
    assert flight.V_b == pytest.approx(sign * table.V_b[j], rel=1e-9)
    assert flight.r_px == pytest.approx(table.r_px[way, i, j], rel=1e-9)
    assert flight.alpha == pytest.approx(table.alpha[way, i, j], rel=1e-9)


@pytest.mark.parametrize(("way", "i", "j"), POINTS)
def test_turning_ends_at_the_rate_of_the_steady_turn(zju: stommel.Vehicle, way: int, i: int, j: int) -> None:
    """A tenth of a degree of rudder: the steady turn of the nonlinear equations is linear to 1e-4 there."""
    table = flight_table(zju)
    delta = 0.1
    straight, turning = (
        stommel.steady_flight(
            zju,
            moving_mass_mm=1e3 * float(table.r_px[way, i, j]),
            ballast_ml=1e6 * (-1.0, 1.0)[way] * float(table.V_b[j]),
            rudder_deg=rudder,
            physics=stommel.FULL,
            within_limits=False,
        )
        for rudder in (0.0, delta)
    )
    pole, drive = table.turn_pole[way, i, j], table.turn_drive[way, i, j]
    assert -drive / pole * radians(delta) == pytest.approx(turning.turn_rate, rel=1e-3)
    lateral = linearise(zju, straight, physics=stommel.FULL).lateral
    assert lateral is not None
    assert pole == pytest.approx(np.linalg.eigvals(lateral.A).real.max(), rel=1e-8)


def test_without_a_lateral_plane_nothing_turns() -> None:
    table = flight_table(stommel.load_vehicle("slocum"))
    assert not table.turn_pole.any()
    assert not table.turn_drive.any()
    assert (table.speed > 0.0).all()


def test_another_vehicle_has_another_table_and_a_table_is_its_callers_own(zju: stommel.Vehicle) -> None:
    first = flight_table(zju)
    kept = first.speed.copy()
    first.speed[:] = 0.0
    assert (flight_table(zju).speed == kept).all()
    draggy = zju.with_value("hydrodynamics.drag_kg_m", 1.2 * zju.value("hydrodynamics.drag_kg_m"))
    assert (flight_table(draggy).speed < kept).all()
    assert (flight_table(zju, physics=stommel.PAPER).theta == first.theta).all()
    # the largest volume is no part of the equations of motion
    smaller = zju.with_value("actuators.buoyancy.volume_ml.0", 0.5 * zju.value("actuators.buoyancy.volume_ml.0"))
    smaller = smaller.with_value(
        "actuators.buoyancy.volume_ml.1", 0.5 * smaller.value("actuators.buoyancy.volume_ml.1")
    )
    assert flight_table(smaller).V_b == pytest.approx(0.5 * first.V_b)
    for _ in range(20):  # more than are kept
        draggy = draggy.with_value("hydrodynamics.drag_kg_m", 1.01 * draggy.value("hydrodynamics.drag_kg_m"))
        flight_table(draggy)
    assert (flight_table(zju).speed == kept).all()


def test_refused_where_there_is_no_flight(zju: stommel.Vehicle) -> None:
    with pytest.raises(StommelError, match=r"ROGUE .*needs the table \[actuators.buoyancy\]"):
        flight_table(stommel.load_vehicle("rogue"))
    heavy = Water(rho=1.02 * reference_water(zju).rho)  # too heavy to dive in
    with pytest.raises(StommelError, match=r"no steady flight at pitch -5 deg with -\d+\.\d ml for its flight table"):
        flight_table(zju, water=heavy)
