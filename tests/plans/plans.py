"""A plan that can be flown, to change in tests."""

from copy import deepcopy
from typing import Any

PLAN: dict[str, Any] = {
    "format": 1,
    "name": "To the shelf break",
    "vehicle": "zju",
    "start": {"latitude_deg": 28.70, "longitude_deg": 126.10},
    "start_time": "2026-07-01T00:00:00Z",
    "duration_days": 1,
    "waypoints": [
        {"latitude_deg": 28.67, "longitude_deg": 126.13},
        {"latitude_deg": 28.70, "longitude_deg": 126.16},
    ],
    "dives": {"depth_m": 70, "pitch_deg": 30, "speed_m_s": 0.5, "least_altitude_m": 10},
    "surface": {"session_s": 180},
    "water": {"ocean": "east_china_sea"},
}


def plan_with(**changes: Any) -> dict[str, Any]:
    """The plan with other values of some keys; None takes a key out. A table is replaced as a whole."""
    changed = deepcopy(PLAN) | changes
    return {key: value for key, value in changed.items() if value is not None}


def place(latitude: float, longitude: float) -> dict[str, float]:
    return {"latitude_deg": latitude, "longitude_deg": longitude}
