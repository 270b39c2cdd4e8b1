"""The sensors: how wrong and how late they are, SI units and radians."""

from math import cos, exp, radians, sin
from typing import NamedTuple

from stommel.geometry.vectors import Matrix, Vector
from stommel.simulation.scenario.scenario_file import ScenarioFile


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
    declination: float
    """What headings are corrected by, from magnetic to true north [rad]."""
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


def sensors_of(scenario: ScenarioFile) -> Sensors:
    """Sensor errors of a scenario, SI units and radians."""
    s, ctd, step = scenario.sensors, scenario.ctd, scenario.integration.control_step_s
    dip, east = radians(s.magnetic_inclination_deg), radians(s.magnetic_declination_deg)
    rows = s.soft_iron
    return Sensors(
        attitude_noise=radians(s.attitude_noise_deg),
        heading_noise=radians(s.heading_noise_deg),
        pressure_noise=s.pressure_noise_m,
        pressure_bias=s.pressure_bias_m,
        attitude_lag=round(s.attitude_latency_s / step),
        pressure_lag=round(s.pressure_latency_s / step),
        altimeter_noise=s.altimeter_noise_m,
        position_noise=s.gps_noise_m,
        first_fix_time=s.first_fix_s,
        altimeter_range=s.altimeter_range_m,
        field=(cos(dip) * cos(east), cos(dip) * sin(east), sin(dip)),
        declination=east if s.known_declination_deg is None else radians(s.known_declination_deg),
        hard_iron=s.hard_iron,
        soft_iron=(*rows[0], *rows[1], *rows[2]),
        pump_field=s.pump_field,
        valve_field=s.valve_field,
        mass_field=s.pitch_drive_field,
        steering_field=s.steering_field,
        shielding=s.shielding,
        voltage_bias=s.voltage_bias_v,
        voltage_noise=s.voltage_noise_v,
        current_bias=s.current_bias_a,
        current_noise=s.current_noise_a,
        internal_pressure_bias=s.internal_pressure_bias_pa,
        internal_pressure_noise=s.internal_pressure_noise_pa,
        leak_volume=s.leak_ml / 1e6,
        thermistor_decay=1.0 - followed(step, ctd.temperature_lag_s),
        # the answers to a temperature that changes evenly through the step
        thermistor_gain=ctd.temperature_lag_s / step * followed(step, ctd.temperature_lag_s),
        cell_decay=1.0 - followed(step, ctd.thermal_lag_s),
        cell_gain=ctd.thermal_share * ctd.thermal_lag_s / step * followed(step, ctd.thermal_lag_s),
        sample_every=round(scenario.sampling.every_s / step),
    )


def followed(step: float, time_constant: float) -> float:
    """Share of a difference that a first-order lag follows in a step."""
    return 1.0 - exp(-step / time_constant) if time_constant > 0.0 else 1.0
