"""What the vehicle measures of its attitude, depth, position and water, and when it hears of it (compiled)."""

import math
from typing import NamedTuple

import numpy as np

from stommel.compilation import inlined
from stommel.control.readings import Readings
from stommel.dynamics.equations import state_from_array
from stommel.dynamics.state import DEPTH, R_PX, V_B
from stommel.geometry.earth import metres_per_radian
from stommel.geometry.vectors import Quaternion, Vector, add, cross, dot, down_in_body, matrix_times, scale, to_body
from stommel.simulation.plant.sensors import Sensors
from stommel.simulation.scenario.scenario_file import LONGEST_LATENCY


class Felt(NamedTuple):
    """What the compass and its accelerometers feel."""

    down_b2: float
    """Direction down along b2."""
    down_b3: float
    """Direction down along b3."""
    theta: float
    """Pitch [rad]."""
    psi: float
    """Heading [rad]."""


@inlined
def disturbing_field(sensors: Sensors, plant_state: np.record) -> Vector:
    """Field of the motors and the valve that run now, behind their shielding, in the body frame."""
    open_share = 1.0 - sensors.shielding
    field = (0.0, 0.0, 0.0)
    if plant_state.pumping:
        field = add(field, scale(open_share, sensors.pump_field))
    if plant_state.valve_open:
        field = add(field, scale(open_share, sensors.valve_field))
    if plant_state.mass_moving:
        field = add(field, scale(open_share, sensors.mass_field))
    if plant_state.steering_moving:
        field = add(field, scale(open_share, sensors.steering_field))
    return field


@inlined
def felt_field(sensors: Sensors, plant_state: np.record, Q: Quaternion) -> Vector:
    """Magnetic field at the compass in the body frame, in parts of the Earth's: with iron, and motors that run."""
    b = matrix_times(sensors.soft_iron, to_body(Q, sensors.field))
    return add(add(b, sensors.hard_iron), disturbing_field(sensors, plant_state))


@inlined
def compass(sensors: Sensors, plant_state: np.record, Q: Quaternion, noise: np.random.Generator) -> Felt:
    """Direction down by the accelerometers and the tilt-compensated magnetic heading, with iron, motors and noise.

    East is down cross field, north is east cross down; both as the sensors feel them, in the body frame.
    """
    zeta, sigma = down_in_body(Q), sensors.attitude_noise
    felt = (
        zeta[0] + sigma * noise.standard_normal(),
        zeta[1] + sigma * noise.standard_normal(),
        zeta[2] + sigma * noise.standard_normal(),
    )
    down = scale(1.0 / math.sqrt(dot(felt, felt)), felt)
    b = felt_field(sensors, plant_state, Q)
    east = cross(down, b)
    north = cross(east, down)
    psi = math.atan2(east[0], north[0]) + sensors.declination + sensors.heading_noise * noise.standard_normal()
    theta = math.atan2(-down[0], math.sqrt(down[1] * down[1] + down[2] * down[2]))
    return Felt(down[1], down[2], theta, psi)


@inlined
def depth_sensor(sensors: Sensors, depth: float, noise: np.random.Generator) -> float:
    """Depth from the pressure sensor [m]."""
    return depth + sensors.pressure_bias + sensors.pressure_noise * noise.standard_normal()


@inlined
def late(sensors: Sensors, world: np.record, tick: int, now: Felt, depth: float) -> tuple[Felt, float]:
    """Attitude and depth that reach the software at this control step: measured some steps ago."""
    row = world.measured[tick % LONGEST_LATENCY]
    row[0], row[1], row[2], row[3], row[4] = now.theta, now.psi, depth, now.down_b2, now.down_b3
    then = world.measured[(tick - sensors.attitude_lag) % LONGEST_LATENCY]
    pressed = world.measured[(tick - sensors.pressure_lag) % LONGEST_LATENCY]
    return Felt(then[3], then[4], then[0], then[1]), pressed[2]


@inlined
def altimeter(sensors: Sensors, above: float, noise: np.random.Generator) -> float:
    """Height above the bottom [m]; infinite where it is out of range."""
    if above >= sensors.altimeter_range:
        return math.inf
    return above + sensors.altimeter_noise * noise.standard_normal()


@inlined
def feel_temperature(sensors: Sensors, world: np.record, T: float) -> None:
    """Let thermistor and conductivity cell of the CTD follow the water's temperature through one control step.

    The thermistor is a first-order lag; the cell's walls lag by the thermal mass of Lueck and Picklo (1990). Both are
    exact for a temperature that changes evenly through the step.
    """
    change = T - world.water_before
    lag = sensors.thermistor_decay * (world.water_before - world.thermistor) + sensors.thermistor_gain * change
    world.thermistor = T - lag
    world.cell_error = sensors.cell_decay * world.cell_error + sensors.cell_gain * change
    world.water_before = T


@inlined
def fix(
    sensors: Sensors, latitude: float, longitude: float, metres: tuple[float, float], noise: np.random.Generator
) -> tuple[float, float]:
    """A position from GPS, with the metres per radian of latitude and longitude there."""
    return (
        latitude + sensors.position_noise * noise.standard_normal() / metres[0],
        longitude + sensors.position_noise * noise.standard_normal() / metres[1],
    )


@inlined
def oil_volume(x: np.ndarray, world: np.record) -> float:
    """Ballast volume by the oil outside [m3]: leaked water and a dropped weight are in the state's ballast volume."""
    volume: float = x[V_B] + world.leaked - world.dropped
    return volume


@inlined
def measured_internal_pressure(sensors: Sensors, world: np.record) -> float:
    """Pressure in the hull by its sensor, without noise [Pa]."""
    pressure: float = world.internal_pressure + sensors.internal_pressure_bias
    return pressure


@inlined
def sense(
    sensors: Sensors, world: np.record, x: np.ndarray, bottom: float, tick: int, noise: np.random.Generator
) -> Readings:
    """What the sensors say at a control step, `bottom` being the depth of the ground [m]."""
    now = compass(sensors, world, state_from_array(x).Q, noise)
    felt, depth = late(sensors, world, tick, now, depth_sensor(sensors, x[DEPTH], noise))
    altitude = altimeter(sensors, bottom - x[DEPTH], noise)
    fixed = world.fixed != 0
    world.fixed = 0
    return Readings(
        felt.down_b2,
        felt.down_b3,
        felt.theta,
        felt.psi,
        depth,
        altitude,
        x[R_PX],
        oil_volume(x, world),
        world.steering,
        world.leaked > sensors.leak_volume,
        measured_internal_pressure(sensors, world),
        world.voltage + sensors.voltage_bias,
        world.current + sensors.current_bias,
        fixed,
        world.fix_time,
        world.fix_latitude,
        world.fix_longitude,
    )


@inlined
def listen(
    sensors: Sensors, world: np.record, radio: bool, dry: bool, t: float, step: float, noise: np.random.Generator
) -> None:
    """Let the receiver of GPS find a position, once it has been on with the antenna dry for long enough."""
    if not radio:
        world.listening = 0
        return
    if not world.listening:
        world.listening, world.received = 1, 0.0
    if not dry:
        return
    received: float = world.received + step
    world.received = received
    if received >= sensors.first_fix_time:
        metres = metres_per_radian(world.latitude)
        world.fix_latitude, world.fix_longitude = fix(sensors, world.latitude, world.longitude, metres, noise)
        world.fix_time, world.fixed = t, 1
