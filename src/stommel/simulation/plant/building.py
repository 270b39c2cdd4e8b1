"""From a vehicle file to the plant that the mission loop drives: actuators, consumers, battery."""

from math import inf, nan, pi, radians

import numpy as np

from stommel.errors import FileError, Problem
from stommel.machinery.hull.floating import hull_form
from stommel.machinery.power import EnergyModel, energy_model
from stommel.simulation.plant.parameters import (
    ALWAYS,
    CONDITIONS,
    CONSUMERS,
    MOVING,
    SAMPLING,
    SENSORS,
    SURFACED,
    UNDERWATER,
    Array,
    Battery,
    Engine,
    Loads,
    MassDrive,
    Plant,
    SteeringDrive,
)
from stommel.vehicle import Vehicle, VehicleFile
from stommel.vehicle.schema import Consumer

_SLOPES = np.tan(np.radians(np.linspace(-80.0, 80.0, 33)))
_DEFAULT_MASS_SPEED = 5e-3
_DEFAULT_STEERING_SPEED = radians(10.0)
_SLOWEST = 1e-6
"""A drive that stalls on a slope still creeps [m/s], so that time goes on."""


def plant_of(vehicle: Vehicle, temperature_c: float | None = None) -> Plant:
    """Return the plant of a vehicle whose battery is as warm as the water of its dives; the reference water's if None.

    Where the file describes engine, drives, consumers and battery, their own models give flow, speed and energy; where
    it does not, the actuators move at the speeds that the file states, and energy is not counted. Sensors
    that run under water are on while the software commands to sample.

    Raises
    ------
    FileError
        The file gives no range or flow of the buoyancy engine, or nothing that steers.
    """
    d = vehicle.description
    model = energy_model(vehicle, temperature_c=temperature_c) if _tells_energy(d) else None
    return Plant(
        mass=_mass_drive(d, model),
        engine=_engine(vehicle, model),
        steering=_steering(vehicle, model),
        loads=_loads(model),
        battery=_battery(vehicle, model),
        antenna=d.antenna.position_m if d.antenna is not None else (nan, nan, nan),
        form=hull_form(d),
        drop_weight=0.0 if d.drop_weight is None else d.drop_weight.mass_in_water_kg,
    )


def _tells_energy(d: VehicleFile) -> bool:
    return d.battery is not None and d.energy is not None and bool(d.consumers)


def _mass_drive(d: VehicleFile, model: EnergyModel | None) -> MassDrive:
    drive = d.actuators.moving_mass
    low, high = drive.travel_m if drive is not None else (-inf, inf)
    if model is not None:
        work = model.works.pitch
        seconds = np.interp(_SLOPES, work.slope, work.forward_s_m)
        joules = np.interp(_SLOPES, work.slope, work.forward_j_m)
        speed = np.where(np.isfinite(seconds), 1.0 / seconds, _SLOWEST)
        joules = np.where(np.isfinite(joules), joules, 0.0)
    else:
        stated = drive.speed_mm_s / 1e3 if drive is not None and drive.speed_mm_s else _DEFAULT_MASS_SPEED
        speed, joules = np.full(len(_SLOPES), stated), np.zeros(len(_SLOPES))
    return MassDrive(low, high, _SLOPES, speed, joules)


def _engine(vehicle: Vehicle, model: EnergyModel | None) -> Engine:
    engine = vehicle.description.actuators.buoyancy
    if engine is None:
        raise FileError(
            [Problem(vehicle.origin, "actuators.buoyancy", "[actuators.buoyancy] is missing: a mission needs it")]
        )
    low, high = engine.volume_m3
    if model is not None:
        work = model.works.pump
        strong = np.isfinite(work.inflating_j_m3)
        return Engine(
            pressure=work.pressure_pa,
            pump_flow=np.where(strong, work.inflating_m3_s, 0.0),
            pump_j_m3=np.where(strong, work.inflating_j_m3, 0.0),
            valve_flow=work.deflating_m3_s,
            valve_j_m3=work.deflating_j_m3,
            low=low,
            high=high,
        )
    if engine.flow_ml_s is None:
        key = "actuators.buoyancy.flow_ml_s"
        text = f"{key} is missing: a mission needs the flow of the pump, or the table [engine]"
        raise FileError([Problem(vehicle.origin, key, text)])
    flow = np.full(2, engine.flow_ml_s / 1e6)
    return Engine(
        pressure=np.array([0.0, 1e8]),
        pump_flow=flow,
        pump_j_m3=np.zeros(2),
        valve_flow=flow,
        valve_j_m3=np.zeros(2),
        low=low,
        high=high,
    )


