"""Telemetry as a table: of each message how often it is said, how urgent it is, and what its fields are."""

import math
from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from stommel.control.dive_cycle import SURFACE
from stommel.geometry.earth import to_waypoint
from stommel.link.outbox import Priority
from stommel.link.values import boot_ms
from stommel.messages.mavlink import Fields, entry_words
from stommel.onboard.coordination.executive import State
from stommel.onboard.coordination.failsafes import Reaction
from stommel.onboard.coordination.navigation import NavigationEstimate
from stommel.onboard.radio.observed import Observed
from stommel.onboard.radio.sensor_health import sensor_health

STATES = tuple(State)
"""States of the executive by their numbers on the air."""
FIRST_MODE = 100
"""`custom_mode` of the first state: the lower numbers are modes of ArduSub, by whose names software shows them."""
_ALARM_BITS = {words: bit for bit, words in entry_words("GLIDER_ALARM").items()}
_UNKNOWN_16, _UNKNOWN_U16 = 0x7FFF, 0xFFFF

ARMED, CUSTOM_MODE = 128, 1
"""MAV_MODE_FLAG_SAFETY_ARMED, told while a mission is started, and MAV_MODE_FLAG_CUSTOM_MODE_ENABLED."""
_SUBMARINE, _GENERIC, _MAVLINK_2 = 12, 0, 3
_BOOT, _STANDBY, _ACTIVE, _CRITICAL, _EMERGENCY = 1, 3, 4, 5, 6
_NO_FIX, _FIX_3D = 1, 3


class TelemetryRow(NamedTuple):
    """A message that is said again and again."""

    name: str
    interval: float
    """Between two of them [s], if nobody asks for another."""
    priority: Priority
    fields: Callable[[Observed], Fields | None]
    """None where there is nothing to say yet."""


def clipped(value: float, bits: int, *, signed: bool, unknown: int = 0) -> int:
    """Nearest whole number that a field of so many bits holds; what is no number is `unknown`."""
    if math.isnan(value):
        return unknown
    low, high = (-(1 << bits - 1), (1 << bits - 1) - 1) if signed else (0, (1 << bits) - 1)
    return int(min(max(value, low), high)) if math.isinf(value) else min(max(round(value), low), high)


def degrees_e7(angle: float) -> int:
    """An angle [rad] in 1e-7 deg."""
    return clipped(math.degrees(angle) * 1e7, 32, signed=True)


def heartbeat(seen: Observed) -> Fields:
    """Type, mode and state as ordinary MAVLink software shows them; the mode is the executive's state."""
    executive, worst = seen.view.executive, seen.view.safety.worst
    status = _STANDBY
    if worst >= Reaction.ABORT or executive.state is State.ABORT:
        status = _EMERGENCY
    elif worst >= Reaction.NO_DIVE:
        status = _CRITICAL
    elif executive.state is State.START_UP:
        status = _BOOT
    elif executive.started:
        status = _ACTIVE
    return {
        "type": _SUBMARINE,
        "autopilot": _GENERIC,
        "base_mode": CUSTOM_MODE | (ARMED if executive.started else 0),
        "custom_mode": FIRST_MODE + STATES.index(executive.state),
        "system_status": status,
        "mavlink_version": _MAVLINK_2,
    }


def _velocity(memory: np.record, navigation: NavigationEstimate, psi: float) -> tuple[float, float, float]:
    """Over ground to the north, to the east, and down, by dead reckoning [m/s]."""
    speed, down = float(memory["path_speed"]), float(memory["vertical_speed"])
    level = math.sqrt(max(0.0, speed * speed - down * down))
    return level * math.cos(psi) + navigation.current_north, level * math.sin(psi) + navigation.current_east, down


def _display(seen: Observed) -> Fields | None:
    """What a pilot sees: ground software takes speed and height from here."""
    navigation = seen.view.navigation
    if navigation is None or seen.memory is None:
        return None
    readings = seen.view.situation.readings
    north, east, down = _velocity(seen.memory, navigation, readings.psi)
    return {
        "airspeed": float(seen.memory["path_speed"]),
        "groundspeed": math.hypot(north, east),
        "alt": -readings.depth,
        "climb": -down,
        "heading": clipped(math.degrees(readings.psi), 16, signed=True) % 360,
    }


