"""Where the costs of the actuators come from: the drives that the file describes, otherwise an efficiency."""

from collections.abc import Iterator
from dataclasses import dataclass
from functools import lru_cache
from math import radians
from typing import Literal

import numpy as np

from stommel.machinery.drives import PitchDrive, RudderDrive
from stommel.machinery.power.actuator_work import PitchDriveWork, PumpWork, RudderWork
from stommel.machinery.power.engine_work import pump_by_engine
from stommel.vehicle import Vehicle
from stommel.vehicle.schema import EnergyPlan

Actuator = Literal["pump", "pitch", "rudder"]
ACTUATORS: tuple[Actuator, ...] = ("pump", "pitch", "rudder")

PRESSURES = 41
PITCHES = np.radians(np.linspace(-88.0, 88.0, 89))
SPEEDS_SQUARE = np.array([0.0, 1.0, 6.25])
"""Squares of the speeds at which the rudder's cost is tabulated [m2/s2]; its hinge moment is linear in them."""

PLAN_KEYS: dict[Actuator, frozenset[str]] = {
    "pump": frozenset({"pump_efficiency", "pump_idle_power_w", "valve_power_w"}),
    "pitch": frozenset({"pitch_drive_efficiency", "pitch_drive_idle_power_w"}),
    "rudder": frozenset({"rudder_turn_j"}),
}
"""Keys of the table [energy] that stand for an actuator which the file does not describe."""


@dataclass(frozen=True)
class ActuatorWorks:
    """Costs of the three actuators."""

    pump: PumpWork
    pitch: PitchDriveWork
    rudder: RudderWork

    def scaled(self, actuator: Actuator, factor: float) -> "ActuatorWorks":
        """Return the same actuators with the energies of one of them multiplied."""
        pump, pitch, rudder = self.pump, self.pitch, self.rudder
        match actuator:
            case "pump":
                pump = pump.scaled(factor)
            case "pitch":
                pitch = pitch.scaled(factor)
            case "rudder":
                rudder = rudder.scaled(factor)
        return ActuatorWorks(pump, pitch, rudder)


@dataclass(frozen=True)
class ActuatorModels:
    """Builds the costs of a vehicle's actuators, each by the best description that its file has."""

    vehicle: Vehicle
    deepest_pa: float
    """Pressure that the cost of the pump is tabulated to [Pa]."""

    @property
    def described(self) -> frozenset[Actuator]:
        """Actuators that the file describes as machines."""
        drives = self.vehicle.description.drives
        found: set[Actuator] = set()
        if self.vehicle.description.engine is not None:
            found.add("pump")
        if drives is not None and drives.pitch is not None:
            found.add("pitch")
        if drives is not None and drives.rudder is not None and self.vehicle.description.rudder is not None:
            found.add("rudder")
        return frozenset(found)

    def works(self, plan: EnergyPlan) -> ActuatorWorks:
        """Costs under a plan."""
        return ActuatorWorks(self.pump(plan), self.pitch(plan), self.rudder(plan))

    def pump(self, plan: EnergyPlan) -> PumpWork:
        """Cost of moving oil."""
        engine = self.vehicle.description.engine
        if engine is not None:
            return pump_by_engine(engine, self.deepest_pa)
        return pump_by_efficiency(self.vehicle, plan, self.deepest_pa)

    def pitch(self, plan: EnergyPlan) -> PitchDriveWork:
        """Cost of moving the mass."""
        if "pitch" in self.described:
            return pitch_drive_by_machinery(self.vehicle)
        return pitch_drive_by_efficiency(self.vehicle, plan)

    def rudder(self, plan: EnergyPlan) -> RudderWork:
        """Cost of steering."""
        if "rudder" in self.described:
            return rudder_by_machinery(self.vehicle, plan)
        return rudder_by_energy(self.vehicle, plan)

    def lacking(self) -> Iterator[tuple[str, str]]:
        """Yield (key, what to do) of what the costs need and the file does not say."""
        d = self.vehicle.description
        plan, engine, drive = d.energy, d.actuators.buoyancy, d.actuators.moving_mass
        described = self.described
        if engine is None:
            yield "[actuators.buoyancy]", "endurance needs it, with volume_ml and flow_ml_s"
        elif engine.flow_ml_s is None and "pump" not in described:
            yield "actuators.buoyancy.flow_ml_s", "endurance needs the flow of the pump"
        if drive is None:
            yield "[actuators.moving_mass]", "endurance needs it, with travel_mm and speed_mm_s"
        elif drive.speed_mm_s is None and "pitch" not in described:
            yield "actuators.moving_mass.speed_mm_s", "endurance needs the speed of the drive"
        if plan is None:
            return
        if plan.pump_efficiency is None and "pump" not in described:
            yield "energy.pump_efficiency", "endurance needs it where the file does not describe the engine, 0 to 1"
        if plan.pitch_drive_efficiency is None and "pitch" not in described:
            yield "energy.pitch_drive_efficiency", "endurance needs it without a table [drives.pitch], 0 to 1"
        if plan.rudder_turns_per_dive > 0.0 and plan.rudder_turn_j is None and "rudder" not in described:
            yield "energy.rudder_turn_j", "endurance needs it without a table [drives.rudder]"