def _steering(vehicle: Vehicle, model: EnergyModel | None) -> SteeringDrive:
    d = vehicle.description
    if d.steers_by is None:
        text = (
            f"{vehicle.name} has nothing to steer a mission with: neither [rudder] and [actuators.rudder], nor "
            "[actuators.roll] and a moving mass off the axis"
        )
        raise FileError([Problem(vehicle.origin, "rudder", text)])
    drive = d.actuators.rudder if d.steers_by == "rudder" else d.actuators.roll
    assert drive is not None
    energy = 0.0
    if d.steers_by == "rudder" and model is not None and d.energy is not None and d.energy.rudder_turn_deg > 0.0:
        over_and_back = 2.0 * radians(d.energy.rudder_turn_deg)
        energy = float(model.works.rudder.turn(0.4)) / over_and_back
    return SteeringDrive(
        by_mass=float(d.steers_by == "roll"),
        speed=radians(drive.speed_deg_s) if drive.speed_deg_s else _DEFAULT_STEERING_SPEED,
        limit=min(drive.travel_rad, pi),
        j_rad=energy,
    )


def _loads(model: EnergyModel | None) -> Loads:
    power, calls = np.zeros((len(CONSUMERS), len(CONDITIONS))), []
    for consumer in model.consumers if model is not None else ():
        assert model is not None
        efficiency = model.plan.regulator_efficiency if consumer.supply == "regulated" else 1.0
        _add(consumer, efficiency, power)
        if consumer.seconds_per_surfacing is not None:
            extra = (consumer.power_w - consumer.standby_w) / efficiency
            calls.append((CONSUMERS.index(consumer.part), extra, consumer.seconds_per_surfacing))
    # what measures under water is on while the software samples
    power[SENSORS, SAMPLING], power[SENSORS, UNDERWATER] = power[SENSORS, UNDERWATER], 0.0
    return Loads(
        power=power,
        call_consumer=np.array([consumer for consumer, _, _ in calls], dtype=np.int64),
        call_power=np.array([watts for _, watts, _ in calls], dtype=float),
        call_seconds=np.array([seconds for _, _, seconds in calls], dtype=float),
    )


def _add(consumer: Consumer, efficiency: float, power: Array) -> None:
    """Add one consumer: standby always, the rest when it is on; one that runs for a time at each surfacing is not."""
    i = CONSUMERS.index(consumer.part)
    power[i, ALWAYS] += consumer.standby_w / efficiency
    if consumer.seconds_per_surfacing is None:
        columns = {"always": ALWAYS, "surface": SURFACED, "moving": MOVING}
        column = columns.get(consumer.on, CONDITIONS.index(consumer.on) if consumer.on in CONDITIONS else ALWAYS)
        power[i, column] += (consumer.power_w - consumer.standby_w) * consumer.share_on / efficiency


_LITHIUM_POLYMER = np.array([3.27, 3.61, 3.69, 3.73, 3.77, 3.79, 3.82, 3.87, 3.92, 4.02, 4.11, 4.20])
"""Voltage of a cell at rest over its charge [V]: a typical cell, as an assumption."""
_CHARGE = np.array([0.0, 0.05, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0])


def _battery(vehicle: Vehicle, model: EnergyModel | None) -> Battery:
    """Voltage over charge: the shape is the chemistry's, the mean over the discharge the vehicle file's."""
    d = vehicle.description
    if d.battery is None or model is None:
        stated = d.battery.voltage_v if d.battery is not None else nan
        open_voltage, whole, usable, resistance = np.full(len(_CHARGE), stated), inf, inf, 0.0
    else:
        cell = _LITHIUM_POLYMER if d.battery.chemistry == "lithium polymer" else np.ones(len(_CHARGE))
        open_voltage = cell * d.battery.voltage_v / np.trapezoid(cell, _CHARGE)
        usable = model.stored.usable_j
        whole = usable / (d.battery.usable_fraction or 1.0)
        resistance = d.battery.internal_resistance_ohm
    return Battery(
        energy=usable,
        self_discharge=model.stored.self_discharge_w if model is not None else 0.0,
        charge=_CHARGE,
        open_voltage=open_voltage,
        resistance=resistance,
        whole_energy=whole,
    )
