"""What is possible, and yet hardly meant: numbers of a vehicle file that do not fit each other.

Each range of a field is wide enough for any glider; these relations know the size of this one. They are warnings: a
vehicle that breaks one can be analysed.
"""

from collections.abc import Iterator
from math import pi, sqrt

import numpy as np

from stommel.vehicle.checks import rigid_body_inertia_about_origin
from stommel.vehicle.schema import Battery, Consumer, Hull, Matrix3, Part, VehicleFile
from stommel.vehicle.schema.drives import DcMotor, PitchMachinery, RudderMachinery
from stommel.vehicle.schema.engine import Motor

Findings = Iterator[tuple[str, str]]
"""Pairs of a key, and what is odd about it and what would be usual."""

LEAST_STABILITY_ARM_M = 0.003
"""Centre of mass below the centre of buoyancy; published gliders have 4 to 10 mm."""
SLENDEREST = 25.0
"""Length over diameter of a hull."""
DENSEST_KG_M3 = 22600.0
"""Osmium."""
LIGHTEST_KG_M3 = 10.0
"""Foam."""
LEAD_KG_M3 = 11340.0


def implausible(vehicle: VehicleFile) -> Findings:
    """Yield (key, what is odd and what would be usual) for numbers that do not fit each other."""
    yield from _bodies(vehicle)
    yield from _water(vehicle)
    yield from _actuators(vehicle)
    yield from _hull(vehicle)
    yield from _parts(vehicle)
    yield from _energy(vehicle)
    yield from _machinery(vehicle)


def _volume(vehicle: VehicleFile) -> float:
    """Displaced volume [m3]."""
    return vehicle.mass_kg / vehicle.water.density_kg_m3


def longest_m(vehicle: VehicleFile) -> float:
    """Length of the vehicle [m]: of its hull with nose and tail, or that of the slenderest body of its volume."""
    hull = vehicle.hull
    if hull is not None:
        return hull.length_m + hull.nose_length_m + hull.tail_length_m
    return float((4.0 / pi * _volume(vehicle) * SLENDEREST**2) ** (1.0 / 3.0))


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
                f"added_inertia.{name} = {value:g}: usual are {low * m:.3g} to {high * m:.4g} kg for a vehicle of {m:g} kg",
            )
    angle = abs(h.lift_kg_m) / h.lift_per_rad_kg_m
    if angle > 0.3:
        yield "hydrodynamics.lift_kg_m", f"hydrodynamics.lift_kg_m = {h.lift_kg_m:g}: zero lift only at {angle:.2g} rad"
    if abs(h.pitch_moment_kg) > 0.3 * abs(h.pitch_moment_per_rad_kg) and h.pitch_moment_kg:
        yield (
            "hydrodynamics.pitch_moment_kg",
            f"hydrodynamics.pitch_moment_kg = {h.pitch_moment_kg:g}: more than 0.3 rad of pitch_moment_per_rad_kg gives",
        )
    face = _volume(vehicle) ** (2.0 / 3.0) * 500.0
    if not 0.005 * face <= h.drag_kg_m <= 10.0 * face:
        yield (
            "hydrodynamics.drag_kg_m",
            f"hydrodynamics.drag_kg_m = {h.drag_kg_m:g}: usual are {0.005 * face:.2g} to {10.0 * face:.4g} for this volume",
        )
    for name, lever in _levers(vehicle):
        if lever > length:
            yield (
                f"hydrodynamics.{name}",
                f"hydrodynamics.{name}: acts at a lever of {lever:.3g} m; the vehicle is {length:.3g} m long",
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
                f"rudder.side_force_per_rad_kg_m = {share:g}: more than the whole vehicle's, {h.side_force_per_rad_kg_m:g}",
            )
    if vehicle.wing is not None and vehicle.wing.lift_per_rad_kg_m > h.lift_per_rad_kg_m:
        yield (
            "wing.lift_per_rad_kg_m",
            f"wing.lift_per_rad_kg_m: more than the whole vehicle's, {h.lift_per_rad_kg_m:g}",
        )


