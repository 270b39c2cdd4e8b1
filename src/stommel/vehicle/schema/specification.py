"""What the vehicle is asked to do, and the water it is trimmed for."""

from typing import Annotated, Self

from pydantic import Field, model_validator

from stommel.files.fields import Table, ordered
from stommel.files.ranges import BodyLength, Depth, Diameter, Mass, Speed, between


class Specification(Table):
    """What the vehicle is asked to do: Table 3 of the paper, and the flight that section 3.1 designs for."""

    body_length_m: BodyLength
    overall_length_m: Annotated[float, between(0.2, 15)]
    diameter_mm: Diameter
    mass_kg: Mass
    oil_volume_ml: Annotated[float, between(1, 1e5)]
    depth_m: Depth
    pitch_deg: Annotated[float, Field(strict=True, ge=0.1, lt=90)]
    rudder_deg: Annotated[float, between(0.1, 90)] | None = None
    endurance_days: Annotated[float, between(0.01, 3650)] | None = None
    speed_m_s: Speed | None = None
    """Greatest speed along the path that the design must reach."""
    design_speed_m_s: Speed | None = None
    """Speed of Table 1: pitch is varied at this speed."""
    design_pitch_deg: Annotated[float, Field(strict=True, ge=0.1, lt=90)] | None = None
    """Magnitude of the pitch of Table 2: speed is varied at this pitch."""
    shallowest_pitch_deg: Annotated[float, Field(strict=True, ge=0.1, lt=90)] = 5.0
    """Magnitude of the shallowest pitch that the design must fly at the design speed."""

    @model_validator(mode="after")
    def _pitches_are_ordered(self) -> Self:
        ordered("shallowest_pitch_deg to pitch_deg", (self.shallowest_pitch_deg, self.pitch_deg))
        return self


class ReferenceWater(Table):
    """Water in which the vehicle is trimmed neutral."""

    density_kg_m3: Annotated[float, between(900, 1200)]
    temperature_c: Annotated[float, between(-3, 45)] = 15.0
    gravity_m_s2: Annotated[float, between(9.7, 9.9)] = 9.81
