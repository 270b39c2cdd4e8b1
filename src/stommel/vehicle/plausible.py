"""What is possible, and yet hardly meant: numbers of a vehicle file that do not fit each other.

Each range of a field is wide enough for any glider; these relations know the size of this one. They are warnings: a
vehicle that breaks one can be analysed.
"""

from math import pi, sqrt

import numpy as np

from stommel.vehicle.checks import rigid_body_inertia_about_origin
from stommel.vehicle.plausible_machinery import Findings, actuator_findings, energy_findings, machinery_findings
from stommel.vehicle.schema import Hull, Matrix3, Part, VehicleFile
from stommel.vehicle.size import SLENDEREST, displaced_m3, longest_m

LEAST_STABILITY_ARM_M = 0.003
"""Centre of mass below the centre of buoyancy; published gliders have 4 to 10 mm."""
MOST_OFF_LEVEL = 0.005
"""Centre of mass forward of the centre of buoyancy at neutral, over the length; shipped vehicles have none."""
DENSEST_KG_M3 = 22600.0
"""Osmium."""
LIGHTEST_KG_M3 = 10.0
"""Foam."""
LEAD_KG_M3 = 11340.0


def implausible(vehicle: VehicleFile) -> Findings:
    """Yield (key, what is odd and what would be usual) for numbers that do not fit each other."""
    yield from _bodies(vehicle)
    yield from _water(vehicle)
    yield from actuator_findings(vehicle)
    yield from _hull(vehicle)
    yield from _outside_things(vehicle)
    yield from _parts(vehicle)
    yield from energy_findings(vehicle)
    yield from machinery_findings(vehicle)


def _bodies(vehicle: VehicleFile) -> Findings:
    m, length = vehicle.mass_kg, longest_m(vehicle)
    body, mover, ballast = vehicle.rigid_body, vehicle.moving_mass, vehicle.ballast
    spec = vehicle.specification
    if spec is not None and m > 1.05 * spec.mass_kg:
        yield (
            "specification.mass_kg",
            f"the vehicle has {m:g} kg, more than its specification.mass_kg = {spec.mass_kg:g}",
        )
    if spec is not None and m < 0.2 * spec.mass_kg:
        yield (
            "specification.mass_kg",
            f"the vehicle has {m:g} kg, hardly any of specification.mass_kg = {spec.mass_kg:g}",
        )
    moment = body.mass_kg * body.centre_of_mass_m[2] + mover.mass_kg * mover.offset_m
    arm = (moment + ballast.mass_kg * ballast.position_m[2]) / m
    if arm < LEAST_STABILITY_ARM_M:
        yield (
            "rigid_body.centre_of_mass_m.2",
            f"the centre of mass lies {arm * 1e3:.2g} mm below the centre of buoyancy; it rights the vehicle from "
            f"{LEAST_STABILITY_ARM_M * 1e3:g} mm on",
        )
    level = body.mass_kg * body.centre_of_mass_m[0] + mover.mass_kg * mover.neutral_position_m
    forward = (level + ballast.mass_kg * ballast.position_m[0]) / m
    if abs(forward) > MOST_OFF_LEVEL * length:
        yield (
            "moving_mass.neutral_position_m",
            f"with the moving mass at moving_mass.neutral_position_m the centre of mass lies {forward * 1e3:.3g} mm "
            "forward of the centre of buoyancy: the vehicle does not rest level",
        )
    for key, share in (("moving_mass.mass_kg", mover.mass_kg / m), ("ballast.mass_kg", ballast.mass_kg / m)):
        if share > 0.6:
            yield key, f"{key}: {100 * share:.0f} % of the vehicle's mass; usual are 10 to 30 %"
    if mover.mass_kg < 0.01 * m:
        yield "moving_mass.mass_kg", f"moving_mass.mass_kg = {mover.mass_kg:g}: hardly moves a vehicle of {m:g} kg"
    yield from _gyration("rigid_body.inertia_kg_m2", _about_mass(vehicle), body.mass_kg, length, least=True)
    yield from _gyration("moving_mass.inertia_kg_m2", mover.inertia_kg_m2, mover.mass_kg, length, least=False)
    yield from _gyration("added_inertia.inertia_kg_m2", vehicle.added_inertia.inertia_kg_m2, m, length, least=False)


