"""Trim, both ways: from a wanted flight to the actuators, and from actuator settings to the flight that results."""

from collections.abc import Sequence
from dataclasses import dataclass
from math import isfinite, radians

import numpy as np

from stommel.analysis.flight import SteadyFlight, flight_from
from stommel.analysis.limits import (
    Excess,
    Reason,
    UnreachableFlightError,
    excesses,
    nearest_reachable,
)
from stommel.analysis.request import RequestError, check_angle, check_speed
from stommel.analysis.steady_equations import CONVERGED, QUANTITIES
from stommel.analysis.turning import turn_of_settings
from stommel.analysis.wings_level import TOO_SHALLOW, flight_of_settings, trim_into
from stommel.dynamics.packing import pack, reference_water
from stommel.dynamics.state import Water
from stommel.vehicle import PAPER, Physics, Vehicle


def trim(
    vehicle: Vehicle,
    *,
    speed_m_s: float,
    pitch_deg: float | None = None,
    glide_path_deg: float | None = None,
    physics: Physics = PAPER,
    water: Water | None = None,
    within_limits: bool = True,
) -> SteadyFlight:
    """Find the actuator settings of wings-level steady flight (section 3.1 of the paper).

    Parameters
    ----------
    vehicle
        The glider.
    speed_m_s
        Speed along the path.
    pitch_deg, glide_path_deg
        Exactly one of them; negative dives.
    physics
        The paper's model, or what the vehicle file adds to it.
    water
        Still water; the vehicle's reference water if left out.
    within_limits
        Refuse settings beyond the limits of the vehicle file.

    Raises
    ------
    RequestError
        A number is impossible.
    UnreachableFlightError
        The vehicle cannot fly this; with the reason and the nearest flight that it can.
    """
    if (pitch_deg is None) == (glide_path_deg is None):
        raise RequestError("give either a pitch or a glide path, not both and not neither")
    along_path = pitch_deg is None
    angle_deg = glide_path_deg if pitch_deg is None else pitch_deg
    assert angle_deg is not None
    name = "glide path" if along_path else "pitch"
    check_speed(speed_m_s)
    check_angle(name, angle_deg)
    water = water or reference_water(vehicle)
    record = pack(vehicle, physics)
    z = np.zeros(QUANTITIES)
    code = trim_into(record, float(speed_m_s), radians(angle_deg), along_path, water, z)
    wanted = f"speed {speed_m_s:g} m/s at {name} {angle_deg:g} deg is not reachable"
    if code != CONVERGED:
        nearest = nearest_reachable(vehicle, physics, water, speed_m_s, radians(angle_deg)) if within_limits else None
        if code == TOO_SHALLOW:
            why = "no angle of attack gives the lift for so shallow a path"
            raise UnreachableFlightError(f"{wanted}: {why}", (Reason.SHALLOW,), nearest)
        why = "the moving mass has no position that balances the pitching moment"
        raise UnreachableFlightError(f"{wanted}: {why}", (Reason.NO_EQUILIBRIUM,), nearest)
    flight = flight_from(record, z, water)
    broken = excesses(vehicle, flight) if within_limits else ()
    if broken:
        nearest = nearest_reachable(vehicle, physics, water, speed_m_s, flight.theta)
        raise _unreachable(wanted, broken, nearest)
    return flight


@dataclass(frozen=True)
class TrimRow:
    """A row of a trim table: the flight, and the limits of the vehicle file that it would break."""

    flight: SteadyFlight
    beyond: tuple[Excess, ...]


def trim_table(
    vehicle: Vehicle,
    *,
    speeds_m_s: Sequence[float],
    pitches_deg: Sequence[float],
    physics: Physics = PAPER,
    water: Water | None = None,
) -> list[TrimRow]:
    """Trim every pair of speed and pitch, as Tables 1 and 2 of the paper do.

    A flight beyond the actuators' limits stays in the table, with the limits it breaks: a table is for choosing them.

    Raises
    ------
    RequestError, UnreachableFlightError
        As `trim`, for flights that no settings could give.
    """
    rows = []
    for speed in speeds_m_s:
        for pitch in pitches_deg:
            flight = trim(vehicle, speed_m_s=speed, pitch_deg=pitch, physics=physics, water=water, within_limits=False)
            rows.append(TrimRow(flight, excesses(vehicle, flight)))
    return rows


def steady_flight(
    vehicle: Vehicle,
    *,
    moving_mass_mm: float,
    ballast_ml: float,
    rudder_deg: float = 0.0,
    roll_mass_deg: float = 0.0,
    physics: Physics = PAPER,
    water: Water | None = None,
    within_limits: bool = True,
) -> SteadyFlight:
    """Find the steady flight, straight or turning, that actuator settings give.

    Raises
    ------
    RequestError
        A number is impossible, or the vehicle lacks the actuator.
    LateralPlaneUnknownError
        A turn is asked of a vehicle whose lateral coefficients are unknown.
    UnreachableFlightError
        No steady flight, or settings beyond the limits of the vehicle file.
    """
    settings = {"moving mass": moving_mass_mm, "ballast": ballast_ml, "rudder": rudder_deg, "roll mass": roll_mass_deg}
    for name, value in settings.items():
        if not isfinite(value):
            raise RequestError(f"{name} = {value}: must be a finite number")
    water = water or reference_water(vehicle)
    record = pack(vehicle, physics)
    z = np.zeros(QUANTITIES)
    r_px, V_b = moving_mass_mm / 1e3, ballast_ml / 1e6
    if rudder_deg == 0.0 and roll_mass_deg == 0.0:
        code = flight_of_settings(record, r_px, V_b, water, z)
    else:
        vehicle.require_lateral("turning flight")
        _check_steering(vehicle, rudder_deg, roll_mass_deg)
        code = turn_of_settings(record, r_px, V_b, radians(rudder_deg), radians(roll_mass_deg), water, z)
    asked = f"moving mass {moving_mass_mm:g} mm, ballast {ballast_ml:g} ml"
    if rudder_deg:
        asked += f", rudder {rudder_deg:g} deg"
    if roll_mass_deg:
        asked += f", roll mass {roll_mass_deg:g} deg"
    if code != CONVERGED:
        why = "the vehicle is neutral and drifts" if V_b == 0.0 else "these settings balance in no steady flight"
        raise UnreachableFlightError(f"{asked}: {why}", (Reason.NO_EQUILIBRIUM,))
    flight = flight_from(record, z, water)
    broken = excesses(vehicle, flight) if within_limits else ()
    if broken:
        raise _unreachable(f"{asked} is not possible", broken, None)
    return flight


def _unreachable(wanted: str, broken: tuple[Excess, ...], nearest: SteadyFlight | None) -> UnreachableFlightError:
    reasons = tuple(excess.reason for excess in broken)
    return UnreachableFlightError(f"{wanted}: {'; '.join(map(str, broken))}", reasons, nearest)


def _check_steering(vehicle: Vehicle, rudder_deg: float, roll_mass_deg: float) -> None:
    d = vehicle.description
    if rudder_deg and d.rudder is None:
        raise RequestError(f"{vehicle.name} has no rudder; its file has no table [rudder]")
    if roll_mass_deg and d.moving_mass.offset_m == 0.0:
        raise RequestError(f"{vehicle.name} cannot roll its moving mass: moving_mass.offset_m is 0")