def _position(seen: Observed) -> Fields | None:
    navigation = seen.view.navigation
    if navigation is None or seen.memory is None:
        return None
    readings = seen.view.situation.readings
    above = clipped(-1e3 * readings.depth, 32, signed=True)
    north, east, down = _velocity(seen.memory, navigation, readings.psi)
    return {
        "time_boot_ms": boot_ms(seen.t),
        "lat": degrees_e7(navigation.latitude),
        "lon": degrees_e7(navigation.longitude),
        "alt": above,
        "relative_alt": above,
        "vx": clipped(100.0 * north, 16, signed=True),
        "vy": clipped(100.0 * east, 16, signed=True),
        "vz": clipped(100.0 * down, 16, signed=True),
        "hdg": clipped(100.0 * math.degrees(readings.psi), 32, signed=True) % 36000
        if math.isfinite(readings.psi)
        else _UNKNOWN_U16,
    }


def _attitude(seen: Observed) -> Fields:
    readings = seen.view.situation.readings
    return {
        "time_boot_ms": boot_ms(seen.t),
        "roll": math.atan2(readings.down_b2, readings.down_b3),
        "pitch": readings.theta,
        "yaw": readings.psi,
    }


def _gps(seen: Observed) -> Fields | None:
    fix = seen.fix
    if fix is None:
        return {"fix_type": _NO_FIX, "satellites_visible": 255, "eph": _UNKNOWN_U16, "epv": _UNKNOWN_U16}
    known = math.isfinite(fix.utc)
    return {
        "time_usec": clipped(1e6 * (fix.utc if known else fix.t), 64, signed=False),
        "fix_type": _FIX_3D,
        "lat": degrees_e7(fix.latitude),
        "lon": degrees_e7(fix.longitude),
        "eph": _UNKNOWN_U16,
        "epv": _UNKNOWN_U16,
        "vel": clipped(100.0 * fix.speed, 16, signed=False, unknown=_UNKNOWN_U16),
        "cog": clipped(100.0 * (math.degrees(fix.course) % 360.0), 16, signed=False, unknown=_UNKNOWN_U16),
        "satellites_visible": min(fix.satellites, 255),
        "h_acc": clipped(1e3 * fix.sigma, 32, signed=False),
    }


def _share_left(seen: Observed) -> float:
    """Of the battery [%]; not a number where nobody said what it holds."""
    battery = seen.view.battery
    if battery is None or not battery.used + battery.left > 0.0:
        return math.nan
    return 100.0 * battery.left / (battery.used + battery.left)


def _system_status(seen: Observed) -> Fields:
    battery = seen.said("Battery")
    return sensor_health(seen.view.safety) | {
        "voltage_battery": clipped(1e3 * battery.get("voltage", math.nan), 16, signed=False, unknown=_UNKNOWN_U16),
        "current_battery": clipped(100.0 * battery.get("current", math.nan), 16, signed=True, unknown=-1),
        "battery_remaining": clipped(_share_left(seen), 8, signed=True, unknown=-1),
    }


def _battery(seen: Observed) -> Fields | None:
    said = seen.said("Battery")
    if not said:
        return None
    account = seen.view.battery
    left = math.inf if account is None else 3600.0 * account.hours_left
    return {
        "temperature": clipped(100.0 * said["temperature"], 16, signed=True, unknown=_UNKNOWN_16),
        "voltages": (clipped(1e3 * said["voltage"], 16, signed=False), *[_UNKNOWN_U16] * 9),
        "current_battery": clipped(100.0 * said["current"], 16, signed=True),
        "current_consumed": -1,
        "energy_consumed": -1 if account is None else clipped(account.used / 100.0, 32, signed=True),
        "battery_remaining": clipped(_share_left(seen), 8, signed=True, unknown=-1),
        "time_remaining": clipped(left, 32, signed=True) if math.isfinite(left) else 0,
    }


def surface_time_left(seen: Observed) -> float:
    """Until the next dive [s]; not a number under way, or when none is to come."""
    memory, orders, executive = seen.memory, seen.orders, seen.view.executive
    if memory is None or orders is None or executive.state is not State.COMMUNICATE or executive.no_dive:
        return math.nan
    if int(memory["phase"]) != SURFACE:
        return math.nan
    return max(0.0, orders.dives.surface_time - (seen.t - float(memory["since"])))


def _glider_state(seen: Observed) -> Fields:
    view, memory = seen.view, seen.memory
    readings = view.situation.readings
    alarms = sum(_ALARM_BITS.get(alarm.name, 0) for alarm in view.safety.active)
    return {
        "time_boot_ms": boot_ms(seen.t),
        "phase": view.executive.phase,
        "executive": STATES.index(view.executive.state),
        "dive": dive_number(seen),
        "waypoint": 0 if memory is None else clipped(float(memory["waypoint"]), 16, signed=False),
        "depth": readings.depth,
        "altitude": readings.altitude if math.isfinite(readings.altitude) else math.nan,
        "surface_time_left": surface_time_left(seen),
        "mission": seen.mission,
        "alarms": alarms,
    }