def _about_mass(vehicle: VehicleFile) -> Matrix3:
    body = vehicle.rigid_body
    J = rigid_body_inertia_about_origin(vehicle)
    x, y, z = body.centre_of_mass_m
    square = np.diag([y * y + z * z, x * x + z * z, x * x + y * y])
    rows = (J - body.mass_kg * square).tolist()
    return rows[0], rows[1], rows[2]


def _gyration(key: str, J: Matrix3, mass: float, length: float, *, least: bool) -> Findings:
    """Radii of gyration between that of a ball of lead and half the vehicle's length."""
    ball = 0.4 * (3.0 * mass / (4.0 * pi * LEAD_KG_M3)) ** (2.0 / 3.0)
    for axis in range(3):
        moment = abs(J[axis][axis])
        if moment > mass * (0.5 * length) ** 2:
            yield (
                f"{key}.{axis}",
                f"{key}: {moment:.4g} kg m2 is a radius of gyration of {sqrt(moment / mass):.3g} m; half the vehicle's "
                f"length is {0.5 * length:.3g} m",
            )
        elif least and moment < mass * ball:
            yield f"{key}.{axis}", f"{key}: {moment:.4g} kg m2 is less than a ball of lead of {mass:g} kg has"


def _water(vehicle: VehicleFile) -> Findings:
    """Added masses and coefficients against the vehicle's size."""
    m, length, h, added = vehicle.mass_kg, longest_m(vehicle), vehicle.hydrodynamics, vehicle.added_inertia
    for name, value, low, high in (
        ("surge_kg", added.surge_kg, 0.003, 2.0),
        ("sway_kg", added.sway_kg or 0.0, 0.03, 10.0),
        ("heave_kg", added.heave_kg, 0.03, 10.0),
    ):
        if value and not low * m <= value <= high * m:
            yield (
                f"added_inertia.{name}",
                f"added_inertia.{name} = {value:g}: a vehicle of {m:g} kg has {low * m:.3g} to {high * m:.4g}",
            )
    angle = abs(h.lift_kg_m) / h.lift_per_rad_kg_m
    if angle > 0.3:
        yield "hydrodynamics.lift_kg_m", f"hydrodynamics.lift_kg_m = {h.lift_kg_m:g}: zero lift only at {angle:.2g} rad"
    if abs(h.pitch_moment_kg) > 0.3 * abs(h.pitch_moment_per_rad_kg) and h.pitch_moment_kg:
        yield (
            "hydrodynamics.pitch_moment_kg",
            f"hydrodynamics.pitch_moment_kg = {h.pitch_moment_kg:g}: more than 0.3 rad of angle of attack gives",
        )
    face = displaced_m3(vehicle) ** (2.0 / 3.0) * 500.0
    if not 0.005 * face <= h.drag_kg_m <= 10.0 * face:
        yield (
            "hydrodynamics.drag_kg_m",
            f"hydrodynamics.drag_kg_m = {h.drag_kg_m:g}: this volume has {0.005 * face:.2g} to {10.0 * face:.4g}",
        )
    lever = abs(h.pitch_moment_per_rad_kg) / h.lift_per_rad_kg_m
    if lever > length:
        yield (
            "hydrodynamics.pitch_moment_per_rad_kg",
            f"hydrodynamics.pitch_moment_per_rad_kg: acts {lever:.3g} m away; the vehicle is {length:.3g} m long",
        )
    for name in ("pitch_damping_kg_s", "roll_damping_kg_s", "yaw_damping_kg_s"):
        value = abs(getattr(h, name) or 0.0)
        if value > 10.0 * m * length**2:
            yield (
                f"hydrodynamics.{name}",
                f"hydrodynamics.{name} = {-value:g}: more than {10.0 * m * length**2:.4g} for this mass and length",
            )
    if vehicle.rudder is not None and h.side_force_per_rad_kg_m is not None:
        share = vehicle.rudder.side_force_per_rad_kg_m
        if share > h.side_force_per_rad_kg_m:
            yield (
                "rudder.side_force_per_rad_kg_m",
                f"rudder.side_force_per_rad_kg_m = {share:g}: the whole vehicle has {h.side_force_per_rad_kg_m:g}",
            )
    for name, surface in (("wing", vehicle.wing), ("rudder", vehicle.rudder)):
        moved = surface.aerodynamic_centre_aft_m - surface.reference_aft_m if surface is not None else 0.0
        if abs(moved) > 0.1 * length:
            yield (
                f"{name}.reference_aft_m",
                f"{name}.aerodynamic_centre_aft_m lies {1e3 * moved:.3g} mm aft of {name}.reference_aft_m, for which "
                "the coefficients were found: too far to add up",
            )
    if vehicle.wing is not None and vehicle.wing.lift_per_rad_kg_m > h.lift_per_rad_kg_m:
        yield (
            "wing.lift_per_rad_kg_m",
            f"wing.lift_per_rad_kg_m: more than the whole vehicle's, {h.lift_per_rad_kg_m:g}",
        )


