"""Channels of telemetry: what every value of a vehicle is called, its unit, how often it comes, and out of what."""

import math
from collections.abc import Callable, Mapping
from functools import cache
from typing import NamedTuple

from stommel.link.service import Received
from stommel.messages.mavlink import Fields, entry_words

DEGREES = math.degrees(1.0)
FULL_TURN = 360.0
"""[deg]"""


class Channel(NamedTuple):
    """A value over time."""

    key: str
    """In archive, API and products; its ending is the unit."""
    words: str
    unit: str
    """As people read it; empty for a number without one."""
    group: str
    message: str
    """Of MAVLink; `-` for what the station itself measures."""
    value: Callable[[Fields], float | None]
    """Of the fields of the message; None where they do not tell."""
    period_s: float
    """Between two values while the vehicle is heard."""
    low: float
    high: float
    """Values outside cannot be; they are still kept as they came."""
    standard_name: str = ""
    """Of the CF conventions; empty where there is none."""
    enumeration: str = ""
    """Of `glider.xml`, whose entries the values are."""
    turn: float | None = None
    """Full turn after which the values begin anew, in the unit; None where they do not."""

    @property
    def values(self) -> Mapping[int, str]:
        """What the numbers mean, where they stand for words."""
        return entry_words(self.enumeration) if self.enumeration else {}


def _of(field: str, scale: float = 1.0) -> Callable[[Fields], float | None]:
    """A field; what is not a number is not told."""

    def value(fields: Fields) -> float | None:
        found = fields[field]
        assert isinstance(found, int | float)
        return found * scale if math.isfinite(found) else None

    return value


def _unless(field: str, unknown: int, scale: float = 1.0) -> Callable[[Fields], float | None]:
    """A field of whole numbers, one of which says that it is not known."""

    def value(fields: Fields) -> float | None:
        found = fields[field]
        assert isinstance(found, int | float)
        return None if found == unknown else found * scale

    return value


def _heading(fields: Fields) -> float | None:
    yaw = fields["yaw"]
    assert isinstance(yaw, float)
    return math.degrees(yaw) % 360.0 if math.isfinite(yaw) else None


def _flag(field: str, bit: int) -> Callable[[Fields], float | None]:
    def value(fields: Fields) -> float | None:
        found = fields[field]
        assert isinstance(found, int)
        return float(bool(found & bit))

    return value


def _told(_: Fields) -> float | None:
    """Of a channel that the station measures: no message tells it."""
    return None


_STATE, _PLACE, _WAY, _GPS = "GLIDER_STATE", "GLOBAL_POSITION_INT", "NAVIGATION_ESTIMATE", "GPS_RAW_INT"
_ENGINE, _MASS, _ENERGY, _CTD = "BUOYANCY_ENGINE_STATE", "MOVING_MASS_STATE", "ENERGY_STATE", "CTD_SAMPLE"
_ALL = math.inf

