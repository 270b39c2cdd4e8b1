"""Endurance, range and number of dives of one battery charge, with what each part of the vehicle costs.

Equation numbers are those of docs/theory/energy.
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from math import isfinite
from typing import Any

import numpy as np

from stommel.analysis import RequestError, SteadyFlight, UnreachableFlightError, trim
from stommel.analysis.limits import excesses
from stommel.analysis.stratified import DiveBallast
from stommel.design.endurance.dive_cycle import DiveCycle, dive_cycle, glides_of
from stommel.design.endurance.sea import Sea
from stommel.errors import StommelError
from stommel.machinery.power.model import EnergyModel, energy_model
from stommel.machinery.power.stored_energy import StoredEnergy
from stommel.vehicle import PAPER, Physics, Vehicle

DAY = 86400.0
SELF_DISCHARGE = "self-discharge"
COLDEST_C, WARMEST_C = -3.0, 45.0
"""Temperatures of sea water, as a vehicle file allows them [deg C]."""


class DepthError(StommelError):
    """A depth that the hull is not rated for, or that is none."""


class DriveStallError(StommelError):
    """A drive that the motor cannot move in this dive."""


@dataclass(frozen=True)
class Wanted:
    """The dive that is asked about."""

    speed_m_s: float
    """Speed along the path."""
    pitch_deg: float
    """Pitch of the dive, negative; the climb has the same upwards."""
    depth_m: float
    """Depth of the lower turn."""


@dataclass(frozen=True)
class Endurance:
    """What one charge gives, at one speed, pitch and depth."""

    wanted: Wanted
    dive: SteadyFlight
    climb: SteadyFlight
    model: EnergyModel
    cycle: DiveCycle
    stored: StoredEnergy
    endurance_s: float
    """Time until the usable energy is gone [s]."""
    ballast: DiveBallast | None = None
    """Ballast that the stratification asks for; None in water of one density."""
    sea: Sea | None = None
    """Where it dives; None in the reference water."""

    @property
    def ballast_swing_m3(self) -> float:
        """Ballast volume from dive to climb [m3]."""
        return self.climb.V_b - self.dive.V_b if self.ballast is None else self.ballast.up - self.ballast.down

    @property
    def flown_speed_m_s(self) -> float:
        """Way through the water over the time of dive and climb [m/s]; the wanted speed where the water allows it."""
        if self.ballast is None:
            return self.wanted.speed_m_s
        return 2.0 / (1.0 / self.ballast.speed_down + 1.0 / self.ballast.speed_up)

    @property
    def days(self) -> float:
        """Endurance [days]."""
        return self.endurance_s / DAY

    @property
    def dives(self) -> float:
        """Number of dives of one charge."""
        return self.endurance_s / float(self.cycle.duration_s)

    @property
    def range_m(self) -> float:
        """Way over the ground in still water [m]."""
        return self.dives * float(self.cycle.distance_m)

    @property
    def mean_power_w(self) -> float:
        """Mean power that the battery gives, self-discharge left out [W]."""
        return float(self.cycle.total_j / self.cycle.duration_s)

    @property
    def energy_per_dive_j(self) -> Mapping[str, float]:
        """Energy of each part in a dive [J]; with the self-discharge they add up to what the battery loses."""
        lost = self.stored.self_discharge_w * float(self.cycle.duration_s)
        return {name: float(energy) for name, energy in self.cycle.energy_j.items()} | {SELF_DISCHARGE: lost}

    def as_row(self) -> dict[str, Any]:
        """The result in words with units."""
        energies, cycle = self.energy_per_dive_j, self.cycle
        total = sum(energies.values())
        return {
            "speed_m_s": self.wanted.speed_m_s,
            "flown_speed_m_s": self.flown_speed_m_s,
            "ocean": None if self.sea is None else self.sea.ocean.name,
            "pitch_deg": self.wanted.pitch_deg,
            "depth_m": self.wanted.depth_m,
            "endurance_days": self.days,
            "range_km": self.range_m / 1e3,
            "dives": self.dives,
            "mean_power_w": self.mean_power_w,
            "energy_per_dive_j": energies,
            "share": {name: energy / total for name, energy in energies.items()},
            "cycle": {
                "duration_s": float(cycle.duration_s),
                "dive_s": float(cycle.dive_s),
                "climb_s": float(cycle.climb_s),
                "turn_s": float(cycle.turn_s),
                "surface_s": float(cycle.surface_s),
                "actuators_moving_s": float(cycle.moving_s),
                "distance_m": float(cycle.distance_m),
                "ballast_swing_ml": self.ballast_swing_m3 * 1e6,
            },
            "battery": {
                "rated_wh": self.stored.rated_j / 3600.0,
                "usable_wh": self.stored.usable_j / 3600.0,
                "derating": self.stored.derating,
                "temperature_c": self.model.temperature_c,
                "self_discharge_w": self.stored.self_discharge_w,
            },
        }


@np.errstate(divide="ignore", invalid="ignore")  # what is infinite is refused by name
def endurance(
    vehicle: Vehicle,
    *,
    speed_m_s: float | None = None,
    pitch_deg: float | None = None,
    depth_m: float | None = None,
    temperature_c: float | None = None,
    sea: Sea | None = None,
    physics: Physics = PAPER,
) -> Endurance:
    """Find how long and how far a vehicle flies on one charge.

    Parameters
    ----------
    vehicle
        The glider; its file needs [battery], [energy] and [[consumers]].
    speed_m_s, pitch_deg, depth_m
        The dive; its pitch is negative, and the climb mirrors it. Left out, they are the specification's design speed,
        design pitch and depth.
    temperature_c
        Temperature of the water [deg C]; if left out that of the sea, or else the reference water's.
    sea
        An ocean, a place and a time: its stratification asks for more ballast from dive to climb. Without it the water
        has one density.
    physics
        The paper's model, or what the vehicle file adds to it.

    Raises
    ------
    FileError
        The vehicle file lacks what this needs.
    RequestError
        A number is impossible or missing.
    DepthError
        Deeper than the hull is rated for.
    UnreachableFlightError
        The vehicle cannot fly this; with the nearest flight that it can.
    PumpStallError, DriveStallError
        An actuator is too weak for this dive.
    """
    if temperature_c is not None and not COLDEST_C <= temperature_c <= WARMEST_C:
        raise RequestError(f"temperature = {temperature_c:g} deg C: must be {COLDEST_C:g} to {WARMEST_C:g}")
    model = energy_model(vehicle, temperature_c=temperature_c)
    wanted = wanted_of(vehicle, speed_m_s, pitch_deg, depth_m)
    if sea is not None:
        check_dive(vehicle, model, wanted)
        vehicle = sea.trimmed(vehicle, physics, wanted.depth_m)
        if temperature_c is None:
            temperature_c = sea.water(wanted.depth_m).mean_temperature_c
        model = energy_model(vehicle, temperature_c=temperature_c)
    check_dive(vehicle, model, wanted)
    dive, climb = flights_of(vehicle, wanted, physics)
    found = balance(model, wanted, dive, climb, ballast_in(sea, vehicle, wanted, physics))
    return replace(found, sea=sea)


def ballast_in(sea: Sea | None, vehicle: Vehicle, wanted: Wanted, physics: Physics) -> DiveBallast | None:
    """Ballast that a sea asks for; None without one."""
    if sea is None:
        return None
    return sea.ballast(vehicle, physics, wanted.pitch_deg, wanted.speed_m_s, wanted.depth_m)


def wanted_of(vehicle: Vehicle, speed_m_s: float | None, pitch_deg: float | None, depth_m: float | None) -> Wanted:
    """Fill what is left out from the specification.

    Raises
    ------
    RequestError
        It is not there either.
    """
    spec = vehicle.description.specification
    speed = spec.design_speed_m_s if speed_m_s is None and spec else speed_m_s
    pitch = -spec.design_pitch_deg if pitch_deg is None and spec and spec.design_pitch_deg else pitch_deg
    depth = spec.depth_m if depth_m is None and spec else depth_m
    for name, value, key in (
        ("speed", speed, "design_speed_m_s"),
        ("pitch", pitch, "design_pitch_deg"),
        ("depth", depth, "depth_m"),
    ):
        if value is None:
            raise RequestError(f"{vehicle.name}: give a {name}; its file has no specification.{key}")
    assert speed is not None
    assert pitch is not None
    assert depth is not None
    return Wanted(speed, pitch, depth)


def check_dive(vehicle: Vehicle, model: EnergyModel, wanted: Wanted) -> None:
    """Refuse a depth that the hull, the plan or the pump does not allow, and a pitch that does not dive."""
    depth, hull = wanted.depth_m, vehicle.description.hull
    if not (isfinite(depth) and depth > 0.0):
        raise DepthError(f"depth = {depth:g} m: must be greater than 0")
    if hull is not None and hull.depth_rating_m is not None and depth > hull.depth_rating_m:
        raise DepthError(
            f"depth = {depth:g} m: deeper than the hull is rated for; must be at most hull.depth_rating_m = "
            f"{hull.depth_rating_m:g} m"
        )
    if model.plan.dives_per_surfacing > 1 and depth <= model.plan.upper_turn_m:
        raise DepthError(f"depth = {depth:g} m: must be deeper than energy.upper_turn_m = {model.plan.upper_turn_m:g}")
    if not -90.0 < wanted.pitch_deg < 0.0:
        raise RequestError(
            f"pitch = {wanted.pitch_deg:g} deg: give the pitch of the dive, between -90 and 0 deg, both excluded"
        )
    model.works.pump.check(float(model.pressure(depth)))


def flights_of(vehicle: Vehicle, wanted: Wanted, physics: Physics) -> tuple[SteadyFlight, SteadyFlight]:
    """Trim the dive and the climb (section 3.1 of the paper)."""
    dive = trim(vehicle, speed_m_s=wanted.speed_m_s, pitch_deg=wanted.pitch_deg, physics=physics)
    climb = trim(vehicle, speed_m_s=wanted.speed_m_s, pitch_deg=-wanted.pitch_deg, physics=physics)
    return dive, climb


def quick_flights_of(vehicle: Vehicle, wanted: Wanted, physics: Physics) -> tuple[SteadyFlight, SteadyFlight]:
    """As `flights_of`, without the search for the nearest flight where the wanted one is out of reach."""
    found = []
    for pitch in (wanted.pitch_deg, -wanted.pitch_deg):
        flight = trim(vehicle, speed_m_s=wanted.speed_m_s, pitch_deg=pitch, physics=physics, within_limits=False)
        broken = excesses(vehicle, flight)
        if broken:
            raise UnreachableFlightError("; ".join(map(str, broken)), tuple(excess.reason for excess in broken))
        found.append(flight)
    return found[0], found[1]


def balance(
    model: EnergyModel,
    wanted: Wanted,
    dive: SteadyFlight,
    climb: SteadyFlight,
    ballast: DiveBallast | None = None,
) -> Endurance:
    """Fly a dive, and hold its energy against the battery."""
    glides = glides_of(dive, climb)
    if ballast is not None:
        glides = glides.with_ballast(ballast)
    return replace(spent(model, wanted, dive, climb, dive_cycle(model, glides, wanted.depth_m)), ballast=ballast)


def spent(model: EnergyModel, wanted: Wanted, dive: SteadyFlight, climb: SteadyFlight, cycle: DiveCycle) -> Endurance:
    """Hold the energy of a dive against the battery: t = E_usable / (E_dive / t_dive + P_self) (eq-e12).

    Raises
    ------
    DriveStallError
        A motor stalls in this dive.
    """
    stored = model.stored
    consumers = {consumer.name for consumer in model.consumers}  # they are on for ever because something else is stuck
    endless = [name for name, energy in cycle.energy_j.items() if not isfinite(energy)]
    stuck = [name for name in endless if name not in consumers] or endless
    if stuck or not isfinite(cycle.duration_s):
        why = "no oil comes back out of the bladder" if "valve" in stuck else "the motor stalls"
        raise DriveStallError(
            f"speed {wanted.speed_m_s:g} m/s at pitch {wanted.pitch_deg:g} deg: {why} "
            f"({', '.join(stuck) or 'pitch drive'})"
        )
    power = float(cycle.total_j / cycle.duration_s)
    return Endurance(wanted, dive, climb, model, cycle, stored, stored.usable_j / (power + stored.self_discharge_w))
