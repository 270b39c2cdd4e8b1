"""Direct-current motor in steady running (docs/theory/drives)."""

from dataclasses import dataclass

from stommel.vehicle.schema.drives import DcMotor


@dataclass(frozen=True)
class Running:
    """A motor that turns steadily, or stands still because the load is too great."""

    torque: float
    """Torque at the shaft [N m]."""
    current: float
    """[A]."""
    speed: float
    """[rad/s]; 0 where it stalls."""
    power: float
    """Electrical power taken from the supply [W]."""

    @property
    def stalls(self) -> bool:
        """Whether the load holds the motor still."""
        return self.speed <= 0.0


@dataclass(frozen=True)
class Motor:
    """A motor on a supply. SI units."""

    K_t: float
    """Torque constant [N m/A], and voltage constant [V s/rad]."""
    R: float
    """Resistance of the winding [ohm]."""
    I_0: float
    """No-load current [A]."""
    U: float
    """Voltage of the supply [V]."""
    J: float
    """Moment of inertia of the rotor [kg m2]."""
    I_continuous: float
    """Current that it bears without end [A]."""

    @classmethod
    def on_supply(cls, data: DcMotor, supply_v: float | None) -> "Motor":
        """Take a motor's data from a vehicle file; without a supply it runs on its nominal voltage."""
        return cls(
            K_t=data.torque_constant_mn_m_a * 1e-3,
            R=data.resistance_ohm,
            I_0=data.no_load_current_a,
            U=data.nominal_voltage_v if supply_v is None else supply_v,
            J=data.rotor_inertia_g_cm2 * 1e-7,
            I_continuous=data.continuous_current_a,
        )

    @property
    def stall_current(self) -> float:
        """Current with the shaft held [A]."""
        return self.U / self.R

    @property
    def stall_torque(self) -> float:
        """Torque with the shaft held [N m]."""
        return self.K_t * (self.stall_current - self.I_0)

    @property
    def no_load_speed(self) -> float:
        """Speed without load [rad/s]."""
        return (self.U - self.R * self.I_0) / self.K_t

    def running(self, torque: float) -> Running:
        """Run steadily against `torque` at the shaft [N m]; a negative one drives the motor, which then brakes."""
        current = torque / self.K_t + self.I_0  # (eq-d1)
        speed = (self.U - self.R * current) / self.K_t  # (eq-d2)
        if speed <= 0.0:
            return Running(self.stall_torque, self.stall_current, 0.0, self.U * self.stall_current)
        # a driver without recuperation takes nothing back from a motor that is driven
        return Running(torque, current, speed, self.U * max(current, 0.0))
