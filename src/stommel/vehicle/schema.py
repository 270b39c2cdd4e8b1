"""What a vehicle file may say: tables, keys with their units, allowed ranges.

One frozen model is both the form of the file and the description that the rest of stommel reads; where the file speaks
millimetres, millilitres or degrees, a property gives SI (docs/decisions/0002). Anything that a table does not know is
refused.
"""

from collections.abc import Iterator
from math import pi, radians
from typing import Annotated, Any, Literal, Self

from pydantic import BaseModel, BeforeValidator, ConfigDict, Field, model_validator

Finite = Annotated[float, Field(strict=True, allow_inf_nan=False)]
Positive = Annotated[float, Field(strict=True, gt=0, allow_inf_nan=False)]
NotNegative = Annotated[float, Field(strict=True, ge=0, allow_inf_nan=False)]
NotPositive = Annotated[float, Field(strict=True, le=0, allow_inf_nan=False)]
Point = tuple[Finite, Finite, Finite]
Interval = tuple[Finite, Finite]
Row = tuple[Finite, Finite, Finite]
Matrix3 = tuple[Row, Row, Row]

ZERO_MATRIX: Matrix3 = ((0.0, 0.0, 0.0), (0.0, 0.0, 0.0), (0.0, 0.0, 0.0))


def _as_matrix(value: Any) -> Any:
    """Take [xx, yy, zz] for a diagonal matrix."""
    if isinstance(value, list | tuple) and len(value) == 3 and all(isinstance(v, int | float) for v in value):
        xx, yy, zz = value
        return ((xx, 0.0, 0.0), (0.0, yy, 0.0), (0.0, 0.0, zz))
    return value


Tensor = Annotated[Matrix3, BeforeValidator(_as_matrix)]
"""Symmetric 3 x 3 tensor: [xx, yy, zz], or three rows."""


class Table(BaseModel):
    """A table of a vehicle file."""

    model_config = ConfigDict(extra="forbid", frozen=True, strict=False)


def ordered(name: str, interval: Interval) -> None:
    """Refuse an interval whose ends are swapped."""
    if not interval[0] < interval[1]:
        raise ValueError(f"{name} = {list(interval)}: the first number must be less than the second")


class Specification(Table):
    """What the vehicle is asked to do: Table 3 of the paper, and the flight that section 3.1 designs for."""

    body_length_m: Positive
    overall_length_m: Positive
    diameter_mm: Positive
    mass_kg: Positive
    oil_volume_ml: Positive
    depth_m: Positive
    pitch_deg: Annotated[float, Field(strict=True, gt=0, lt=90)]
    rudder_deg: Annotated[float, Field(strict=True, gt=0, le=90)] | None = None
    endurance_days: Positive | None = None
    speed_m_s: Positive | None = None
    """Greatest speed along the path that the design must reach."""
    design_speed_m_s: Positive | None = None
    """Speed of Table 1: pitch is varied at this speed."""
    design_pitch_deg: Annotated[float, Field(strict=True, gt=0, lt=90)] | None = None
    """Magnitude of the pitch of Table 2: speed is varied at this pitch."""
    shallowest_pitch_deg: Annotated[float, Field(strict=True, gt=0, lt=90)] = 5.0
    """Magnitude of the shallowest pitch that the design must fly at the design speed."""

    @model_validator(mode="after")
    def _pitches_are_ordered(self) -> Self:
        ordered("shallowest_pitch_deg to pitch_deg", (self.shallowest_pitch_deg, self.pitch_deg))
        return self


class ReferenceWater(Table):
    """Water in which the vehicle is trimmed neutral."""

    density_kg_m3: Annotated[float, Field(strict=True, ge=900, le=1200)]
    temperature_c: Annotated[float, Field(strict=True, ge=-3, le=45)] = 15.0
    gravity_m_s2: Annotated[float, Field(strict=True, ge=9.7, le=9.9)] = 9.81


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


class MovingMassDrive(Table):
    """Travel and speed of the moving mass along the hull."""

    travel_mm: Interval
    """Positions of the mass forward of the centre of buoyancy, aft end first."""
    speed_mm_s: Positive | None = None

    @property
    def travel_m(self) -> tuple[float, float]:
        """Travel in metres."""
        return self.travel_mm[0] / 1e3, self.travel_mm[1] / 1e3

    @model_validator(mode="after")
    def _travel_is_an_interval(self) -> Self:
        ordered("travel_mm", self.travel_mm)
        return self


