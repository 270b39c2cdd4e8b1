"""Pressure hull and bays."""

from math import pi
from typing import Self

from pydantic import model_validator

from stommel.vehicle.schema.fields import Finite, NotNegative, Positive, Table


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
