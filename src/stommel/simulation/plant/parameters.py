"""The parts of the plant as the mission loop is told of them, SI units and radians."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from stommel.geometry.vectors import Vector
from stommel.machinery.hull.floating import HullForm

Array = NDArray[np.float64]

PUMP, PITCH_DRIVE, STEERING, CONTROLLER, SENSORS, NAVIGATION, COMMUNICATION, HOTEL, BATTERY = range(9)
CONSUMERS = (
    "pump",
    "pitch_drive",
    "steering",
    "controller",
    "sensors",
    "navigation",
    "communication",
    "hotel",
    "battery",
)
"""Who uses energy, in the order of every array of energies; the battery that which it turns into heat itself."""

ALWAYS, UNDERWATER, DIVE, CLIMB, SURFACED, MOVING, DRIFTING, SAMPLING = range(8)
CONDITIONS = ("always", "underwater", "dive", "climb", "surface", "moving", "drift", "sampling")
"""When a consumer is on, in the order of the columns of `Loads.power`."""


class MassDrive(NamedTuple):
    """The drive of the moving mass; tables over the slope are read straight between their points."""

    low: float
    """Aft limit switch [m]."""
    high: float
    """Forward limit switch [m]."""
    slope: Array
    """tan(pitch), rising; moving aft is moving forward at minus the pitch."""
    speed: Array
    """Speed of the moving mass forward at these slopes [m/s]."""
    j_m: Array
    """Its electrical energy per metre [J/m]."""


class Engine(NamedTuple):
    """The buoyancy engine; tables over the pressure are read straight between their points."""

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
    low: float
    """Least ballast volume [m3]."""
    high: float
    """Greatest ballast volume [m3]."""


class SteeringDrive(NamedTuple):
    """What turns the rudder, or the rolling mass."""

    by_mass: float
    """1: the rolling mass steers; 0: the rudder."""
    speed: float
    """[rad/s]"""
    limit: float
    """To either side [rad]."""
    j_rad: float
    """Electrical energy per angle [J/rad]."""


class Loads(NamedTuple):
    """Consumers that are switched: by the software's commands, or by what moves."""

    power: Array
    """Power of each consumer (rows, `CONSUMERS`) in each condition (columns, `CONDITIONS`) [W]."""
    call_consumer: NDArray[np.int64]
    """Consumers that are on for a given time at each surfacing: whose they are (`CONSUMERS`)."""
    call_power: Array
    """Their power [W]."""
    call_seconds: Array
    """Their time from the surfacing on [s]."""


class Battery(NamedTuple):
    """Where the energy comes from."""

    energy: float
    """Usable at the start [J]; infinite where the vehicle file does not say."""
    self_discharge: float
    """Loss without any load [W]."""
    charge: Array
    """Share of the whole energy that is left, rising."""
    open_voltage: Array
    """Voltage without load at these shares [V]."""
    resistance: float
    """Of battery and wires [ohm]."""
    whole_energy: float
    """With what may not be used [J]."""


class Plant(NamedTuple):
    """The vehicle's machinery."""

    mass: MassDrive
    engine: Engine
    steering: SteeringDrive
    loads: Loads
    battery: Battery
    antenna: Vector
    """Tip of the antenna in the body frame [m]; not numbers where the vehicle file does not say."""
    form: HullForm
    """What of the hull stands out of the water."""
    drop_weight: float
    """Weight in water, as mass, that can be let go [kg]; zero for none."""