class BuoyancyEngine(Table):
    """Volume and flow of the buoyancy engine; zero is neutral."""

    volume_ml: Interval
    flow_ml_s: Positive | None = None
    bladder_position_m: Point | None = None
    reservoir_position_m: Point | None = None
    oil_density_kg_m3: Annotated[float, Field(strict=True, ge=500, le=1500)] | None = None

    @property
    def volume_m3(self) -> tuple[float, float]:
        """Range of the ballast volume in cubic metres."""
        return self.volume_ml[0] / 1e6, self.volume_ml[1] / 1e6

    @model_validator(mode="after")
    def _volume_is_an_interval(self) -> Self:
        ordered("volume_ml", self.volume_ml)
        return self


class RudderDrive(Table):
    """Travel and speed of the rudder."""

    travel_deg: Annotated[float, Field(strict=True, gt=0, le=90)]
    """To either side."""
    speed_deg_s: Positive | None = None

    @property
    def travel_rad(self) -> float:
        """Travel to either side in radians."""
        return radians(self.travel_deg)


class RollDrive(Table):
    """Travel and speed of the moving mass about the longitudinal axis."""

    travel_deg: Annotated[float, Field(strict=True, gt=0, le=180)]
    """To either side."""
    speed_deg_s: Positive | None = None

    @property
    def travel_rad(self) -> float:
        """Travel to either side in radians."""
        return radians(self.travel_deg)


class Actuators(Table):
    """What the vehicle can do; an actuator without limits may be left out."""

    moving_mass: MovingMassDrive | None = None
    buoyancy: BuoyancyEngine | None = None
    rudder: RudderDrive | None = None
    roll: RollDrive | None = None


class Hull(Table):
    """Pressure hull."""

    length_m: Positive
    outer_diameter_mm: Positive
    inner_diameter_mm: Positive | None = None
    nose_position_m: Finite
    """Forward end of the sealed hull, forward of the centre of buoyancy."""
    tail_length_m: NotNegative = 0.0
    """What extends aft of the sealed hull: wet tail, bladder, rudder."""
    nose_length_m: NotNegative = 0.0
    """What extends forward of the sealed hull: wet nose with sensors."""
    material: str | None = None
    wall_mm: Positive | None = None
    depth_rating_m: Positive | None = None
    compressibility_per_pa: NotNegative = 0.0
    thermal_expansion_per_k: Finite = 0.0

    @model_validator(mode="after")
    def _has_an_inside(self) -> Self:
        if self.inner_diameter_mm is not None and self.inner_diameter_mm >= self.outer_diameter_mm:
            raise ValueError(
                f"inner_diameter_mm = {self.inner_diameter_mm:g}: must be less than outer_diameter_mm = "
                f"{self.outer_diameter_mm:g}"
            )
        return self

    @property
    def volume_m3(self) -> float:
        """Volume of the plain tube [m3]."""
        return pi / 4 * (self.outer_diameter_mm / 1e3) ** 2 * self.length_m


class Bay(Table):
    """A section of the vehicle (Fig. 6 of the paper)."""

    name: str
    from_m: Finite
    """Forward end, forward of the centre of buoyancy."""
    to_m: Finite
    """Aft end."""
    flooded: bool = False
    holds: tuple[str, ...] = ()

    @model_validator(mode="after")
    def _reads_forward_to_aft(self) -> Self:
        if self.to_m >= self.from_m:
            raise ValueError(f"to_m = {self.to_m:g}: must be aft of (less than) from_m = {self.from_m:g}")
        return self


class Battery(Table):
    """Energy store."""

    capacity_ah: Positive
    voltage_v: Positive
    chemistry: str


class VehicleFile(Table):
    """A glider, as its file describes it."""

    format: Literal[1] = 1
    name: Annotated[str, Field(min_length=1)]
    summary: str = ""
    notes: tuple[str, ...] = ()
    """Known slips and limits of the sources; the report prints them."""
    specification: Specification | None = None
    water: ReferenceWater
    rigid_body: RigidBody
    moving_mass: MovingMass
    ballast: Ballast
    added_inertia: AddedInertia
    hydrodynamics: Hydrodynamics
    wing: Wing | None = None
    rudder: Rudder | None = None
    actuators: Actuators = Actuators()
    hull: Hull | None = None
    bays: tuple[Bay, ...] = ()
    battery: Battery | None = None

    @property
    def mass_kg(self) -> float:
        """Total mass m = m_rb + m_p + m_b [kg]."""
        return self.rigid_body.mass_kg + self.moving_mass.mass_kg + self.ballast.mass_kg

    def unknown_lateral(self) -> Iterator[str]:
        """Keys that sideways motion needs and this vehicle's sources do not give."""
        if self.added_inertia.sway_kg is None:
            yield "added_inertia.sway_kg"
        for key in (
            "side_force_per_rad_kg_m",
            "roll_moment_per_rad_kg",
            "yaw_moment_per_rad_kg",
            "roll_damping_kg_s",
            "yaw_damping_kg_s",
        ):
            if getattr(self.hydrodynamics, key) is None:
                yield f"hydrodynamics.{key}"
