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
    clamped,
    excesses,
    nearest_reachable,
)
from stommel.analysis.request import RequestError, check_angle, check_roll, check_speed
from stommel.analysis.steady_equations import CONVERGED, QUANTITIES
from stommel.analysis.turning import turn_of_settings
from stommel.analysis.wings_level import TOO_SHALLOW, flight_of_settings, trim_into
from stommel.dynamics.packing import pack, reference_water
from stommel.seawater.water import Water
from stommel.vehicle import PAPER, Physics, Vehicle
from stommel.vehicle.missing_table import missing_table


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

    def nearest_to() -> SteadyFlight | None:
        return nearest_reachable(vehicle, physics, water, speed_m_s, radians(angle_deg), along_path=along_path)

    if code != CONVERGED:
        nearest = nearest_to() if within_limits else None
        if code == TOO_SHALLOW:
            why = "no angle of attack gives the lift for so shallow a path"
            raise UnreachableFlightError(f"{wanted}: {why}", (Reason.SHALLOW,), nearest)
        why = "the moving mass has no position that balances the pitching moment"
        raise UnreachableFlightError(f"{wanted}: {why}", (Reason.NO_EQUILIBRIUM,), nearest)
    flight = flight_from(record, z, water)
    broken = excesses(vehicle, flight) if within_limits else ()
    if broken:
        raise _unreachable(wanted, broken, nearest_to())
    return flight


@dataclass(frozen=True)
class TrimRow:
    """A row of a trim table: the flight, and the limits of the vehicle file that it would break."""

    flight: SteadyFlight
    beyond: tuple[Excess, ...]

    def as_row(self) -> dict[str, object]:
        """The row in words with units."""
        return {**self.flight.as_row(), "beyond_limits": [str(excess) for excess in self.beyond]}


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
    if rudder_deg or roll_mass_deg:
        vehicle.require_lateral("turning flight")
        _check_steering(vehicle, rudder_deg, roll_mass_deg)
    water = water or reference_water(vehicle)
    record = pack(vehicle, physics)
    flight = _flight_of(record, tuple(settings.values()), water)
    asked = f"moving mass {moving_mass_mm:g} mm, ballast {ballast_ml:g} ml"
    if rudder_deg:
        asked += f", rudder {rudder_deg:g} deg"
    if roll_mass_deg:
        asked += f", roll mass {roll_mass_deg:g} deg"
    broken = excesses(vehicle, flight) if flight is not None and within_limits else ()
    if flight is not None and not broken:
        return flight
    nearest = _nearest_settings(vehicle, record, tuple(settings.values()), water) if within_limits else None
    if flight is None:
        neutral = water.rho * (record.V_0 + ballast_ml / 1e6) == record.m
        why = "the vehicle is neutral and drifts" if neutral else "these settings balance in no steady flight"
        raise UnreachableFlightError(f"{asked}: {why}", (Reason.NO_EQUILIBRIUM,), nearest)
    raise _unreachable(f"{asked} is not possible", broken, nearest)


Settings = tuple[float, ...]
"""Moving mass [mm], ballast [ml], rudder [deg], roll mass [deg]."""


def _flight_of(record: np.record, settings: Settings, water: Water) -> SteadyFlight | None:
    """Find the steady flight of four actuator settings, if they have one."""
    z = np.zeros(QUANTITIES)
    r_px, V_b = settings[0] / 1e3, settings[1] / 1e6
    delta_r, mu = radians(settings[2]), radians(settings[3])
    if delta_r == 0.0 and mu == 0.0:
        code = flight_of_settings(record, r_px, V_b, water, z)
    else:
        code = turn_of_settings(record, r_px, V_b, delta_r, mu, water, z)
    return flight_from(record, z, water) if code == CONVERGED else None


def _nearest_settings(vehicle: Vehicle, record: np.record, settings: Settings, water: Water) -> SteadyFlight | None:
    """Flight of the settings that keep within the limits: each cut at its own, then rudder and roll taken back."""
    cut = clamped(vehicle, settings)

    def at(share: float) -> SteadyFlight | None:
        flight = _flight_of(record, (cut[0], cut[1], share * cut[2], share * cut[3]), water)
        return flight if flight is not None and not excesses(vehicle, flight) else None

    nearest, low, high = at(1.0), 0.0, 1.0
    if nearest is not None or (nearest := at(0.0)) is None:
        return nearest
    for _ in range(30):
        middle = 0.5 * (low + high)
        trial = at(middle)
        low, high, nearest = (middle, high, trial) if trial is not None else (low, middle, nearest)
    return nearest


def _unreachable(wanted: str, broken: tuple[Excess, ...], nearest: SteadyFlight | None) -> UnreachableFlightError:
    reasons = tuple(excess.reason for excess in broken)
    return UnreachableFlightError(f"{wanted}: {'; '.join(map(str, broken))}", reasons, nearest)


def _check_steering(vehicle: Vehicle, rudder_deg: float, roll_mass_deg: float) -> None:
    d = vehicle.description
    if rudder_deg and d.rudder is None:
        raise RequestError(f"{vehicle.name} has no rudder; its file has no table [rudder]; {missing_table('rudder')}")
    if roll_mass_deg:
        check_roll(vehicle)
