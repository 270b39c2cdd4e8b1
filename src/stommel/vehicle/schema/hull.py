"""Pressure hull and bays."""

from math import pi
from typing import Annotated, Self

from pydantic import model_validator

from stommel.files.fields import Name, Table
from stommel.files.kinds import Flag
from stommel.files.ranges import (
    BodyLength,
    Compressibility,
    Coordinate,
    Depth,
    Diameter,
    Pressure,
    ThermalExpansion,
    Wall,
    ZeroOr,
    between,
)

Fraction = Annotated[float, between(0.1, 1)]
SafetyFactor = Annotated[float, between(1, 50)]
End = Annotated[float, ZeroOr(0.002, 5)]


class Rings(Table):
    """Ring stiffeners inside the tube, of rectangular section."""

    spacing_mm: Annotated[float, between(1, 10000)]
    """Distance between neighbouring rings, or between a ring and the end of the bay."""
    height_mm: Annotated[float, between(0.1, 1000)]
    """How far a ring stands inward from the wall."""
    width_mm: Annotated[float, between(0.1, 1000)]
    """Width of a ring along the tube."""


class Hull(Table):
    """Pressure hull."""

    length_m: BodyLength
    outer_diameter_mm: Diameter
    inner_diameter_mm: Annotated[float, between(10, 2000)] | None = None
    nose_position_m: Coordinate
    """Forward end of the sealed hull, forward of the centre of buoyancy."""
    tail_length_m: End = 0.0
    """What extends aft of the sealed hull: wet tail, bladder, rudder."""
    nose_length_m: End = 0.0
    """What extends forward of the sealed hull: wet nose with sensors."""
    material: Name | None = None
    wall_mm: Wall | None = None
    depth_rating_m: Depth | None = None
    design_pressure_mpa: Pressure | None = None
    """Pressure that the depth rating stands for; the water's weight over that depth if left out. P_max of the paper."""
    checked_length_m: Annotated[float, between(0.01, 10)] | None = None
    """Longest length of tube between reinforced joints: L of the paper. The longest dry bay if left out."""
    weld_efficiency: Fraction = 1.0
    """Share of the wall's strength that a longitudinal weld keeps; 1 for a seamless tube."""
    wall_allowance_mm: Annotated[float, between(0, 50)] = 0.0
    """Wall that corrosion and tolerances may take: C of the paper."""
    yield_safety_factor: SafetyFactor = 2.0
    """Yield stress over permissible stress."""
    tensile_safety_factor: SafetyFactor = 3.0
    """Tensile stress over permissible stress."""
    circumferential_safety_factor: SafetyFactor = 2.0
    """Critical over working pressure for buckling round the circumference: m_c of the paper."""
    knock_down: Fraction = 1.0
    """Share of a perfect tube's buckling pressure round the circumference that the built tube keeps; 1 if left out."""
    axial_safety_factor: SafetyFactor = 3.0
    """Critical over permissible stress for buckling along the axis: m_a of the paper."""
    rings: Rings | None = None
    compressibility_per_pa: Compressibility = 0.0
    thermal_expansion_per_k: ThermalExpansion = 0.0

    @model_validator(mode="after")
    def _has_an_inside(self) -> Self:
        if self.inner_diameter_mm is not None and self.inner_diameter_mm >= self.outer_diameter_mm:
            raise ValueError(
                f"inner_diameter_mm = {self.inner_diameter_mm:g}: must be less than outer_diameter_mm = "
                f"{self.outer_diameter_mm:g}"
            )
        if self.wall_mm is not None and self.wall_mm >= 0.5 * self.outer_diameter_mm:
            raise ValueError(
                f"wall_mm = {self.wall_mm:g}: must be less than half of outer_diameter_mm = {self.outer_diameter_mm:g}"
            )
        if self.checked_length_m is not None and self.checked_length_m > self.length_m:
            raise ValueError(
                f"checked_length_m = {self.checked_length_m:g}: must be at most length_m = {self.length_m:g}"
            )
        if self.rings is not None and self.rings.height_mm >= 0.5 * self.outer_diameter_mm:
            raise ValueError(
                f"rings.height_mm = {self.rings.height_mm:g}: must be less than half of outer_diameter_mm = "
                f"{self.outer_diameter_mm:g}"
            )
        return self

    @property
    def volume_m3(self) -> float:
        """Volume of the plain tube [m3]."""
        return pi / 4 * (self.outer_diameter_mm / 1e3) ** 2 * self.length_m


class Bay(Table):
    """A section of the vehicle (Fig. 6 of the paper)."""

    name: Name
    from_m: Coordinate
    """Forward end, forward of the centre of buoyancy."""
    to_m: Coordinate
    """Aft end."""
    flooded: Flag = False
    holds: tuple[str, ...] = ()

    @model_validator(mode="after")
    def _reads_forward_to_aft(self) -> Self:
        if self.to_m >= self.from_m:
            raise ValueError(f"to_m = {self.to_m:g}: must be aft of (less than) from_m = {self.from_m:g}")
        return self