def pump_by_efficiency(vehicle: Vehicle, plan: EnergyPlan, deepest_pa: float) -> PumpWork:
    """Pressure work over an efficiency, and an idle power while the pump runs at its rated flow (eq-e6)."""
    engine = vehicle.description.actuators.buoyancy
    assert engine is not None
    assert engine.flow_ml_s is not None
    assert plan.pump_efficiency is not None
    P = np.linspace(0.0, deepest_pa, PRESSURES)
    flow = np.full_like(P, engine.flow_ml_s / 1e6)
    return PumpWork(
        pressure_pa=P,
        inflating_j_m3=P / plan.pump_efficiency + plan.pump_idle_power_w / flow,
        inflating_m3_s=flow,
        deflating_j_m3=plan.valve_power_w / flow,
        deflating_m3_s=flow,
        origin="energy.pump_efficiency and energy.pump_idle_power_w",
        starting_j=np.zeros_like(P),
    )


def pitch_drive_by_machinery(vehicle: Vehicle) -> PitchDriveWork:
    """The drive that [drives.pitch] describes; infinite cost where its motor stalls."""
    return _pitch_table(PitchDrive.of(vehicle))


@lru_cache(maxsize=64)
def _pitch_table(drive: PitchDrive) -> PitchDriveWork:
    points = [drive.point(float(theta), 1) for theta in PITCHES]
    slowness = [1.0 / point.speed if point.speed > 0.0 else np.inf for point in points]
    costs = [point.energy_per_metre for point in points]
    return PitchDriveWork(
        slope=np.tan(PITCHES),
        forward_j_m=np.array([np.inf if cost is None else cost for cost in costs]),
        forward_s_m=np.array(slowness),
        origin="the table drives.pitch",
    )


def pitch_drive_by_efficiency(vehicle: Vehicle, plan: EnergyPlan) -> PitchDriveWork:
    """Lifting over an efficiency, nothing back when lowering, and an idle power while the drive runs (eq-e7)."""
    d = vehicle.description
    drive = d.actuators.moving_mass
    assert drive is not None
    assert drive.speed_mm_s is not None
    assert plan.pitch_drive_efficiency is not None
    slowness = np.full_like(PITCHES, 1e3 / drive.speed_mm_s)
    lift = d.moving_mass.mass_kg * d.water.gravity_m_s2 * np.sin(PITCHES)
    return PitchDriveWork(
        slope=np.tan(PITCHES),
        forward_j_m=np.maximum(lift, 0.0) / plan.pitch_drive_efficiency + plan.pitch_drive_idle_power_w * slowness,
        forward_s_m=slowness,
        origin="energy.pitch_drive_efficiency and energy.pitch_drive_idle_power_w",
    )


def rudder_by_machinery(vehicle: Vehicle, plan: EnergyPlan) -> RudderWork:
    """The drive that [drives.rudder] describes; infinite cost where its motor stalls."""
    return _rudder_table(RudderDrive.of(vehicle), radians(plan.rudder_turn_deg), plan.rudder_hold_s)


@lru_cache(maxsize=64)
def _rudder_table(drive: RudderDrive, angle: float, hold: float) -> RudderWork:
    if angle == 0.0:
        return RudderWork(SPEEDS_SQUARE, np.zeros_like(SPEEDS_SQUARE), 0.0, "the table drives.rudder")
    turns = [drive.turn(angle, float(np.sqrt(square)), hold) for square in SPEEDS_SQUARE]
    still = turns[0]
    return RudderWork(
        speed_square=SPEEDS_SQUARE,
        turn_j=np.array([np.inf if turn is None else turn.energy for turn in turns]),
        turn_s=np.inf if still is None else still.out.time + still.back.time,
        origin="the table drives.rudder",
    )


def rudder_by_energy(vehicle: Vehicle, plan: EnergyPlan) -> RudderWork:
    """One stated energy for putting the rudder over and back."""
    drive = vehicle.description.actuators.rudder
    speed = drive.speed_deg_s if drive is not None else None
    return RudderWork(
        speed_square=np.array([0.0]),
        turn_j=np.array([plan.rudder_turn_j or 0.0]),
        turn_s=2.0 * plan.rudder_turn_deg / speed if speed else 0.0,
        origin="energy.rudder_turn_j",
    )