def _hull(vehicle: VehicleFile) -> Findings:
    hull = vehicle.hull
    if hull is None:
        return
    yield from _hull_size(vehicle, hull)
    spec = vehicle.specification
    if spec is not None:
        for key, value, wanted in (
            ("hull.length_m", hull.length_m, spec.body_length_m),
            ("hull.outer_diameter_mm", hull.outer_diameter_mm, spec.diameter_mm),
            ("hull.depth_rating_m", hull.depth_rating_m or spec.depth_m, spec.depth_m),
        ):
            if not 0.2 <= value / wanted <= 5.0:
                yield key, f"{key} = {value:g}: the specification says {wanted:g}"
    if hull.design_pressure_mpa is not None and hull.depth_rating_m is not None:
        expected = hull.depth_rating_m * vehicle.water.density_kg_m3 * 9.81 / 1e6
        if not 0.8 <= hull.design_pressure_mpa / expected <= 3.0:
            yield (
                "hull.design_pressure_mpa",
                f"hull.design_pressure_mpa = {hull.design_pressure_mpa:g}: hull.depth_rating_m = "
                f"{hull.depth_rating_m:g} is {expected:.3g} MPa",
            )


def _hull_size(vehicle: VehicleFile, hull: Hull) -> Findings:
    slenderness = hull.length_m / (hull.outer_diameter_mm / 1e3)
    if not 0.5 <= slenderness <= SLENDEREST:
        yield "hull.length_m", f"hull.length_m = {hull.length_m:g}: {slenderness:.3g} diameters; usual are 4 to 12"
    if not 0.3 <= hull.volume_m3 / displaced_m3(vehicle) <= 3.0:
        yield (
            "hull.length_m",
            f"the hull has {1e3 * hull.volume_m3:.4g} l; the vehicle displaces {1e3 * displaced_m3(vehicle):.4g} l",
        )
    if hull.inner_diameter_mm is not None and hull.inner_diameter_mm < 0.5 * hull.outer_diameter_mm:
        yield "hull.inner_diameter_mm", f"hull.inner_diameter_mm = {hull.inner_diameter_mm:g}: less than half the outer"
    overall, spec = longest_m(vehicle), vehicle.specification
    if spec is not None and abs(overall - spec.overall_length_m) > 0.2 * spec.overall_length_m:
        yield (
            "specification.overall_length_m",
            f"hull with nose and tail is {overall:.3g} m long; {spec.overall_length_m:g} m are specified",
        )


