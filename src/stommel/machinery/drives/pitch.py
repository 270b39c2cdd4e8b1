"""Drive of the moving mass at an attitude of the hull: load, torque, speed, power, energy per travel."""

from dataclasses import dataclass, replace
from math import cos, degrees, isinf, pi, sin
from typing import Literal

from stommel.machinery.drives.failures import DriveError
from stommel.machinery.drives.gears import Gearbox, Helix, screw_helix, worm_helix
from stommel.machinery.drives.motor import Motor, Running
from stommel.vehicle import Vehicle
from stommel.vehicle.missing_table import missing_table

Direction = Literal[-1, 1]
"""+1 moves the mass forward, -1 aft."""


@dataclass(frozen=True)
class PitchPoint:
    """The drive in one direction at one pitch."""

    theta: float
    """Pitch [rad]; negative is nose down."""
    direction: Direction
    load: float
    """Force along the screw against the motion [N]; negative helps it."""
    motor: Running
    speed: float
    """Speed of the mass [m/s], without sign; 0 where the motor stalls."""
    starting_torque: float
    """Torque at the motor that breaks the mass loose from rest [N m]."""
    stall_margin: float
    """Torque that the motor has at rest over the one that it needs; infinite where it needs none."""

    @property
    def uphill(self) -> bool:
        """Whether the mass is lifted."""
        return self.direction * sin(self.theta) > 0.0

    @property
    def starts(self) -> bool:
        """Whether the motor breaks the mass loose from rest."""
        return self.stall_margin > 1.0

    @property
    def energy_per_metre(self) -> float | None:
        """Electrical energy for a metre of travel [J/m]; None where the motor stalls."""
        return self.motor.power / self.speed if self.speed > 0.0 else None

    def as_row(self) -> dict[str, float | str | bool | None]:
        """Words with units; no margin where the load helps, no energy of a motor that stalls."""
        energy = self.energy_per_metre
        return {
            "pitch_deg": round(degrees(self.theta), 9),
            "direction": "forward" if self.direction > 0 else "aft",
            "uphill": self.uphill,
            "load_n": self.load,
            "torque_mn_m": self.motor.torque * 1e3,
            "current_a": self.motor.current,
            "speed_mm_s": self.speed * 1e3,
            "power_w": self.motor.power,
            "energy_j_per_mm": None if energy is None else energy / 1e3,
            "starting_torque_mn_m": self.starting_torque * 1e3,
            "stall_margin": None if isinf(self.stall_margin) else self.stall_margin,
            "starts": self.starts,
        }


@dataclass(frozen=True)
class PitchDrive:
    """Motor, gearbox, worm gear, screw and nut, and the mass on its guide. SI units."""

    motor: Motor
    gearbox: Gearbox
    worm: Helix | None
    worm_ratio: float
    screw: Helix
    lead: float
    """Travel in one turn of the screw [m]."""
    m_p: float
    """Moving mass [kg]."""
    g: float
    """[m/s2]."""
    guide_friction: float
    static_friction_factor: float

    @classmethod
    def of(cls, vehicle: Vehicle) -> "PitchDrive":
        """Build the drive of a vehicle.

        Raises
        ------
        DriveError
            The file has no table [drives.pitch], or a thread that jams.
        """
        d = vehicle.description
        if d.drives is None or d.drives.pitch is None:
            raise DriveError(
                f"{vehicle.origin}: has no table [drives.pitch], which describes the drive of the mass; "
                f"{missing_table('drives.pitch')}"
            )
        data = d.drives.pitch
        return cls(
            motor=Motor.on_supply(data.motor, d.battery.voltage_v if d.battery else None),
            gearbox=Gearbox(data.gearbox_ratio, data.gearbox_efficiency),
            worm=worm_helix(data.worm) if data.worm else None,
            worm_ratio=data.worm.ratio if data.worm else 1.0,
            screw=screw_helix(data.screw),
            lead=data.screw.lead_mm * 1e-3,
            m_p=d.moving_mass.mass_kg,
            g=d.water.gravity_m_s2,
            guide_friction=data.guide_friction,
            static_friction_factor=data.static_friction_factor,
        )

    @property
    def travel_per_radian(self) -> float:
        """Travel of the mass for an angle of the motor [m/rad]."""
        return self.lead / (2.0 * pi * self.worm_ratio * self.gearbox.ratio)

    @property
    def efficiency(self) -> float:
        """Work on an opposing load over work of the motor's shaft."""
        worm = self.worm.efficiency if self.worm else 1.0
        return self.gearbox.efficiency * worm * self.screw.efficiency

    @property
    def self_locking(self) -> bool:
        """Whether the mass stays where it is without power: one thread that locks itself is enough."""
        return self.screw.self_locking or (self.worm is not None and self.worm.self_locking)

    def load(self, theta: float, direction: Direction) -> float:
        """Force against the motion at pitch `theta` [rad]: weight along the axis and friction of the guide [N]."""
        weight = self.m_p * self.g
        return direction * weight * sin(theta) + self.guide_friction * weight * cos(theta)  # (eq-d6)

    def motor_torque(self, load: float) -> float:
        """Torque at the motor's shaft for a force against the motion, stage by stage [N m] (eq-d7)."""
        wheel = self.screw.input_torque(load * self.lead / (2.0 * pi))
        worm = wheel / self.worm_ratio if self.worm is None else self.worm.input_torque(wheel / self.worm_ratio)
        return self.gearbox.input_torque(worm)

    def thrust(self, torque: float) -> float:
        """Force on an opposing load for a torque at the motor [N]."""
        return torque * self.efficiency / self.travel_per_radian

    def at_rest(self) -> "PitchDrive":
        """Return this drive with the friction of rest."""
        factor = self.static_friction_factor
        return replace(
            self,
            worm=self.worm.at_rest(factor) if self.worm else None,
            screw=self.screw.at_rest(factor),
            guide_friction=factor * self.guide_friction,
        )

    def point(self, theta: float, direction: Direction) -> PitchPoint:
        """Run the mass in `direction` at pitch `theta` [rad]."""
        load = self.load(theta, direction)
        motor = self.motor.running(self.motor_torque(load))
        rest = self.at_rest()
        starting = rest.motor_torque(rest.load(theta, direction))
        margin = self.motor.stall_torque / starting if starting > 0.0 else float("inf")
        return PitchPoint(theta, direction, load, motor, motor.speed * self.travel_per_radian, starting, margin)
