"""What the mission loop is told of the sensors and of what surrounds the vehicle, SI units and radians."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from stommel.geometry.vectors import Matrix, Vector

Array = NDArray[np.float64]


class Sensors(NamedTuple):
    """Errors of the sensors that control reads."""

    attitude_noise: float
    """Standard deviation of pitch and roll [rad]."""
    heading_noise: float
    """[rad]"""
    pressure_noise: float
    """As depth [m]."""
    pressure_bias: float
    """As depth [m]."""
    position_noise: float
    """Of GPS, each of north and east [m]."""
    first_fix_time: float
    """With the antenna dry, after surfacing [s]."""
    attitude_lag: int
    """Control steps by which attitude and heading reach the software late."""
    pressure_lag: int
    """The same of depth."""
    altimeter_noise: float
    """Of the height above the bottom [m]."""
    altimeter_range: float
    """Beyond it no bottom is heard [m]."""
    field: Vector
    """The Earth's magnetic field, north, east, down, in units of its own strength."""
    hard_iron: Vector
    """Field of the vehicle's magnets in the body frame, in the same units."""
    soft_iron: Matrix
    """Distortion of the Earth's field by the vehicle's iron, by rows; the unit matrix for none."""
    pump_field: Vector
    """Field of the running pump."""
    valve_field: Vector
    """Field of the open valve."""
    mass_field: Vector
    """Field of the running pitch drive."""
    steering_field: Vector
    """Field of the running steering motor."""
    shielding: float
    """Share of the disturbing fields of motors and valve that shielding takes away, 0 to 1."""
    voltage_bias: float
    """Of the battery's voltage [V]."""
    voltage_noise: float
    """[V]"""
    current_bias: float
    """Of the current out of the battery [A]."""
    current_noise: float
    """[A]"""
    internal_pressure_bias: float
    """Of the pressure in the hull [Pa]."""
    internal_pressure_noise: float
    """[Pa]"""
    leak_volume: float
    """Water in the hull that the leak detectors notice [m3]."""
    thermistor_decay: float
    """Share of the lag of the CTD's thermistor that is left after one control step."""
    thermistor_gain: float
    """New lag of the thermistor for a change of the water's temperature in one control step."""
    cell_decay: float
    """Share of the thermal error of the conductivity cell that is left after one control step."""
    cell_gain: float
    """New error of the cell for a change of the water's temperature in one control step."""
    sample_every: int
    """Control steps between two samples of the CTD."""
    sampled: Array
    """1 for each phase of the dive in which the CTD samples, else 0."""


class Waves(NamedTuple):
    """Elevation of the sea surface above a floating vehicle that follows it in part, as a sum of cosines."""

    amplitude: Array
    """Of the elevation relative to the vehicle [m]."""
    omega: Array
    """Angular frequency [rad/s]."""
    phase: Array
    """[rad]"""


class Hull(NamedTuple):
    """The room inside the hull: its air, and a leak."""

    air_pressure: float
    """When it was closed [Pa]."""
    air_temperature: float
    """When it was closed [K]."""
    air_volume: float
    """With the ballast volume at zero [m3]."""
    temperature_weight: float
    """Share of its difference to the water's temperature that the air follows in one control step."""
    leak_starts: float
    """Time of the mission [s]; infinite for a tight hull."""
    leak_rate: float
    """[m3/s]"""
    deepest: float
    """Depth at which the hull is given up for lost [m]."""


class Alarms(NamedTuple):
    """What ends the mission."""

    energy: float
    """Measured energy out of the battery [J]."""
    leak: bool
    """Whether the leak detectors do."""
    internal_pressure: float
    """Measured pressure in the hull [Pa]; infinite for none."""