def _levers(vehicle: VehicleFile) -> Iterator[tuple[str, float]]:
    """Moment over force for an angle [m], where both are known."""
    h = vehicle.hydrodynamics
    yield "pitch_moment_per_rad_kg", abs(h.pitch_moment_per_rad_kg) / h.lift_per_rad_kg_m


def _actuators(vehicle: VehicleFile) -> Findings:
    a, drives, length = vehicle.actuators, vehicle.drives, longest_m(vehicle)
    if a.buoyancy is not None:
        yield from _engine_volume(vehicle)
    if a.moving_mass is not None:
        low, high = a.moving_mass.travel_m
        if high - low > length:
            yield (
                "actuators.moving_mass.travel_mm",
                f"actuators.moving_mass.travel_mm: {1e3 * (high - low):g} mm, more than the vehicle is long",
            )
        if high - low < 0.002 * length:
            yield (
                "actuators.moving_mass.travel_mm",
                f"actuators.moving_mass.travel_mm: {1e3 * (high - low):g} mm hardly trims a vehicle of {length:.3g} m",
            )
        if drives is not None and drives.pitch is not None:
            yield from _switches(a.moving_mass.travel_mm, drives.pitch)


def _engine_volume(vehicle: VehicleFile) -> Findings:
    engine = vehicle.actuators.buoyancy
    assert engine is not None
    key, (low, high) = "actuators.buoyancy.volume_ml", engine.volume_ml
    share = (high - low) / 1e6 / _volume(vehicle)
    if not 5e-4 <= share <= 0.2:
        yield key, f"{key}: {high - low:g} ml are {100 * share:.2g} % of the vehicle; usual are 0.3 to 5 %"
    if low >= 0.0 or high <= 0.0 or min(-low, high) < 0.05 * max(-low, high):
        yield key, f"{key} = [{low:g}, {high:g}]: hardly {'sinks' if -low < high else 'rises'} from neutral"
    if engine.flow_ml_s is not None and not 1.0 <= (high - low) / engine.flow_ml_s <= 86400.0:
        yield (
            "actuators.buoyancy.flow_ml_s",
            f"actuators.buoyancy.flow_ml_s = {engine.flow_ml_s:g}: moves the whole {high - low:g} ml in "
            f"{(high - low) / engine.flow_ml_s:.2g} s",
        )
    spec = vehicle.specification
    if spec is not None and not 0.5 <= (high - low) / spec.oil_volume_ml <= 3.0:
        yield (
            key,
            f"{key}: {high - low:g} ml from end to end; specification.oil_volume_ml = {spec.oil_volume_ml:g}",
        )
    circuit = vehicle.engine
    if circuit is not None:
        has = circuit.measured_piston.working_volume_ml
        if abs(has - (high - low)) > 0.05 * (high - low):
            yield key, f"{key}: {high - low:g} ml from end to end; the piston of [engine] moves {has:.4g} ml"


def _switches(travel: tuple[float, float], drive: PitchMachinery) -> Findings:
    key, reach = "drives.pitch.switches_mm", travel[1] - travel[0]
    ends = (("aft", drive.switches_mm[0] - travel[0]), ("forward", travel[1] - drive.switches_mm[1]))
    for end, inside in ends:
        if inside > 0.0:
            yield key, f"{key}: the {end} switch opens {inside:g} mm inside the travel of actuators.moving_mass"
        elif -inside > 0.05 * reach:
            yield key, f"{key}: the {end} switch opens {-inside:g} mm outside the travel of actuators.moving_mass"


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
    if not 0.3 <= hull.volume_m3 / _volume(vehicle) <= 3.0:
        yield (
            "hull.length_m",
            f"the hull has {1e3 * hull.volume_m3:.4g} l; the vehicle displaces {1e3 * _volume(vehicle):.4g} l",
        )
    if hull.inner_diameter_mm is not None and hull.inner_diameter_mm < 0.5 * hull.outer_diameter_mm:
        yield "hull.inner_diameter_mm", f"hull.inner_diameter_mm = {hull.inner_diameter_mm:g}: less than half the outer"
    overall, spec = longest_m(vehicle), vehicle.specification
    if spec is not None and abs(overall - spec.overall_length_m) > 0.2 * spec.overall_length_m:
        yield (
            "specification.overall_length_m",
            f"hull with nose and tail is {overall:.3g} m long; specification.overall_length_m = {spec.overall_length_m:g}",
        )


