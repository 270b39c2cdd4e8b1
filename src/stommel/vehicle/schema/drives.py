"""What moves the moving mass and the rudder: motors, gears, screw, switches, brake (section 4.3.3 of the paper)."""

from typing import Annotated, Self

from pydantic import Field, model_validator

from stommel.files.fields import Table, ordered
from stommel.files.kinds import Flag
from stommel.files.ranges import (
    Current,
    Efficiency,
    NoLoadCurrent,
    Position,
    Power,
    RotorInertia,
    Share,
    TorqueConstant,
    Voltage,
    between,
)

LeadAngle = Annotated[float, Field(strict=True, ge=0.05, lt=45)]
Friction = Annotated[float, Field(strict=True, ge=0, lt=1)]
FlankAngle = Annotated[float, Field(strict=True, ge=0, lt=45)]


class DcMotor(Table):
    """Brushed direct-current motor, as its data sheet gives it."""

    torque_constant_mn_m_a: TorqueConstant
    """Torque per current; in SI units also the voltage per angular speed."""
    resistance_ohm: Annotated[float, between(0.001, 2000)]
    """Resistance of the winding between the terminals."""
    no_load_current_a: NoLoadCurrent
    """Current that the motor's own friction takes."""
    nominal_voltage_v: Voltage
    """Supply, where the vehicle file has no battery."""
    continuous_current_a: Current
    """Current that it bears without end."""
    rotor_inertia_g_cm2: RotorInertia
    """Moment of inertia of the rotor, by which it runs on after a switch has opened."""


class WormGear(Table):
    """Worm and worm wheel."""

    ratio: Annotated[float, between(1, 500)]
    """Turns of the worm for one of the wheel."""
    lead_angle_deg: LeadAngle
    """Angle of the worm's thread."""
    friction: Friction
    """Coefficient of sliding friction between worm and wheel."""
    pressure_angle_deg: FlankAngle = 20.0
    """Angle of the flanks."""


class Screw(Table):
    """Screw and sliding nut."""

    lead_mm: Annotated[float, between(0.05, 200)]
    """Travel of the nut in one turn."""
    pitch_diameter_mm: Annotated[float, between(0.5, 500)]
    """Diameter at which the flanks meet."""
    friction: Friction
    """Coefficient of sliding friction between screw and nut."""
    flank_angle_deg: FlankAngle = 15.0
    """Half the angle of the thread: 15 degrees for a trapezoidal thread, 0 for a square one."""


class PitchMachinery(Table):
    """Drive of the moving mass: motor, gearbox, worm gear, screw and nut, limit switches."""

    motor: DcMotor
    gearbox_ratio: Annotated[float, between(1, 50000)] = 1.0
    """Of a gearbox between motor and worm."""
    gearbox_efficiency: Efficiency = 1.0
    """Of that gearbox."""
    worm: WormGear | None = None
    screw: Screw
    guide_friction: Friction
    """Coefficient of friction between the moving mass and its guide."""
    static_friction_factor: Annotated[float, between(1, 5)] = 1.5
    """Friction at rest over friction in motion, in guide, screw and worm."""
    switches_mm: tuple[Position, Position]
    """Positions of the mass at which a limit switch cuts the motor off; outside the travel of the actuator."""
    stops_mm: tuple[Position, Position]
    """Positions of the mass at the mechanical end stops, outside the switches."""
    switch_delay_ms: Annotated[float, between(0, 5000)] = 0.0
    """From the opening of a switch until the motor is without current."""

    @model_validator(mode="after")
    def _limits_are_nested(self) -> Self:
        ordered("switches_mm", self.switches_mm)
        ordered("stops_mm", self.stops_mm)
        if not (self.stops_mm[0] < self.switches_mm[0] and self.switches_mm[1] < self.stops_mm[1]):
            raise ValueError(
                f"stops_mm = {list(self.stops_mm)}: must lie outside switches_mm = {list(self.switches_mm)}"
            )
        return self


class Brake(Table):
    """Electromagnetic brake on the shaft of the motor."""

    holding_torque_mn_m: Annotated[float, between(0.01, 1e5)]
    """Torque that it holds."""
    power_w: Power
    """Power while its coil is fed."""
    release_ms: Annotated[float, between(0, 5000)]
    """From feeding the coil until the shaft is free."""
    normally_closed: Flag = True
    """Whether it holds without power; otherwise it must be fed to hold."""


class RudderMachinery(Table):
    """Drive of the rudder: blade, stock with its seal, gearbox, motor, brake."""

    chord_mm: Annotated[float, between(5, 2000)]
    """Chord of the blade."""
    span_mm: Annotated[float, between(5, 3000)] | None = None
    """Height of the blade, from the hull or its own root to the tip."""
    stock_chord_fraction: Share
    """Where the stock passes through the blade: distance from the leading edge over the chord."""
    seal_friction_mn_m: Annotated[float, between(0, 1e5)]
    """Friction of seal and bearings at the stock."""
    motor: DcMotor
    gearbox_ratio: Annotated[float, between(1, 50000)]
    """Turns of the motor for one of the stock."""
    gearbox_efficiency: Efficiency
    """Of that gearbox."""
    brake: Brake | None = None


class Drives(Table):
    """Drives of moving mass and rudder; a drive that is not designed yet may be left out."""

    pitch: PitchMachinery | None = None
    rudder: RudderMachinery | None = None
