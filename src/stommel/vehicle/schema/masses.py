"""Masses and inertia: rigid body, moving mass, ballast, and the water that moves with them."""

from typing import Annotated, Literal

from stommel.files.fields import ZERO_MATRIX, Matrix3, Point, Table, Tensor
from stommel.files.ranges import Coordinate, Mass, ZeroOr, between

WaterMass = Annotated[float, ZeroOr(0.001, 20000)]
"""Of the water that moves with a vehicle [kg]."""


class RigidBody(Table):
    """Everything that neither moves nor belongs to the ballast system."""

    mass_kg: Mass
    centre_of_mass_m: Point
    inertia_kg_m2: Tensor
    inertia_about: Literal["centre_of_buoyancy", "centre_of_mass"]


class MovingMass(Table):
    """The mass that slides along the hull for pitch, and may swing about it for roll."""

    mass_kg: Annotated[float, between(0.02, 1000)]
    neutral_position_m: Coordinate
    offset_m: Annotated[float, ZeroOr(0.0005, 1)] = 0.0
    """Distance from the longitudinal axis; the mass hangs straight down at roll angle zero."""
    inertia_kg_m2: Tensor = ZERO_MATRIX
    """About its own centre of mass, at roll angle zero."""


class Ballast(Table):
    """The buoyancy-control system as a fixed mass of variable volume."""

    mass_kg: Annotated[float, ZeroOr(0.01, 500)]
    position_m: Point


class AddedInertia(Table):
    """Mass and inertia of the water that moves with the hull; all positive."""

    surge_kg: WaterMass
    sway_kg: WaterMass | None = None
    heave_kg: WaterMass
    inertia_kg_m2: Tensor = ZERO_MATRIX
    coupling_kg_m: Matrix3 = ZERO_MATRIX
    """C_f by rows: angular momentum from linear velocity."""
