"""Flight envelope: what actuator ranges reach, and which ranges a wanted region needs (section 3.1 of the paper)."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from math import ceil, degrees, radians

import numpy as np
from numpy.typing import NDArray

from stommel.analysis.flight import SteadyFlight, flight_from
from stommel.analysis.limits import Reason, excesses, reachable
from stommel.analysis.request import RequestError
from stommel.analysis.steady_equations import ALPHA, CONVERGED, QUANTITIES, R_PX
from stommel.analysis.trim import trim
from stommel.analysis.wings_level import trim_at_ballast
from stommel.dynamics.packing import pack, reference_water
from stommel.seawater.water import Water
from stommel.vehicle import PAPER, Physics, Vehicle
from stommel.vehicle.missing_table import missing_table


@dataclass(frozen=True)
class EnvelopeRow:
    """Speeds that the vehicle reaches at one pitch; none if `slowest` is None."""

    pitch_deg: float
    slowest: SteadyFlight | None
    fastest: SteadyFlight | None
    limited_by: str
    """What stops the vehicle from flying faster at this pitch."""

    def as_row(self) -> dict[str, object]:
        """The row in words with units; null where no speed is reachable."""
        slow, fast = self.slowest, self.fastest
        return {
            "pitch_deg": self.pitch_deg,
            "minimum_speed_m_s": slow.V if slow else None,
            "maximum_speed_m_s": fast.V if fast else None,
            "maximum_horizontal_speed_m_s": fast.horizontal_speed if fast else None,
            "moving_mass_position_mm": fast.r_px * 1e3 if fast else None,
            "ballast_volume_ml": fast.V_b * 1e6 if fast else None,
            "limited_by": self.limited_by,
        }


def flight_envelope(
    vehicle: Vehicle,
    *,
    pitches_deg: Sequence[float] | None = None,
    physics: Physics = PAPER,
    water: Water | None = None,
) -> list[EnvelopeRow]:
    """Find the speeds that the vehicle's actuator ranges reach at each pitch, diving and climbing.

    Raises
    ------
    RequestError
        The vehicle file gives no range of ballast volume.
    """
    engine = vehicle.description.actuators.buoyancy
    if engine is None:
        raise RequestError(
            f"{vehicle.name}: an envelope needs the table [actuators.buoyancy] with volume_ml; "
            f"{missing_table('actuators.buoyancy')}"
        )
    if pitches_deg is None:
        steep = [1.0, 2.0, 3.0, 4.0, *range(5, 90, 5), 88.0]
        pitches_deg = [*(-p for p in reversed(steep)), *steep]
        return _with_pitch_limits(vehicle, pitches_deg, physics, water)
    water = water or reference_water(vehicle)
    record = pack(vehicle, physics)
    low, high = engine.volume_m3
    return [_envelope_row(vehicle, record, water, float(pitch), low if pitch <= 0 else high) for pitch in pitches_deg]


def _with_pitch_limits(
    vehicle: Vehicle, pitches_deg: Sequence[float], physics: Physics, water: Water | None
) -> list[EnvelopeRow]:
    """Rows at the given pitches, and at the last reachable pitch wherever reach begins or ends between two of them."""

    def row_at(pitch: float) -> EnvelopeRow:
        (row,) = flight_envelope(vehicle, pitches_deg=[pitch], physics=physics, water=water)
        return row

    rows = [row_at(float(pitch)) for pitch in pitches_deg]
    complete = rows[:1]
    for before, after in pairwise(rows):
        if (before.fastest is None) != (after.fastest is None) and before.pitch_deg * after.pitch_deg > 0:
            inside, outside = (before, after) if after.fastest is None else (after, before)
            limit = inside
            while abs(inside.pitch_deg - outside.pitch_deg) > 1e-3:
                middle = row_at(0.5 * (inside.pitch_deg + outside.pitch_deg))
                inside, outside = (inside, middle) if middle.fastest is None else (middle, outside)
                limit = inside
            complete.append(replace(limit, limited_by=outside.limited_by))
        complete.append(after)
    return complete


def _envelope_row(vehicle: Vehicle, record: np.record, water: Water, pitch_deg: float, V_limit: float) -> EnvelopeRow:
    """Follow the ballast volume from nearly nothing to its limit, and find where the reachable part begins and ends."""
    shares = np.linspace(0.0, 1.0, 65)[1:]
    shares[0] = 1e-3

    def at(share: float) -> tuple[NDArray[np.float64], bool, int]:
        z = np.zeros((1, QUANTITIES))
        code = trim_at_ballast(record, radians(pitch_deg), share * V_limit, water, z[0])
        return z[0], bool(reachable(vehicle, z, np.array([code]))[0]), code

    tried = [at(float(share)) for share in shares]
    inside = [k for k, (_, ok, _) in enumerate(tried) if ok]
    if not inside:
        return EnvelopeRow(pitch_deg, None, None, _why_none(vehicle, tried[-1]))

    def edge(inner: float, outer: float) -> NDArray[np.float64]:
        for _ in range(50):
            middle = 0.5 * (inner + outer)
            if at(middle)[1]:
                inner = middle
            else:
                outer = middle
        return at(inner)[0]

    first, last = inside[0], inside[-1]
    slow = tried[first][0] if first == 0 else edge(float(shares[first]), float(shares[first - 1]))
    whole = last == len(shares) - 1
    fast = tried[last][0] if whole else edge(float(shares[last]), float(shares[last + 1]))
    limited_by = "ballast volume" if whole else _why_none(vehicle, tried[last + 1])
    return EnvelopeRow(pitch_deg, flight_from(record, slow, water), flight_from(record, fast, water), limited_by)


def _why_none(vehicle: Vehicle, tried: tuple[NDArray[np.float64], bool, int]) -> str:
    z, _, code = tried
    if code != CONVERGED:
        return "no equilibrium"
    if abs(z[ALPHA]) > radians(vehicle.description.hydrodynamics.stall_begins_deg):
        return "stall"
    drive = vehicle.description.actuators.moving_mass
    if drive is not None and not drive.travel_m[0] <= z[R_PX] <= drive.travel_m[1]:
        return "moving-mass travel"
    return "ballast volume"


@dataclass(frozen=True)
class RangesNeeded:
    """Actuator ranges that a set of wanted flights needs, about neutral, diving and climbing alike."""

    moving_mass_mm: float
    """Greatest distance of the moving mass from its neutral position."""
    ballast_ml: float
    """Greatest ballast volume."""
    moving_mass_choice_mm: float
    """The same, rounded up to a step a designer would choose."""
    ballast_choice_ml: float
    furthest: SteadyFlight
    """Flight that needs the most travel."""
    heaviest: SteadyFlight
    """Flight that needs the most volume."""
    stalled: tuple[SteadyFlight, ...] = ()
    """Those of the wanted flights that lie beyond the stall angle, which no range of an actuator reaches."""

    def as_row(self) -> dict[str, object]:
        """The ranges in words with units."""
        return {
            "moving_mass_travel_mm": self.moving_mass_mm,
            "ballast_volume_ml": self.ballast_ml,
            "moving_mass_travel_choice_mm": self.moving_mass_choice_mm,
            "ballast_volume_choice_ml": self.ballast_choice_ml,
            "most_travel_at": {"speed_m_s": self.furthest.V, "pitch_deg": degrees(self.furthest.theta)},
            "most_volume_at": {"speed_m_s": self.heaviest.V, "pitch_deg": degrees(self.heaviest.theta)},
            "beyond_stall": [{"speed_m_s": one.V, "pitch_deg": degrees(one.theta)} for one in self.stalled],
        }


def ranges_needed(
    vehicle: Vehicle,
    wanted: Iterable[tuple[float, float]],
    *,
    travel_step_mm: float = 50.0,
    volume_step_ml: float = 50.0,
    physics: Physics = PAPER,
    water: Water | None = None,
) -> RangesNeeded:
    """Find the ranges of moving mass and ballast volume that reach all `wanted` flights.

    Parameters
    ----------
    wanted
        Pairs of speed [m/s] and pitch [deg]; both diving and climbing are tried, whatever the sign.
    travel_step_mm, volume_step_ml
        Steps that the choices are rounded up to.

    Raises
    ------
    RequestError, UnreachableFlightError
        As `trim`, for flights that no settings could give.
    """
    neutral = vehicle.description.moving_mass.neutral_position_m
    flights = [
        trim(vehicle, speed_m_s=speed, pitch_deg=sign * abs(pitch), physics=physics, water=water, within_limits=False)
        for speed, pitch in wanted
        for sign in (-1.0, 1.0)
    ]
    if not flights:
        raise RequestError("no wanted flights: give at least one pair of speed and pitch")
    furthest = max(flights, key=lambda flight: abs(flight.r_px - neutral))
    heaviest = max(flights, key=lambda flight: abs(flight.V_b))
    travel, volume = abs(furthest.r_px - neutral) * 1e3, abs(heaviest.V_b) * 1e6
    return RangesNeeded(
        moving_mass_mm=travel,
        ballast_ml=volume,
        moving_mass_choice_mm=ceil(travel / travel_step_mm) * travel_step_mm,
        ballast_choice_ml=ceil(volume / volume_step_ml) * volume_step_ml,
        furthest=furthest,
        heaviest=heaviest,
        stalled=tuple(
            flight for flight in flights if any(one.reason is Reason.STALL for one in excesses(vehicle, flight))
        ),
    )


def specified_flights(vehicle: Vehicle) -> list[tuple[float, float]]:
    """Flights that the specification asks for: all pitches at the design speed, all speeds at the design pitch.

    Raises
    ------
    RequestError
        The vehicle file does not specify them.
    """
    spec = vehicle.description.specification
    if spec is None or not (spec.speed_m_s and spec.design_speed_m_s and spec.design_pitch_deg):
        raise RequestError(
            f"{vehicle.name}: the table [specification] needs speed_m_s, design_speed_m_s and design_pitch_deg for this"
        )
    pitches = np.arange(spec.shallowest_pitch_deg, spec.pitch_deg + 1e-9, 5.0)
    pitches = np.unique(np.append(pitches, spec.pitch_deg))
    speeds = np.unique(np.append(np.arange(0.1, spec.speed_m_s, 0.1), spec.speed_m_s))
    return [
        *((spec.design_speed_m_s, float(pitch)) for pitch in pitches),
        *((float(speed), spec.design_pitch_deg) for speed in speeds),
    ]
