"""What a glider is: validated description, loading, provenance, built-in vehicles."""

from stommel.files.provenance import Provenance
from stommel.vehicle.loading import (
    LateralPlaneUnknownError,
    UnknownVehicleError,
    Vehicle,
    builtin_names,
    builtin_text,
    load_vehicle,
    stated_numbers,
    vehicle_from_text,
    vehicle_text,
)
from stommel.vehicle.physics import FULL, PAPER, PHYSICS, Physics
from stommel.vehicle.schema import VehicleFile

__all__ = [
    "FULL",
    "PAPER",
    "PHYSICS",
    "LateralPlaneUnknownError",
    "Physics",
    "Provenance",
    "UnknownVehicleError",
    "Vehicle",
    "VehicleFile",
    "builtin_names",
    "builtin_text",
    "load_vehicle",
    "stated_numbers",
    "vehicle_from_text",
    "vehicle_text",
]
