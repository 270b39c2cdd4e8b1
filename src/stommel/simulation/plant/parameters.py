"""What the mission loop is told of the plant and of time, SI units and radians."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from stommel.geometry.vectors import Vector

Array = NDArray[np.float64]

PUMP, PITCH_DRIVE, STEERING, CONTROLLER, SENSORS, NAVIGATION, COMMUNICATION, HOTEL = range(8)
CONSUMERS = (
    "pump",
    "pitch_drive",
    "steering",
    "controller",
    "sensors",
    "navigation",
    "communication",
    "hotel",
)
"""Who uses energy, in the order of every array of energies."""

ALWAYS, UNDERWATER, DIVE, CLIMB, SURFACED, MOVING, DRIFTING = range(7)
CONDITIONS = ("always", "underwater", "dive", "climb", "surface", "moving", "drift")
"""When a consumer is on, in the order of the columns of `Plant.power`."""


class Plant(NamedTuple):
    """Actuators, power and battery. Tables over pressure and slope are read straight between their points."""

    mass_low: float
    """Aft limit switch [m]."""
    mass_high: float
    """Forward limit switch [m]."""
    slope: Array
    """tan(pitch), rising; moving aft is moving forward at minus the pitch."""
    mass_speed: Array
    """Speed of the moving mass forward at these slopes [m/s]."""
    mass_j_m: Array
    """Its electrical energy per metre [J/m]."""
    pressure: Array
    """Gauge pressure of the sea, rising [Pa]."""
    pump_flow: Array
    """Flow of the pump at these pressures [m3/s]; zero where it stalls."""
    pump_j_m3: Array
    """Electrical energy of motor and pump per volume [J/m3]."""
    valve_flow: Array
    """Flow of the open valve when the bladder empties [m3/s]."""
    valve_j_m3: Array
    """Electrical energy of the valve per volume [J/m3]."""
    ballast_low: float
    """[m3]"""
    ballast_high: float
    """[m3]"""
    steers_by_mass: float
    """1: the rolling mass steers; 0: the rudder."""
    steering_speed: float
    """Of rudder or rolling mass [rad/s]."""
    steering_limit: float
    """To either side [rad]."""
    steering_j_rad: float
    """Electrical energy of the steering drive per angle [J/rad]."""
    power: Array
    """Power of each consumer (rows, `CONSUMERS`) in each condition (columns, `CONDITIONS`) [W]."""
    call_consumer: NDArray[np.int64]
    """Consumers that are on for a given time at each surfacing: whose they are (`CONSUMERS`)."""
    call_power: Array
    """Their power [W]."""
    call_seconds: Array
    """Their time from the surfacing on [s]."""
    self_discharge: float
    """Loss of the battery without any load [W]."""
    battery_energy: float
    """Usable at the start [J]; infinite where the vehicle file does not say."""
    charge: Array
    """Share of the whole energy that is left, rising."""
    open_voltage: Array
    """Voltage without load at these shares [V]."""
    resistance: float
    """Of battery and wires [ohm]."""
    whole_energy: float
    """Energy of the battery with what may not be used [J]."""
    antenna: Vector
    """Tip of the antenna in the body frame [m]; not numbers where the vehicle file does not say."""


class Loop(NamedTuple):
    """How time goes."""

    start: float
    """Start of the mission [s since 1970-01-01 UTC]."""
    control_step: float
    """Between two decisions [s]."""
    steady_steps: int
    """Integration steps in a control step while nothing moves."""
    moving_steps: int
    """Integration steps in a control step while an actuator moves or the vehicle answers it."""
    damping: float
    """Fastest damping of the vehicle's rotation, over the square of its speed [s/m2]."""
    settle_time: float
    """How long the vehicle answers [s]."""
    column_period: float
    """Between two looks at the ocean around the vehicle [s]."""
    record_every: int
    """Control steps between two rows of output."""
