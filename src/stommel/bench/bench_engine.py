"""The engine of a vehicle as it stands on the bench."""

from dataclasses import replace
from math import pi, sqrt

from stommel.bench.engine_log import EngineLog
from stommel.bench.failures import BenchRequestError
from stommel.machinery.engine.reduction import engine_parameters
from stommel.machinery.engine.steady_state import EngineParameters
from stommel.vehicle import Vehicle
from stommel.vehicle.missing_table import missing_table


def bench_engine(vehicle: Vehicle) -> EngineParameters:
    """Constants of a vehicle's engine on the bench, where air of the room stands behind the reservoir's piston.

    Raises
    ------
    BenchRequestError
        The vehicle has no engine, or its bladder is stiff.
    CircuitError
        The circuit cannot be reduced to steady pumping.
    """
    engine = vehicle.description.engine
    if engine is None:
        raise BenchRequestError(
            f"{vehicle.name}: its file has no table [engine]; the bench tests need one; {missing_table('engine')}"
        )
    if engine.bladders[0].stiffness_mpa_ml > 0.0:
        raise BenchRequestError(f"{vehicle.name}: the bench tests know a limp bladder only, stiffness_mpa_ml = 0")
    return replace(engine_parameters(engine), reservoir_pressure_pa=0.0)


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
