"""Gears that turn a load into a torque at the motor: gearbox, worm gear, screw and nut (docs/theory/drives).

A load is positive where it opposes the motion and negative where it helps.
"""

from dataclasses import dataclass
from math import atan, cos, pi, radians, tan

from stommel.machinery.drives.failures import DriveError
from stommel.vehicle.schema.drives import Screw, WormGear


@dataclass(frozen=True)
class Helix:
    """A sliding thread: of a screw in its nut, or of a worm on its wheel."""

    lead_angle: float
    """Angle of the thread, gamma [rad]."""
    friction_angle: float
    """Angle of friction on the inclined flanks, rho = atan(mu / cos(alpha)) [rad]."""

    @property
    def efficiency(self) -> float:
        """Work out over work in, where the thread drives the load (eq-d4)."""
        return tan(self.lead_angle) / tan(self.lead_angle + self.friction_angle)

    @property
    def back_driving_efficiency(self) -> float:
        """Work out over work in, where the load drives the thread (eq-d5); not positive where it locks itself."""
        return tan(self.lead_angle - self.friction_angle) / tan(self.lead_angle)

    @property
    def self_locking(self) -> bool:
        """Whether no load, however great, turns the thread."""
        return self.friction_angle >= self.lead_angle

    def as_row(self) -> dict[str, float | bool]:
        """The thread in words."""
        return {
            "efficiency": self.efficiency,
            "back_driving_efficiency": self.back_driving_efficiency,
            "self_locking": self.self_locking,
        }

    def input_torque(self, ideal: float) -> float:
        """Torque that drives a load which would need `ideal` without friction [N m]."""
        return ideal / self.efficiency if ideal >= 0.0 else ideal * self.back_driving_efficiency  # (eq-d3)

    def at_rest(self, factor: float) -> "Helix":
        """Return this thread with the friction of rest, `factor` times that of motion."""
        return _helix(self.lead_angle, factor * tan(self.friction_angle), "static friction")


def worm_helix(worm: WormGear) -> Helix:
    """Thread of a worm."""
    return _helix(
        radians(worm.lead_angle_deg), worm.friction / cos(radians(worm.pressure_angle_deg)), "drives.pitch.worm"
    )


def screw_helix(screw: Screw) -> Helix:
    """Thread of a screw."""
    lead_angle = atan(screw.lead_mm / (pi * screw.pitch_diameter_mm))
    return _helix(lead_angle, screw.friction / cos(radians(screw.flank_angle_deg)), "drives.pitch.screw")


def _helix(lead_angle: float, friction: float, where: str) -> Helix:
    helix = Helix(lead_angle, atan(friction))
    if lead_angle + helix.friction_angle >= 0.5 * pi:
        raise DriveError(f"{where}: lead angle and friction are so great that the thread jams under any load")
    return helix


@dataclass(frozen=True)
class Gearbox:
    """Gears with one efficiency in both directions."""

    ratio: float
    efficiency: float

    def input_torque(self, load: float) -> float:
        """Torque at the motor's side for `load` at the other [N m]."""
        ideal = load / self.ratio
        return ideal / self.efficiency if ideal >= 0.0 else ideal * self.efficiency
