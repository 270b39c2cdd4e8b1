"""What the vehicle measures of its attitude, depth and position (compiled)."""

import math
from typing import NamedTuple

import numpy as np

from stommel.dynamics.compilation import inlined
from stommel.dynamics.vectors import Quaternion, Vector, add, down_in_body, matrix_times, scale, to_body
from stommel.simulation.parameters import Sensors


class Attitude(NamedTuple):
    """Roll, pitch and heading [rad]."""

    phi: float
    theta: float
    psi: float


@inlined
def attitude_of(Q: Quaternion) -> Attitude:
    """True roll, pitch and heading."""
    zeta = down_in_body(Q)
    return Attitude(
        math.atan2(zeta[1], zeta[2]),
        math.atan2(-zeta[0], math.hypot(zeta[1], zeta[2])),
        math.atan2(2.0 * (Q[1] * Q[2] + Q[0] * Q[3]), 1.0 - 2.0 * (Q[2] * Q[2] + Q[3] * Q[3])),
    )


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
def compass(sensors: Sensors, plant_state: np.record, Q: Quaternion, noise: np.random.Generator) -> Attitude:
    """Roll and pitch of the tilt sensor, and the tilt-compensated magnetic heading, with iron, motors and noise."""
    true = attitude_of(Q)
    phi = true.phi + sensors.attitude_noise * noise.standard_normal()
    theta = true.theta + sensors.attitude_noise * noise.standard_normal()
    b = matrix_times(sensors.soft_iron, to_body(Q, sensors.field))
    b = add(add(b, sensors.hard_iron), disturbing_field(sensors, plant_state))
    # turned back to the horizontal by the measured roll and pitch
    across = b[2] * math.sin(phi) - b[1] * math.cos(phi)
    along = b[0] * math.cos(theta) + b[1] * math.sin(theta) * math.sin(phi) + b[2] * math.sin(theta) * math.cos(phi)
    psi = math.atan2(across, along) + sensors.heading_noise * noise.standard_normal()
    return Attitude(phi, theta, psi)


@inlined
def depth_sensor(sensors: Sensors, depth: float, noise: np.random.Generator) -> float:
    """Depth from the pressure sensor [m]."""
    return depth + sensors.pressure_bias + sensors.pressure_noise * noise.standard_normal()