CHANNELS: tuple[Channel, ...] = (
    Channel("depth_m", "depth", "m", "motion", _STATE, _of("depth"), 2.0, -5.0, 12_000.0, "depth"),
    Channel("altitude_m", "height above the sea floor", "m", "motion", _STATE, _of("altitude"), 2.0, 0.0, 12_000.0,
            "height_above_sea_floor"),
    Channel("state", "state of the vehicle", "", "state", _STATE, _of("executive"), 2.0, 0.0, 255.0, "",
            "GLIDER_EXECUTIVE"),
    Channel("phase", "phase of the dive", "", "state", _STATE, _of("phase"), 2.0, 0.0, 255.0, "", "GLIDER_PHASE"),
    Channel("dive", "number of the dive", "", "state", _STATE, _of("dive"), 2.0, 0.0, 65_535.0),
    Channel("waypoint", "number of the waypoint, from 1", "", "state", _STATE,
            lambda fields: float(fields["waypoint"]) + 1.0,  # type: ignore[arg-type]
            2.0, 1.0, 65_536.0),
    Channel("mission", "number of the mission", "", "state", _STATE, _of("mission"), 2.0, 0.0, 4.3e9),
    Channel("surface_time_left_s", "until the next dive", "s", "state", _STATE, _of("surface_time_left"), 2.0, 0.0,
            86_400.0),
    Channel("vehicle_alarms", "alarms aboard, one bit each", "", "state", _STATE, _of("alarms"), 2.0, 0.0, 1.9e19),
    Channel("pitch_deg", "pitch, nose up", "deg", "attitude", "ATTITUDE", _of("pitch", DEGREES), 2.0, -90.0, 90.0,
            "platform_pitch"),
    Channel("roll_deg", "roll, right side down", "deg", "attitude", "ATTITUDE", _of("roll", DEGREES), 2.0, -180.0,
            180.0, "platform_roll", turn=FULL_TURN),
    Channel("heading_deg", "heading", "deg", "attitude", "ATTITUDE", _heading, 2.0, 0.0, 360.0,
            "platform_orientation", turn=FULL_TURN),
    Channel("speed_through_water_m_s", "speed through the water", "m/s", "motion", "VFR_HUD", _of("airspeed"), 5.0,
            0.0, 10.0, "platform_speed_wrt_sea_water"),
    Channel("speed_over_ground_m_s", "speed over ground", "m/s", "motion", "VFR_HUD", _of("groundspeed"), 5.0, 0.0,
            10.0, "platform_speed_wrt_ground"),
    Channel("climb_m_s", "vertical speed, upwards", "m/s", "motion", "VFR_HUD", _of("climb"), 5.0, -5.0, 5.0),
    Channel("latitude_deg", "latitude", "deg", "navigation", _PLACE, _of("lat", 1e-7), 5.0, -90.0, 90.0, "latitude"),
    Channel("longitude_deg", "longitude", "deg", "navigation", _PLACE, _of("lon", 1e-7), 5.0, -180.0, 180.0,
            "longitude", turn=FULL_TURN),
    Channel("position_sigma_m", "standard deviation of the position", "m", "navigation", _WAY, _of("sigma"), 10.0, 0.0,
            1e6),
    Channel("fix_age_s", "time since the last position by GPS", "s", "navigation", _WAY, _of("fix_age"), 10.0, 0.0,
            1e8),
    Channel("waypoint_distance_m", "distance to the waypoint", "m", "navigation", _WAY, _of("waypoint_distance"), 10.0,
            0.0, 2.1e7),
    Channel("current_north_m_s", "current to the north", "m/s", "navigation", _WAY, _of("current_north"), 10.0, -5.0,
            5.0, "northward_sea_water_velocity"),
    Channel("current_east_m_s", "current to the east", "m/s", "navigation", _WAY, _of("current_east"), 10.0, -5.0, 5.0,
            "eastward_sea_water_velocity"),
    Channel("gps_satellites", "satellites of the last fix", "", "navigation", _GPS, _unless("satellites_visible", 255),
            5.0, 0.0, 255.0),
    Channel("gps_sigma_m", "accuracy of the last fix", "m", "navigation", _GPS, _of("h_acc", 1e-3), 5.0, 0.0, 1e6),
    Channel("ballast_ml", "oil outside of the hull", "ml", "actuators", _ENGINE, _of("ballast", 1e6), 5.0, -5000.0,
            5000.0),
    Channel("ballast_setpoint_ml", "oil that is asked for", "ml", "actuators", _ENGINE, _of("ballast_setpoint", 1e6),
            5.0, -5000.0, 5000.0),
    Channel("pump_current_a", "current of the pump", "A", "actuators", _ENGINE, _of("current"), 5.0, -100.0, 100.0),
    Channel("pump_running", "pump runs", "", "actuators", _ENGINE, _flag("flags", 1), 5.0, 0.0, 1.0),
    Channel("valve_open", "valve is open", "", "actuators", _ENGINE, _flag("flags", 2), 5.0, 0.0, 1.0),
    Channel("moving_mass_mm", "moving mass, forward", "mm", "actuators", _MASS, _of("position", 1e3), 5.0, -2000.0,
            2000.0),
    Channel("moving_mass_setpoint_mm", "moving mass, asked for", "mm", "actuators", _MASS,
            _of("position_setpoint", 1e3), 5.0, -2000.0, 2000.0),
    Channel("mass_current_a", "current of the mass drive", "A", "actuators", _MASS, _of("current"), 5.0, -100.0, 100.0),
    Channel("steering_deg", "rudder or rolling mass", "deg", "actuators", _MASS, _of("steering", DEGREES), 5.0, -180.0,
            180.0),
    Channel("steering_setpoint_deg", "rudder or rolling mass, asked for", "deg", "actuators", _MASS,
            _of("steering_setpoint", DEGREES), 5.0, -180.0, 180.0),
    Channel("voltage_v", "voltage of the battery", "V", "energy", _ENERGY, _of("voltage"), 20.0, 0.0, 1000.0),
    Channel("battery_current_a", "current out of the battery", "A", "energy", _ENERGY, _of("current"), 20.0, -1000.0,
            1000.0),
    Channel("energy_used_kj", "energy used", "kJ", "energy", _ENERGY, _of("energy_used", 1e-3), 20.0, 0.0, 1e9),
    Channel("energy_left_kj", "energy left", "kJ", "energy", _ENERGY, _of("energy_left", 1e-3), 20.0, 0.0, 1e9),
    Channel("battery_temperature_degc", "temperature of the battery", "degC", "energy", _ENERGY, _of("temperature"),
            20.0, -60.0, 150.0),
    Channel("battery_left_share", "share of the battery that is left", "", "energy", "SYS_STATUS",
            _unless("battery_remaining", -1, 0.01), 5.0, 0.0, 1.0),
    Channel("pressure_dbar", "pressure of the sea", "dbar", "samples", _CTD, _of("pressure"), 14_400.0, -10.0, 12_000.0,
            "sea_water_pressure"),
    Channel("temperature_degc", "temperature of the sea", "degC", "samples", _CTD, _of("temperature"), 14_400.0, -5.0,
            50.0, "sea_water_temperature"),
    Channel("conductivity_s_m", "conductivity of the sea", "S/m", "samples", _CTD, _of("conductivity"), 14_400.0, 0.0,
            10.0, "sea_water_electrical_conductivity"),
    Channel("link_loss_share", "share of frames that were lost", "", "link", "-", _told, 10.0, 0.0, 1.0),
    Channel("link_round_trip_s", "round trip of the radio", "s", "link", "-", _told, 10.0, 0.0, 3600.0),
    Channel("link_goodput_b_s", "new bytes of files", "B/s", "link", "-", _told, 10.0, 0.0, 1e9),
    Channel("link_waiting_b", "bytes that wait to be sent", "B", "link", "-", _told, 10.0, 0.0, 1e9),
)  # fmt: skip
"""All of them, in the order in which people want them."""

MEASURED = "-"
"""Message of a channel that the station itself measures."""
STALE_AFTER = 2.0
"""Periods after which a value is stale: one may just be on its way."""


@cache
def channel_named(key: str) -> Channel | None:
    """Return the channel of a key; None if there is none."""
    return next((channel for channel in CHANNELS if channel.key == key), None)


@cache
def channels_of(message: str) -> tuple[Channel, ...]:
    """Return the channels that a message tells."""
    return tuple(channel for channel in CHANNELS if channel.message == message)


def told_by(received: Received) -> list[tuple[str, float]]:
    """Return key and value of each channel that a message tells."""
    found = []
    for channel in channels_of(received.name):
        value = channel.value(received.values)
        if value is not None:
            found.append((channel.key, value))
    return found


def is_stale(age_s: float, period_s: float) -> bool:
    """Whether a value of this age is older than it should be while the vehicle is heard [s]."""
    return age_s > STALE_AFTER * period_s
