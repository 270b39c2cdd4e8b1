"""What a vehicle file may say: tables, keys with their units, allowed ranges.

One frozen model is both the form of the file and the description that the rest of stommel reads; where the file speaks
millimetres, millilitres or degrees, a property gives SI (docs/decisions/0002). Anything that a table does not know is
refused.
"""

from stommel.files.fields import Matrix3, Point
from stommel.vehicle.schema.actuators import Actuators, BuoyancyEngine, MovingMassDrive, RollDrive, RudderDrive
from stommel.vehicle.schema.budget import Part
from stommel.vehicle.schema.drives import Drives
from stommel.vehicle.schema.energy import Battery, Consumer, EnergyPlan
from stommel.vehicle.schema.engine import Engine
from stommel.vehicle.schema.hull import Bay, Hull, Rings
from stommel.vehicle.schema.hydrodynamics import Hydrodynamics, Rudder, Wing
from stommel.vehicle.schema.masses import AddedInertia, Ballast, MovingMass, RigidBody
from stommel.vehicle.schema.specification import ReferenceWater, Specification
from stommel.vehicle.schema.vehicle_file import VehicleFile

__all__ = [
    "Actuators",
    "AddedInertia",
    "Ballast",
    "Battery",
    "Bay",
    "BuoyancyEngine",
    "Consumer",
    "Drives",
    "EnergyPlan",
    "Engine",
    "Hull",
    "Hydrodynamics",
    "Matrix3",
    "MovingMass",
    "MovingMassDrive",
    "Part",
    "Point",
    "ReferenceWater",
    "RigidBody",
    "Rings",
    "RollDrive",
    "Rudder",
    "RudderDrive",
    "Specification",
    "VehicleFile",
    "Wing",
]
