"""Viscous coefficients, and the shares of wing and rudder in them."""

from typing import Annotated, Literal, Self

from pydantic import Field, model_validator

from stommel.files.fields import Finite, NotNegative, NotPositive, Positive, Table, ordered


class Hydrodynamics(Table):
    """Viscous coefficients; forces are coefficient times speed squared, angles in radians."""

    drag_kg_m: Positive
    drag_per_rad2_kg_m: NotNegative
    lift_kg_m: Finite = 0.0
    lift_per_rad_kg_m: Positive
    pitch_moment_kg: Finite = 0.0
    pitch_moment_per_rad_kg: Finite
    pitch_damping_kg_s: NotPositive | None = None
    side_force_per_rad_kg_m: NotNegative | None = None
    """Positive: the side force opposes sideslip."""
    roll_moment_per_rad_kg: Finite | None = None
    yaw_moment_per_rad_kg: Finite | None = None
    roll_damping_kg_s: NotPositive | None = None
    yaw_damping_kg_s: NotPositive | None = None
    moments_along: Literal["body", "flow"] = "body"
    """Axes of the moments: the body's as in the paper, or the flow's as in Graver (2005) and Zhang et al. (2013)."""
    stall_begins_deg: Annotated[float, Field(strict=True, gt=0, lt=60)] = 15.0
    stall_ends_deg: Annotated[float, Field(strict=True, gt=0, lt=90)] = 30.0
    broadside_drag_kg_m: Positive | None = None
    """Normal force of the separated flow at 90 degrees; the lift slope where it is not given."""

    @model_validator(mode="after")
    def _stall_is_an_interval(self) -> Self:
        ordered("stall_begins_deg to stall_ends_deg", (self.stall_begins_deg, self.stall_ends_deg))
        return self


class Wing(Table):
    """The wing's share of the coefficients, for the component build-up."""

    aerodynamic_centre_aft_m: Finite
    reference_aft_m: Finite
    """Where the wing was when the vehicle's total coefficients were found."""
    lift_per_rad_kg_m: NotNegative


class Rudder(Table):
    """The rudder's share of the coefficients, and its travel."""

    aerodynamic_centre_aft_m: Finite
    reference_aft_m: Finite
    height_m: Finite
    """Aerodynamic centre above the longitudinal axis."""
    side_force_per_rad_kg_m: NotNegative