def _parts(vehicle: VehicleFile) -> Findings:
    length = longest_m(vehicle)
    for k, part in enumerate(vehicle.parts):
        key = f"parts.{k}"
        if part.mass_kg > vehicle.mass_kg:
            yield f"{key}.mass_kg", f"{key}.mass_kg = {part.mass_kg:g}: {part.name!r} is heavier than the whole vehicle"
        if part.volume_m3 > _volume(vehicle):
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


def _energy(vehicle: VehicleFile) -> Findings:
    battery, plan = vehicle.battery, vehicle.energy
    for k, consumer in enumerate(vehicle.consumers):
        key = f"consumers.{k}"
        if consumer.standby_w > consumer.power_w:
            yield (
                f"{key}.standby_w",
                f"{key}.standby_w = {consumer.standby_w:g}: {consumer.name!r} takes more in standby than "
                f"power_w = {consumer.power_w:g}",
            )
        session = plan.surface_session_s if plan is not None else None
        if session is not None and (consumer.seconds_per_surfacing or 0.0) > session:
            yield (
                f"{key}.seconds_per_surfacing",
                f"{key}.seconds_per_surfacing = {consumer.seconds_per_surfacing:g}: energy.surface_session_s = {session:g}",
            )
        if consumer.sample_every_s is not None and consumer.sample_every_s > 3600.0:
            yield (
                f"{key}.sample_every_s",
                f"{key}.sample_every_s = {consumer.sample_every_s:g}: {consumer.name!r} samples less than once an hour",
            )
        if battery is not None:
            yield from _thirsty(key, consumer, battery)
    if battery is not None and battery.internal_resistance_ohm * battery.capacity_ah > battery.voltage_v:
        yield (
            "battery.internal_resistance_ohm",
            f"battery.internal_resistance_ohm = {battery.internal_resistance_ohm:g}: the discharge of an hour, "
            f"{battery.capacity_ah:g} A, would take all of the {battery.voltage_v:g} V",
        )


def _thirsty(key: str, consumer: Consumer, battery: Battery) -> Findings:
    """A consumer that alone empties the battery within a day."""
    stored_wh = battery.capacity_ah * battery.voltage_v
    always = consumer.power_w * consumer.share_on
    if consumer.on in ("always", "underwater", "dive", "climb", "moving") and always * 24.0 > stored_wh:
        yield (
            f"{key}.power_w",
            f"{key}.power_w = {consumer.power_w:g}: {consumer.name!r} alone empties the battery in "
            f"{stored_wh / always:.2g} h",
        )
    if consumer.on == "surface" and consumer.power_w > stored_wh:
        yield (
            f"{key}.power_w",
            f"{key}.power_w = {consumer.power_w:g}: {consumer.name!r} empties the battery in an hour",
        )


