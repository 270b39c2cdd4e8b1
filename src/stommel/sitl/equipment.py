"""From a mission's vehicle and plant to the settings of its software: limits, expectations, calibration."""

import math

import numpy as np

from stommel.control.dive_cycle import PHASES
from stommel.control.flight_table import look_up
from stommel.control.orders import Orders
from stommel.onboard.coordination.compass.calibration import CompassCalibration
from stommel.onboard.coordination.limits import ActuatorLimits, SafetyLimits
from stommel.onboard.coordination.power import PowerSchedule
from stommel.onboard.coordination.settings import CoordinatorSettings
from stommel.onboard.nodes.acquisition_settings import AcquisitionSettings
from stommel.onboard.nodes.motion_settings import MotionSettings
from stommel.simulation.plant.hull_air import Hull
from stommel.simulation.plant.parameters import Battery, Engine
from stommel.simulation.plant.parameters import Plant as Machinery
from stommel.simulation.plant.sensors import Sensors
from stommel.simulation.setup import Setup
from stommel.sitl.instruments import EARTH_FIELD

SLOWEST_CLIMB = 0.05
"""Vertical speed of a vehicle that hardly climbs [m/s]."""
UNRATED = 6000.0
"""Depth for vehicles whose file states no rating [m]: no glider is rated deeper."""
_NORMAL_PRESSURE = 101_325.0
_MOST_VOLTAGE = 34.0


def actuator_limits(setup: Setup) -> ActuatorLimits:
    """What the actuators can do, and where the moving mass stands when the vehicle is brought up."""
    plant, orders = setup.equipment.plant, setup.orders
    nose_up = look_up(orders.table, orders.dives.theta, plant.engine.high)[0]
    surface = orders.dives.r_px_surface
    surface = nose_up if math.isnan(surface) else surface
    tail_antenna = plant.antenna[0] < 0.0
    low, high = _mass_travel(plant)
    return ActuatorLimits(
        V_b_least=plant.engine.low,
        V_b_greatest=plant.engine.high,
        r_px_aft=low,
        r_px_fore=high,
        r_px_nose_up=min(high, max(low, nose_up)),
        r_px_surface=min(high, max(low, surface)),
        r_px_calling=min(high, max(low, surface if tail_antenna else nose_up)),
        steering=plant.steering.limit,
        hold_mass=orders.laws.pitch.tolerance,
    )


def safety_limits(setup: Setup) -> SafetyLimits:
    """Numbers that the failsafes hold readings against, from what vehicle and plant are made of."""
    plant, hull, dives = setup.equipment.plant, setup.equipment.hull, setup.orders.dives
    low, high = _voltages(plant.battery)
    engine = plant.engine
    slowest = float(engine.pump_flow[engine.pump_flow > 0.0].min())
    return SafetyLimits(
        hull_rating_depth=hull.rating if math.isfinite(hull.rating) else UNRATED,
        submerged_depth=max(2.0, 2.0 * dives.shallow_depth),
        longest_submerged=2.0 * dives.abort_time + dives.abort_depth / SLOWEST_CLIMB,
        turning_time=2.0 * (engine.high - engine.low) / slowest + 60.0,
        least_voltage=0.95 * low,
        lowest_voltage=0.85 * low,
        greatest_voltage=1.1 * high,
        greatest_current=1.5 * _greatest_power(plant) / (0.85 * low),
        vacuum_lost=_vacuum_lost(hull),
        hull_flooding=1.05 * _NORMAL_PRESSURE,
        least_field=0.4 * EARTH_FIELD,
        greatest_field=2.0 * EARTH_FIELD,
    )


def coordinator_settings(setup: Setup, sample_interval: float, calibration: CompassCalibration) -> CoordinatorSettings:
    """Return the settings of the coordinator."""
    plant = setup.equipment.plant
    return CoordinatorSettings(
        safety=safety_limits(setup),
        actuators=actuator_limits(setup),
        has_drop_weight=plant.drop_weight > 0.0,
        declination=setup.equipment.sensors.declination,
        calibration=calibration,
        usable_energy=plant.battery.energy if math.isfinite(plant.battery.energy) else None,
        schedule=PowerSchedule(ctd=(sample_interval,) * len(PHASES)),
    )


def motion_settings(plant: Machinery, orders: Orders) -> MotionSettings:
    """Return the settings of the motion-control node: ends of the ways, and the speeds that it may expect."""
    engine, drive = plant.engine, plant.mass
    low, high = _mass_travel(plant)
    level = float(np.interp(0.0, drive.slope, drive.speed))
    return MotionSettings(
        ballast_low=engine.low,
        ballast_high=engine.high,
        mass_low=low,
        mass_high=high,
        steering_limit=plant.steering.limit,
        has_drop_weight=plant.drop_weight > 0.0,
        pump_flow=float(engine.pump_flow.max()),
        valve_flow=float(engine.valve_flow[engine.valve_flow > 0.0].min()),
        valve_fastest=float(engine.valve_flow.max()),
        mass_speed=level,
        steering_speed=plant.steering.speed,
        mass_tolerance=orders.laws.pitch.tolerance,
    )


def acquisition_settings(plant: Machinery) -> AcquisitionSettings:
    """Return the settings of the data-acquisition node."""
    low, high = _voltages(plant.battery)
    return AcquisitionSettings(voltage_low=0.85 * low, voltage_high=1.1 * high)


def known_disturbances(sensors: Sensors) -> CompassCalibration:
    """Return the calibration that a careful operator would have found: iron and actuators of the scenario, exact."""
    inverse = np.linalg.inv(np.array(sensors.soft_iron).reshape(3, 3))
    rows = tuple(tuple(float(cell) for cell in row) for row in inverse)
    return CompassCalibration(
        hard_iron=_in_ut(sensors.hard_iron, 1.0),
        correction=rows,  # type: ignore[arg-type]  # three rows of three
        pump=_in_ut(sensors.pump_field, 1.0 - sensors.shielding),
        valve=_in_ut(sensors.valve_field, 1.0 - sensors.shielding),
        pitch_drive=_in_ut(sensors.mass_field, 1.0 - sensors.shielding),
        steering=_in_ut(sensors.steering_field, 1.0 - sensors.shielding),
    )


def _in_ut(field: tuple[float, float, float], share: float) -> tuple[float, float, float]:
    x, y, z = field
    return (share * EARTH_FIELD * x, share * EARTH_FIELD * y, share * EARTH_FIELD * z)


def _mass_travel(plant: Machinery) -> tuple[float, float]:
    low, high = plant.mass.low, plant.mass.high
    return (low, high) if math.isfinite(low + high) else (-0.59, 0.59)


def _voltages(battery: Battery) -> tuple[float, float]:
    """Voltage without load of the empty and of the full battery [V]."""
    low, high = float(battery.open_voltage.min()), float(battery.open_voltage.max())
    return low, min(high, _MOST_VOLTAGE)


def _greatest_power(plant: Machinery) -> float:
    """All consumers and the engine at its strongest [W]."""
    engine: Engine = plant.engine
    pump = float(np.max(engine.pump_flow * engine.pump_j_m3))
    drive = float(np.max(plant.mass.speed * plant.mass.j_m)) + plant.steering.speed * plant.steering.j_rad
    return pump + drive + float(plant.loads.power.sum()) + float(plant.loads.call_power.sum()) + 10.0


def _vacuum_lost(hull: Hull) -> float:
    """Half the way from the pressure of the closed hull to that of the air outside [Pa]."""
    return max(0.5 * (hull.air_pressure + _NORMAL_PRESSURE), 1.2 * hull.air_pressure)
