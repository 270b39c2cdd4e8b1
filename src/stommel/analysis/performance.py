"""The best conditions to fly in: found by search over trimmed flights, not read from a table."""

from dataclasses import dataclass
from math import radians

import numpy as np

from stommel.analysis.flight import SteadyFlight, flight_from
from stommel.analysis.limits import Reason, UnreachableFlightError
from stommel.analysis.request import RequestError
from stommel.analysis.steady_equations import CONVERGED, QUANTITIES
from stommel.analysis.wings_level import trim_at_incidence
from stommel.dynamics.packing import pack, reference_water
from stommel.seawater.water import Water
from stommel.vehicle import PAPER, Physics, Vehicle


@dataclass(frozen=True)
class BestConditions:
    """Best wings-level flights at one ballast volume."""

    best_glide: SteadyFlight
    """Farthest over the ground per metre of depth: the greatest lift-to-drag ratio."""
    fastest: SteadyFlight
    """Greatest horizontal speed."""

    def as_row(self) -> dict[str, object]:
        """Both flights in words with units."""
        return {"best_glide": self.best_glide.as_turn(), "fastest": self.fastest.as_turn()}


def best_conditions(
    vehicle: Vehicle, *, ballast_ml: float, physics: Physics = PAPER, water: Water | None = None
) -> BestConditions:
    """Find the best-glide and the maximum-horizontal-speed flight at a ballast volume.

    Raises
    ------
    RequestError
        The ballast volume is zero or not finite.
    UnreachableFlightError
        No steady flight at any pitch.
    """
    from scipy.optimize import minimize_scalar  # noqa: PLC0415 - slow to import, only wanted here

    if not np.isfinite(ballast_ml) or ballast_ml == 0.0:
        raise RequestError(f"ballast = {ballast_ml:g} ml: must be a finite number other than zero")
    water = water or reference_water(vehicle)
    record = pack(vehicle, physics)
    # along the angle of attack, not the pitch: the shallowest glides of a slow vehicle have the nose above the horizon
    stall = radians(vehicle.description.hydrodynamics.stall_begins_deg)
    side = 1.0 if ballast_ml < 0.0 else -1.0
    grid = np.linspace(0.0, stall, 181)[1:]

    def at(incidence: float) -> SteadyFlight | None:
        z = np.zeros(QUANTITIES)
        code = trim_at_incidence(record, side * incidence, ballast_ml / 1e6, water, z)
        return flight_from(record, z, water) if code == CONVERGED else None

    def loss(incidence: float, merit: str) -> float:
        flight = at(incidence)
        return -float(getattr(flight, merit)) if flight is not None else 0.0

    best = {}
    for merit in ("glide_ratio", "horizontal_speed"):
        k = int(np.argmin([loss(float(incidence), merit) for incidence in grid]))
        found = minimize_scalar(
            loss,
            args=(merit,),
            bounds=(grid[max(k - 1, 0)], grid[min(k + 1, len(grid) - 1)]),
            method="bounded",
            options={"xatol": 1e-10},
        )
        flight = at(float(found.x))
        if flight is None:
            raise UnreachableFlightError(
                f"{vehicle.name} has no steady flight at a ballast volume of {ballast_ml:g} ml",
                (Reason.NO_EQUILIBRIUM,),
            )
        best[merit] = flight
    return BestConditions(best_glide=best["glide_ratio"], fastest=best["horizontal_speed"])
