"""From a vehicle file to the plant that the mission loop drives: actuators, consumers, battery."""

from math import inf, pi, radians
from typing import Any

import numpy as np

from stommel.design.energy import EnergyModel, energy_model
from stommel.errors import FileError, Problem
from stommel.simulation.parameters import (
    ALWAYS,
    CONDITIONS,
    CONSUMERS,
    MOVING,
    SURFACED,
    Array,
    Plant,
)
from stommel.vehicle import Vehicle, VehicleFile
from stommel.vehicle.schema import Consumer

_SLOPES = np.tan(np.radians(np.linspace(-80.0, 80.0, 33)))
_DEFAULT_MASS_SPEED = 5e-3
_DEFAULT_STEERING_SPEED = radians(10.0)
_SLOWEST = 1e-6
"""A drive that stalls on a slope still creeps [m/s], so that time goes on."""


def plant_of(vehicle: Vehicle) -> Plant:
    """Return the plant of a vehicle.

    Where the file describes engine, drives, consumers and battery, their own models give flow, speed and energy; where
    it does not, the actuators move at the speeds that the file states, and energy is not counted.

    Raises
    ------
    FileError
        The file gives no range or flow of the buoyancy engine, or nothing that steers.
    """
    d = vehicle.description
    model = energy_model(vehicle) if _tells_energy(d) else None
    return Plant(
        **_mass_drive(d, model),
        **_oil(vehicle, model),
        **_steering(vehicle, model),
        **_consumers(model),
    )


def _tells_energy(d: VehicleFile) -> bool:
    return d.battery is not None and d.energy is not None and bool(d.consumers)


def _mass_drive(d: VehicleFile, model: EnergyModel | None) -> dict[str, Any]:
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
    return {"mass_low": low, "mass_high": high, "slope": _SLOPES, "mass_speed": speed, "mass_j_m": joules}


def _oil(vehicle: Vehicle, model: EnergyModel | None) -> dict[str, Any]:
    engine = vehicle.description.actuators.buoyancy
    if engine is None:
        raise FileError(
            [Problem(vehicle.origin, "actuators.buoyancy", "[actuators.buoyancy] is missing: a mission needs it")]
        )
    low, high = engine.volume_m3
    if model is not None:
        work = model.works.pump
        strong = np.isfinite(work.inflating_j_m3)
        return {
            "pressure": work.pressure_pa,
            "pump_flow": np.where(strong, work.inflating_m3_s, 0.0),
            "pump_j_m3": np.where(strong, work.inflating_j_m3, 0.0),
            "valve_flow": work.deflating_m3_s,
            "valve_j_m3": work.deflating_j_m3,
            "ballast_low": low,
            "ballast_high": high,
        }
    if engine.flow_ml_s is None:
        key = "actuators.buoyancy.flow_ml_s"
        text = f"{key} is missing: a mission needs the flow of the pump, or the table [engine]"
        raise FileError([Problem(vehicle.origin, key, text)])
    flow = np.full(2, engine.flow_ml_s / 1e6)
    return {
        "pressure": np.array([0.0, 1e8]),
        "pump_flow": flow,
        "pump_j_m3": np.zeros(2),
        "valve_flow": flow,
        "valve_j_m3": np.zeros(2),
        "ballast_low": low,
        "ballast_high": high,
    }


def _steering(vehicle: Vehicle, model: EnergyModel | None) -> dict[str, Any]:
    d = vehicle.description
    rudder, roll = d.actuators.rudder, d.actuators.roll
    if d.rudder is not None and rudder is not None:
        speed = radians(rudder.speed_deg_s) if rudder.speed_deg_s else _DEFAULT_STEERING_SPEED
        energy = 0.0
        if model is not None and d.energy is not None and d.energy.rudder_turn_deg > 0.0:
            over_and_back = 2.0 * radians(d.energy.rudder_turn_deg)
            energy = float(model.works.rudder.turn(0.4)) / over_and_back
        return {
            "steers_by_mass": 0.0,
            "steering_speed": speed,
            "steering_limit": rudder.travel_rad,
            "steering_j_rad": energy,
        }
    if roll is not None and d.moving_mass.offset_m > 0.0:
        speed = radians(roll.speed_deg_s) if roll.speed_deg_s else _DEFAULT_STEERING_SPEED
        return {
            "steers_by_mass": 1.0,
            "steering_speed": speed,
            "steering_limit": min(roll.travel_rad, pi),
            "steering_j_rad": 0.0,
        }
    raise FileError(
        [
            Problem(
                vehicle.origin,
                "rudder",
                f"{vehicle.name} has nothing to steer a mission with: neither [rudder] and [actuators.rudder], nor "
                "[actuators.roll] and a moving mass off the axis",
            )
        ]
    )


def _consumers(model: EnergyModel | None) -> dict[str, Any]:
    power, surfacing = np.zeros((len(CONSUMERS), len(CONDITIONS))), np.zeros(len(CONSUMERS))
    if model is None:
        return {
            "power": power,
            "surfacing_energy": surfacing,
            "self_discharge": 0.0,
            "battery_energy": inf,
        }
    for consumer in model.consumers:
        efficiency = model.plan.regulator_efficiency if consumer.supply == "regulated" else 1.0
        _add(consumer, efficiency, power, surfacing)
    stored = model.stored
    return {
        "power": power,
        "surfacing_energy": surfacing,
        "self_discharge": stored.self_discharge_w,
        "battery_energy": stored.usable_j,
    }


def _add(consumer: Consumer, efficiency: float, power: Array, surfacing: Array) -> None:
    """Add one consumer: standby always, the rest when it is on."""
    i = CONSUMERS.index(consumer.part)
    power[i, ALWAYS] += consumer.standby_w / efficiency
    extra = consumer.power_w - consumer.standby_w
    if consumer.seconds_per_surfacing is not None:
        surfacing[i] += extra * consumer.seconds_per_surfacing / efficiency
        return
    columns = {"always": ALWAYS, "surface": SURFACED, "moving": MOVING}
    column = columns.get(consumer.on, CONDITIONS.index(consumer.on) if consumer.on in CONDITIONS else ALWAYS)
    power[i, column] += extra * consumer.share_on / efficiency
