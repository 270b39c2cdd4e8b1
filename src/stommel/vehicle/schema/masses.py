"""Masses and inertia: rigid body, moving mass, ballast, and the water that moves with them."""

from typing import Literal

from stommel.files.fields import ZERO_MATRIX, Finite, Matrix3, NotNegative, Point, Positive, Table, Tensor


class RigidBody(Table):
    """Everything that neither moves nor belongs to the ballast system."""

    mass_kg: Positive
    centre_of_mass_m: Point
    inertia_kg_m2: Tensor
    inertia_about: Literal["centre_of_buoyancy", "centre_of_mass"]


class MovingMass(Table):
    """The mass that slides along the hull for pitch, and may swing about it for roll."""

    mass_kg: Positive
    neutral_position_m: Finite
    offset_m: NotNegative = 0.0
    """Distance from the longitudinal axis; the mass hangs straight down at roll angle zero."""
    inertia_kg_m2: Tensor = ZERO_MATRIX
    """About its own centre of mass, at roll angle zero."""


class Ballast(Table):
    """The buoyancy-control system as a fixed mass of variable volume."""

    mass_kg: NotNegative
    position_m: Point


class AddedInertia(Table):
    """Mass and inertia of the water that moves with the hull; all positive."""

    surge_kg: NotNegative
    sway_kg: NotNegative | None = None
    heave_kg: NotNegative
    inertia_kg_m2: Tensor = ZERO_MATRIX
    coupling_kg_m: Matrix3 = ZERO_MATRIX
    """C_f by rows: angular momentum from linear velocity."""
