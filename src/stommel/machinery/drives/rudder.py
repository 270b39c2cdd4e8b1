"""Drive of the rudder: hinge moment, step, holding brake, energy of a turn."""

from dataclasses import dataclass
from math import copysign, degrees, sin

import numpy as np

from stommel.machinery.drives.failures import DriveError
from stommel.machinery.drives.gears import Gearbox
from stommel.machinery.drives.motor import Motor, Running
from stommel.vehicle import Vehicle
from stommel.vehicle.missing_table import missing_table
from stommel.vehicle.schema.drives import Brake

STEPS = 120


def centre_of_pressure(delta_r: float) -> float:
    """Where the force of a blade at the angle `delta_r` [rad] acts: chord from the leading edge (eq-d11).

    Joessel's rule for flat plates, 0 to 90 degrees.
    """
    return 0.195 + 0.305 * sin(abs(delta_r))


@dataclass(frozen=True)
class RudderStep:
    """A move of the rudder from one angle to another."""

    start: float
    """[rad]."""
    end: float
    """[rad]."""
    time: float
    """[s], without the brake's release."""
    energy: float
    """Electrical energy of the motor [J]."""
    greatest_torque: float
    """Greatest torque at the motor [N m]."""
    greatest_current: float
    """[A]."""

    def as_row(self) -> dict[str, float]:
        """Words with units."""
        return {
            "from_deg": degrees(self.start),
            "to_deg": degrees(self.end),
            "time_s": self.time,
            "energy_j": self.energy,
            "greatest_torque_mn_m": self.greatest_torque * 1e3,
            "greatest_current_a": self.greatest_current,
        }


@dataclass(frozen=True)
class RudderTurn:
    """A turn of the vehicle: release, put the rudder over, hold, release, put it back."""

    angle: float
    """[rad]."""
    hold: float
    """Time that the rudder is held over [s]."""
    out: RudderStep
    back: RudderStep
    brake_per_release: float
    """Energy of the brake for one release and one move [J], the greater of the two."""
    brake_energy: float
    """Energy of the brake in the whole turn [J]."""
    hold_energy: float
    """Energy to hold the rudder over [J]: none with a normally closed brake."""

    @property
    def energy(self) -> float:
        """Energy of the whole turn [J]."""
        return self.out.energy + self.back.energy + self.brake_energy + self.hold_energy

    def as_row(self) -> dict[str, float]:
        """Words with units."""
        return {
            "angle_deg": degrees(self.angle),
            "hold_s": self.hold,
            "energy_j": self.energy,
            "motor_energy_j": self.out.energy + self.back.energy,
            "brake_energy_j": self.brake_energy,
            "brake_energy_per_release_j": self.brake_per_release,
            "hold_energy_j": self.hold_energy,
        }


@dataclass(frozen=True)
class RudderDrive:
    """Motor, brake, gearbox, stock with its seal, and blade. SI units."""

    motor: Motor
    gearbox: Gearbox
    brake: Brake | None
    chord: float
    """[m]."""
    stock: float
    """Chord from the leading edge to the stock, over the chord."""
    seal_friction: float
    """[N m]."""
    Y_r: float
    """Slope of the side force [kg/m], times V^2."""

    @classmethod
    def of(cls, vehicle: Vehicle) -> "RudderDrive":
        """Build the drive of a vehicle's rudder.

        Raises
        ------
        DriveError
            The file has no table [drives.rudder] or no table [rudder].
        """
        d = vehicle.description
        if d.drives is None or d.drives.rudder is None:
            raise DriveError(
                f"{vehicle.origin}: has no table [drives.rudder], which describes the rudder's drive; "
                f"{missing_table('drives.rudder')}"
            )
        if d.rudder is None:
            raise DriveError(
                f"{vehicle.origin}: [drives.rudder] needs the table [rudder], which gives the side force; "
                f"{missing_table('rudder')}"
            )
        data = d.drives.rudder
        return cls(
            motor=Motor.on_supply(data.motor, d.battery.voltage_v if d.battery else None),
            gearbox=Gearbox(data.gearbox_ratio, data.gearbox_efficiency),
            brake=data.brake,
            chord=data.chord_mm * 1e-3,
            stock=data.stock_chord_fraction,
            seal_friction=data.seal_friction_mn_m * 1e-3,
            Y_r=d.rudder.side_force_per_rad_kg_m,
        )

    def hinge_moment(self, delta_r: float, V: float) -> float:
        """Moment of the water about the stock [N m], positive where it turns the rudder back to zero.

        The force is the one of the equations of motion, linear in the angle: beyond stall a rudder carries less, so
        this is an upper bound there.
        """
        force = self.Y_r * abs(delta_r) * V**2  # (eq-d10)
        return force * self.chord * (centre_of_pressure(delta_r) - self.stock)  # (eq-d12)

    def running(self, delta_r: float, V: float, outwards: bool) -> Running:
        """Move through the angle `delta_r` [rad] at the speed `V` [m/s], away from zero or back."""
        hinge = self.hinge_moment(delta_r, V)
        load = (hinge if outwards else -hinge) + self.seal_friction  # (eq-d13)
        return self.motor.running(self.gearbox.input_torque(load))

    def step(self, start: float, end: float, V: float) -> RudderStep | None:
        """Move from `start` to `end` [rad]; None if the motor stalls on the way."""
        angles = start + (np.arange(STEPS) + 0.5) / STEPS * (end - start)
        sense = copysign(1.0, end - start)
        points = [self.running(float(angle), V, angle * sense > 0.0) for angle in angles]
        if any(point.stalls for point in points):
            return None
        times = [abs(end - start) / STEPS * self.gearbox.ratio / point.speed for point in points]
        return RudderStep(
            start,
            end,
            sum(times),
            sum(time * point.power for time, point in zip(times, points, strict=True)),
            max(point.torque for point in points),
            max(point.current for point in points),
        )

    def holding_margin(self, delta_r: float, V: float) -> float | None:
        """What the brake holds over what the water asks of it; None without a brake. Friction is not counted on."""
        if self.brake is None:
            return None
        held = self.brake.holding_torque_mn_m * 1e-3 * self.gearbox.ratio
        moment = abs(self.hinge_moment(delta_r, V))
        return held / moment if moment > 0.0 else float("inf")

    def turn(self, angle: float, V: float, hold: float) -> RudderTurn | None:
        """Put the rudder over to `angle` [rad], hold it for `hold` [s], put it back; None if the motor stalls."""
        out, back = self.step(0.0, angle, V), self.step(angle, 0.0, V)
        if out is None or back is None:
            return None
        per_release, brake_energy, hold_energy = 0.0, 0.0, 0.0
        if self.brake is not None:
            power, release = self.brake.power_w, self.brake.release_ms / 1e3
            if self.brake.normally_closed:
                moves = [power * (release + step.time) for step in (out, back)]
                per_release, brake_energy = max(moves), sum(moves)
            else:
                hold_energy = power * hold
        else:
            hold_energy = self._stalled_power(angle, V) * hold
        return RudderTurn(angle, hold, out, back, per_release, brake_energy, hold_energy)

    def _stalled_power(self, angle: float, V: float) -> float:
        """Power that holds the rudder by the motor alone, its friction not counted on [W]."""
        moment = abs(self.hinge_moment(angle, V))
        return self.motor.R * (moment / self.gearbox.ratio / self.motor.K_t) ** 2
