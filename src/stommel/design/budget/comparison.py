"""The budget beside what the vehicle file says without it: masses, centres, inertia, travel of the moving mass."""

from collections.abc import Iterator
from dataclasses import dataclass
from math import radians, tan
from typing import Any

import numpy as np

from stommel.design.budget.added_inertia import spheroid_added_inertia
from stommel.design.budget.mass_properties import Tensor3
from stommel.design.budget.totals import Budget
from stommel.design.named_warning import NamedWarning
from stommel.vehicle import Vehicle
from stommel.vehicle.checks import rigid_body_inertia_about_origin
from stommel.vehicle.schema.budget import Part

MASS_TOLERANCE_KG = 1e-3
PLACE_TOLERANCE_M = 5e-4
DEFAULT_PITCH_DEG = 35.0


@dataclass(frozen=True)
class InertiaComparison:
    """Inertia of the rigid body about the origin beside the file's sum with the water's. [kg m2]."""

    budget: Tensor3
    """J_rb of the parts."""
    file_sum: Tensor3
    """J_rb + J_f as the file has it."""
    spheroid: tuple[float, float, float] | None
    """J_f of a spheroid of the hull's overall length and diameter: roll, pitch, yaw; None without a hull."""

    @property
    def left_for_water(self) -> Tensor3:
        """What the file's sum leaves for the water that moves with the vehicle."""
        return self.file_sum - self.budget

    @property
    def possible(self) -> bool:
        """Whether that is an inertia: positive semidefinite."""
        return bool(np.linalg.eigvalsh(self.left_for_water)[0] >= -1e-9)

    def as_row(self) -> dict[str, Any]:
        """The tensors in words with units."""
        return {
            "inertia_kg_m2": self.budget.tolist(),
            "file_sum_with_water_kg_m2": self.file_sum.tolist(),
            "left_for_water_kg_m2": self.left_for_water.tolist(),
            "spheroid_added_inertia_kg_m2": None if self.spheroid is None else list(self.spheroid),
        }


def compare_inertia(vehicle: Vehicle, budget: Budget) -> InertiaComparison:
    """Hold the inertia of the parts against the file's."""
    d = vehicle.description
    spheroid = None
    if d.hull is not None:
        length, width = d.hull.length_m + d.hull.nose_length_m + d.hull.tail_length_m, d.hull.outer_diameter_mm / 1e3
        if length > width:
            across = spheroid_added_inertia(length, width, d.water.density_kg_m3)
            spheroid = (0.0, across, across)
    return InertiaComparison(
        budget.rigid_body.inertia,
        rigid_body_inertia_about_origin(d) + np.array(d.added_inertia.inertia_kg_m2),
        spheroid,
    )


def highest_lever(vehicle: Vehicle, budget: Budget) -> float | None:
    """Centre of mass of the rigid body below the axis if every dry part lay as low as it fits [m] (eq-w9)."""
    d = vehicle.description
    if d.hull is None or budget.rigid_body.mass <= 0.0:
        return None
    radius = (d.hull.inner_diameter_mm or d.hull.outer_diameter_mm) / 2e3
    moment = 0.0
    for part in d.parts:
        if part.moving or part.ballast:
            continue
        lowest = max(radius - _half_height(part), 0.0)
        moment += part.mass_kg * (part.position_m[2] if part.wet else max(lowest, part.position_m[2]))
    return moment / budget.rigid_body.mass


def _half_height(part: Part) -> float:
    if part.box_mm is not None:
        return part.box_mm[2] / 2e3
    return (part.diameter_mm or 0.0) / 2e3


def comparison_warnings(vehicle: Vehicle, budget: Budget, inertia: InertiaComparison) -> Iterator[NamedWarning]:
    """Everything in which budget and file disagree."""
    yield from _masses(vehicle, budget)
    yield from _centres(vehicle, budget)
    if not inertia.possible:
        yield NamedWarning(
            "inertia_exceeds_file",
            f"about the origin the rigid parts alone have {_diagonal(inertia.budget)} kg m2; the file gives rigid body "
            f"and water together {_diagonal(inertia.file_sum)}, which leaves the water less than nothing",
        )
    yield from _sweep(vehicle)
    for part in vehicle.description.parts:
        bay = next(bay for bay in vehicle.description.bays if bay.name == part.bay)
        if bay.flooded and not part.wet:
            yield NamedWarning(
                "dry_part_in_water", f"{part.name!r} is in the flooded bay {bay.name!r} and displaces no water"
            )


def _diagonal(J: Tensor3) -> str:
    return ", ".join(f"{value:.3g}" for value in np.diag(J))


