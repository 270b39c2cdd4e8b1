"""From a wanted turn to the settings that fly it."""

from dataclasses import dataclass
from math import isfinite, radians
from typing import Literal

import numpy as np

from stommel.analysis.flight import SteadyFlight, flight_from
from stommel.analysis.limits import Excess, Reason, UnreachableFlightError, excesses
from stommel.analysis.request import RequestError, check_angle, check_roll, check_speed
from stommel.analysis.steady_equations import CONVERGED, DELTA_R, MU, QUANTITIES
from stommel.analysis.trim import trim
from stommel.analysis.turning import turn_into
from stommel.dynamics.packing import pack, reference_water
from stommel.seawater.water import Water
from stommel.vehicle import PAPER, Physics, Vehicle
from stommel.vehicle.missing_table import missing_table

Steering = Literal["rudder", "roll"]


def turn(
    vehicle: Vehicle,
    *,
    speed_m_s: float,
    pitch_deg: float,
    turn_rate_rad_s: float | None = None,
    radius_m: float | None = None,
    by: Steering | None = None,
    physics: Physics = PAPER,
    water: Water | None = None,
    within_limits: bool = True,
) -> SteadyFlight:
    """Find the settings of a wanted turn.

    Parameters
    ----------
    turn_rate_rad_s, radius_m
        Exactly one of them; positive to starboard.
    by
        What steers: the rudder or the rolling mass; the one that the vehicle has if left out, the rudder if it has
        both.

    Raises
    ------
    RequestError
        A number is impossible, or the vehicle lacks the actuator.
    LateralPlaneUnknownError
        The vehicle's lateral coefficients are unknown.
    UnreachableFlightError
        No such turn, or settings beyond the limits of the vehicle file; with the tightest turn that works.
    """
    if (turn_rate_rad_s is None) == (radius_m is None):
        raise RequestError("give either a turn rate or a radius, not both and not neither")
    wanted = turn_rate_rad_s if radius_m is None else radius_m
    assert wanted is not None
    by_radius = radius_m is not None
    name, unit = ("radius", "m") if by_radius else ("turn rate", "rad/s")
    if not isfinite(wanted) or wanted == 0.0:
        raise RequestError(f"{name} = {wanted} {unit}: must be a finite number other than zero")
    check_speed(speed_m_s)
    check_angle("pitch", pitch_deg)
    vehicle.require_lateral("turning flight")
    water = water or reference_water(vehicle)
    steering = _steering(vehicle, by)
    question = _Turn(vehicle, physics, water, speed_m_s, radians(pitch_deg), wanted, by_radius, steering, within_limits)
    flight, broken = question.at(1.0)
    if flight is not None and not broken:
        return flight
    tightest = question.tightest()
    if tightest is None:
        # not even straight: say why
        trim(
            vehicle,
            speed_m_s=speed_m_s,
            pitch_deg=pitch_deg,
            physics=physics,
            water=water,
            within_limits=within_limits,
        )
    asked = f"speed {speed_m_s:g} m/s at pitch {pitch_deg:g} deg with {name} {wanted:g} {unit}"
    why = "; ".join(map(str, broken)) or "no steady turn so tight"
    reasons = tuple(excess.reason for excess in broken) or (Reason.NO_EQUILIBRIUM,)
    raise UnreachableFlightError(f"{asked} is not reachable: {why}", reasons, tightest)


@dataclass(frozen=True)
class _Turn:
    """A wanted turn, of which a share can be asked for: of its turn rate, or of its curvature."""

    vehicle: Vehicle
    physics: Physics
    water: Water
    speed: float
    theta: float
    wanted: float
    by_radius: bool
    steering: int
    within_limits: bool

    def at(self, share: float) -> tuple[SteadyFlight | None, tuple[Excess, ...]]:
        """Return the turn at a share of what is wanted, None if there is none, and the limits that it breaks."""
        z = np.zeros(QUANTITIES)
        rate, curvature = (0.0, share / self.wanted) if self.by_radius else (share * self.wanted, 0.0)
        record = pack(self.vehicle, self.physics)
        code = turn_into(record, float(self.speed), self.theta, rate, curvature, self.steering, self.water, z)
        if code != CONVERGED:
            return None, ()
        flight = flight_from(record, z, self.water)
        return flight, excesses(self.vehicle, flight) if self.within_limits else ()

    def tightest(self) -> SteadyFlight | None:
        """Return the tightest turn towards the wanted one that works."""
        low, high = 0.0, 1.0
        found: SteadyFlight | None = None
        for _ in range(40):
            middle = 0.5 * (low + high)
            flight, broken = self.at(middle)
            if flight is not None and not broken:
                low, found = middle, flight
            else:
                high = middle
        return found


def _steering(vehicle: Vehicle, by: Steering | None) -> int:
    d = vehicle.description
    if by is None and d.rudder is None and d.actuators.roll is None:
        raise RequestError(f"{vehicle.name} can steer neither by rudder nor by rolling its moving mass")
    if by is None:
        by = "rudder" if d.rudder is not None else "roll"
    if by == "rudder" and d.rudder is None:
        raise RequestError(f"{vehicle.name} has no rudder; its file has no table [rudder]; {missing_table('rudder')}")
    if by == "roll":
        check_roll(vehicle)
    return DELTA_R if by == "rudder" else MU
