"""Oracle: the closed form of steady pumping against the simulation, and against a root of its own equations."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.optimize import brentq

from stommel.machinery.engine import EngineParameters, engine_parameters, simulate
from stommel.machinery.engine.steady_state import friction_pressure, steady_state
from stommel.vehicle.schema import Engine

ML = 1e-6


@pytest.mark.parametrize("pressure_mpa", [0.0, 1.0, 2.0, 4.0])
@pytest.mark.parametrize("speed_rpm", [3500.0, 7000.0])
def test_simulation_settles_to_it(zju: Engine, pressure_mpa: float, speed_rpm: float) -> None:
    run = simulate(zju, pressure_pa=pressure_mpa * 1e6, inflate_m3=300 * ML, motor_speed_rpm=speed_rpm)
    c, at = run.courses, run.phases[0].duration_s / 2
    omega = speed_rpm * np.pi / 30
    steady = steady_state(engine_parameters(zju), pressure_mpa * 1e6, omega)

    def middle(values: np.ndarray) -> float:
        return float(np.interp(at, c.t_s, values))

    # oil that is set free in the emptying cylinder, 0.07 MPa of 1400, separates piston and bladder by less than 1e-4
    assert middle(c.flow_ml_s) * ML == pytest.approx(float(steady.flow_m3_s), rel=1e-4)
    assert middle(c.current_a) == pytest.approx(float(steady.current_a), rel=1e-5)
    assert middle(c.voltage_v) == pytest.approx(float(steady.voltage_v), rel=1e-5)
    assert middle(c.power_w) == pytest.approx(float(steady.power_w), rel=1e-5)


def test_driven_piston_settles_to_it() -> None:
    from stommel.machinery.engine import load_engine

    engine = load_engine("slocum-1000m").engine
    run = simulate(engine, pressure_pa=2e6, inflate_m3=200 * ML)
    steady = steady_state(engine_parameters(engine), 2e6, engine.inflate.motor_speed_rpm * np.pi / 30)
    current = float(np.interp(20.0, run.courses.t_s, run.courses.current_a))
    assert current == pytest.approx(float(steady.current_a), rel=2e-3)  # strain energy of the fluid: p / 2 K


def test_flow_solves_its_equation(zju: Engine) -> None:
    """A root found by bisection of Eq. (n1) with every loss written out once more, Stribeck part and all."""
    P = replace(engine_parameters(zju), cylinder_stribeck_n=60.0, stribeck_velocity_m_s=4e-3, line_loss_pa_s2_m6=5e15)
    for p, omega in [(0.0, 733.0), (2e6, 733.0), (2e6, 500.0)]:
        ideal = P.displacement_m3_rev * omega / P.gear_ratio / (2 * np.pi)

        def excess(q: float, p: float = p, ideal: float = ideal) -> float:
            v = q / P.piston_area_m2
            force = 60.0 * np.exp(-((v / 4e-3) ** 2)) + P.cylinder_coulomb_n + P.cylinder_viscous_n_s_m * v
            lines = P.cracking_pressure_pa + P.line_resistance_pa_s_m3 * q + 5e15 * q**2
            dp = p - P.reservoir_pressure_pa + force / P.piston_area_m2 + lines
            return ideal - P.leakage_m3_s_pa * dp - q

        assert float(steady_state(P, p, omega).flow_m3_s) == pytest.approx(brentq(excess, 0.0, ideal), rel=1e-6)


def test_without_losses_it_is_a_transformer() -> None:
    """Ideal torque D dp / 2 pi, ideal flow D n, and all power into the sea."""
    P = EngineParameters(
        torque_constant_n_m_a=0.025, resistance_ohm=0.0, no_load_current_a=0.0, gear_ratio=15.0, gear_efficiency=1.0,
        displacement_m3_rev=1.1e-6, leakage_m3_s_pa=0.0, pump_friction_n_m=0.0, pump_friction_share=0.0,
        pump_damping_n_m_s=0.0, piston_area_m2=2e-3, cylinder_coulomb_n=0.0, cylinder_viscous_n_s_m=0.0,
        line_resistance_pa_s_m3=0.0,
    )  # fmt: skip
    p, n = np.array([0.0, 1e6, 2e6])[:, None], np.array([350.0, 700.0])[None, :]
    found = steady_state(P, p, n)
    assert found.flow_m3_s.shape == (3, 2)
    np.testing.assert_allclose(found.flow_m3_s, np.broadcast_to(1.1e-6 * n / 15 / (2 * np.pi), (3, 2)), rtol=1e-12)
    np.testing.assert_allclose(found.pump_torque_n_m, np.broadcast_to(1.1e-6 * p / (2 * np.pi), (3, 2)), rtol=1e-12)
    np.testing.assert_allclose(found.total_efficiency[1:], 1.0, rtol=1e-12)
    assert not found.total_efficiency[0].any()


def test_stall_and_limits_are_marked(zju: Engine) -> None:
    P = engine_parameters(zju)
    found = steady_state(P, np.array([2e6, 20e6]), 733.0)
    assert found.stalled.tolist() == [False, True]
    assert found.flow_m3_s[1] == 0.0
    assert not steady_state(P, 2e6, 2000.0).attainable  # needs more than 24 V
    assert not steady_state(replace(P, current_limit_a=1.0), 2e6, 733.0).attainable


def test_friction_pressure_at_rest_and_in_motion(zju: Engine) -> None:
    P = engine_parameters(zju)
    at_rest = (P.cylinder_coulomb_n + P.cylinder_stribeck_n) / P.piston_area_m2
    assert float(friction_pressure(P, 0.0)) == pytest.approx(at_rest, rel=1e-12)
    assert float(friction_pressure(P, 1.0)) == pytest.approx(
        (P.cylinder_coulomb_n + P.cylinder_viscous_n_s_m / P.piston_area_m2) / P.piston_area_m2, rel=1e-12
    )
