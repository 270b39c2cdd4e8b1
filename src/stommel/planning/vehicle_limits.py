"""The limits that a vehicle's software holds missions against, from the vehicle's file."""

from stommel.control.vehicle_limits import VehicleLimits
from stommel.errors import FileError, Problem
from stommel.vehicle import Vehicle
from stommel.vehicle.fingerprint import untrimmed_fingerprint

AIR_AT_THE_SURFACE_KPA = 101.325
"""Standard atmosphere: in a hull without its vacuum the pressure is no greater."""


def depth_rating(vehicle: Vehicle) -> float | None:
    """Depth that the file of a vehicle rates it for [m], by its hull or else by its specification."""
    hull, specification = vehicle.description.hull, vehicle.description.specification
    if hull is not None and hull.depth_rating_m is not None:
        return hull.depth_rating_m
    return specification.depth_m if specification is not None else None


def vehicle_limits(vehicle: Vehicle) -> VehicleLimits:
    """What the software's configuration says of a vehicle.

    Raises
    ------
    FileError
        The vehicle's file lacks what a mission needs: buoyancy engine, drive of the moving mass, a depth.
    """
    d = vehicle.description
    engine, drive = d.actuators.buoyancy, d.actuators.moving_mass
    depth = depth_rating(vehicle)
    needed = {"actuators.buoyancy": engine, "actuators.moving_mass": drive, "hull.depth_rating_m": depth}
    missing = [key for key, found in needed.items() if found is None]
    if missing or engine is None or drive is None or depth is None:
        texts = (f"{key} is missing: the limits of missions need it" for key in missing)
        raise FileError([Problem(vehicle.origin, key, text) for key, text in zip(missing, texts, strict=True)])
    steering = {"rudder": d.actuators.rudder, "roll": d.actuators.roll}.get(d.steers_by or "")
    battery = d.battery
    return VehicleLimits(
        vehicle_sha256=untrimmed_fingerprint(vehicle),
        ballast_ml=engine.range_ml,
        moving_mass_mm=drive.travel_mm,
        steering_deg=steering.travel_deg if steering is not None else 0.0,
        depth_rating_m=depth,
        internal_pressure_kpa=AIR_AT_THE_SURFACE_KPA,
        battery_wh=round(battery.capacity_ah * battery.voltage_v, 3) if battery is not None else None,
    )
