"""What moves the moving mass and the rudder: motors, gears, screw, switches, brake (section 4.3.3 of the paper)."""

from typing import Annotated, Self

from pydantic import Field, model_validator

from stommel.files.fields import Interval, NotNegative, Positive, Table, ordered

Share = Annotated[float, Field(strict=True, ge=0, le=1)]
Efficiency = Annotated[float, Field(strict=True, gt=0, le=1)]
LeadAngle = Annotated[float, Field(strict=True, gt=0, lt=45)]
Friction = Annotated[float, Field(strict=True, ge=0, lt=1)]
FlankAngle = Annotated[float, Field(strict=True, ge=0, lt=45)]


class DcMotor(Table):
    """Brushed direct-current motor, as its data sheet gives it."""

    torque_constant_mn_m_a: Positive
    """Torque per current; in SI units also the voltage per angular speed."""
    resistance_ohm: Positive
    """Resistance of the winding between the terminals."""
    no_load_current_a: NotNegative
    """Current that the motor's own friction takes."""
    nominal_voltage_v: Positive
    """Supply, where the vehicle file has no battery."""
    continuous_current_a: Positive
    """Current that it bears without end."""
    rotor_inertia_g_cm2: Positive
    """Moment of inertia of the rotor, by which it runs on after a switch has opened."""


class WormGear(Table):
    """Worm and worm wheel."""

    ratio: Annotated[float, Field(strict=True, ge=1)]
    """Turns of the worm for one of the wheel."""
    lead_angle_deg: LeadAngle
    """Angle of the worm's thread."""
    friction: Friction
    """Coefficient of sliding friction between worm and wheel."""
    pressure_angle_deg: FlankAngle = 20.0
    """Angle of the flanks."""


class Screw(Table):
    """Screw and sliding nut."""

    lead_mm: Positive
    """Travel of the nut in one turn."""
    pitch_diameter_mm: Positive
    """Diameter at which the flanks meet."""
    friction: Friction
    """Coefficient of sliding friction between screw and nut."""
    flank_angle_deg: FlankAngle = 15.0
    """Half the angle of the thread: 15 degrees for a trapezoidal thread, 0 for a square one."""


class PitchMachinery(Table):
    """Drive of the moving mass: motor, gearbox, worm gear, screw and nut, limit switches."""

    motor: DcMotor
    gearbox_ratio: Annotated[float, Field(strict=True, ge=1)] = 1.0
    """Of a gearbox between motor and worm."""
    gearbox_efficiency: Efficiency = 1.0
    """Of that gearbox."""
    worm: WormGear | None = None
    screw: Screw
    guide_friction: Friction
    """Coefficient of friction between the moving mass and its guide."""
    static_friction_factor: Annotated[float, Field(strict=True, ge=1, le=5)] = 1.5
    """Friction at rest over friction in motion, in guide, screw and worm."""
    switches_mm: Interval
    """Positions of the mass at which a limit switch cuts the motor off; outside the travel of the actuator."""
    stops_mm: Interval
    """Positions of the mass at the mechanical end stops, outside the switches."""
    switch_delay_ms: NotNegative = 0.0
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

    holding_torque_mn_m: Positive
    """Torque that it holds."""
    power_w: NotNegative
    """Power while its coil is fed."""
    release_ms: NotNegative
    """From feeding the coil until the shaft is free."""
    normally_closed: bool = True
    """Whether it holds without power; otherwise it must be fed to hold."""


class RudderMachinery(Table):
    """Drive of the rudder: blade, stock with its seal, gearbox, motor, brake."""

    chord_mm: Positive
    """Chord of the blade."""
    span_mm: Positive | None = None
    """Height of the blade, from the hull or its own root to the tip."""
    stock_chord_fraction: Share
    """Where the stock passes through the blade: distance from the leading edge over the chord."""
    seal_friction_mn_m: NotNegative
    """Friction of seal and bearings at the stock."""
    motor: DcMotor
    gearbox_ratio: Annotated[float, Field(strict=True, ge=1)]
    """Turns of the motor for one of the stock."""
    gearbox_efficiency: Efficiency
    """Of that gearbox."""
    brake: Brake | None = None


class Drives(Table):
    """Drives of moving mass and rudder; a drive that is not designed yet may be left out."""

    pitch: PitchMachinery | None = None
    rudder: RudderMachinery | None = None
