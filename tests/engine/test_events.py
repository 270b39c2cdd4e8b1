"""Events: in the right order, at the right instants, with the right outcome."""

import numpy as np
import pytest

from stommel.machinery.engine import Outcome, engine_parameters, simulate, stall_pressure
from stommel.machinery.engine.segments import SimulationError
from stommel.machinery.engine.steady_state import steady_state
from stommel.vehicle.schema import Engine

ML = 1e-6


def replaced(engine: Engine, kind: str, **values: float) -> Engine:
    """The engine with numbers of the first part of a kind changed."""
    first, *others = getattr(engine, kind)
    return engine.model_copy(update={kind: (first.model_copy(update=values), *others)})


def names(run: object) -> list[str]:
    return [name for _, name in run.events]  # type: ignore[attr-defined]


def test_order_of_an_inflation(zju: Engine) -> None:
    found = names(simulate(zju, pressure_pa=2e6, inflate_m3=100 * ML))
    order = ["reservoir moves", "check_valve opens", "speed reached", "target", "check_valve closes", "at rest"]
    assert [found.index(name) for name in order] == sorted(found.index(name) for name in order)


def test_instants_that_are_known(zju: Engine) -> None:
    run = simulate(zju, pressure_pa=2e6, inflate_m3=100 * ML)
    at = {name: t for t, name in reversed(run.events)}
    ramp = zju.motors[0].ramp_s
    assert at["speed reached"] == pytest.approx(ramp, abs=1e-9)
    assert at["at rest"] - at["target"] == pytest.approx(ramp, abs=1e-9)


def test_check_valve_opens_at_its_cracking_pressure(zju: Engine) -> None:
    run = simulate(zju, pressure_pa=2e6, inflate_m3=100 * ML)
    opens = next(t for t, name in run.events if name == "check_valve opens")
    p = {name: float(np.interp(opens, run.courses.t_s, values)) for name, values in run.courses.pressure_mpa.items()}
    before, after = (next(v for k, v in p.items() if port in k) for port in ("check_valve.inlet", "check_valve.outlet"))
    assert before - after == pytest.approx(zju.check_valves[0].cracking_pressure_mpa, abs=1e-4)


def test_piston_breaks_away_at_its_static_friction(zju: Engine) -> None:
    run = simulate(zju, pressure_pa=2e6, inflate_m3=100 * ML)
    moves = next(t for t, name in run.events if name == "reservoir moves")
    piston = zju.reservoirs[0]
    p = next(values for name, values in run.courses.pressure_mpa.items() if "reservoir.oil" in name)
    pull = (piston.gas_pressure_mpa - float(np.interp(moves, run.courses.t_s, p))) * 1e6 * piston.area_m2
    assert pull == pytest.approx(piston.coulomb_n + piston.stribeck_n, abs=0.1)


def test_times_do_not_depend_on_the_integrator(zju: Engine, monkeypatch: pytest.MonkeyPatch) -> None:
    """A thousand times the accuracy changes the duration by less than a millisecond, the energy by less than 1e-5."""
    coarse = simulate(zju, pressure_pa=2e6, inflate_m3=300 * ML).phases[0]
    monkeypatch.setattr("stommel.machinery.engine.segments.RTOL", 1e-9)
    monkeypatch.setattr("stommel.machinery.engine.segments.LONGEST_STEP_S", 0.2)
    fine = simulate(zju, pressure_pa=2e6, inflate_m3=300 * ML).phases[0]
    assert coarse.duration_s == pytest.approx(fine.duration_s, abs=1e-3)
    assert coarse.energy_j == pytest.approx(fine.energy_j, rel=1e-5)


def test_leakage_takes_the_whole_flow(zju: Engine) -> None:
    run = simulate(zju, pressure_pa=9e6, inflate_m3=500 * ML)
    assert run.stalled
    assert run.phases[0].outcome is Outcome.NO_FLOW
    assert "check_valve opens" not in names(run)
    # below the pressure of no flow by the closed form; above it the engine is given up only if it crawls
    pressures = np.linspace(7e6, 9e6, 20001)
    omega = zju.inflate.motor_speed_rpm * np.pi / 30
    steady = steady_state(engine_parameters(zju), pressures, omega)
    blocked = float(pressures[np.argmax(steady.stalled)])
    assert stall_pressure(zju) == pytest.approx(blocked, rel=0.01)


