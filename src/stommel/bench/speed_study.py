"""The motor speed of a vehicle's engine as a part of its design: what the bench of section 5.1.2 would show."""

from dataclasses import dataclass
from math import pi

from stommel.bench.bench_engine import bench_engine
from stommel.bench.failures import BenchRequestError
from stommel.bench.performance import OperatingPoint, model_points
from stommel.bench.speed_choice import SpeedChoice, TimeLimit, choose_speed
from stommel.machinery.engine.steady_state import EngineParameters
from stommel.vehicle import Vehicle

SPEED_SHARES = (0.5, 0.75, 1.0, 1.25)
"""Motor speeds in multiples of the vehicle file's: with 7000 r/min those of section 5.1.2 of the paper."""
PRESSURE_SHARES = (0.0, 0.25, 0.5, 0.75, 1.0, 1.25)
"""Pressures in multiples of the greatest in service: with 2 MPa those of section 5.1.2 of the paper."""
TIME_LIMIT_S = 90.0
"""Longest inflation at the greatest pressure in service: an assumption, the paper names no limit."""


@dataclass(frozen=True)
class SpeedStudy:
    """Points of the model on the bench, and the speed chosen from them."""

    engine: EngineParameters
    """On the bench."""
    points: tuple[OperatingPoint, ...]
    choice: SpeedChoice
    file_speed: float
    """Motor speed of the vehicle file [rad/s]."""


def speed_study(vehicle: Vehicle) -> SpeedStudy:
    """Run the model over speeds and pressures about those of the vehicle file, and choose a speed.

    Raises
    ------
    BenchRequestError
        The vehicle file gives no engine, no motor speed or no pressure in service.
    CircuitError
        The circuit cannot be reduced to steady pumping.
    """
    engine = bench_engine(vehicle)
    d = vehicle.description
    assert d.engine is not None  # bench_engine refuses it
    speed = abs(d.engine.inflate.motor_speed_rpm) * 2 * pi / 60
    service = _pressure_in_service(vehicle)
    if speed == 0.0 or service is None:
        raise BenchRequestError("the vehicle file gives no engine.inflate.motor_speed_rpm or no hull.depth_rating_m")
    spec = d.specification
    volume_ml = (spec.oil_volume_ml if spec else None) or d.engine.measured_piston.working_volume_ml
    points = model_points(engine, [s * service for s in PRESSURE_SHARES], [s * speed for s in SPEED_SHARES])
    limit = TimeLimit(TIME_LIMIT_S, volume_ml / 1e6, service)
    return SpeedStudy(engine, tuple(points), choose_speed(points, limit, engine.piston_area_m2), speed)


def _pressure_in_service(vehicle: Vehicle) -> float | None:
    """Greatest gauge pressure [Pa]: the design pressure of the hull, or the water's weight over its depth rating."""
    hull, water = vehicle.description.hull, vehicle.description.water
    if hull is None:
        return None
    if hull.design_pressure_mpa is not None:
        return hull.design_pressure_mpa * 1e6
    return None if hull.depth_rating_m is None else hull.depth_rating_m * water.density_kg_m3 * water.gravity_m_s2
