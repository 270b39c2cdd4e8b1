"""How large a vehicle is, from what its file says."""

from math import pi

from stommel.vehicle.schema import VehicleFile

SLENDEREST = 25.0
"""Length over diameter of a hull."""


def displaced_m3(vehicle: VehicleFile) -> float:
    """Volume of water that it displaces when it is neutral [m3]."""
    return vehicle.mass_kg / vehicle.water.density_kg_m3


def longest_m(vehicle: VehicleFile) -> float:
    """Length of the vehicle [m]: of its hull with nose and tail, or that of the slenderest body of its volume."""
    hull = vehicle.hull
    if hull is not None:
        return hull.length_m + hull.nose_length_m + hull.tail_length_m
    return float((4.0 / pi * displaced_m3(vehicle) * SLENDEREST**2) ** (1.0 / 3.0))
