"""The hydraulic circuit of the file against what the file says of the buoyancy engine as an actuator."""

from collections.abc import Iterator
from math import prod

from stommel.design.named_warning import NamedWarning
from stommel.machinery.engine.cycle import simulate
from stommel.vehicle import Vehicle
from stommel.vehicle.schema import Engine

VOLUME_SLACK = 1e-3
FLOW_ABOVE, FLOW_BELOW = 1.02, 0.5
"""A stated flow above that of the circuit without losses is impossible; one below half of it is another engine's."""


def engine_agreement(vehicle: Vehicle) -> Iterator[NamedWarning]:
    """Volume, flow, and whether it inflates at the greatest depth."""
    d = vehicle.description
    if d.engine is None:
        return
    yield from _stalls(vehicle, d.engine)
    stated = d.actuators.buoyancy
    if stated is None:
        return
    span, working = stated.volume_ml[1] - stated.volume_ml[0], d.engine.measured_piston.working_volume_ml
    if span > working * (1.0 + VOLUME_SLACK):
        yield NamedWarning(
            "engine_volume_short",
            f"actuators.buoyancy.volume_ml = {list(stated.volume_ml)} spans {span:g} ml; the engine moves "
            f"{working:.1f} ml over the working range of {d.engine.sensor.measures!r}",
        )
    flow = flow_without_losses_ml_s(d.engine)
    if flow is not None and stated.flow_ml_s is not None and not FLOW_BELOW <= stated.flow_ml_s / flow <= FLOW_ABOVE:
        yield NamedWarning(
            "engine_flow_differs",
            f"actuators.buoyancy.flow_ml_s = {stated.flow_ml_s:g}; the engine moves {flow:.3g} ml/s without any loss",
        )


def flow_without_losses_ml_s(engine: Engine) -> float | None:
    """Flow of the inflating engine by its geometry alone [ml/s]; None if nothing drives the oil."""
    rpm = engine.ideal_pump_speed_rpm
    if rpm is None:
        rpm = abs(engine.inflate.motor_speed_rpm) / prod(box.ratio for box in engine.gearboxes)
    if engine.pumps:
        return sum(pump.displacement_ml_r for pump in engine.pumps) * rpm / 60.0
    if engine.screws and engine.cylinders:
        return engine.cylinders[0].area_m2 * engine.screws[0].lead_mm / 1e3 * 1e6 * rpm / 60.0
    return None


def _stalls(vehicle: Vehicle, engine: Engine) -> Iterator[NamedWarning]:
    """Begin an inflation at the greatest depth that the file names."""
    d = vehicle.description
    depths = [d.hull.depth_rating_m if d.hull else None, d.specification.depth_m if d.specification else None]
    depth = max((depth for depth in depths if depth is not None), default=None)
    if depth is None:
        return
    pressure = d.water.density_kg_m3 * d.water.gravity_m_s2 * depth
    little = 0.02 * engine.measured_piston.working_volume_ml / 1e6
    if simulate(engine, pressure_pa=pressure, inflate_m3=little).stalled:
        yield NamedWarning(
            "engine_stalls",
            f"the engine does not inflate at {depth:g} m, where the sea presses with {pressure / 1e6:.3g} MPa",
        )
