"""Cost of moving oil with the engine that a vehicle file describes.

A motor that pumps from a reservoir, and a valve that lets the oil back, have a closed form, which the tests hold
against the simulation. Any other circuit is simulated at a few pressures; that takes a fraction of a second, once.
"""

from dataclasses import replace
from functools import lru_cache
from math import pi

import numpy as np

from stommel.design.bench.bench_engine import bench_engine
from stommel.design.bench.failures import BenchRequestError
from stommel.design.energy.actuator_work import Array, PumpWork
from stommel.design.engine.simulation import simulate
from stommel.design.engine.steady_state import EngineParameters, friction_pressure, steady_state
from stommel.vehicle import Vehicle
from stommel.vehicle.schema import Engine

PRESSURES = 41
SIMULATED_SHARES = (0.0, 0.05, 0.25, 0.5, 0.75, 1.0)
"""Pressures of a simulated table, over the deepest."""
STRIBECK_ITERATIONS = 20


def pump_by_engine(vehicle: Vehicle, deepest_pa: float) -> PumpWork:
    """Cost of moving oil by [engine], up to a pressure [Pa]."""
    engine = vehicle.description.engine
    assert engine is not None
    try:
        parameters = bench_engine(vehicle)
    except BenchRequestError:
        return _simulated(engine, deepest_pa)
    valves = [valve for valve in engine.solenoid_valves if valve.name in engine.deflate.open_valves]
    if engine.deflate.motor_speed_rpm != 0.0 or len(valves) != 1 or engine.accumulators:
        return _simulated(engine, deepest_pa)
    parameters = replace(parameters, reservoir_pressure_pa=engine.reservoirs[0].gas_pressure_mpa * 1e6)
    return _in_closed_form(engine, parameters, deepest_pa)


def _in_closed_form(engine: Engine, parameters: EngineParameters, deepest_pa: float) -> PumpWork:
    """Steady pumping with the energy of the rotor at each start (eq-e12); a valve's steady flow (eq-e13)."""
    P = np.linspace(0.0, deepest_pa, PRESSURES)
    omega = abs(engine.inflate.motor_speed_rpm) * 2.0 * pi / 60.0
    state = steady_state(parameters, P, omega)
    works = state.attainable & ~state.stalled
    flow = np.where(works, state.flow_m3_s, np.nan)
    (valve,) = (valve for valve in engine.solenoid_valves if valve.name in engine.deflate.open_valves)
    held = sum(valve.power_w for valve in engine.solenoid_valves if valve.name in engine.inflate.open_valves)
    out = _valve_flow(parameters, valve.resistance_mpa_s_ml * 1e12, valve.loss_mpa_s2_ml2 * 1e18, P)
    J = engine.motors[0].rotor_inertia_g_cm2 * 1e-7
    with np.errstate(divide="ignore"):
        return PumpWork(
            pressure_pa=P,
            inflating_j_m3=np.where(works, (state.power_w + held) / flow, np.inf),
            inflating_m3_s=np.where(works, flow, 0.0),
            deflating_j_m3=np.where(out > 0.0, valve.power_w / out, np.inf),
            deflating_m3_s=out,
            origin="the table engine, in closed form",
            starting_j=0.5 * J * omega**2 / parameters.driver_efficiency,
        )


def _valve_flow(parameters: EngineParameters, resistance: float, loss: float, P: Array) -> Array:
    """Flow that the pressure over the valve drives back into the reservoir [m3/s]; zero where friction holds it."""
    q = np.full_like(P, 1e-6)
    viscous = parameters.cylinder_viscous_n_s_m / parameters.piston_area_m2**2
    for _ in range(STRIBECK_ITERATIONS):
        still = friction_pressure(parameters, q) - viscous * q
        driving = np.maximum(P - parameters.reservoir_pressure_pa - still, 0.0)
        b = resistance + viscous
        q = 2.0 * driving / (b + np.sqrt(b**2 + 4.0 * loss * driving))
    return np.asarray(q)


@lru_cache(maxsize=16)
def _simulated(engine: Engine, deepest_pa: float) -> PumpWork:
    """Two strokes at each of a few pressures: what grows with the volume, and what a start costs."""
    P = deepest_pa * np.array(SIMULATED_SHARES)
    most = engine.measured_piston.working_volume_ml / 1e6
    small, large = 0.2 * most, 0.6 * most
    rows = []
    for pressure in P:
        runs = [simulate(engine, pressure_pa=float(pressure), inflate_m3=v, deflate_m3=v) for v in (small, large)]
        phases = [[run.phase(name) for run in runs] for name in ("inflate", "deflate")]
        row: list[float] = []
        for first, second in phases:
            if first is None or second is None or first.outcome.stalled or second.outcome.stalled:
                row += [np.inf, 0.0, 0.0]
                continue
            moved = abs(second.moved_m3) - abs(first.moved_m3)
            cost = (second.energy_j - first.energy_j) / moved
            row += [cost, moved / (second.duration_s - first.duration_s), first.energy_j - cost * abs(first.moved_m3)]
        rows.append(row)
    table = np.array(rows)
    return PumpWork(
        pressure_pa=P,
        inflating_j_m3=table[:, 0],
        inflating_m3_s=table[:, 1],
        deflating_j_m3=table[:, 3],
        deflating_m3_s=table[:, 4],
        origin="the table engine, simulated",
        starting_j=max(0.0, float(np.mean(table[np.isfinite(table[:, 0]), 2]))),
    )
