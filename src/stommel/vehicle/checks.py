"""Checks that need more than one number of a vehicle file: can this body exist, and does all of it fit inside."""

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from stommel.vehicle.schema import Hull, Matrix3, Point, VehicleFile
from stommel.vehicle.schema.budget import part_problems


def skew(a: Point) -> NDArray[np.float64]:
    """The matrix a^ with a^ b = a x b."""
    return np.array([[0.0, -a[2], a[1]], [a[2], 0.0, -a[0]], [-a[1], a[0], 0.0]])


def rigid_body_inertia_about_origin(vehicle: VehicleFile) -> NDArray[np.float64]:
    """J_rb about the centre of buoyancy [kg m2], moved there if the file gives it about the centre of mass."""
    body = vehicle.rigid_body
    J = np.array(body.inertia_kg_m2)
    if body.inertia_about == "centre_of_mass":
        r = skew(body.centre_of_mass_m)
        J = J - body.mass_kg * r @ r
    return J


def problems(vehicle: VehicleFile) -> Iterator[tuple[str, str]]:
    """Yield (key, what is wrong and what is allowed) for all that makes this vehicle impossible."""
    yield from _tensor_problems(vehicle)
    yield from _places(vehicle)
    yield from _bays(vehicle)
    yield from part_problems(vehicle.parts, vehicle.bays, vehicle.hull)


def _tensor_problems(vehicle: VehicleFile) -> Iterator[tuple[str, str]]:
    tensors: tuple[tuple[str, Matrix3, bool], ...] = (
        ("rigid_body.inertia_kg_m2", vehicle.rigid_body.inertia_kg_m2, True),
        ("moving_mass.inertia_kg_m2", vehicle.moving_mass.inertia_kg_m2, False),
        ("added_inertia.inertia_kg_m2", vehicle.added_inertia.inertia_kg_m2, False),
    )
    sound = True
    for key, rows, strictly in tensors:
        J = np.array(rows)
        shown = f"{key} = {J.tolist()}"
        if not np.allclose(J, J.T, rtol=1e-12, atol=0.0):
            yield key, f"{shown}: must be symmetric"
            sound = False
            continue
        least = float(np.linalg.eigvalsh(J)[0])
        if least < -1e-12 or (strictly and least <= 0.0):
            kind = "definite" if strictly else "semidefinite"
            yield key, f"{shown}: must be positive {kind}; its least eigenvalue is {least:.6g} kg m2"
            sound = False
    if not sound:
        return
    body = vehicle.rigid_body
    r = skew(body.centre_of_mass_m)
    about_mass = rigid_body_inertia_about_origin(vehicle) + body.mass_kg * r @ r
    least = float(np.linalg.eigvalsh(about_mass)[0])
    if least <= 0.0:
        yield (
            "rigid_body.inertia_kg_m2",
            f"rigid_body.inertia_kg_m2 = {np.array(body.inertia_kg_m2).tolist()}: less than what the mass needs at "
            f"centre_of_mass_m = {list(body.centre_of_mass_m)}; about the centre of mass its least eigenvalue is "
            f"{least:.6g} kg m2 and must be greater than 0",
        )
        return
    added = vehicle.added_inertia
    M = np.diag([added.surge_kg, added.sway_kg or 0.0, added.heave_kg]) + body.mass_kg * np.eye(3)
    C = np.array(added.coupling_kg_m) + body.mass_kg * r
    J = np.array(added.inertia_kg_m2) + rigid_body_inertia_about_origin(vehicle)
    if np.linalg.eigvalsh(np.block([[M, C.T], [C, J]]))[0] <= 0.0:
        yield (
            "added_inertia.coupling_kg_m",
            f"added_inertia.coupling_kg_m = {np.array(added.coupling_kg_m).tolist()}: too large; rigid body and added "
            "inertia together are not positive definite",
        )


def _places(vehicle: VehicleFile) -> Iterator[tuple[str, str]]:
    hull = vehicle.hull
    if hull is None:
        return
    sealed = (hull.nose_position_m - hull.length_m, hull.nose_position_m)
    whole = (sealed[0] - hull.tail_length_m, sealed[1] + hull.nose_length_m)
    offset = vehicle.moving_mass.offset_m
    yield from _outside("rigid_body.centre_of_mass_m", vehicle.rigid_body.centre_of_mass_m, whole, hull)
    yield from _outside("ballast.position_m", vehicle.ballast.position_m, whole, hull)
    yield from _outside(
        "moving_mass.neutral_position_m", (vehicle.moving_mass.neutral_position_m, 0.0, offset), sealed, hull
    )
    drive, engine = vehicle.actuators.moving_mass, vehicle.actuators.buoyancy
    if drive is not None:
        for end in drive.travel_m:
            yield from _outside("actuators.moving_mass.travel_mm", (end, 0.0, offset), sealed, hull)
        low, high = drive.travel_m
        if not low <= vehicle.moving_mass.neutral_position_m <= high:
            yield (
                "moving_mass.neutral_position_m",
                f"moving_mass.neutral_position_m = {vehicle.moving_mass.neutral_position_m:g}: must lie within "
                f"actuators.moving_mass.travel_mm = [{drive.travel_mm[0]:g}, {drive.travel_mm[1]:g}]",
            )
    if engine is not None and engine.bladder_position_m is not None:
        yield from _outside("actuators.buoyancy.bladder_position_m", engine.bladder_position_m, whole, hull)
    if engine is not None and engine.reservoir_position_m is not None:
        yield from _outside("actuators.buoyancy.reservoir_position_m", engine.reservoir_position_m, sealed, hull)


def _outside(key: str, r: Point, extent: tuple[float, float], hull: Hull) -> Iterator[tuple[str, str]]:
    if not extent[0] <= r[0] <= extent[1]:
        yield (
            key,
            f"{key}: {r[0]:g} m is outside the hull, which reaches from {extent[0]:g} to {extent[1]:g} m",
        )
    radius, distance = hull.outer_diameter_mm / 2e3, float(np.hypot(r[1], r[2]))
    if distance > radius:
        yield key, f"{key}: {distance:g} m off the axis is outside the hull, whose radius is {radius:g} m"


def _bays(vehicle: VehicleFile) -> Iterator[tuple[str, str]]:
    for before, after in zip(vehicle.bays, vehicle.bays[1:], strict=False):
        if after.from_m > before.to_m + 1e-9:
            yield (
                "bays",
                f"bays: {after.name!r} begins at {after.from_m:g} m, inside {before.name!r}, which ends at "
                f"{before.to_m:g} m; bays are listed from nose to tail and may not overlap",
            )
