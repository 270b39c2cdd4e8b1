"""What stands in the way of a flight: travel, volume, stall, unknown coefficients, or the equations themselves."""

from dataclasses import dataclass
from enum import Enum
from math import degrees, inf, radians

import numpy as np

from stommel.analysis.flight import SteadyFlight, flight_from
from stommel.analysis.steady_equations import ALPHA, CONVERGED, QUANTITIES, R_PX, V_B, V
from stommel.analysis.wings_level import trim_many
from stommel.dynamics.packing import pack
from stommel.errors import StommelError
from stommel.seawater.water import Water
from stommel.vehicle import Physics, Vehicle

SPEED_WEIGHT = 1 / 0.1
ANGLE_WEIGHT = 1 / radians(5.0)
"""Nearness of flights: 0.1 m/s counts as much as 5 degrees."""


_SLACK = 1e-9
"""A limit is met when it is missed by no more than rounding [mm, ml, deg]."""


class Reason(Enum):
    """Why a flight is out of reach."""

    TRAVEL = "moving-mass travel"
    VOLUME = "ballast volume"
    RUDDER = "rudder travel"
    ROLL = "roll travel of the moving mass"
    STALL = "stall"
    SHALLOW = "path too shallow"
    NO_EQUILIBRIUM = "no equilibrium"


@dataclass(frozen=True)
class Excess:
    """One limit that a flight would break."""

    reason: Reason
    quantity: str
    needed: float
    low: float
    high: float
    unit: str

    def __str__(self) -> str:
        if self.reason is Reason.STALL:
            return f"{self.quantity} {self.needed:.1f} {self.unit} is beyond stall at {self.high:g} {self.unit}"
        return (
            f"needs {self.quantity} {self.needed:.1f} {self.unit}, "
            f"but the limits are {self.low:g} to {self.high:g} {self.unit}"
        )


class UnreachableFlightError(StommelError):
    """A wanted flight that the vehicle cannot fly: the reasons, and the nearest flight that it can."""

    def __init__(self, message: str, reasons: tuple[Reason, ...], nearest: SteadyFlight | None = None) -> None:
        self.reasons = reasons
        self.nearest = nearest
        if nearest is not None:
            message += f"; nearest reachable: {_in_words(nearest)}"
        super().__init__(message)


def _in_words(flight: SteadyFlight) -> str:
    turning = f"turn rate {flight.turn_rate:.5g} rad/s, radius {flight.radius:.4g} m, " if flight.turn_rate else ""
    settings = f"moving mass {flight.r_px * 1e3:.1f} mm, ballast {flight.V_b * 1e6:.1f} ml"
    if flight.delta_r:
        settings += f", rudder {degrees(flight.delta_r):.2f} deg"
    if flight.mu:
        settings += f", roll mass {degrees(flight.mu):.2f} deg"
    return (
        f"{turning}speed {flight.V:.3f} m/s at pitch {degrees(flight.theta):.2f} deg, "
        f"glide path {degrees(flight.gamma):.2f} deg ({settings})"
    )


def excesses(vehicle: Vehicle, flight: SteadyFlight) -> tuple[Excess, ...]:
    """Limits of the vehicle file that `flight` breaks; none where the file gives no limit."""
    actuators, stall = vehicle.description.actuators, vehicle.description.hydrodynamics.stall_begins_deg
    checks: list[Excess] = []

    def check(reason: Reason, quantity: str, value: float, low: float, high: float, unit: str) -> None:
        if not low - _SLACK <= value <= high + _SLACK:
            checks.append(Excess(reason, quantity, value, low, high, unit))

    if actuators.moving_mass is not None:
        check(Reason.TRAVEL, "the moving mass at", flight.r_px * 1e3, *actuators.moving_mass.travel_mm, "mm")
    if actuators.buoyancy is not None:
        check(Reason.VOLUME, "a ballast volume of", flight.V_b * 1e6, *actuators.buoyancy.range_ml, "ml")
    if actuators.rudder is not None:
        travel = actuators.rudder.travel_deg
        check(Reason.RUDDER, "a rudder angle of", degrees(flight.delta_r), -travel, travel, "deg")
    if actuators.roll is not None:
        travel = actuators.roll.travel_deg
        check(Reason.ROLL, "the moving mass rolled by", degrees(flight.mu), -travel, travel, "deg")
    check(Reason.STALL, "angle of attack", degrees(flight.alpha), -stall, stall, "deg")
    check(Reason.STALL, "sideslip", degrees(flight.beta), -stall, stall, "deg")
    return tuple(checks)


