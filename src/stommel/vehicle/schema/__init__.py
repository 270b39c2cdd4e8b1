"""What a vehicle file may say: tables, keys with their units, allowed ranges.

One frozen model is both the form of the file and the description that the rest of stommel reads; where the file speaks
millimetres, millilitres or degrees, a property gives SI (docs/decisions/0002). Anything that a table does not know is
refused.
"""

from stommel.vehicle.schema.actuators import Actuators, BuoyancyEngine, MovingMassDrive, RollDrive, RudderDrive
from stommel.vehicle.schema.energy import Battery, Consumer, EnergyPlan
from stommel.vehicle.schema.fields import Matrix3, Point
from stommel.vehicle.schema.hull import Bay, Hull
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
    "EnergyPlan",
    "Hull",
    "Hydrodynamics",
    "Matrix3",
    "MovingMass",
    "MovingMassDrive",
    "Point",
    "ReferenceWater",
    "RigidBody",
    "RollDrive",
    "Rudder",
    "RudderDrive",
    "Specification",
    "VehicleFile",
    "Wing",
]
