"""The best conditions to fly in: found by search over trimmed flights, not read from a table."""

from collections.abc import Callable
from dataclasses import dataclass
from itertools import pairwise
from math import degrees, radians

import numpy as np

from stommel.analysis.flight import SteadyFlight, flight_from
from stommel.analysis.limits import Reason, UnreachableFlightError, excesses
from stommel.analysis.request import RequestError
from stommel.analysis.steady_equations import CONVERGED, QUANTITIES
from stommel.analysis.wings_level import trim_at_incidence
from stommel.dynamics.packing import pack, reference_water
from stommel.seawater.water import Water
from stommel.vehicle import PAPER, Physics, Vehicle

NEAR_STALL_DEG = 0.1
NEAR_END_MM = 0.1
"""A best flight this near to a limit lies at it: the limit, not the flow, ends the search there."""


@dataclass(frozen=True)
class BestConditions:
    """Best wings-level flights at one ballast volume, within the limits of the vehicle file where it has any such."""

    best_glide: SteadyFlight
    """Farthest over the ground per metre of depth: the greatest lift-to-drag ratio."""
    fastest: SteadyFlight
    """Greatest horizontal speed."""
    glide_remarks: tuple[str, ...] = ()
    """Limits that the best glide lies at, or breaks where no flight breaks none; none for an optimum of the flow."""
    fastest_remarks: tuple[str, ...] = ()
    """Likewise of the fastest flight."""

    def as_row(self) -> dict[str, object]:
        """Both flights in words with units, each with its limits."""
        return {
            "best_glide": self.best_glide.as_turn() | {"limits": list(self.glide_remarks)},
            "fastest": self.fastest.as_turn() | {"limits": list(self.fastest_remarks)},
        }


def best_conditions(
    vehicle: Vehicle, *, ballast_ml: float, physics: Physics = PAPER, water: Water | None = None
) -> BestConditions:
    """Find the best-glide and the maximum-horizontal-speed flight at a ballast volume.

    The search keeps to the limits of the vehicle file. Where no flight does, it is made without them, and the flights
    say which limits they break.

    Raises
    ------
    RequestError
        The ballast volume is zero or not finite.
    UnreachableFlightError
        No steady flight at any pitch.
    """
    if not np.isfinite(ballast_ml) or ballast_ml == 0.0:
        raise RequestError(f"ballast = {ballast_ml:g} ml: must be a finite number other than zero")
    water = water or reference_water(vehicle)
    record = pack(vehicle, physics)
    # along the angle of attack, not the pitch: the shallowest glides of a slow vehicle have the nose above the horizon
    stall = radians(vehicle.description.hydrodynamics.stall_begins_deg)
    side = 1.0 if ballast_ml < 0.0 else -1.0
    grid = [float(incidence) for incidence in np.linspace(0.0, stall, 181)[1:]]

    def at(incidence: float) -> SteadyFlight | None:
        z = np.zeros(QUANTITIES)
        code = trim_at_incidence(record, side * incidence, ballast_ml / 1e6, water, z)
        return flight_from(record, z, water) if code == CONVERGED else None

    def within(incidence: float) -> SteadyFlight | None:
        flight = at(incidence)
        return flight if flight is not None and not excesses(vehicle, flight) else None

    for allowed in (within, at):
        found = [_greatest(allowed, grid, merit) for merit in ("glide_ratio", "horizontal_speed")]
        if found[0] is not None and found[1] is not None:
            glide, fastest = found[0], found[1]
            return BestConditions(glide, fastest, _remarks(vehicle, glide), _remarks(vehicle, fastest))
    raise UnreachableFlightError(
        f"{vehicle.name} has no steady flight at a ballast volume of {ballast_ml:g} ml", (Reason.NO_EQUILIBRIUM,)
    )


def _greatest(flown: Callable[[float], SteadyFlight | None], grid: list[float], merit: str) -> SteadyFlight | None:
    """Flight of the greatest merit among those that `flown` has: about the best of a grid, and at its ends."""
    from scipy.optimize import minimize_scalar  # noqa: PLC0415 - slow to import, only wanted here

    def value(flight: SteadyFlight) -> float:
        return float(getattr(flight, merit))

    def loss(incidence: float) -> float:
        flight = flown(incidence)
        return -value(flight) if flight is not None else 0.0

    tried = {incidence: flown(incidence) for incidence in grid}
    for before, after in pairwise(grid):
        if (tried[before] is None) != (tried[after] is None):
            end = _edge(flown, *((after, before) if tried[before] is None else (before, after)))
            tried[end] = flown(end)
    known = sorted(incidence for incidence, flight in tried.items() if flight is not None)
    if not known:
        return None
    k = int(np.argmin([loss(incidence) for incidence in known]))
    bounds = (known[max(k - 1, 0)], known[min(k + 1, len(known) - 1)])
    candidates = [tried[known[k]]]
    if bounds[0] < bounds[1]:
        found = minimize_scalar(loss, bounds=bounds, method="bounded", options={"xatol": 1e-10})
        candidates.append(flown(float(found.x)))
    return max((flight for flight in candidates if flight is not None), key=value)


def _edge(flown: Callable[[float], SteadyFlight | None], inside: float, outside: float) -> float:
    """Last angle of attack that is flown between one that is and one that is not."""
    for _ in range(50):
        middle = 0.5 * (inside + outside)
        if flown(middle) is None:
            outside = middle
        else:
            inside = middle
    return inside


def _remarks(vehicle: Vehicle, flight: SteadyFlight) -> tuple[str, ...]:
    """Limits that a flight breaks, and those that it lies at."""
    remarks = [str(excess) for excess in excesses(vehicle, flight)]
    broken = {excess.reason for excess in excesses(vehicle, flight)}
    stall, drive = vehicle.description.hydrodynamics.stall_begins_deg, vehicle.description.actuators.moving_mass
    if Reason.STALL not in broken and abs(degrees(flight.alpha)) > stall - NEAR_STALL_DEG:
        remarks.append("at the stall angle, where the model ends")
    if drive is not None and Reason.TRAVEL not in broken:
        end = min(drive.travel_mm, key=lambda end: abs(end - flight.r_px * 1e3))
        if abs(end - flight.r_px * 1e3) < NEAR_END_MM:
            remarks.append(f"at the end of the moving mass's travel, {end:g} mm")
    return tuple(remarks)
