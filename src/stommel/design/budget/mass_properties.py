"""Mass, centre of mass and inertia of bodies and of their sum (docs/theory/budget)."""

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from stommel.vehicle.checks import skew
from stommel.vehicle.schema.budget import Part

Vector3 = NDArray[np.float64]
Tensor3 = NDArray[np.float64]


@dataclass(frozen=True)
class MassProperties:
    """Mass, its centre, and its inertia about the origin of the body frame. SI units."""

    mass: float
    """[kg]."""
    centre: Vector3
    """Centre of mass [m]; the origin for no mass."""
    inertia: Tensor3
    """About the origin [kg m2]."""

    @property
    def inertia_about_centre(self) -> Tensor3:
        """About its own centre of mass [kg m2] (eq-w3, read backwards)."""
        r = skew(tuple(self.centre))
        return self.inertia + self.mass * r @ r


def own_inertia(part: Part) -> Tensor3:
    """Inertia of a part about its own centre [kg m2] (eq-w1, eq-w2); zero for a point."""
    if part.box_mm is not None:
        x, y, z = (side / 1e3 for side in part.box_mm)
        return part.mass_kg / 12.0 * np.diag([y**2 + z**2, x**2 + z**2, x**2 + y**2])  # (eq-w1)
    if part.length_mm is not None and part.diameter_mm is not None:
        length = part.length_mm / 1e3
        radii = ((part.diameter_mm / 2e3) ** 2) + ((part.inner_diameter_mm / 2e3) ** 2)
        across = radii / 4.0 + length**2 / 12.0
        return part.mass_kg * np.diag([radii / 2.0, across, across])  # (eq-w2)
    return np.zeros((3, 3))


def mass_properties(parts: Iterable[Part]) -> MassProperties:
    """Sum of the parts."""
    mass, moment, inertia = 0.0, np.zeros(3), np.zeros((3, 3))
    for part in parts:
        r = skew(part.position_m)
        mass += part.mass_kg
        moment += part.mass_kg * np.array(part.position_m)
        inertia += own_inertia(part) - part.mass_kg * r @ r  # (eq-w3)
    return MassProperties(mass, moment / mass if mass > 0.0 else np.zeros(3), inertia)
