"""Actuators, drives, engine and consumers against each other and against the vehicle they are built into."""

from collections.abc import Iterator
from math import pi

from stommel.vehicle.schema import Battery, Consumer, VehicleFile
from stommel.vehicle.schema.drives import DcMotor, PitchMachinery, RudderMachinery
from stommel.vehicle.schema.engine import Motor
from stommel.vehicle.size import displaced_m3, longest_m

Findings = Iterator[tuple[str, str]]
"""Pairs of a key, and what is odd about it and what would be usual."""


def actuator_findings(vehicle: VehicleFile) -> Findings:
    """Ranges and speeds of the actuators against the vehicle, its engine and its drives."""
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
        neutral = vehicle.moving_mass.neutral_position_m
        if min(neutral - low, high - neutral) < 0.15 * (high - low):
            yield (
                "moving_mass.neutral_position_m",
                f"moving_mass.neutral_position_m = {neutral:g}: near an end of actuators.moving_mass.travel_mm, which "
                "hardly trims both ways",
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
    share = (high - low) / 1e6 / displaced_m3(vehicle)
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


def energy_findings(vehicle: VehicleFile) -> Findings:
    """Consumers against the battery and the plan."""
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
                f"{key}.seconds_per_surfacing = {consumer.seconds_per_surfacing:g}: a session has {session:g} s",
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


def machinery_findings(vehicle: VehicleFile) -> Findings:
    """Motors that cannot turn, and drives that do not run as fast as is stated."""
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
            f"drives.rudder.brake.holding_torque_mn_m = {drive.brake.holding_torque_mn_m:g}: the motor "
            f"gives at most {stall:.3g} mN m",
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
            f"{key}: rotor, resistance and torque constant give a time constant of {constant:.2g} s, not 2 to 50 ms",
        )
    if isinstance(motor, DcMotor):
        if motor.continuous_current_a > 5.0 * stall:
            yield (
                f"{key}.continuous_current_a",
                f"{key}.continuous_current_a = {motor.continuous_current_a:g}: {supply:g} V drive {stall:.3g} A",
            )
        if not 0.2 <= motor.nominal_voltage_v / supply <= 5.0:
            yield (
                f"{key}.nominal_voltage_v",
                f"{key}.nominal_voltage_v = {motor.nominal_voltage_v:g}: fed by {supply:g} V",
            )
