"""A glider, as its file describes it."""

from collections.abc import Iterator
from typing import Annotated, Literal, Self

from pydantic import AfterValidator, Field, model_validator

from stommel.files.fields import Table
from stommel.files.kinds import Format
from stommel.vehicle.schema.actuators import Actuators
from stommel.vehicle.schema.antenna import Antenna
from stommel.vehicle.schema.budget import Part
from stommel.vehicle.schema.drives import Drives
from stommel.vehicle.schema.drop_weight import DropWeight
from stommel.vehicle.schema.energy import Battery, Consumer, EnergyPlan
from stommel.vehicle.schema.engine import Engine
from stommel.vehicle.schema.hull import Bay, Hull
from stommel.vehicle.schema.hydrodynamics import Hydrodynamics, Rudder, Wing
from stommel.vehicle.schema.masses import AddedInertia, Ballast, MovingMass, RigidBody
from stommel.vehicle.schema.specification import ReferenceWater, Specification


def _one_printable_line(text: str) -> str:
    if not text.isprintable() or not text.strip():
        raise ValueError(f"{text!r}: must be one line of printable text")
    return text


class VehicleFile(Table):
    """A glider, as its file describes it."""

    format: Format = 1
    name: Annotated[str, Field(max_length=80), AfterValidator(_one_printable_line)]
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
    engine: Engine | None = None
    hull: Hull | None = None
    bays: tuple[Bay, ...] = ()
    antenna: Antenna | None = None
    drop_weight: DropWeight | None = None
    battery: Battery | None = None
    energy: EnergyPlan | None = None
    consumers: tuple[Consumer, ...] = ()
    drives: Drives | None = None
    parts: tuple[Part, ...] = ()

    @property
    def mass_kg(self) -> float:
        """Total mass m = m_rb + m_p + m_b [kg]."""
        return self.rigid_body.mass_kg + self.moving_mass.mass_kg + self.ballast.mass_kg

    @model_validator(mode="after")
    def _engine_moves_no_more_than_its_stroke(self) -> Self:
        if self.engine is not None and self.actuators.buoyancy is not None:
            self.actuators.buoyancy.limit_to_stroke(self.engine.measured_piston.working_volume_ml)
        return self

    @property
    def steers_by(self) -> Literal["rudder", "roll"] | None:
        """What steers the vehicle: the rudder, if it has both; None if it has neither."""
        if self.rudder is not None and self.actuators.rudder is not None:
            return "rudder"
        return "roll" if self.actuators.roll is not None and self.moving_mass.offset_m > 0.0 else None

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
