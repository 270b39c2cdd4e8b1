"""What the mission loop is told: numbers of the plant, of the sensors, and of the mission, SI units and radians."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from stommel.dynamics.vectors import Matrix, Vector

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

ALWAYS, UNDERWATER, DIVE, CLIMB, SURFACED, MOVING = range(6)
CONDITIONS = ("always", "underwater", "dive", "climb", "surface", "moving")
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
    surfacing_energy: Array
    """Energy that a stay at the surface takes at once, by consumer [J]."""
    self_discharge: float
    """Loss of the battery without any load [W]."""
    battery_energy: float
    """Usable at the start [J]; infinite where the vehicle file does not say."""


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
    """After surfacing [s]."""
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
    settle_time: float
    """How long the vehicle answers [s]."""
    column_period: float
    """Between two looks at the ocean around the vehicle [s]."""
    record_every: int
    """Control steps between two rows of output."""


STATE_COLUMNS = (
    "time", "latitude", "longitude", "depth", "roll", "pitch", "heading", "u", "v", "w", "p", "q", "r",
    "moving_mass", "ballast", "rudder", "roll_mass", "phase", "measured_pitch", "measured_heading", "measured_depth",
    "density", "temperature", "salinity", "current_north", "current_east", "bottom_depth",
    "reckoned_latitude", "reckoned_longitude",
    *(f"energy_{consumer}" for consumer in CONSUMERS),
)  # fmt: skip
"""Columns of the record."""

SURFACING_COLUMNS = (
    "time", "latitude", "longitude", "current_north", "current_east", "true_current_north", "true_current_east",
    "reckoning_error", "submerged", "dive",
)  # fmt: skip
"""Columns of the list of surfacings."""

EVENT_COLUMNS = ("time", "phase", "latitude", "longitude", "depth", "reason")
"""Columns of the list of events: every change of phase, and why where a dive or the mission ends."""

SOFTWARE_STATE = np.dtype(
    [
        ("phase", "f8"), ("since", "f8"), ("submerged_since", "f8"), ("dives", "f8"), ("dives_here", "f8"),
        ("event", "f8"),
        ("waypoint", "i8"), ("line_latitude", "f8"), ("line_longitude", "f8"),
        ("heading_wanted", "f8"), ("steering", "f8"), ("correction", "f8"), ("corrected_at", "f8"),
        ("depth_before", "f8"), ("path_speed", "f8"), ("vertical_speed", "f8"), ("heading_before", "f8"),
        ("latitude", "f8"), ("longitude", "f8"),
        ("reckoned_north", "f8"), ("reckoned_east", "f8"),
        ("submerged_latitude", "f8"), ("submerged_longitude", "f8"),
        ("surfaced_at", "f8"), ("under_water", "f8"), ("reckoning_error", "f8"),
        ("first_fix_at", "f8"), ("first_fix_latitude", "f8"), ("first_fix_longitude", "f8"),
        ("current_north", "f8"), ("current_east", "f8"),
    ]
)  # fmt: skip
"""What the vehicle's own software remembers from one decision to the next."""

PLANT_STATE = np.dtype(
    [
        ("latitude", "f8"), ("longitude", "f8"), ("afloat", "i8"), ("speed", "f8"),
        ("steering", "f8"), ("pumping", "i8"), ("valve_open", "i8"), ("mass_moving", "i8"), ("steering_moving", "i8"),
        ("moved_at", "f8"), ("energy", "f8", (len(CONSUMERS),)), ("energy_total", "f8"),
        ("current_sum_north", "f8"), ("current_sum_east", "f8"), ("current_time", "f8"),
    ]
)  # fmt: skip
"""What the world knows beyond the state of the equations of motion."""
