"""A made-up glider for developing the page: sawtooth dives as plain formulas of time. Not a model of anything."""

import math
from typing import Any

EPOCH = 1_777_800_000.0
DIVE_S, SURFACE_S, DEPTH_M = 2400.0, 480.0, 180.0
CYCLE_S = DIVE_S + SURFACE_S
START = (30.72, 126.20)
SPEED_M_S = 0.31
COURSE_DEG = 118.0

CHANNELS: list[tuple[str, str, str, str, float]] = [
    ("depth_m", "depth", "m", "motion", 2.0),
    ("altitude_m", "height above the sea floor", "m", "motion", 2.0),
    ("state", "state of the vehicle", "", "state", 2.0),
    ("phase", "phase of the dive", "", "state", 2.0),
    ("dive", "number of the dive", "", "state", 2.0),
    ("pitch_deg", "pitch, nose up", "deg", "attitude", 2.0),
    ("roll_deg", "roll, right side down", "deg", "attitude", 2.0),
    ("heading_deg", "heading", "deg", "attitude", 2.0),
    ("climb_m_s", "vertical speed, upwards", "m/s", "motion", 5.0),
    ("speed_through_water_m_s", "speed through the water", "m/s", "motion", 5.0),
    ("latitude_deg", "latitude", "deg", "navigation", 5.0),
    ("longitude_deg", "longitude", "deg", "navigation", 5.0),
    ("position_sigma_m", "the position may be wrong by", "m", "navigation", 10.0),
    ("waypoint_distance_m", "distance to the waypoint", "m", "navigation", 10.0),
    ("current_north_m_s", "current to the north", "m/s", "navigation", 10.0),
    ("current_east_m_s", "current to the east", "m/s", "navigation", 10.0),
    ("ballast_ml", "oil outside of the hull", "ml", "actuators", 5.0),
    ("ballast_setpoint_ml", "oil that is asked for", "ml", "actuators", 5.0),
    ("pump_current_a", "current of the pump", "A", "actuators", 5.0),
    ("moving_mass_mm", "moving mass, forward", "mm", "actuators", 5.0),
    ("moving_mass_setpoint_mm", "moving mass, asked for", "mm", "actuators", 5.0),
    ("steering_deg", "rudder or rolling mass", "deg", "actuators", 5.0),
    ("voltage_v", "voltage of the battery", "V", "energy", 20.0),
    ("battery_current_a", "current out of the battery", "A", "energy", 20.0),
    ("energy_used_kj", "energy used", "kJ", "energy", 20.0),
    ("energy_left_kj", "energy left", "kJ", "energy", 20.0),
    ("battery_left_share", "share of the battery that is left", "", "energy", 5.0),
    ("temperature_degc", "temperature of the sea", "degC", "samples", 600.0),
    ("conductivity_s_m", "conductivity of the sea", "S/m", "samples", 600.0),
    ("pressure_dbar", "pressure of the sea", "dbar", "samples", 600.0),
    ("link_loss_share", "share of frames that were lost", "", "link", 10.0),
]
STATES = {0: "start-up", 1: "hold", 2: "communicate", 3: "mission", 4: "ascend", 5: "recover", 6: "abort"}
PHASES = {0: "surface", 1: "descent", 2: "inflection", 3: "ascent", 4: "recovery", 5: "drift"}

WAITING = {"commands": 0, "parameters": 0, "missions": 0, "transfers": 0, "abort": None}


def phase_of(u: float) -> int:
    """Phase at a share u of the dive, beyond 1 at the surface."""
    return 0 if u >= 1.0 else 1 if u < 0.46 else 2 if u < 0.52 else 3


