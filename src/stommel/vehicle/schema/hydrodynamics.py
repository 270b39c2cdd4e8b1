"""Viscous coefficients, and the shares of wing and rudder in them."""

from typing import Annotated, Literal, Self

from pydantic import model_validator

from stommel.files.fields import Table, ordered
from stommel.files.ranges import Coordinate, between

ZeroAngleForce = Annotated[float, between(-5000, 5000)]
SideForceSlope = Annotated[float, between(0, 10000)]
MomentSlope = Annotated[float, between(-20000, 20000)]
Damping = Annotated[float, between(-15000, 0)]


class Hydrodynamics(Table):
    """Viscous coefficients; forces are coefficient times speed squared, angles in radians."""

    drag_kg_m: Annotated[float, between(0.01, 1000)]
    drag_per_rad2_kg_m: Annotated[float, between(0, 20000)]
    lift_kg_m: ZeroAngleForce = 0.0
    lift_per_rad_kg_m: Annotated[float, between(0.1, 50000)]
    pitch_moment_kg: ZeroAngleForce = 0.0
    pitch_moment_per_rad_kg: MomentSlope
    pitch_damping_kg_s: Damping | None = None
    side_force_per_rad_kg_m: SideForceSlope | None = None
    """Positive: the side force opposes sideslip."""
    roll_moment_per_rad_kg: MomentSlope | None = None
    yaw_moment_per_rad_kg: MomentSlope | None = None
    roll_damping_kg_s: Damping | None = None
    yaw_damping_kg_s: Damping | None = None
    moments_along: Literal["body", "flow"] = "body"
    """Axes of the moments: the body's as in the paper, or the flow's as in Graver (2005) and Zhang et al. (2013)."""
    stall_begins_deg: Annotated[float, between(1, 59)] = 15.0
    stall_ends_deg: Annotated[float, between(2, 89)] = 30.0
    broadside_drag_kg_m: Annotated[float, between(0.1, 50000)] | None = None
    """Normal force of the separated flow at 90 degrees; the lift slope where it is not given."""

    @model_validator(mode="after")
    def _stall_is_an_interval(self) -> Self:
        ordered("stall_begins_deg to stall_ends_deg", (self.stall_begins_deg, self.stall_ends_deg))
        return self


class Wing(Table):
    """The wing's share of the coefficients, for the component build-up."""

    aerodynamic_centre_aft_m: Coordinate
    reference_aft_m: Coordinate
    """Where the wing was when the vehicle's total coefficients were found."""
    lift_per_rad_kg_m: Annotated[float, between(0, 50000)]


class Rudder(Table):
    """The rudder's share of the coefficients, and its travel."""

    aerodynamic_centre_aft_m: Coordinate
    reference_aft_m: Coordinate
    height_m: Annotated[float, between(-3, 3)]
    """Aerodynamic centre above the longitudinal axis."""
    side_force_per_rad_kg_m: SideForceSlope