def clamped(vehicle: Vehicle, settings: tuple[float, ...]) -> tuple[float, ...]:
    """Cut moving mass [mm], ballast [ml], rudder [deg] and roll mass [deg] at the limits of the vehicle file."""
    a = vehicle.description.actuators
    rudder, roll = (drive.travel_deg if drive else inf for drive in (a.rudder, a.roll))
    limits = (
        a.moving_mass.travel_mm if a.moving_mass else (-inf, inf),
        a.buoyancy.range_ml if a.buoyancy else (-inf, inf),
        (-rudder, rudder),
        (-roll, roll),
    )
    return tuple(min(max(value, low), high) for value, (low, high) in zip(settings, limits, strict=True))


def reachable(vehicle: Vehicle, flights: np.ndarray, codes: np.ndarray) -> np.ndarray:
    """Which of many wings-level flights (N x 10) are within the limits of the vehicle file."""
    actuators, stall = vehicle.description.actuators, radians(vehicle.description.hydrodynamics.stall_begins_deg)
    low, high = actuators.moving_mass.travel_m if actuators.moving_mass else (-inf, inf)
    least, most = actuators.buoyancy.volume_m3 if actuators.buoyancy else (-inf, inf)
    r_px, V_b = flights[:, R_PX], flights[:, V_B]
    within: np.ndarray = (
        (codes == CONVERGED)
        & (r_px >= low)
        & (r_px <= high)
        & (V_b >= least)
        & (V_b <= most)
        & (np.abs(flights[:, ALPHA]) <= stall)
    )
    return within


def nearest_reachable(
    vehicle: Vehicle, physics: Physics, water: Water, speed: float, angle: float, *, along_path: bool
) -> SteadyFlight | None:
    """Return the reachable wings-level flight nearest to `speed` [m/s] and pitch `angle` [rad], if there is any.

    With `along_path` the angle is that of the glide path.

    A grid over all speeds and pitches, then finer grids about the best: reachable regions need be neither convex nor
    whole.
    """
    record = pack(vehicle, physics)
    side = -1.0 if angle <= 0.0 else 1.0
    speeds, angles = np.linspace(0.02, 2.5, 63), side * np.radians(np.linspace(1.0, 89.0, 89))
    best: np.ndarray | None = None
    for _ in range(6):
        V_grid, angle_grid = (grid.ravel() for grid in np.meshgrid(speeds, angles))
        flights = np.zeros((len(V_grid), QUANTITIES))
        codes = trim_many(record, V_grid, angle_grid, along_path, water, flights)
        within = reachable(vehicle, flights, codes)
        if not within.any():
            break
        distance = np.hypot(SPEED_WEIGHT * (V_grid - speed), ANGLE_WEIGHT * (angle_grid - angle))
        k = int(np.argmin(np.where(within, distance, inf)))
        best = flights[k]
        # shrink by less than a grid cell each time: the neighbours of the best stay inside
        speeds = np.clip(best[V] + (speeds[1] - speeds[0]) * np.linspace(-1, 1, 13), 1e-3, None)
        angles = angle_grid[k] + (angles[1] - angles[0]) * np.linspace(-1, 1, 13)
    return None if best is None else flight_from(record, best, water)
