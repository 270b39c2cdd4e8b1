"""All that is asked of a budget, in one value for terminal, report and scripts."""

from collections.abc import Iterator
from dataclasses import dataclass
from math import isfinite
from typing import Any

from stommel.design.budget.comparison import (
    MASS_TOLERANCE_KG,
    InertiaComparison,
    compare_inertia,
    comparison_warnings,
    highest_lever,
)
from stommel.design.budget.failures import BudgetError
from stommel.design.budget.reserve import Reserve, best_trim_density, compression, reserve
from stommel.design.budget.totals import Budget, mass_budget
from stommel.design.budget.trimming import FOAM_DENSITY, Trimming, trimming
from stommel.design.named_warning import NamedWarning
from stommel.vehicle import Vehicle

DENSITIES = (900.0, 1200.0)
"""Waters that are taken for water [kg/m3], as in a vehicle file."""


@dataclass(frozen=True)
class BudgetStudy:
    """Budget, trimming and reserve of a vehicle in a water, or over a range of waters."""

    vehicle: Vehicle
    budget: Budget
    inertia: InertiaComparison
    highest_lever: float | None
    """Lowest place that the rigid body's centre of mass could have [m below the axis]."""
    density: tuple[float, float]
    """Least and greatest [kg/m3]."""
    trimming: Trimming | None
    """What to add; None where no place is enough."""
    reserve: Reserve | None
    """Of the trimmed vehicle; None without a buoyancy engine or trimming."""
    warnings: tuple[NamedWarning, ...]

    @property
    def floats(self) -> bool:
        """Whether the vehicle as it is rises in the lightest of the waters with all its ballast volume."""
        return not any(warning.name == "does_not_float" for warning in self.warnings)

    def as_json(self) -> dict[str, Any]:
        """The study in words with units."""
        rigid_body = self.budget.rigid_body
        return {
            "vehicle": self.vehicle.name,
            "density_kg_m3": list(self.density),
            **self.budget.as_row(),
            "rigid_body": {
                "mass_kg": rigid_body.mass,
                "centre_of_mass_m": rigid_body.centre.tolist(),
                "lowest_possible_centre_m": self.highest_lever,
                **self.inertia.as_row(),
            },
            "trimming": None if self.trimming is None else self.trimming.as_row(),
            "reserve": None if self.reserve is None else self.reserve.as_row(),
            "warnings": [warning.as_row() for warning in self.warnings],
        }


def budget_study(
    vehicle: Vehicle,
    density_kg_m3: float | tuple[float, float] | None = None,
    *,
    foam_density_kg_m3: float = FOAM_DENSITY,
) -> BudgetStudy:
    """Sum the parts of a vehicle, trim it, and see what its buoyancy engine has left.

    Parameters
    ----------
    density_kg_m3
        Density of the water, or the least and greatest of a sea area; the file's reference water if left out.
    foam_density_kg_m3
        Density of the foam that may be added.

    Raises
    ------
    BudgetError
        The file lacks the parts or the hull, no part displaces water, or a density is impossible.
    """
    low, high = _range(density_kg_m3, vehicle.description.water.density_kg_m3)
    budget = mass_budget(vehicle)
    inertia = compare_inertia(vehicle, budget)
    target = best_trim_density(vehicle, budget.volume, low, high) if high > low else low
    trimmed = trimming(vehicle, budget, target, foam_density_kg_m3)
    left = reserve(vehicle, trimmed.volume, target, low, high) if trimmed is not None else None
    warnings = [
        *comparison_warnings(vehicle, budget, inertia),
        *_floating(vehicle, budget, low, high),
        *_trimming_warnings(vehicle, trimmed, target),
        *_reserve_warnings(left),
    ]
    return BudgetStudy(
        vehicle, budget, inertia, highest_lever(vehicle, budget), (low, high), trimmed, left, tuple(warnings)
    )


