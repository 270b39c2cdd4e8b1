"""The engine of a vehicle as it stands on the bench."""

from dataclasses import replace
from math import pi, sqrt

from stommel.design.bench.engine_log import EngineLog
from stommel.design.bench.failures import BenchRequestError
from stommel.design.engine.steady_state import EngineParameters
from stommel.vehicle import Vehicle


def bench_engine(vehicle: Vehicle) -> EngineParameters:
    """Constants of a vehicle's engine on the bench, where air of the room stands behind the reservoir's piston.

    Raises
    ------
    BenchRequestError
        The vehicle has no engine, or one that is not a motor, a gearbox, a pump and a reservoir.
    """
    engine = vehicle.description.engine
    if engine is None:
        raise BenchRequestError(f"{vehicle.name}: its file has no [engine]; the bench tests need one")
    parts = (engine.motors, engine.gearboxes, engine.pumps, engine.reservoirs, engine.bladders)
    if any(len(kind) != 1 for kind in parts):
        raise BenchRequestError(
            f"{vehicle.name}: the bench tests know an engine of one motor, gearbox, pump, reservoir and bladder"
        )
    (motor,), (gearbox,), (pump,), (reservoir,) = engine.motors, engine.gearboxes, engine.pumps, engine.reservoirs
    passages = (*engine.lines, *engine.check_valves)
    return replace(
        EngineParameters(
            torque_constant_n_m_a=motor.torque_constant_mn_m_a / 1e3,
            resistance_ohm=motor.resistance_ohm,
            no_load_current_a=motor.no_load_current_a,
            gear_ratio=gearbox.ratio,
            gear_efficiency=gearbox.efficiency,
            displacement_m3_rev=pump.displacement_ml_r / 1e6,
            leakage_m3_s_pa=pump.leakage_ml_s_mpa / 1e12,
            pump_friction_n_m=pump.friction_n_m,
            pump_friction_share=pump.friction_share,
            pump_damping_n_m_s=pump.damping_n_m_s,
            piston_area_m2=reservoir.area_m2,
            cylinder_coulomb_n=reservoir.coulomb_n,
            cylinder_viscous_n_s_m=reservoir.viscous_n_s_m,
            line_resistance_pa_s_m3=sum(part.resistance_mpa_s_ml for part in passages) * 1e12,
            line_loss_pa_s2_m6=sum(line.loss_mpa_s2_ml2 for line in engine.lines) * 1e18,
            cracking_pressure_pa=sum(valve.cracking_pressure_mpa for valve in engine.check_valves) * 1e6,
            cylinder_stribeck_n=reservoir.stribeck_n,
            stribeck_velocity_m_s=reservoir.stribeck_mm_s / 1e3,
            supply_voltage_v=motor.supply_voltage_v,
            driver_efficiency=motor.driver_efficiency,
            current_limit_a=motor.current_limit_a,
        ),
        reservoir_pressure_pa=0.0,
    )


def piston_area_of(log: EngineLog, engine: EngineParameters) -> float:
    """S [m2]: of the log's column map if it says so, otherwise of the vehicle.

    Raises
    ------
    BenchRequestError
        Both say so, and disagree.
    """
    if log.piston_diameter_m is None:
        return engine.piston_area_m2
    area = pi / 4 * log.piston_diameter_m**2
    if abs(area / engine.piston_area_m2 - 1.0) > 1e-6:
        stated = 2e3 * sqrt(engine.piston_area_m2 / pi)
        raise BenchRequestError(
            f"piston_diameter_mm = {log.piston_diameter_m * 1e3:g} in the column map, {stated:g} in the vehicle file: "
            "is it the log of this engine?"
        )
    return area
