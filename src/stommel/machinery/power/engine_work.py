"""Cost of moving oil with the engine that a vehicle file describes.

Inflating is `InflationCosts` of the engine's package: steady pumping in closed form with the driver's ramps. Deflating
through one valve has a closed form as well. A circuit without one, or one that deflates by motor, is simulated at a few
pressures; that takes a fraction of a second, once.
"""

from functools import lru_cache

import numpy as np

from stommel.machinery.engine.circuit import CircuitError
from stommel.machinery.engine.cycle import simulate
from stommel.machinery.engine.reduction import InflationCosts
from stommel.machinery.engine.steady_state import EngineParameters, friction_pressure
from stommel.machinery.power.actuator_work import Array, PumpWork
from stommel.vehicle.schema import Engine

PRESSURES = 41
SIMULATED_SHARES = (0.0, 0.05, 0.25, 0.5, 0.75, 1.0)
"""Pressures of a simulated table, over the deepest."""
SMALL, LARGE = 0.2, 0.6
"""Strokes by which a start is told from what grows with the volume, over the engine's whole stroke."""
STRIBECK_ITERATIONS = 20


def pump_by_engine(engine: Engine, deepest_pa: float) -> PumpWork:
    """Cost of moving oil by [engine], up to a pressure [Pa]."""
    simple = engine.deflate.motor_speed_rpm == 0.0 and len(engine.deflate.open_valves) == 1
    if not simple or engine.accumulators or not engine.reservoirs:
        return _simulated(engine, deepest_pa)
    try:
        costs = InflationCosts(engine)
    except CircuitError:
        return _simulated(engine, deepest_pa)
    P = np.linspace(0.0, deepest_pa, PRESSURES)
    small, large = (share * engine.measured_piston.working_volume_ml / 1e6 for share in (SMALL, LARGE))
    energy = np.array([costs.energy_j(volume, P) for volume in (small, large)])
    time = np.array([costs.duration_s(volume, P) for volume in (small, large)])
    flow = (large - small) / (time[1] - time[0])
    cost = (energy[1] - energy[0]) / (large - small)
    (valve,) = (valve for valve in engine.solenoid_valves if valve.name in engine.deflate.open_valves)
    out = valve_flow(costs.parameters, valve.resistance_mpa_s_ml * 1e12, valve.loss_mpa_s2_ml2 * 1e18, P)
    with np.errstate(divide="ignore"):
        return PumpWork(
            pressure_pa=P,
            inflating_j_m3=np.where(np.isfinite(cost), cost, np.inf),
            inflating_m3_s=np.where(np.isfinite(flow), flow, 0.0),
            deflating_j_m3=valve.power_w / out,
            deflating_m3_s=out,
            origin="the table engine, steady pumping",
            starting_j=np.nan_to_num(energy[0] - cost * small),
            starting_s=float(np.nanmax(np.nan_to_num(time[0] - small / flow))),
        )


def valve_flow(parameters: EngineParameters, resistance: float, loss: float, P: Array) -> Array:
    """Flow through a valve back into the reservoir [m3/s] (eq-e8); zero where friction holds the piston."""
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
    table = np.array([[*_strokes(engine, float(p), "inflate"), *_strokes(engine, float(p), "deflate")] for p in P])
    return PumpWork(
        pressure_pa=P,
        inflating_j_m3=table[:, 0],
        inflating_m3_s=table[:, 1],
        deflating_j_m3=table[:, 3],
        deflating_m3_s=table[:, 4],
        origin="the table engine, simulated",
        starting_j=np.maximum(table[:, 2], 0.0),
    )


def _strokes(engine: Engine, pressure: float, phase: str) -> tuple[float, float, float]:
    """Energy per volume [J/m3], flow [m3/s] and energy of a start [J] of inflating or deflating; stalled: no flow."""
    most = engine.measured_piston.working_volume_ml / 1e6
    runs = [
        simulate(
            engine,
            pressure_pa=pressure,
            inflate_m3=share * most if phase == "inflate" else 0.0,
            deflate_m3=share * most if phase == "deflate" else 0.0,
        ).phase(phase)
        for share in (SMALL, LARGE)
    ]
    first, second = runs
    if first is None or second is None or first.outcome.stalled or second.outcome.stalled:
        return np.inf, 0.0, 0.0
    moved = abs(second.moved_m3) - abs(first.moved_m3)
    cost = (second.energy_j - first.energy_j) / moved
    return cost, moved / (second.duration_s - first.duration_s), first.energy_j - cost * abs(first.moved_m3)