def _outside_things(vehicle: VehicleFile) -> Findings:
    """The antenna stands out of the hull, away from the middle; the bladder lies in the water."""
    antenna, engine, hull = vehicle.antenna, vehicle.actuators.buoyancy, vehicle.hull
    if antenna is not None and hull is not None:
        x, y, z = antenna.position_m
        inside = hull.nose_position_m - longest_m(vehicle) + hull.nose_length_m <= x
        if inside and y * y + z * z < (hull.outer_diameter_mm / 2e3) ** 2:
            yield "antenna.position_m", "antenna.position_m: does not stand out of the hull"
        if abs(x) < 0.1 * longest_m(vehicle):
            yield "antenna.position_m", f"antenna.position_m: {x:g} m is so near the middle that no pitch raises it"
    weight, engine_l = vehicle.drop_weight, 0.0 if engine is None else (engine.volume_m3[1] - engine.volume_m3[0]) * 1e3
    if weight is not None and not 0.5 * engine_l <= weight.mass_in_water_kg <= 0.2 * vehicle.mass_kg:
        yield (
            "drop_weight.mass_in_water_kg",
            f"drop_weight.mass_in_water_kg = {weight.mass_in_water_kg:g}: between half of what the engine moves "
            f"({0.5 * engine_l:.3g} kg) and a fifth of the vehicle ({0.2 * vehicle.mass_kg:.3g} kg) is usual",
        )
    flooded = [bay for bay in vehicle.bays if bay.flooded]
    if engine is not None and engine.bladder_position_m is not None and flooded:
        at = engine.bladder_position_m[0]
        if not any(bay.to_m - 1e-6 <= at <= bay.from_m + 1e-6 for bay in flooded):
            yield (
                "actuators.buoyancy.bladder_position_m",
                f"actuators.buoyancy.bladder_position_m: {at:g} m is in no flooded bay; the bladder lies in the water",
            )


def _parts(vehicle: VehicleFile) -> Findings:
    length = longest_m(vehicle)
    for k, part in enumerate(vehicle.parts):
        key = f"parts.{k}"
        if part.mass_kg > vehicle.mass_kg:
            yield f"{key}.mass_kg", f"{key}.mass_kg = {part.mass_kg:g}: {part.name!r} is heavier than the whole vehicle"
        if part.volume_m3 > displaced_m3(vehicle):
            yield (
                f"{key}.volume_ml",
                f"{key}.volume_ml = {part.volume_ml:g}: {part.name!r} displaces more than the vehicle",
            )
        room = part_volume_m3(part)
        if room and part.mass_kg and not LIGHTEST_KG_M3 <= part.mass_kg / room <= DENSEST_KG_M3:
            yield f"{key}.mass_kg", f"{key}: {part.name!r} has {part.mass_kg / room:.3g} kg/m3 within its dimensions"
        if part.volume_ml and part.mass_kg and not LIGHTEST_KG_M3 <= part.mass_kg / part.volume_m3 <= DENSEST_KG_M3:
            yield (
                f"{key}.volume_ml",
                f"{key}: {part.name!r} has {part.mass_kg / part.volume_m3:.3g} kg/m3 of its volume",
            )
        if max(*(part.box_mm or (0.0, 0.0)), part.length_mm or 0.0) / 1e3 > 3.0 * length:
            yield key, f"{key}: {part.name!r} is larger than the vehicle"


def part_volume_m3(part: Part) -> float | None:
    """Volume within a part's dimensions [m3]; None for a point."""
    if part.box_mm is not None:
        a, b, c = part.box_mm
        return a * b * c / 1e9
    if part.length_mm is None or part.diameter_mm is None:
        return None
    return pi / 4.0 * (part.diameter_mm**2 - part.inner_diameter_mm**2) * part.length_mm / 1e9