def _range(density: float | tuple[float, float] | None, reference: float) -> tuple[float, float]:
    if density is None:
        return reference, reference
    low, high = density if isinstance(density, tuple) else (density, density)
    for value in (low, high):
        if not (isfinite(value) and DENSITIES[0] <= value <= DENSITIES[1]):
            raise BudgetError(
                f"density = {value:g} kg/m3: must be at least {DENSITIES[0]:g} and at most {DENSITIES[1]:g}"
            )
    if low > high:
        raise BudgetError(f"density = {low:g}:{high:g} kg/m3: the first number must not be greater than the second")
    return low, high


def _floating(vehicle: Vehicle, budget: Budget, low: float, high: float) -> Iterator[NamedWarning]:
    engine = vehicle.description.actuators.buoyancy
    least, most = engine.volume_m3 if engine else (0.0, 0.0)
    heavy = budget.total.mass - low * (budget.volume + most)
    if heavy > 0.0:
        yield NamedWarning(
            "does_not_float",
            f"the parts weigh {budget.total.mass:.3f} kg and displace {budget.volume * 1e3:.3f} l; in water of {low:g} "
            f"kg/m3 that is {heavy:.3f} kg too much even with all the ballast volume of {most * 1e6:g} ml",
        )
    shrinks = compression(vehicle, budget.volume, low)
    deep = heavy + low * shrinks
    if heavy <= 0.0 < deep:
        yield NamedWarning(
            "does_not_rise",
            f"at the depth of its rating the hull has lost {shrinks * 1e6:.1f} ml; in water of {low:g} kg/m3 that is "
            f"{deep:.3f} kg too much even with all the ballast volume of {most * 1e6:g} ml: it does not return",
        )
    light = high * (budget.volume + least) - budget.total.mass
    if light > 0.0:
        yield NamedWarning(
            "does_not_sink",
            f"the parts weigh {budget.total.mass:.3f} kg and displace {budget.volume * 1e3:.3f} l; in water of "
            f"{high:g} kg/m3 that is {light:.3f} kg too little even with the bladder empty: add the trim weight",
        )
    if budget.stability_arm <= 0.0:
        yield NamedWarning(
            "top_heavy",
            f"the centre of mass is {-budget.stability_arm * 1e3:.2f} mm above the centre of buoyancy: it turns over",
        )


def _trimming_warnings(vehicle: Vehicle, trimmed: Trimming | None, rho: float) -> Iterator[NamedWarning]:
    if trimmed is None:
        yield NamedWarning(
            "no_place_to_trim",
            f"no trim weight in the sealed bays and no foam in the flooded ones makes the vehicle neutral and level in "
            f"water of {rho:.6g} kg/m3: the foam would not fit",
        )
        return
    spec = vehicle.description.specification
    if spec is not None and trimmed.added_mass > 0.0 and trimmed.mass > spec.mass_kg + MASS_TOLERANCE_KG:
        yield NamedWarning(
            "trimmed_over_specification",
            f"trimmed for {rho:.6g} kg/m3 the vehicle has {trimmed.mass:.3f} kg; specification.mass_kg = "
            f"{spec.mass_kg:g}",
        )


def _reserve_warnings(left: Reserve | None) -> Iterator[NamedWarning]:
    if left is None:
        return
    if left.least < 0.0:
        where = ", ".join(f"{row.rho:.6g}" for row in left.rows if min(row.to_dive, row.to_climb) < 0.0)
        band = left.sinks_and_rises
        words = f"; it both sinks and rises from {band[0]:.1f} to {band[1]:.1f} kg/m3" if band else ""
        yield NamedWarning(
            "reserve_exhausted",
            f"trimmed for {left.trimmed_for:.6g} kg/m3, the buoyancy engine has too little volume at {where} kg/m3"
            f"{words}; trim the vehicle anew for each part of the area",
        )
    elif left.design_speed is not None and any(
        speed is not None and speed < left.design_speed
        for row in left.rows
        for speed in (row.dive_speed, row.climb_speed)
    ):
        yield NamedWarning(
            "reserve_slow",
            f"the design speed of {left.design_speed:g} m/s is not reached in every water of the range",
        )