def test_motor_stalls_at_its_current_limit(zju: Engine) -> None:
    weak = replaced(replaced(zju, "motors", current_limit_a=1.5), "pumps", leakage_ml_s_mpa=0.01)
    run = simulate(weak, pressure_pa=4e6, inflate_m3=500 * ML)
    assert run.phases[0].outcome is Outcome.MOTOR_STALLED
    assert names(run)[-1] == "stalled"
    assert run.phases[0].peak_current_a == pytest.approx(1.5, rel=1e-6)
    found = stall_pressure(weak)
    assert found is not None
    # torque balance at rest: k_t (I_max - I_0) i eta = D dp (1 + c) / 2 pi + T_0
    P = engine_parameters(weak)
    torque = P.torque_constant_n_m_a * (1.5 - P.no_load_current_a) * P.gear_ratio * P.gear_efficiency
    dp = (torque - P.pump_friction_n_m) * 2 * np.pi / (P.displacement_m3_rev * (1 + P.pump_friction_share))
    assert found == pytest.approx(dp, rel=0.1)


def test_voltage_limits_the_speed(zju: Engine) -> None:
    """Beyond the no-load speed at 24 V the motor turns as fast as it can, and still inflates."""
    run = simulate(zju, pressure_pa=2e6, inflate_m3=100 * ML, motor_speed_rpm=12000.0)
    assert run.phases[0].outcome is Outcome.REACHED
    assert "limited" in names(run)
    assert "speed reached" not in names(run)
    assert run.courses.motor_rpm.max() < 24.0 / 25.1e-3 * 30 / np.pi
    assert run.courses.voltage_v.max() <= 24.0 + 1e-9


def test_stuck_piston_does_not_deflate(zju: Engine) -> None:
    """At the surface, without vacuum in the hull, the oil's pressure does not overcome the piston's friction."""
    bench = replaced(zju, "reservoirs", gas_pressure_mpa=0.0)
    run = simulate(bench, pressure_pa=0.0, deflate_m3=500 * ML)
    assert run.phases[0].outcome is Outcome.NO_FLOW
    assert simulate(zju, pressure_pa=0.0, deflate_m3=500 * ML).phases[0].outcome is Outcome.REACHED


def test_end_stop(zju: Engine) -> None:
    """A target that the overshoot of a slow stop carries beyond the mechanical end."""
    short = replaced(zju, "reservoirs", stroke_mm=277.6, working_range_mm=(0.0, 277.5))
    coarse = short.model_copy(update={"sensor": short.sensor.model_copy(update={"resolution_mm": 50.0})})
    run = simulate(coarse, pressure_pa=2e6, deflate_m3=500 * ML)
    assert run.phases[0].outcome is Outcome.END_STOP
    assert run.phases[0].piston_m[1] == pytest.approx(0.2776, abs=1e-9)
    assert run.oil_residual < 1e-6


def test_driven_piston_meets_its_end_stop() -> None:
    from stommel.machinery.engine import load_engine

    engine = replaced(load_engine("slocum-1000m").engine, "cylinders", stroke_mm=226.6)
    coarse = engine.model_copy(update={"sensor": engine.sensor.model_copy(update={"resolution_mm": 50.0})})
    run = simulate(coarse, pressure_pa=1e6, deflate_m3=500 * ML)
    assert run.phases[0].outcome is Outcome.END_STOP
    assert run.phases[0].piston_m[1] == pytest.approx(0.2266, abs=1e-9)
    assert run.courses.motor_rpm[-1] <= 0.0


def test_sensor_decides_when_to_stop(zju: Engine) -> None:
    """The piston stops at a reading of the sensor at or beyond the wanted one, not before it."""
    step = zju.sensor.resolution_mm
    phase = simulate(zju, pressure_pa=1e6, inflate_m3=123.4 * ML).phases[0]
    wanted = 277.5 - 123.4 * ML / zju.measured_piston.area_m2 * 1e3
    reading = np.floor(wanted / step) * step
    assert phase.piston_m[1] * 1e3 == pytest.approx(reading, abs=0.02)


def test_accumulator_fills_and_holds() -> None:
    """Behind a throttle the pump lifts the accumulator above its precharge; at rest it empties into the bladder."""
    from stommel.machinery.engine import load_engine

    engine = replaced(load_engine("high-pressure").engine, "accumulators", precharge_mpa=5.0)
    engine = replaced(engine, "lines", resistance_mpa_s_ml=0.001)
    tight = engine.model_copy(
        update={"lines": tuple(line.model_copy(update={"resistance_mpa_s_ml": 0.8}) for line in engine.lines[1:])}
    )
    tight = tight.model_copy(update={"lines": (engine.lines[0], *tight.lines)})
    found = names(simulate(tight, pressure_pa=3e6, inflate_m3=200 * ML, hold_s=60.0))
    assert "accumulator fills" in found
    assert "accumulator is empty" in found
    assert found.index("accumulator fills") < found.index("accumulator is empty")


def test_stick_and_slip_is_named(zju: Engine) -> None:
    rough = replaced(zju, "reservoirs", stribeck_n=20.0, stribeck_mm_s=0.5, viscous_n_s_m=300.0)
    with pytest.raises(SimulationError, match="sticks and slips because"):
        simulate(rough, pressure_pa=2e6, inflate_m3=500 * ML)