def dive_number(seen: Observed) -> int:
    """Number of this dive, or at the surface of the last one; 0 before the first."""
    return 0 if seen.memory is None else clipped(float(seen.memory["dives"]), 16, signed=False)


def _engine(seen: Observed) -> Fields | None:
    said, drives = seen.said("MotionStatus"), seen.said("MotionDrives")
    if not said:
        return None
    flags = bool(drives.get("pump_running")) | bool(drives.get("valve_open")) << 1
    return {
        "time_boot_ms": boot_ms(seen.t),
        "ballast": said["ballast"],
        "ballast_setpoint": seen.view.commands.V_b,
        "current": drives.get("pump_current", math.nan),
        "flags": flags | bool(drives.get("engine_stuck")) << 2,
    }


def _mass(seen: Observed) -> Fields | None:
    said, drives = seen.said("MotionStatus"), seen.said("MotionDrives")
    if not said:
        return None
    names = ("mass_moving", "steering_moving", "mass_stuck", "steering_stuck")
    return {
        "time_boot_ms": boot_ms(seen.t),
        "position": said["moving_mass"],
        "position_setpoint": seen.view.commands.r_px,
        "current": drives.get("mass_current", math.nan),
        "steering": said["steering"],
        "steering_setpoint": seen.view.commands.steering,
        "flags": sum(bool(drives.get(name)) << k for k, name in enumerate(names)),
    }


def _energy(seen: Observed) -> Fields | None:
    said, account = seen.said("Battery"), seen.view.battery
    if not said:
        return None
    return {
        "time_boot_ms": boot_ms(seen.t),
        "voltage": said["voltage"],
        "current": said["current"],
        "energy_used": math.nan if account is None else account.used,
        "energy_left": math.nan if account is None else account.left,
        "temperature": said["temperature"],
    }


def waypoint_distance(seen: Observed) -> float:
    """To the waypoint that is aimed at [m]; not a number where there is none."""
    memory, orders, navigation = seen.memory, seen.orders, seen.view.navigation
    if memory is None or orders is None or navigation is None or not int(memory["waypoint"]) < len(orders.waypoints):
        return math.nan
    latitude, longitude = orders.waypoints[int(memory["waypoint"])]
    return math.hypot(*to_waypoint(navigation.latitude, navigation.longitude, float(latitude), float(longitude)))


def _navigation(seen: Observed) -> Fields | None:
    estimate = seen.view.navigation
    if estimate is None:
        return None
    return {
        "time_boot_ms": boot_ms(seen.t),
        "latitude": degrees_e7(estimate.latitude),
        "longitude": degrees_e7(estimate.longitude),
        "sigma": math.hypot(estimate.sigma_north, estimate.sigma_east) / math.sqrt(2.0),
        "current_north": estimate.current_north,
        "current_east": estimate.current_east,
        "waypoint_distance": waypoint_distance(seen),
        "fix_age": estimate.since_fix if math.isfinite(estimate.since_fix) else math.nan,
    }


def _system_time(seen: Observed) -> Fields:
    return {"time_unix_usec": clipped(1e6 * seen.utc, 64, signed=False), "time_boot_ms": boot_ms(seen.t)}


TELEMETRY = (
    TelemetryRow("HEARTBEAT", 1.0, Priority.STATE, heartbeat),
    TelemetryRow("GLIDER_STATE", 2.0, Priority.STATE, _glider_state),
    TelemetryRow("GLOBAL_POSITION_INT", 5.0, Priority.STATE, _position),
    TelemetryRow("NAVIGATION_ESTIMATE", 10.0, Priority.STATE, _navigation),
    TelemetryRow("GPS_RAW_INT", 5.0, Priority.STATE, _gps),
    TelemetryRow("VFR_HUD", 5.0, Priority.STATE, _display),
    TelemetryRow("ATTITUDE", 2.0, Priority.STATE, _attitude),
    TelemetryRow("SYS_STATUS", 5.0, Priority.STATE, _system_status),
    TelemetryRow("BATTERY_STATUS", 20.0, Priority.STATE, _battery),
    TelemetryRow("ENERGY_STATE", 20.0, Priority.STATE, _energy),
    TelemetryRow("BUOYANCY_ENGINE_STATE", 5.0, Priority.STATE, _engine),
    TelemetryRow("MOVING_MASS_STATE", 5.0, Priority.STATE, _mass),
    TelemetryRow("SYSTEM_TIME", 10.0, Priority.STATE, _system_time),
)
"""What the vehicle tells while its radio is on, the most urgent first."""