def values(t: float) -> dict[str, float]:
    """Every channel at t."""
    elapsed = t - EPOCH
    dive, into = divmod(elapsed, CYCLE_S)
    u = into / DIVE_S
    phase = phase_of(u)
    depth = DEPTH_M * (1.0 - abs(2.0 * min(u, 1.0) - 1.0)) + 0.3 * math.sin(elapsed / 3.0)
    pitch = {0: 2.0, 1: -26.0, 2: -26.0 + 52.0 * (u - 0.46) / 0.06, 3: 26.0}[phase] + 0.6 * math.sin(elapsed / 11.0)
    under = depth if phase else 0.0
    gone = SPEED_M_S * elapsed
    north, east = gone * math.cos(math.radians(COURSE_DEG)), gone * math.sin(math.radians(COURSE_DEG))
    return {
        "depth_m": max(0.0, under),
        "altitude_m": 320.0 - under,
        "state": 3.0 if phase else 2.0,
        "phase": float(phase),
        "dive": dive + 1.0,
        "pitch_deg": pitch,
        "roll_deg": 4.0 * math.sin(elapsed / 60.0),
        "heading_deg": (COURSE_DEG + 6.0 * math.sin(elapsed / 90.0)) % 360.0,
        "climb_m_s": {0: 0.0, 1: -0.15, 2: 0.0, 3: 0.15}[phase],
        "speed_through_water_m_s": 0.34 if phase else 0.05,
        "latitude_deg": START[0] + north / 111_200.0,
        "longitude_deg": START[1] + east / 95_600.0,
        "position_sigma_m": 8.0 + (400.0 * u if phase else 0.0),
        "waypoint_distance_m": max(0.0, 21_000.0 - gone % 21_000.0),
        "current_north_m_s": 0.06,
        "current_east_m_s": 0.17,
        "ballast_ml": {0: 380.0, 1: -350.0, 2: -350.0 + 700.0 * (u - 0.46) / 0.06, 3: 350.0}[phase],
        "ballast_setpoint_ml": -350.0 if phase == 1 else 350.0,
        "pump_current_a": 2.4 if phase == 2 else 0.0,
        "moving_mass_mm": -pitch * 0.9,
        "moving_mass_setpoint_mm": -30.0 if pitch > 0 else 30.0,
        "steering_deg": 3.0 * math.sin(elapsed / 90.0),
        "voltage_v": 28.4 - elapsed / 4.0e5 - (0.4 if phase == 2 else 0.0),
        "battery_current_a": 0.11 + (2.4 if phase == 2 else 0.0),
        "energy_used_kj": elapsed * 0.003,
        "energy_left_kj": 8200.0 - elapsed * 0.003,
        "battery_left_share": max(0.0, 0.83 - elapsed / 4.0e6),
        "temperature_degc": 8.0 + 14.0 * math.exp(-under / 60.0),
        "conductivity_s_m": 3.6 + 1.2 * math.exp(-under / 60.0),
        "pressure_dbar": under * 1.008,
        "link_loss_share": 0.02,
    }


def summary(vehicle: int, now: float, speed: float) -> dict[str, Any]:
    """Summary of the glider that flies (1) or of the one that never spoke (2)."""
    if vehicle == 2:
        reason = "nothing has come from this vehicle yet"
        empty = ("last_contact", "state", "phase", "dive", "waypoint", "mission", "position", "battery",
                 "next_surfacing", "speed_made_good", "current", "waypoint_distance_m", "eta", "holder")  # fmt: skip
        return {
            "vehicle": 2, "name": "Sea-Wing 12", "model": "seawing", "simulated": False, "speed": 1.0, "now": now,
            "heard": False, "link_reason": "waits for the first frame on serial /dev/ttyUSB0", "alarms": [],
            **dict.fromkeys(empty), "missing": dict.fromkeys(empty, reason), "told": {}, "waiting": WAITING,
        }  # fmt: skip
    found = values(now)
    dive_begin = EPOCH + (found["dive"] - 1.0) * CYCLE_S
    up = dive_begin + DIVE_S
    last = {"dive": int(found["dive"]) - 1, "t": dive_begin - SURFACE_S}
    return {
        "vehicle": 1, "name": "ZJU glider", "model": "zju", "simulated": True, "speed": speed, "now": now,
        "heard": True, "last_contact": now - 3.0, "link_reason": None, "state": STATES[int(found["state"])],
        "phase": PHASES[int(found["phase"])], "dive": int(found["dive"]), "waypoint": 2, "mission": "east china sea",
        "alarms": [{"id": 1, "vehicle": 1, "key": "position_sigma_m", "words": "the position may be wrong by 380 m",
                    "severity": "warning", "raised": dive_begin, "acknowledged": None, "acknowledged_by": None}]
        if found["position_sigma_m"] > 200.0
        else [],
        "position": {"latitude": found["latitude_deg"], "longitude": found["longitude_deg"], "t": now - 3.0,
                     "sigma_m": found["position_sigma_m"], "source": "estimate", "doubt": None},
        "battery": {"share": found["battery_left_share"], "voltage_v": found["voltage_v"], "t": now - 12.0},
        "next_surfacing": {"t": up, "why": f"end of dive {int(found['dive'])} as the last dives went"}
        if now < up
        else None,
        "speed_made_good": {"m_s": 0.29, "course_deg": 112.0, **last},
        "current": {"north_m_s": 0.06, "east_m_s": 0.17, **last},
        "told": dict.fromkeys(("state", "phase", "dive", "waypoint", "mission", "waypoint_distance_m"), now - 3.0),
        "waypoint_distance_m": found["waypoint_distance_m"], "eta": {"t": now + found["waypoint_distance_m"] / 0.29},
        "missing": {} if now < up else {"next_surfacing": "it is at the surface"}, "holder": "anna",
        "waiting": WAITING,
    }  # fmt: skip
