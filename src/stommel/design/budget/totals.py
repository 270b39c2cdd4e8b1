"""The budget of a vehicle: bay by bay, in all, and as the three masses of the equations of motion."""

from dataclasses import dataclass
from typing import Any

import numpy as np

from stommel.design.budget.failures import BudgetError
from stommel.design.budget.mass_properties import MassProperties, Vector3, mass_properties
from stommel.vehicle import Vehicle
from stommel.vehicle.missing_table import missing_table
from stommel.vehicle.schema.budget import Part


@dataclass(frozen=True)
class BayTotal:
    """What one bay holds."""

    name: str
    flooded: bool
    parts: tuple[Part, ...]
    mass: MassProperties
    volume: float
    """Displaced by its parts [m3]."""

    def as_row(self) -> dict[str, Any]:
        """The bay in words with units; an empty one has no centre."""
        return {
            "name": self.name,
            "flooded": self.flooded,
            "parts": [part.name for part in self.parts],
            "mass_kg": self.mass.mass,
            "displaced_volume_ml": self.volume * 1e6,
            "centre_of_mass_m": self.mass.centre.tolist() if self.parts else None,
        }


@dataclass(frozen=True)
class Budget:
    """Sums of all parts, with the moving mass and the ballast at neutral."""

    bays: tuple[BayTotal, ...]
    total: MassProperties
    rigid_body: MassProperties
    moving: MassProperties
    ballast: MassProperties
    volume: float
    """Displaced volume [m3]."""
    centre_of_buoyancy: Vector3
    """[m]."""

    @property
    def neutral_density(self) -> float:
        """Water in which it neither sinks nor rises [kg/m3]."""
        return self.total.mass / self.volume

    @property
    def stability_arm(self) -> float:
        """Centre of mass below centre of buoyancy [m]; negative is top-heavy."""
        return float(self.total.centre[2] - self.centre_of_buoyancy[2])

    def as_row(self) -> dict[str, Any]:
        """The sums in words with units."""
        return {
            "total_mass_kg": self.total.mass,
            "displaced_volume_ml": self.volume * 1e6,
            "centre_of_mass_m": self.total.centre.tolist(),
            "centre_of_buoyancy_m": self.centre_of_buoyancy.tolist(),
            "stability_arm_mm": self.stability_arm * 1e3,
            "neutral_density_kg_m3": self.neutral_density,
            "moving_mass_kg": self.moving.mass,
            "ballast_kg": self.ballast.mass,
            "bays": [bay.as_row() for bay in self.bays],
        }


def mass_budget(vehicle: Vehicle) -> Budget:
    """Sum the parts of a vehicle.

    Raises
    ------
    BudgetError
        The file has no parts, or they have no mass or displace no water.
    """
    d = vehicle.description
    if not d.parts:
        raise BudgetError(
            f"{vehicle.origin}: has no table [[parts]], of which a budget is the sum; add the parts and their bays; "
            f"{missing_table('parts')}; {missing_table('bays')}"
        )
    volume = sum(part.volume_m3 for part in d.parts)
    if volume <= 0.0:
        raise BudgetError(
            f"{vehicle.origin}: no part displaces water, so nothing floats; give the hull and all wet parts volume_ml"
        )
    total = mass_properties(d.parts)
    if total.mass <= 0.0:
        raise BudgetError(f"{vehicle.origin}: the parts have no mass; give them mass_kg")
    moment = sum((part.volume_m3 * np.array(part.position_m) for part in d.parts), np.zeros(3))
    bays = []
    for bay in d.bays:
        inside = tuple(part for part in d.parts if part.bay == bay.name)
        displaced = sum(part.volume_m3 for part in inside)
        bays.append(BayTotal(bay.name, bay.flooded, inside, mass_properties(inside), displaced))
    return Budget(
        bays=tuple(bays),
        total=total,
        rigid_body=mass_properties(part for part in d.parts if not part.moving and not part.ballast),
        moving=mass_properties(part for part in d.parts if part.moving),
        ballast=mass_properties(part for part in d.parts if part.ballast),
        volume=volume,
        centre_of_buoyancy=moment / volume,  # (eq-w4)
    )
