"""What keeps the moving mass within its travel: software limits, switches, end stops; and what an over-run does."""

from dataclasses import dataclass
from math import inf, isinf
from typing import Literal

from stommel.machinery.drives.pitch import Direction, PitchDrive
from stommel.vehicle import Vehicle

Zone = Literal["within travel", "beyond software limit", "on the switch", "at the end stop"]


@dataclass(frozen=True)
class LimitSwitches:
    """Limits of the mass from the inside outwards [m], aft end first in each pair."""

    travel: tuple[float, float]
    """Limits that the software keeps: the travel of the actuator."""
    switches: tuple[float, float]
    """Where a switch cuts the motor off."""
    stops: tuple[float, float]
    """Where the mass meets metal."""
    delay: float
    """From the opening of a switch until the motor is without current [s]."""

    @classmethod
    def of(cls, vehicle: Vehicle) -> "LimitSwitches | None":
        """Limits of a vehicle; None if its file lacks the travel or the drive."""
        d = vehicle.description
        if d.actuators.moving_mass is None or d.drives is None or d.drives.pitch is None:
            return None
        data = d.drives.pitch
        return cls(
            d.actuators.moving_mass.travel_m,
            (data.switches_mm[0] / 1e3, data.switches_mm[1] / 1e3),
            (data.stops_mm[0] / 1e3, data.stops_mm[1] / 1e3),
            data.switch_delay_ms / 1e3,
        )

    def zone(self, r_px: float) -> Zone:
        """Where the mass at `r_px` [m] is."""
        if not self.stops[0] < r_px < self.stops[1]:
            return "at the end stop"
        if not self.switches[0] < r_px < self.switches[1]:
            return "on the switch"
        return "within travel" if self.travel[0] <= r_px <= self.travel[1] else "beyond software limit"

    def may_move(self, r_px: float, direction: Direction) -> bool:
        """Whether the mass at `r_px` may move that way: beyond a limit, only back inwards."""
        inwards: Direction = 1 if r_px < 0.5 * (self.travel[0] + self.travel[1]) else -1
        return self.zone(r_px) == "within travel" or direction == inwards


@dataclass(frozen=True)
class OverRun:
    """What happens at one end if the software fails to stop the mass, and if the switch fails too."""

    direction: Direction
    switch: float
    """Position of the switch [m]."""
    stop: float
    """Position of the end stop [m]."""
    run_on: float
    """Farthest that the mass moves after the switch opened, without electrical braking [m]."""
    stall_thrust: float
    """Force on the end stop if the switch fails and the motor stalls against it [N]."""
    stall_current: float
    """Current in that case [A]."""

    @property
    def room(self) -> float:
        """From switch to end stop [m]."""
        return abs(self.stop - self.switch)

    @property
    def caught(self) -> bool:
        """Whether the switch stops the mass before the end stop does."""
        return self.run_on < self.room

    def as_row(self) -> dict[str, float | str | bool | None]:
        """Words with units; no way of a mass that nothing slows down."""
        return {
            "end": "forward" if self.direction > 0 else "aft",
            "switch_mm": self.switch * 1e3,
            "stop_mm": self.stop * 1e3,
            "run_on_mm": None if isinf(self.run_on) else self.run_on * 1e3,
            "caught": self.caught,
            "stall_thrust_n": self.stall_thrust,
            "stall_current_a": self.stall_current,
        }


def over_run(drive: PitchDrive, limits: LimitSwitches, direction: Direction, steepest: float) -> OverRun:
    """Run into the limit in `direction`, at the pitch within +-`steepest` [rad] that carries the mass farthest."""
    end = 1 if direction > 0 else 0
    run_on = max(_run_on(drive, limits.delay, direction, theta) for theta in (-steepest, 0.0, steepest))
    return OverRun(
        direction,
        limits.switches[end],
        limits.stops[end],
        run_on,
        drive.thrust(drive.motor.stall_torque),
        drive.motor.stall_current,
    )


def _run_on(drive: PitchDrive, delay: float, direction: Direction, theta: float) -> float:
    """Way at full speed during the delay, then coasting of the rotor against load and its own friction (eq-d9)."""
    point = drive.point(theta, direction)
    slowing = point.motor.torque + drive.motor.K_t * drive.motor.I_0
    if slowing <= 0.0:
        return inf  # the load keeps it turning
    coasting = 0.5 * drive.motor.J * point.motor.speed**2 / slowing
    return point.speed * delay + coasting * drive.travel_per_radian
