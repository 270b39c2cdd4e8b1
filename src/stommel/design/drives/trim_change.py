"""Time and energy of the move of the mass from dive to climb, or back."""

from dataclasses import dataclass
from math import degrees, radians, tan

import numpy as np

from stommel.analysis.flight import SteadyFlight
from stommel.machinery.drives.pitch import Direction, PitchDrive

STEPS = 200


@dataclass(frozen=True)
class TrimChange:
    """A move of the mass between two steady flights."""

    start: SteadyFlight
    end: SteadyFlight
    time: float
    """[s], with the pitch following the mass."""
    energy: float
    """[J], likewise."""
    longest_time: float
    """[s], if the pitch stayed the worse of the two for the whole move."""
    greatest_energy: float
    """[J], likewise."""

    @property
    def travel(self) -> float:
        """Distance that the mass moves [m]."""
        return abs(self.end.r_px - self.start.r_px)

    @property
    def mean_speed(self) -> float:
        """[m/s]."""
        return self.travel / self.time

    def as_row(self) -> dict[str, float]:
        """Words with units."""
        return {
            "from_pitch_deg": degrees(self.start.theta),
            "to_pitch_deg": degrees(self.end.theta),
            "from_mm": self.start.r_px * 1e3,
            "to_mm": self.end.r_px * 1e3,
            "travel_mm": self.travel * 1e3,
            "time_s": self.time,
            "energy_j": self.energy,
            "mean_speed_mm_s": self.mean_speed * 1e3,
            "longest_time_s": self.longest_time,
            "greatest_energy_j": self.greatest_energy,
        }


def trim_change(drive: PitchDrive, start: SteadyFlight, end: SteadyFlight) -> TrimChange | None:
    """Move the mass from one flight's trim to another's; None if the motor stalls on the way.

    While the mass moves, the pitch passes through the equilibria in between: tan(theta) goes in proportion to the
    position (eq-d8).
    """
    direction: Direction = 1 if end.r_px > start.r_px else -1
    share = np.linspace(0.0, 1.0, STEPS + 1)
    pitches = np.arctan(tan(start.theta) + share * (tan(end.theta) - tan(start.theta)))
    points = [drive.point(float(theta), direction) for theta in pitches]
    if any(point.speed <= 0.0 for point in points):
        return None
    travel = abs(end.r_px - start.r_px)
    slowness = np.array([1.0 / point.speed for point in points])
    power = np.array([point.motor.power for point in points])
    time, energy = (travel * float(np.trapezoid(rate, share)) for rate in (slowness, power * slowness))
    return TrimChange(
        start,
        end,
        time,
        energy,
        longest_time=travel * float(slowness.max()),
        greatest_energy=travel * float((power * slowness).max()),
    )


def pitches_between(low_deg: float, high_deg: float, step_deg: float) -> list[float]:
    """Pitches of a table [rad], both ends included."""
    count = round((high_deg - low_deg) / step_deg)
    return [radians(low_deg + k * (high_deg - low_deg) / count) for k in range(count + 1)]