def _machinery(vehicle: VehicleFile) -> Findings:
    drives, a = vehicle.drives, vehicle.actuators
    supply = vehicle.battery.voltage_v if vehicle.battery is not None else None
    if drives is not None and drives.pitch is not None:
        drive = drives.pitch
        yield from _motor("drives.pitch.motor", drive.motor, supply or drive.motor.nominal_voltage_v)
        ratio = drive.gearbox_ratio * (drive.worm.ratio if drive.worm is not None else 1.0)
        runs = _no_load(drive.motor, supply) / ratio / (2.0 * pi) * drive.screw.lead_mm
        stated = a.moving_mass.speed_mm_s if a.moving_mass is not None else None
        yield from _speed("actuators.moving_mass.speed_mm_s", stated, runs, "mm/s")
    if drives is not None and drives.rudder is not None:
        yield from _rudder_drive(vehicle, drives.rudder, supply)
    if vehicle.engine is not None:
        for k, motor in enumerate(vehicle.engine.motors):
            yield from _motor(f"engine.motors.{k}", motor, motor.supply_voltage_v)


def _rudder_drive(vehicle: VehicleFile, drive: RudderMachinery, supply: float | None) -> Findings:
    motor, rudder = drive.motor, vehicle.actuators.rudder
    yield from _motor("drives.rudder.motor", motor, supply or motor.nominal_voltage_v)
    runs = _no_load(motor, supply) / drive.gearbox_ratio * 180.0 / pi
    yield from _speed("actuators.rudder.speed_deg_s", rudder.speed_deg_s if rudder is not None else None, runs, "deg/s")
    stall = motor.torque_constant_mn_m_a * (supply or motor.nominal_voltage_v) / motor.resistance_ohm
    if drive.brake is not None and not 0.01 <= drive.brake.holding_torque_mn_m / stall <= 30.0:
        yield (
            "drives.rudder.brake.holding_torque_mn_m",
            f"drives.rudder.brake.holding_torque_mn_m = {drive.brake.holding_torque_mn_m:g}: the motor's greatest torque "
            f"is {stall:.3g} mN m",
        )
    if drive.seal_friction_mn_m > stall * drive.gearbox_ratio:
        yield (
            "drives.rudder.seal_friction_mn_m",
            f"drives.rudder.seal_friction_mn_m = {drive.seal_friction_mn_m:g}: more than motor and gearbox overcome",
        )


def _no_load(motor: DcMotor, supply: float | None) -> float:
    """Speed of a motor without load [rad/s]."""
    return (supply or motor.nominal_voltage_v) / (motor.torque_constant_mn_m_a / 1e3)


def _speed(key: str, stated: float | None, runs: float, unit: str) -> Findings:
    if stated is not None and not 0.3 <= stated / runs <= 1.2:
        yield key, f"{key} = {stated:g}: the drive runs {runs:.3g} {unit} without load"


def _motor(key: str, motor: DcMotor | Motor, supply: float) -> Findings:
    """A motor that cannot turn, or answers slower or faster than motors do."""
    k, stall = motor.torque_constant_mn_m_a / 1e3, supply / motor.resistance_ohm
    if motor.no_load_current_a > 0.3 * stall:
        yield (
            f"{key}.no_load_current_a",
            f"{key}.no_load_current_a = {motor.no_load_current_a:g}: {supply:g} V drive at most {stall:.3g} A",
        )
    constant = motor.rotor_inertia_g_cm2 / 1e7 * motor.resistance_ohm / k**2
    if not 2e-4 <= constant <= 0.5:
        yield (
            f"{key}.rotor_inertia_g_cm2",
            f"{key}: rotor, resistance and torque constant give a time constant of {constant:.2g} s; usual are 2 to 50 ms",
        )
    if isinstance(motor, DcMotor):
        if motor.continuous_current_a > 5.0 * stall:
            yield (
                f"{key}.continuous_current_a",
                f"{key}.continuous_current_a = {motor.continuous_current_a:g}: {supply:g} V drive at most {stall:.3g} A",
            )
        if not 0.2 <= motor.nominal_voltage_v / supply <= 5.0:
            yield (
                f"{key}.nominal_voltage_v",
                f"{key}.nominal_voltage_v = {motor.nominal_voltage_v:g}: fed by {supply:g} V",
            )