def _masses(vehicle: Vehicle, budget: Budget) -> Iterator[NamedWarning]:
    d = vehicle.description
    pairs = (
        ("rigid_body.mass_kg", budget.rigid_body.mass, d.rigid_body.mass_kg, "parts that neither move nor are ballast"),
        ("moving_mass.mass_kg", budget.moving.mass, d.moving_mass.mass_kg, "moving parts"),
        ("ballast.mass_kg", budget.ballast.mass, d.ballast.mass_kg, "ballast parts"),
    )
    for key, found, stated, which in pairs:
        if abs(found - stated) > MASS_TOLERANCE_KG:
            yield NamedWarning(
                "mass_differs", f"the {which} sum to {found:.3f} kg; {key} = {stated:g} ({found - stated:+.3f} kg)"
            )
    spec = d.specification
    if spec is not None and budget.total.mass > spec.mass_kg + MASS_TOLERANCE_KG:
        yield NamedWarning(
            "over_specification",
            f"the parts sum to {budget.total.mass:.3f} kg; specification.mass_kg = {spec.mass_kg:g}",
        )


def _centres(vehicle: Vehicle, budget: Budget) -> Iterator[NamedWarning]:
    d = vehicle.description
    off = np.abs(budget.centre_of_buoyancy).max()
    if off > PLACE_TOLERANCE_M:
        yield NamedWarning(
            "centre_of_buoyancy_off_origin",
            f"the centre of buoyancy is at {_place(budget.centre_of_buoyancy)} m; the body frame has its origin there, "
            "so all positions of the file should be moved by this",
        )
    body = budget.rigid_body
    stated = np.array(d.rigid_body.centre_of_mass_m)
    if body.mass > 0.0 and np.abs(body.centre - stated).max() > PLACE_TOLERANCE_M:
        yield NamedWarning("centre_of_mass_differs", _centre_of_mass_words(vehicle, budget))
    neutral = np.array([d.moving_mass.neutral_position_m, 0.0, d.moving_mass.offset_m])
    for key, found, place in (
        ("moving_mass.neutral_position_m", budget.moving, neutral),
        ("ballast.position_m", budget.ballast, np.array(d.ballast.position_m)),
    ):
        if found.mass > 0.0 and np.abs(found.centre - place).max() > PLACE_TOLERANCE_M:
            yield NamedWarning(
                "place_differs", f"{key}: the file says {_place(place)} m, the parts {_place(found.centre)} m"
            )


def _centre_of_mass_words(vehicle: Vehicle, budget: Budget) -> str:
    d = vehicle.description
    body, stated = budget.rigid_body, d.rigid_body.centre_of_mass_m
    words = (
        f"the rigid body's centre of mass is at {_place(body.centre)} m; rigid_body.centre_of_mass_m = {list(stated)}"
    )
    highest = highest_lever(vehicle, budget)
    if highest is not None and stated[2] > highest:
        words += f"; z = {stated[2]:g} is out of reach: with every dry part at the bottom it is {highest:.4f} m"
    if abs(body.centre[2] - stated[2]) > PLACE_TOLERANCE_M:
        spec = d.specification
        pitch = (spec.design_pitch_deg if spec else None) or DEFAULT_PITCH_DEG
        travel = [
            body.mass * z / d.moving_mass.mass_kg * tan(radians(pitch)) * 1e3 for z in (body.centre[2], stated[2])
        ]
        words += (
            f"; a pitch of {pitch:g} deg at rest then takes {travel[0]:.0f} mm of the moving mass instead of "
            f"{travel[1]:.0f} mm"
        )
    return words


def _place(r: object) -> str:
    return "(" + ", ".join(f"{value + 0.0:.4f}" for value in np.round(np.asarray(r, dtype=float), 4)) + ")"


def _sweep(vehicle: Vehicle) -> Iterator[NamedWarning]:
    """Moving parts reach beyond their bay at the ends of their travel."""
    d = vehicle.description
    drive = d.actuators.moving_mass
    moving = [part for part in d.parts if part.moving]
    if drive is None or not moving:
        return
    low, high = drive.travel_m
    for bay in d.bays:
        inside = [part for part in moving if part.bay == bay.name]
        if not inside:
            continue
        neutral = d.moving_mass.neutral_position_m
        aft = min(part.position_m[0] - 0.5 * part.length_m for part in inside) + low - neutral
        fore = max(part.position_m[0] + 0.5 * part.length_m for part in inside) + high - neutral
        if aft < bay.to_m - PLACE_TOLERANCE_M or fore > bay.from_m + PLACE_TOLERANCE_M:
            yield NamedWarning(
                "moving_mass_leaves_bay",
                f"over its travel the moving mass sweeps {aft:.3f} to {fore:.3f} m; its bay {bay.name!r} reaches from "
                f"{bay.to_m:g} to {bay.from_m:g} m",
            )
